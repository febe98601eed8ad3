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

/// So many oscillators are followed side by side.
const LANES: usize = 8;

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
        // A term that changes nothing may be zero; where two do so, none of the smaller ones behind them does.
        let mut idle = 0;
        for n in 1..16 {
            let k = f64::from(n);
            let sums = (constant, ramp);
            constant -= term * power / (k + 1.0);
            ramp -= term * power * h / ((k + 1.0) * (k + 2.0));
            idle = if (constant, ramp) == sums { idle + 1 } else { 0 };
            if idle == 2 {
                break;
            }
            let next = -(2.0 * z * w * k * term + w * w * before) / (k * (k + 1.0));
            (before, term) = (term, next);
            power *= h;
        }
        (constant, ramp)
    }

    /// Relative acceleration.
    #[inline(always)]
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
    #[inline(always)]
    fn value_and_rate(_: &Oscillator, [u, v, _]: [f64; 3]) -> [f64; 2] {
        [u, v]
    }

    #[inline(always)]
    fn bend(o: &Oscillator, [u, v, a]: [f64; 3], _: f64) -> f64 {
        o.rate(u, v, a)
    }
}

/// Acceleration of ground and oscillator together.
struct Total;

impl Quantity for Total {
    #[inline(always)]
    fn value_and_rate(o: &Oscillator, [u, v, a]: [f64; 3]) -> [f64; 2] {
        let total = -o.drag * v - o.stiffness * u;
        [total, -o.drag * (total - a) - o.stiffness * v]
    }

    #[inline(always)]
    fn bend(o: &Oscillator, [u, v, a]: [f64; 3], slope: f64) -> f64 {
        let rate = o.rate(u, v, a);
        -o.drag * (-slope - o.drag * rate - o.stiffness * v) - o.stiffness * rate
    }
}

