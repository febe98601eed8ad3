//! Exact response of linear oscillators to a ground acceleration that is linear between samples.
//!
//! `u'' + 2 zeta w u' + w^2 u = -a(t)`. On a piece with `a = a0 + s t` the solution is
//!
//! `u = e^(-zeta w t) (A cos wd t + B sin wd t) + C + D t`, `D = -s / w^2`, `C = -a0 / w^2 + 2 zeta s / w^3`,
//!
//! so one step is a linear map of (u, u') and (a0, s) (Nigam and Jennings 1969). Peaks are not read off the samples:
//! where a rate changes its sign inside a piece the extreme is located there, and pieces longer than an eighth of the
//! period are split, so that none is missed. After the record the ground stands still and the oscillator is followed
//! for one more period, in which a long-period peak may lie.

use crate::parallel::each;
use crate::stop::Stop;

/// Largest relative displacement and largest total acceleration of one oscillator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    /// In m, for accelerations in m/s2.
    pub displacement: f64,
    /// Of ground and oscillator together.
    pub total_acceleration: f64,
}

/// The oscillator, by its circular frequency and damping ratio below one.
#[derive(Clone, Copy)]
struct Oscillator {
    frequency: f64,
    damping: f64,
    damped: f64,
    /// `2 zeta w` and `w^2`.
    drag: f64,
    stiffness: f64,
}

/// The map over one step of length h: (u, v, a0, s) -> (u, v).
#[derive(Clone, Copy)]
struct Step {
    length: f64,
    u: [f64; 4],
    v: [f64; 4],
}

impl Oscillator {
    fn new(frequency: f64, damping: f64) -> Self {
        Oscillator {
            frequency,
            damping,
            damped: frequency * (1.0 - damping * damping).sqrt(),
            drag: 2.0 * damping * frequency,
            stiffness: frequency * frequency,
        }
    }

    fn step(&self, h: f64) -> Step {
        let (w, z, wd) = (self.frequency, self.damping, self.damped);
        let decay = (-z * w * h).exp();
        let (sine, cosine) = (wd * h).sin_cos();
        let (c, s) = (decay * cosine, decay * sine / wd);
        // Displacement and velocity at h from unit values of A = u0 - C and v0 - D + zeta w A.
        let (free_u, free_v) = (c + z * w * s, s);
        let (rate_u, rate_v) = (-w * w * s, c - z * w * s);
        let (constant, ramp) = if w * h < 0.3 {
            self.short_step(h)
        } else {
            // C (1 - free) and D (h - free) for a unit acceleration and a unit slope.
            let (constant, lag) = (-(1.0 - free_u) / (w * w), (h - free_v) / (w * w));
            (constant, -2.0 * z / w * constant - lag)
        };
        // The velocity under a constant acceleration is the unit impulse response; under a ramp it is the displacement
        // under a constant one.
        Step {
            length: h,
            u: [free_u, free_v, constant, ramp],
            v: [rate_u, rate_v, -free_v, constant],
        }
    }

    /// Displacement after a short step under a unit acceleration and under a unit slope: the series of the unit impulse
    /// response integrated once and twice. The closed forms lose all digits there to cancellation.
    fn short_step(&self, h: f64) -> (f64, f64) {
        let (w, z) = (self.frequency, self.damping);
        let (mut before, mut term) = (0.0, 1.0);
        let (mut constant, mut ramp, mut power) = (0.0, 0.0, h * h);
        for n in 1..16 {
            let k = f64::from(n);
            constant -= term * power / (k + 1.0);
            ramp -= term * power * h / ((k + 1.0) * (k + 2.0));
            let next = -(2.0 * z * w * k * term + w * w * before) / (k * (k + 1.0));
            (before, term) = (term, next);
            power *= h;
        }
        (constant, ramp)
    }

    /// Relative acceleration.
    #[inline]
    fn rate(&self, u: f64, v: f64, a: f64) -> f64 {
        -a - self.drag * v - self.stiffness * u
    }
}

impl Step {
    #[inline]
    fn apply(&self, u: f64, v: f64, a: f64, s: f64) -> (f64, f64) {
        (
            self.u[0] * u + self.u[1] * v + self.u[2] * a + self.u[3] * s,
            self.v[0] * u + self.v[1] * v + self.v[2] * a + self.v[3] * s,
        )
    }
}

/// A function of the state along one piece.
trait Quantity {
    /// The function and its rate of change.
    fn value_and_rate(o: &Oscillator, state: [f64; 3]) -> [f64; 2];
    /// Rate of change of that rate.
    fn bend(o: &Oscillator, state: [f64; 3], slope: f64) -> f64;
}

/// Relative displacement.
struct Displacement;

impl Quantity for Displacement {
    #[inline]
    fn value_and_rate(_: &Oscillator, [u, v, _]: [f64; 3]) -> [f64; 2] {
        [u, v]
    }

