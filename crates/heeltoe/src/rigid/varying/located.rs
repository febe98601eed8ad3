//! Where on the integrated motion an event is: Newton's iteration `t_(n+1) = t_n - v_n / v'_n` on what falls through zero
//! there, each state by one step from the start, its rate of change v' by a difference along the motion; the last bit of
//! the way is straight.

use super::advance::{Trial, SHORT};
use super::step::State;
use super::walk::Varying;

/// Steps before giving up.
const ROUNDS: usize = 40;
/// Of Newton's iteration on the polynomial through the ends of a step.
const GUESSES: usize = 2;
/// A root nearer than this part of the length is reached on a straight line: what bends the motion is less than rounding.
const NEXT: f64 = 1e-7;
/// Part of the length over which the rate of change is a difference.
const ASIDE: f64 = 1e-5;

impl Varying<'_> {
    /// Root of a function on the integrated motion, near a first guess, kept within the step; the state there and the
    /// error of the step to it. None where the function has none there.
    pub(super) fn located(
        &self,
        trial: &Trial,
        guess: f64,
        value: impl Fn(&State, f64) -> f64,
    ) -> Option<(f64, State, f64)> {
        let length = trial.length;
        if guess <= 0.0 {
            return Some((0.0, trial.start, 0.0));
        }
        let aside = ASIDE * length;
        let mut t = self.nearer(trial, guess.min(length), &value);
        let (mut state, mut error, mut v) = (trial.start, 0.0, 0.0);
        let (mut near, mut stays) = (false, false);
        for _ in 0..ROUNDS {
            let rate;
            (state, rate, error) = self.stepped(&trial.start, &trial.rate, trial.piece, t);
            v = value(&state, t);
            if v == 0.0 {
                near = true;
                break;
            }
            let beside = |way: f64| value(&along(&state, &rate, way * aside), t + way * aside);
            let slope = (beside(1.0) - beside(-1.0)) / (2.0 * aside);
            let next = (t - v / slope).clamp(0.0, length);
            near = (next - t).abs() <= NEXT * length && next > 0.0 && next < length;
            stays = next == t;
            if near {
                state = along(&state, &rate, next - t);
            }
            t = next;
            if near || stays || t.is_nan() {
                break;
            }
        }
        // A search that runs into an end of the step twice has found nothing where a law of friction bends enough for that.
        let stuck = !self.rubbing.settled()
            && length > SHORT * self.time_scale
            && v.abs() > 1e-9 * value(&trial.start, 0.0).abs();
        // A gap that has just begun to open is zero at the start of the step, too.
        let back = t < 1e-6 * guess;
        ((near || stays && !stuck) && !back && v.is_finite()).then_some((t, state, error))
    }
}

impl Varying<'_> {
    /// A better guess, on the polynomial through the ends of the step.
    fn nearer(&self, trial: &Trial, guess: f64, value: impl Fn(&State, f64) -> f64) -> f64 {
        let aside = ASIDE * trial.length;
        let at = |t: f64| value(&self.between(trial, t), t);
        let mut t = guess;
        for _ in 0..GUESSES {
            let next = t - at(t) * 2.0 * aside / (at(t + aside) - at(t - aside));
            if !(next > 0.0 && next < trial.length) {
                return guess;
            }
            t = next;
        }
        t
    }
}

/// The state a short time away.
fn along(state: &State, rate: &State, since: f64) -> State {
    std::array::from_fn(|i| state[i] + since * rate[i])
}