/// A quantity does not get farther between two states, so much time apart.
#[inline(always)]
fn farthest<Q: Quantity>(o: &Oscillator, start: [f64; 3], end: [f64; 3], slope: f64, length: f64) -> f64 {
    let ([f0, g0], [f1, g1]) = (Q::value_and_rate(o, start), Q::value_and_rate(o, end));
    let (b0, b1) = (Q::bend(o, start, slope), Q::bend(o, end, slope));
    // Inside, a rate exceeds those at both ends by half the length times the largest rate of its own, which on an
    // eighth of a period is less than twice the larger one of the ends.
    let fastest = g0.abs().max(g1.abs()) + length * b0.abs().max(b1.abs());
    f0.abs().max(f1.abs()) + length * fastest
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
    fn turning<Q: Quantity>(&self, end: [f64; 3], known: f64) -> f64 {
        let o = self.oscillator;
        let ([f0, g0], [f1, g1]) = (Q::value_and_rate(o, self.start), Q::value_and_rate(o, end));
        let bend = |state| Q::bend(o, state, self.slope);
        let (b0, b1) = (bend(self.start), bend(end));
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

/// Oscillators side by side, and where they are: what is done to each is the same arithmetic, so that the registers of
/// the machine hold several.
struct Row<'a, const L: usize> {
    oscillators: &'a [Oscillator; L],
    drag: [f64; L],
    stiffness: [f64; L],
    longest: [f64; L],
    /// Length of the last piece, in how many steps it was gone over, one over it, and the maps over such a step.
    known_length: [f64; L],
    parts: [usize; L],
    inverse: [f64; L],
    length: [f64; L],
    to_u: [[f64; L]; 4],
    to_v: [[f64; L]; 4],
    u: [f64; L],
    v: [f64; L],
    largest: [[f64; L]; 2],
}

impl<'a, const L: usize> Row<'a, L> {
    fn new(oscillators: &'a [Oscillator; L]) -> Self {
        let longest = oscillators
            .each_ref()
            .map(|o| std::f64::consts::TAU / o.frequency / 8.0);
        let mut row = Row {
            oscillators,
            drag: oscillators.each_ref().map(|o| o.drag),
            stiffness: oscillators.each_ref().map(|o| o.stiffness),
            longest,
            known_length: longest,
            parts: [1; L],
            inverse: longest.map(|length| 1.0 / length),
            length: longest,
            to_u: [[0.0; L]; 4],
            to_v: [[0.0; L]; 4],
            u: [0.0; L],
            v: [0.0; L],
            largest: [[0.0; L]; 2],
        };
        for (l, length) in longest.into_iter().enumerate() {
            row.set_step(l, length);
        }
        row
    }

    fn set_step(&mut self, l: usize, length: f64) {
        let step = self.oscillators[l].step(length);
        self.length[l] = length;
        for i in 0..4 {
            (self.to_u[i][l], self.to_v[i][l]) = (step.u[i], step.v[i]);
        }
    }

    /// Go over a piece of this length.
    #[inline(always)]
    fn walk(&mut self, lengths: [f64; L], a_start: f64, a_end: f64) {
        // Equal steps differ by the rounding of their times; that is no other step, and divisions are dear.
        let other = |l: usize, known: f64| (lengths[l] - known).abs() > 1e-9 * lengths[l];
        if (0..L).any(|l| other(l, self.known_length[l])) {
            for (l, length) in lengths.into_iter().enumerate() {
                if other(l, self.known_length[l]) {
                    let parts = (length / self.longest[l]).ceil().max(1.0);
                    self.known_length[l] = length;
                    self.parts[l] = parts as usize;
                    self.inverse[l] = 1.0 / length;
                    self.set_step(l, length / parts);
                }
            }
        }
        let slope = self.inverse.map(|inverse| (a_end - a_start) * inverse);
        let most = self.parts.iter().fold(0, |most, parts| most.max(*parts));
        for k in 0..most {
            self.step(k, a_start, &slope);
        }
    }

    /// Go over the part of this number of a piece.
    #[inline(always)]
    fn step(&mut self, k: usize, a_start: f64, slope: &[f64; L]) {
        let (mut u1, mut v1, mut a0) = ([0.0; L], [0.0; L], [0.0; L]);
        // Each is known to reach so much, and gets no farther than that in between.
        let (mut known, mut far) = ([[0.0; L]; 2], [[0.0; L]; 2]);
        for l in 0..L {
            let (u, v, s, h) = (self.u[l], self.v[l], slope[l], self.length[l]);
            let (drag, stiffness) = (self.drag[l], self.stiffness[l]);
            let a = a_start + s * (k as f64 * h);
            let [to_u, to_v] =
                [&self.to_u, &self.to_v].map(|to| to[0][l] * u + to[1][l] * v + to[2][l] * a + to[3][l] * s);
            (u1[l], v1[l], a0[l]) = (to_u, to_v, a);
            let o = &Oscillator {
                drag,
                stiffness,
                ..self.oscillators[l]
            };
            let (start, end) = ([u, v, a], [to_u, to_v, a + s * h]);
            known[0][l] = self.largest[0][l].max(to_u.abs());
            known[1][l] = self.largest[1][l].max((drag * to_v + stiffness * to_u).abs());
            far[0][l] = farthest::<Displacement>(o, start, end, s, h);
            far[1][l] = farthest::<Total>(o, start, end, s, h);
        }
        let near = (0..L).all(|l| far[0][l] <= known[0][l] && far[1][l] <= known[1][l]);
        if near && self.parts.iter().all(|parts| k < *parts) {
            (self.u, self.v, self.largest) = (u1, v1, known);
            return;
        }
        for l in (0..L).filter(|l| k < self.parts[*l]) {
            let piece = Piece {
                oscillator: &self.oscillators[l],
                start: [self.u[l], self.v[l], a0[l]],
                slope: slope[l],
                length: self.length[l],
            };
            let end = [u1[l], v1[l], a0[l] + slope[l] * self.length[l]];
            self.largest[0][l] = known[0][l];
            if far[0][l] > known[0][l] {
                self.largest[0][l] = known[0][l].max(piece.turning::<Displacement>(end, known[0][l]));
            }
            self.largest[1][l] = known[1][l];
            if far[1][l] > known[1][l] {
                self.largest[1][l] = known[1][l].max(piece.turning::<Total>(end, known[1][l]));
            }
            (self.u[l], self.v[l]) = (u1[l], v1[l]);
        }
    }
}

/// Peaks of some oscillators, of whose damping ratios each is in [0, 1).
#[inline(always)]
fn peaks_of<const L: usize>(time: &[f64], ground: &[f64], oscillators: &[Oscillator; L]) -> [Peak; L] {
    let mut row = Row::new(oscillators);
    for k in 1..time.len() {
        let length = time[k] - time[k - 1];
        if length > 0.0 {
            row.walk([length; L], ground[k - 1], ground[k]);
        }
    }
    row.walk(row.longest.map(|longest| 8.0 * longest), 0.0, 0.0);
    let [displacement, total] = row.largest;
    std::array::from_fn(|l| Peak {
        displacement: displacement[l],
        total_acceleration: total[l],
    })
}

/// The same by registers of four numbers, to the bit.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn peaks_by_four<const L: usize>(time: &[f64], ground: &[f64], oscillators: &[Oscillator; L]) -> [Peak; L] {
    peaks_of(time, ground, oscillators)
}

