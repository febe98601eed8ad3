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

use rayon::prelude::*;

/// Largest relative displacement and largest total acceleration of one oscillator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Peak {
    pub displacement: f64,
    pub total_acceleration: f64,
}

/// The oscillator, by its circular frequency and damping ratio below one.
#[derive(Clone, Copy)]
struct Oscillator {
    frequency: f64,
    damping: f64,
    damped: f64,
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
        // u0 - C with C and D written out for a0 and for the slope.
        let (c_a, c_s, d_s) = (-1.0 / (w * w), 2.0 * z / (w * w * w), -1.0 / (w * w));
        Step {
            length: h,
            u: [
                free_u,
                free_v,
                c_a * (1.0 - free_u),
                c_s * (1.0 - free_u) + d_s * (h - free_v),
            ],
            v: [
                rate_u,
                rate_v,
                -c_a * rate_u,
                -c_s * rate_u + d_s * (1.0 - rate_v),
            ],
        }
    }

    /// Relative acceleration.
    fn rate(&self, u: f64, v: f64, a: f64) -> f64 {
        -a - 2.0 * self.damping * self.frequency * v - self.frequency * self.frequency * u
    }

    /// Total acceleration, ground and relative together.
    fn total(&self, u: f64, v: f64) -> f64 {
        -2.0 * self.damping * self.frequency * v - self.frequency * self.frequency * u
    }

    /// Rate of change of the total acceleration.
    fn total_rate(&self, u: f64, v: f64, a: f64) -> f64 {
        -2.0 * self.damping * self.frequency * self.rate(u, v, a) - self.frequency * self.frequency * v
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

/// Value of `extreme` where `slope` changes its sign in `(0, h)`, by the secant method inside the bracket.
fn inside(
    o: &Oscillator,
    start: (f64, f64, f64, f64),
    h: f64,
    slope: impl Fn(f64, f64, f64) -> f64,
    extreme: impl Fn(f64, f64) -> f64,
) -> f64 {
    let (u0, v0, a0, s) = start;
    let at = |t: f64| {
        let (u, v) = o.step(t).apply(u0, v0, a0, s);
        (u, v, slope(u, v, a0 + s * t))
    };
    let (mut low, mut high) = (0.0, h);
    let (mut f_low, mut f_high) = (slope(u0, v0, a0), at(h).2);
    let mut best = f64::NAN;
    // The extreme is flat: an error e in time is e^2 in value, so a few rounds reach rounding.
    for round in 0..60 {
        let mut t = if round % 3 == 2 {
            0.5 * (low + high)
        } else {
            low - f_low * (high - low) / (f_high - f_low)
        };
        if !(t > low && t < high) {
            t = 0.5 * (low + high);
        }
        let (u, v, f) = at(t);
        best = extreme(u, v);
        if f == 0.0 || high - low < 1e-9 * h {
            break;
        }
        if (f > 0.0) == (f_low > 0.0) {
            (low, f_low) = (t, f);
        } else {
            (high, f_high) = (t, f);
        }
    }
    best
}

/// Peaks of one oscillator of circular frequency `frequency` > 0 and damping ratio in [0, 1).
pub fn peak(time: &[f64], ground: &[f64], frequency: f64, damping: f64) -> Peak {
    let o = Oscillator::new(frequency, damping);
    let longest = std::f64::consts::TAU / frequency / 8.0;
    let mut step = o.step(longest);
    let (mut u, mut v) = (0.0, 0.0);
    let mut largest = Peak::default();
    let mut walk = |length: f64, a_start: f64, a_end: f64| {
        if length <= 0.0 {
            return;
        }
        let parts = (length / longest).ceil().max(1.0);
        let h = length / parts;
        // Equal steps differ by the rounding of their times; that is no other step.
        if (h - step.length).abs() > 1e-9 * h {
            step = o.step(h);
        }
        let s = (a_end - a_start) / length;
        for k in 0..parts as usize {
            let a = a_start + s * (k as f64 * h);
            let b = a + s * h;
            let (u1, v1) = step.apply(u, v, a, s);
            let (f0, f1) = (o.total(u, v), o.total(u1, v1));
            let (g0, g1) = (o.total_rate(u, v, a), o.total_rate(u1, v1, b));
            largest.displacement = largest.displacement.max(u1.abs());
            largest.total_acceleration = largest.total_acceleration.max(f1.abs());
            let start = (u, v, a, s);
            // Between two samples the extreme cannot rise above either by more than its rates allow.
            if (v > 0.0) != (v1 > 0.0)
                && u.abs().max(u1.abs()) + h * v.abs().max(v1.abs()) > largest.displacement
            {
                let found = inside(&o, start, h, |_, v, _| v, |u, _| u);
                largest.displacement = largest.displacement.max(found.abs());
            }
            if (g0 > 0.0) != (g1 > 0.0)
                && f0.abs().max(f1.abs()) + h * g0.abs().max(g1.abs()) > largest.total_acceleration
            {
                let found = inside(
                    &o,
                    start,
                    h,
                    |u, v, a| o.total_rate(u, v, a),
                    |u, v| o.total(u, v),
                );
                largest.total_acceleration = largest.total_acceleration.max(found.abs());
            }
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
pub fn spectrum(time: &[f64], ground: &[f64], periods: &[f64], damping: f64) -> Vec<Peak> {
    periods
        .par_iter()
        .map(|&period| {
            if period == 0.0 {
                let pga = ground.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
                return Peak {
                    displacement: 0.0,
                    total_acceleration: pga,
                };
            }
            peak(time, ground, std::f64::consts::TAU / period, damping)
        })
        .collect()
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
    fn a_stiff_oscillator_follows_the_ground() {
        let p = peak(&[0.0, 1.0, 2.0], &[0.0, 5.0, 0.0], 2.0 * PI / 1e-4, 0.05);
        close(p.total_acceleration, 5.0, 1e-4);
    }
}
