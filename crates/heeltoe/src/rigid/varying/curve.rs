//! Functions that solve `r'' = p + q t + k r`, and where they fall through zero.
//!
//! With `C(t) = (cosh wt - 1)/k`, `S(t) = (sinh wt - wt)/(w k)` and `w^2 = k` they are `c0 + c1 t + c2 C + c3 S`, a cubic
//! where k is zero; so are their derivatives, as `C' = t + k S` and `S' = C`. The second one,
//! `c2 cosh wt + c3 sinh(wt)/w`, changes its sign once at most: from there all roots are bracketed.

use super::super::event::bracketed;

/// Terms of the series below that are enough up to a `k t^2`: the next one is less than rounding.
const TERMS: [(f64, u32); 3] = [(1e-3, 3), (0.1, 5), (REACH, 12)];
/// The largest `k t^2` that its functions are asked for.
const REACH: f64 = 4.0;

/// `c0 + c1 t + c2 C(t) + c3 S(t)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve {
    /// k, not negative.
    pub growth: f64,
    pub terms: [f64; 4],
}

/// How long the functions of this k hold.
pub(super) fn holds(growth: f64) -> f64 {
    (REACH / growth).sqrt()
}

/// C, S and the integral of S at `t`.
fn basis(growth: f64, t: f64) -> [f64; 3] {
    let square = t * t;
    let [half, sixth, rest] = [0.5 * square, square * t / 6.0, square * square / 24.0];
    if growth == 0.0 {
        return [half, sixth, rest];
    }
    let x = growth * square;
    let terms = TERMS
        .iter()
        .find(|(up_to, _)| x <= *up_to)
        .map_or(12, |(_, terms)| *terms);
    // 1/n! + x/(n+2)! + ..., times n!.
    let series = |n: u32| {
        (1..=terms).rev().fold(1.0, |sum, j| {
            let m = f64::from(n + 2 * j);
            1.0 + sum * x / (m * (m - 1.0))
        })
    };
    let integral = rest * series(4);
    [half + growth * integral, sixth * series(3), integral]
}

impl Curve {
    pub(super) fn at(&self, t: f64) -> f64 {
        let [c0, c1, c2, c3] = self.terms;
        let [cosine, sine, _] = basis(self.growth, t);
        c0 + c1 * t + c2 * cosine + c3 * sine
    }

    /// It, its derivative and its integral from zero on.
    pub(super) fn with_derivative_and_integral(&self, t: f64) -> [f64; 3] {
        let [c0, c1, c2, c3] = self.terms;
        let [cosine, sine, integral] = basis(self.growth, t);
        [
            c0 + c1 * t + c2 * cosine + c3 * sine,
            c1 + c2 * (t + self.growth * sine) + c3 * cosine,
            t * (c0 + 0.5 * c1 * t) + c2 * sine + c3 * integral,
        ]
    }

    pub(super) fn derivative(&self) -> Self {
        let [_, c1, c2, c3] = self.terms;
        Curve {
            terms: [c1, c2, c3, self.growth * c2],
            ..*self
        }
    }

    /// `start + per_time t + factor` times this.
    pub(super) fn affine(&self, start: f64, per_time: f64, factor: f64) -> Self {
        let [c0, c1, c2, c3] = self.terms.map(|term| factor * term);
        Curve {
            terms: [c0 + start, c1 + per_time, c2, c3],
            ..*self
        }
    }

    /// First moment in `[0, end]` at which it falls through zero, where it falls below `-floor` after that; with no floor
    /// one that reaches zero at the end but for rounding does so.
    pub(super) fn first_fall(&self, end: f64, floor: f64) -> Option<f64> {
        let [c0, c1, c2, c3] = self.terms;
        let [cosine, sine, _] = basis(self.growth, end);
        let change = c1.abs() * end + c2.abs() * cosine + c3.abs() * sine;
        if c0 > 2.0 * change {
            return None;
        }
        let rounding = if floor == 0.0 {
            4.0 * f64::EPSILON * (c0.abs() + change)
        } else {
            -floor
        };
        let rate = self.derivative();
        let mut start = (0.0, c0);
        for stop in rate.sign_changes(end).into_iter().flatten().chain([end]) {
            let value = self.at(stop);
            let low = if stop == end { rounding } else { -floor };
            if value <= low && value < start.1 {
                return Some(if start.1 <= 0.0 {
                    start.0
                } else if value > 0.0 {
                    stop
                } else {
                    root(self, &rate, [start.0, stop])
                });
            }
            start = (stop, value);
        }
        None
    }

