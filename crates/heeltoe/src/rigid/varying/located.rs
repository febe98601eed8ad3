//! Where on the integrated motion an event is: secants `t_(n+1) = t_n - v_n (t_n - t_(n-1)) / (v_n - v_(n-1))` on what falls
//! through zero there, each value by one step from the start.

use super::advance::{Trial, SHORT};
use super::step::State;
use super::walk::Varying;

/// Secants before giving up.
const ROUNDS: usize = 40;

impl Varying<'_> {
    /// Root of a function on the integrated motion, near a first guess: secants, kept within the step; the state there and
    /// the error of the step to it. None where the function has none there.
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
        let at = |t: f64| {
            let (state, error) = self.stepped(&trial.start, &trial.rate, trial.piece, t);
            (value(&state, t), state, error)
        };
        let mut t = guess.min(length);
        let (mut v, mut state, mut error) = at(t);
        let mut before = if t < length {
            (t + 1e-3 * (length - t)).min(length)
        } else {
            0.999 * t
        };
        let mut v_before = at(before).0;
        for _ in 0..ROUNDS {
            if v == 0.0 || v == v_before {
                break;
            }
            let next = (t - v * (t - before) / (v - v_before)).clamp(0.0, length);
            (before, v_before) = (t, v);
            if (next - t).abs() <= 4.0 * f64::EPSILON * t {
                break;
            }
            t = next;
            (v, state, error) = at(t);
        }
        // Its slope tells a fall through zero from a value that only comes near.
        let slope = ((v - v_before) / (t - before)).abs();
        let reach = slope * 1e-9 * length;
        // Secants that run into an end of the step twice have found nothing; a law of friction bends enough for that.
        let stuck = self.rubbing.is_some()
            && length > SHORT * self.time_scale
            && v.abs() > 1e-9 * value(&trial.start, 0.0).abs();
        let settled = v == 0.0 || ((v - v_before).abs() == 0.0 && !stuck) || v.abs() <= reach;
        // A gap that has just begun to open is zero at the start of the step, too.
        let back = t < 1e-6 * guess;
        (settled && !back && v.is_finite()).then_some((t, state, error))
    }
}