    fn bend(o: &Oscillator, [u, v, a]: [f64; 3], _: f64) -> f64 {
        o.rate(u, v, a)
    }
}

/// Acceleration of ground and oscillator together.
struct Total;

impl Quantity for Total {
    #[inline]
    fn value_and_rate(o: &Oscillator, [u, v, a]: [f64; 3]) -> [f64; 2] {
        let total = -o.drag * v - o.stiffness * u;
        [total, -o.drag * (total - a) - o.stiffness * v]
    }

    fn bend(o: &Oscillator, [u, v, a]: [f64; 3], slope: f64) -> f64 {
        let rate = o.rate(u, v, a);
        -o.drag * (-slope - o.drag * rate - o.stiffness * v) - o.stiffness * rate
    }
}

/// One piece: displacement, velocity and ground acceleration at its start, slope of the ground, length.
struct Piece<'a> {
    oscillator: &'a Oscillator,
    start: [f64; 3],
    slope: f64,
    length: f64,
}

impl Piece<'_> {
    fn at(&self, t: f64) -> [f64; 3] {
        let [u, v, a] = self.start;
        let (u, v) = self.oscillator.step(t).apply(u, v, a, self.slope);
        [u, v, a + self.slope * t]
    }

    /// Largest size of a quantity at the turning points inside the piece; `end` is the state at its end. Nothing is
    /// looked for that could not exceed `known`.
    #[inline]
    fn turning<Q: Quantity>(&self, end: [f64; 3], known: f64) -> f64 {
        let o = self.oscillator;
        let ([f0, g0], [f1, g1]) = (Q::value_and_rate(o, self.start), Q::value_and_rate(o, end));
        let bend = |state| Q::bend(o, state, self.slope);
        let (b0, b1) = (bend(self.start), bend(end));
        // Inside, a rate exceeds those at both ends by half the length times the largest rate of its own, which on an
        // eighth of a period is less than twice the larger one of the ends.
        let fastest = g0.abs().max(g1.abs()) + self.length * b0.abs().max(b1.abs());
        if f0.abs().max(f1.abs()) + self.length * fastest <= known {
            return 0.0;
        }
        // From rest, or to rest, the way is that of the rate just after or just before.
        let rises = g0 > 0.0 || (g0 == 0.0 && b0 > 0.0);
        let turns = rises != (g1 > 0.0 || (g1 == 0.0 && b1 < 0.0));
        if turns {
            // Seen as a maximum of `up * f`. Where that is concave it stays below both tangents.
            let up = if rises { 1.0 } else { -1.0 };
            let concave = up * b0 <= 0.0 && up * b1 <= 0.0;
            let meet = (up * (f1 - f0) + g1.abs() * self.length) / (g0.abs() + g1.abs());
            if concave && up * f0 + g0.abs() * meet <= known {
                return 0.0;
            }
        } else if g0 * b0 >= 0.0 || g1 * b1 <= 0.0 {
            // Else the rate may cross zero and come back: it bends towards zero first and away from it later.
            return 0.0;
        }
        let value = |t| Q::value_and_rate(o, self.at(t))[0].abs();
        let rate = |state| Q::value_and_rate(o, state)[1];
        if turns {
            return value(self.root(0.0, self.length, rises, rate));
        }
        let middle = self.root(0.0, self.length, b0 > 0.0, bend);
        if (rate(self.at(middle)) > 0.0) == rises {
            return 0.0;
        }
        let first = self.root(0.0, middle, rises, rate);
        let second = self.root(middle, self.length, !rises, rate);
        value(first).max(value(second))
    }

    /// Moment in `(low, high)` at which `f`, positive or not just after `low`, changes its sign: the secant method inside
    /// the bracket.
    fn root(&self, mut low: f64, mut high: f64, positive: bool, f: impl Fn([f64; 3]) -> f64) -> f64 {
        let (mut f_low, mut f_high) = (f(self.at(low)), f(self.at(high)));
        let mut t = low;
        // A turning point is flat: an error e in time is e^2 in value, so a few rounds reach rounding.
        for round in 0..60 {
            t = if round % 3 == 2 {
                0.5 * (low + high)
            } else {
                low - f_low * (high - low) / (f_high - f_low)
            };
            if !(t > low && t < high) {
                t = 0.5 * (low + high);
            }
            let f_t = f(self.at(t));
            if f_t == 0.0 || high - low < 1e-9 * self.length {
                break;
            }
            if (f_t > 0.0) == positive {
                (low, f_low) = (t, f_t);
            } else {
                (high, f_high) = (t, f_t);
            }
        }
        t
    }
}