    /// Where it changes its sign in `(0, end)`, if it is itself a derivative, which turns once at most.
    fn sign_changes(&self, end: f64) -> [Option<f64>; 2] {
        let rate = self.derivative();
        let turn = rate.turn().filter(|t| *t > 0.0 && *t < end);
        let mut found = [None; 2];
        let mut start = 0.0;
        for (place, stop) in found.iter_mut().zip(turn.into_iter().chain([end])) {
            let (before, after) = (self.at(start), self.at(stop));
            if before * after < 0.0 {
                *place = Some(if before > 0.0 {
                    root(self, &rate, [start, stop])
                } else {
                    root(
                        &self.affine(0.0, 0.0, -1.0),
                        &rate.affine(0.0, 0.0, -1.0),
                        [start, stop],
                    )
                });
            }
            start = stop;
        }
        found
    }

    /// Where `c0 cosh wt + c1 sinh(wt)/w`, as a second derivative is, is zero.
    fn turn(&self) -> Option<f64> {
        let [c0, c1, ..] = self.terms;
        let ratio = -c0 / c1;
        let pace = self.growth.sqrt();
        let t = if pace > 0.0 {
            (pace * ratio).atanh() / pace
        } else {
            ratio
        };
        t.is_finite().then_some(t)
    }
}

/// Root of a curve that falls from above zero to below it.
fn root(curve: &Curve, rate: &Curve, ends: [f64; 2]) -> f64 {
    bracketed(|t| curve.at(t), |t| rate.at(t), ends, 0.5 * (ends[0] + ends[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_what_it_says() {
        let (k, c): (f64, [f64; 4]) = (3.0, [0.3, -1.2, 0.7, 2.0]);
        let (w, curve) = (k.sqrt(), Curve { growth: k, terms: c });
        for t in [1e-3, 0.4, holds(k)] {
            let (cosine, sine) = (((w * t).cosh() - 1.0) / k, ((w * t).sinh() - w * t) / (w * k));
            let whole = c[0] + c[1] * t + c[2] * cosine + c[3] * sine;
            assert!((curve.at(t) - whole).abs() < 1e-14);
            let rate = c[1] + c[2] * (t + k * sine) + c[3] * cosine;
            assert!((curve.derivative().at(t) - rate).abs() < 1e-13);
            let integral = ((w * t).cosh() - 1.0 - 0.5 * k * t * t) / (k * k);
            let sum = c[0] * t + 0.5 * c[1] * t * t + c[2] * sine + c[3] * integral;
            let [value, slope, integral] = curve.with_derivative_and_integral(t);
            assert!((integral - sum).abs() < 1e-14);
            assert_eq!(value, curve.at(t));
            assert!((slope - curve.derivative().at(t)).abs() < 1e-13);
        }
    }

    #[test]
    fn a_fall_between_two_ends_above_zero_is_found() {
        let dips = |start: f64| Curve {
            growth: 2.0,
            terms: [start, -1e-2, 0.3, 0.0],
        };
        // The least value lies 1.67e-4 below the start.
        assert_eq!(dips(2e-4).first_fall(1.0, 0.0), None);
        let fall = dips(1e-4).first_fall(1.0, 0.0).unwrap();
        assert!(dips(1e-4).at(fall).abs() < 1e-18 && fall < 0.0333, "{fall}");
        assert_eq!(dips(1e-4).first_fall(1.0, 1e-4), None);
        assert!(dips(1e-4).at(1.0) > 0.0);
    }

    #[test]
    fn a_root_at_the_start_is_not_found_again() {
        let curve = Curve {
            growth: 1.5,
            terms: [0.0, 0.0, 1.0, -3.0],
        };
        let fall = curve.first_fall(1.5, 0.0).unwrap();
        assert!(fall > 0.5 && curve.at(fall).abs() < 1e-16, "{fall}");
        assert_eq!(curve.first_fall(0.5, 0.0), None);
    }

    #[test]
    fn without_growth_it_is_a_cubic() {
        // t^2 (2 - t)
        let curve = Curve {
            growth: 0.0,
            terms: [0.0, 0.0, 4.0, -6.0],
        };
        assert!((curve.first_fall(5.0, 0.0).unwrap() - 2.0).abs() < 1e-15);
    }
}