fn peaks<const L: usize>(time: &[f64], ground: &[f64], oscillators: &[Oscillator; L]) -> [Peak; L] {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: the machine has them.
        return unsafe { peaks_by_four(time, ground, oscillators) };
    }
    peaks_of(time, ground, oscillators)
}

/// Peaks of one oscillator of circular frequency `frequency` > 0 and damping ratio in [0, 1).
pub fn peak(time: &[f64], ground: &[f64], frequency: f64, damping: f64) -> Peak {
    let [peak] = peaks(time, ground, &[Oscillator::new(frequency, damping)]);
    peak
}

/// Peaks of many oscillators, by their periods; a period of zero is the ground itself.
pub fn spectrum(time: &[f64], ground: &[f64], periods: &[f64], damping: f64, stop: Stop) -> Vec<Peak> {
    let moving: Vec<f64> = periods.iter().copied().filter(|period| *period != 0.0).collect();
    let of = |period: &f64| Oscillator::new(std::f64::consts::TAU / period, damping);
    let rows = each(moving.len().div_ceil(LANES), 1, |row| {
        let here = &moving[row * LANES..moving.len().min((row + 1) * LANES)];
        if stop.asked() {
            return vec![Peak::default(); here.len()];
        }
        match here {
            [period] => vec![peaks(time, ground, &[of(period)])[0]],
            _ => {
                // The last ones stand for those that are missing.
                let all: [Oscillator; LANES] = std::array::from_fn(|l| of(&here[l.min(here.len() - 1)]));
                peaks(time, ground, &all)[..here.len()].to_vec()
            }
        }
    });
    let mut peaks = rows.into_iter().flatten();
    let still = Peak {
        displacement: 0.0,
        total_acceleration: ground.iter().fold(0.0_f64, |m, a| m.max(a.abs())),
    };
    periods
        .iter()
        .map(|period| if *period == 0.0 { Some(still) } else { peaks.next() })
        .map(Option::unwrap_or_default)
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

    #[test]
    fn side_by_side_each_oscillator_has_the_bits_that_it_has_alone() {
        let time: Vec<f64> = (0..=400).map(|k| f64::from(k) * 0.02).collect();
        let ground: Vec<f64> = time.iter().map(|t| (7.0 * t).sin() * (1.3 * t).cos()).collect();
        // Steps of one part and of several, a ground between them, and two that have no row of their own.
        let mut periods = vec![0.03, 0.05, 0.0, 0.1, 0.2, 0.35, 0.5, 0.8, 1.3, 2.5, 0.04];
        let mut peaks = spectrum(&time, &ground, &periods, 0.05, Stop::default());
        let largest = ground.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
        assert_eq!(periods.remove(2), 0.0);
        assert_eq!(peaks.remove(2).total_acceleration, largest);
        for (period, found) in periods.iter().zip(peaks) {
            assert_eq!(found, peak(&time, &ground, 2.0 * PI / period, 0.05), "{period}");
        }
    }
}