/// Peaks of one oscillator of circular frequency `frequency` > 0 and damping ratio in [0, 1).
pub fn peak(time: &[f64], ground: &[f64], frequency: f64, damping: f64) -> Peak {
    let o = Oscillator::new(frequency, damping);
    let longest = std::f64::consts::TAU / frequency / 8.0;
    let mut step = o.step(longest);
    let (mut known_length, mut parts, mut inverse) = (longest, 1.0, 1.0 / longest);
    let (mut u, mut v) = (0.0, 0.0);
    let mut largest = Peak::default();
    let mut walk = |length: f64, a_start: f64, a_end: f64| {
        if length <= 0.0 {
            return;
        }
        // Equal steps differ by the rounding of their times; that is no other step, and divisions are dear.
        if (length - known_length).abs() > 1e-9 * length {
            known_length = length;
            parts = (length / longest).ceil().max(1.0);
            step = o.step(length / parts);
            inverse = 1.0 / length;
        }
        let h = step.length;
        let s = (a_end - a_start) * inverse;
        for k in 0..parts as usize {
            let a = a_start + s * (k as f64 * h);
            let (u1, v1) = step.apply(u, v, a, s);
            let piece = Piece {
                oscillator: &o,
                start: [u, v, a],
                slope: s,
                length: h,
            };
            let end = [u1, v1, a + s * h];
            let known = largest.displacement.max(u1.abs());
            largest.displacement = known.max(piece.turning::<Displacement>(end, known));
            let known = largest
                .total_acceleration
                .max((o.drag * v1 + o.stiffness * u1).abs());
            largest.total_acceleration = known.max(piece.turning::<Total>(end, known));
            (u, v) = (u1, v1);
        }
    };
    for k in 1..time.len() {
        walk(time[k] - time[k - 1], ground[k - 1], ground[k]);
    }
    walk(8.0 * longest, 0.0, 0.0);
    largest
}

/// Peaks of many oscillators, by their periods; a period of zero is the ground itself.
pub fn spectrum(time: &[f64], ground: &[f64], periods: &[f64], damping: f64, stop: Stop) -> Vec<Peak> {
    each(periods.len(), 1, |k| {
        if stop.asked() {
            return Peak::default();
        }
        if periods[k] == 0.0 {
            let pga = ground.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
            return Peak {
                displacement: 0.0,
                total_acceleration: pga,
            };
        }
        peak(time, ground, std::f64::consts::TAU / periods[k], damping)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn close(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance * b.abs(), "{a} instead of {b}");
    }

    #[test]
    fn a_step_of_acceleration_overshoots_by_the_closed_form() {
        for damping in [0.0, 0.02, 0.05, 0.3] {
            let w = 2.0 * PI / 0.7;
            let p = peak(&[0.0, 20.0], &[3.0, 3.0], w, damping);
            let over = 1.0 + (-damping * PI / (1.0_f64 - damping * damping).sqrt()).exp();
            close(p.displacement, 3.0 / (w * w) * over, 1e-12);
        }
    }

    #[test]
    fn a_ramp_without_damping() {
        // u = -(s / w^2)(t - sin(w t) / w): monotone, so its largest value is at the end or in free vibration after.
        let (w, s, end) = (5.0, 2.0, 3.0);
        let p = peak(&[0.0, end], &[0.0, s * end], w, 0.0);
        let u = s / (w * w) * (end - (w * end).sin() / w);
        let v = s / (w * w) * (1.0 - (w * end).cos());
        close(p.displacement, u.hypot(v / w).max(u), 1e-12);
    }

    #[test]
    fn splitting_a_piece_changes_nothing() {
        let coarse = (vec![0.0, 1.0, 2.0], vec![0.0, 5.0, -3.0]);
        let time: Vec<f64> = (0..=200).map(|k| f64::from(k) * 0.01).collect();
        let ground: Vec<f64> = time
            .iter()
            .map(|&t| if t <= 1.0 { 5.0 * t } else { 5.0 - 8.0 * (t - 1.0) })
            .collect();
        for period in [0.03, 0.2, 1.0, 5.0] {
            let w = 2.0 * PI / period;
            let (a, b) = (peak(&coarse.0, &coarse.1, w, 0.05), peak(&time, &ground, w, 0.05));
            close(a.displacement, b.displacement, 1e-11);
            close(a.total_acceleration, b.total_acceleration, 1e-11);
        }
    }

    #[test]
    fn a_turn_just_before_the_end_of_a_piece_from_rest_is_found() {
        for sign in [1.0, -1.0] {
            let ground = [sign, -sign, sign];
            let p = peak(&[0.0, 0.05, 0.1], &ground, 2.0 * PI, 0.0);
            // By small steps elsewhere.
            close(p.displacement, 4.106_048_342_976e-4, 1e-9);
            close(p.total_acceleration, 4.0 * PI * PI * p.displacement, 1e-12);
        }
    }

    #[test]
    fn a_stiff_oscillator_follows_the_ground() {
        let p = peak(&[0.0, 1.0, 2.0], &[0.0, 5.0, 0.0], 2.0 * PI / 1e-4, 0.05);
        close(p.total_acceleration, 5.0, 1e-4);
    }
}
