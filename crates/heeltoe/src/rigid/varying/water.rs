//! Force and moment of the water in the crack under a block.
//!
//! At a distance x from the heel the crack is open by `g(x) = gap + slope x`, and the pressure p(x) is that of
//! [`Law`]:
//!
//! `F = int p(x) dx`, `M = int p(x) x dx`.

use crate::inside::Law;

/// Water whose pressure follows the opening of the crack.
#[derive(Clone, Debug)]
pub struct FollowingWater {
    /// How it does.
    pub law: Law,
    /// Distance from the heel (m) and pressure while the crack is closed (Pa); straight in between.
    pub points: Vec<[f64; 2]>,
    /// Opening over which the pressure changes (m).
    pub opening: f64,
    /// Pressure of the reservoir (Pa).
    pub full: f64,
    /// Force and moment in the closed crack.
    pub(super) closed: [f64; 2],
}

/// Gauss-Legendre of order 2 on (-1, 1), which is exact for a cubic.
const PLACE: f64 = 0.577_350_269_189_625_8;
/// Below this the sum of [`tail`] is taken term by term: the closed form would lose digits.
pub(super) const NARROW: f64 = 0.1;
/// As many factors of it as leave no more than rounding of the first.
pub(super) const ODD: [f64; 8] = [
    1.0 / 3.0,
    1.0 / 5.0,
    1.0 / 7.0,
    1.0 / 9.0,
    1.0 / 11.0,
    1.0 / 13.0,
    1.0 / 15.0,
    1.0 / 17.0,
];

/// `(artanh(e)/e - 1)/e^2 = sum e^(2k)/(2k + 3)`: with it the integrals over (-1, 1) of 1, s and s^2 over 1 + e s are
/// `2 (1 + e^2 S)`, `-2 e S` and `2 S`.
fn tail(e: f64) -> f64 {
    let square = e * e;
    if e.abs() < NARROW {
        return ODD.iter().rev().fold(0.0, |sum, factor| sum * square + factor);
    }
    (e.atanh() / e - 1.0) / square
}

impl FollowingWater {
    /// Water of these numbers.
    pub fn new(law: Law, points: Vec<[f64; 2]>, opening: f64, full: f64) -> Self {
        let mut water = FollowingWater {
            law,
            points,
            opening,
            full,
            closed: [0.0; 2],
        };
        water.closed = water.summed(0.0, 0.0);
        water
    }

    /// Force of the water across the crack and its moment about the heel, where the crack is open by
    /// `gap + slope x` at x.
    pub(super) fn force(&self, gap: f64, slope: f64) -> [f64; 2] {
        if self.law == Law::Constant {
            return self.closed;
        }
        self.summed(gap, slope)
    }

    fn summed(&self, gap: f64, slope: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for pair in self.points.windows(2) {
            let ([x0, p0], [x1, p1]) = (pair[0], pair[1]);
            if x1 <= x0 {
                continue;
            }
            let rise = (p1 - p0) / (x1 - x0);
            let mut start = x0;
            let mut stretch = |end: f64| {
                let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
                let still = p0 + rise * (middle - x0);
                let [force, moment] = self.pressed(still, rise * half, gap + slope * middle, slope * half);
                sum[0] += half * force;
                sum[1] += half * (middle * force + half * moment);
                start = end;
            };
            for k in 0..self.bends() {
                let bend = if slope > 0.0 { k } else { self.bends() - 1 - k };
                let end = (f64::from(bend) * self.opening - gap) / slope;
                // Where the crack is open by the same everywhere, this is nowhere.
                if end > x0 && end < x1 {
                    stretch(end);
                }
            }
            stretch(x1);
        }
        sum
    }

    /// Integrals over s in (-1, 1) of the pressure and of the pressure times s, where `still + rise s` is that of the closed
    /// crack, which is open by `gap + widening s`; no bend lies between.
    fn pressed(&self, still: f64, rise: f64, gap: f64, widening: f64) -> [f64; 2] {
        if self.law == Law::FollowsOpening && gap > 0.0 {
            let open = self.opening + gap;
            let (e, scale) = (widening / open, 2.0 * self.opening / open);
            let sum = tail(e);
            return [
                scale * (still * (1.0 + e * e * sum) - rise * e * sum),
                scale * sum * (rise - still * e),
            ];
        }
        let [before, behind] = [-PLACE, PLACE].map(|s| {
            self.law
                .pressure(still + rise * s, self.full, gap + widening * s, self.opening)
        });
        [before + behind, PLACE * (behind - before)]
    }

    /// Openings, in steps of [`Self::opening`] from zero, at which the law has a kink.
    fn bends(&self) -> u32 {
        match self.law {
            Law::Constant => 0,
            Law::FollowsOpening => 1,
            Law::ZeroWhileOpen | Law::FullWhileOpen => 2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water(law: Law) -> FollowingWater {
        let points = vec![[0.0, 8.0], [4.0, 2.0], [10.0, 0.0]];
        FollowingWater::new(law, points, 1e-3, 8.0)
    }

    /// The same by very many points.
    fn by_sums(w: &FollowingWater, gap: f64, slope: f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for pair in w.points.windows(2) {
            let ([x0, p0], [x1, p1]) = (pair[0], pair[1]);
            let n = 200_000;
            let dx = (x1 - x0) / f64::from(n);
            for k in 0..n {
                let x = x0 + (f64::from(k) + 0.5) * dx;
                let still = p0 + (p1 - p0) * (x - x0) / (x1 - x0);
                let p = w.law.pressure(still, w.full, gap + slope * x, w.opening);
                sum[0] += dx * p;
                sum[1] += dx * p * x;
            }
        }
        sum
    }

    #[test]
    fn forces_are_the_integrals() {
        for law in Law::ALL {
            let w = water(law);
            for (gap, slope) in [
                (0.0, 0.0),
                (2e-3, 0.0),
                (0.0, 3e-4),
                (0.05, -5e-3),
                (1e-2, -8e-4),
                (0.0, 1.0),
                (1e-4, 1e-4),
            ] {
                let (ours, sums) = (w.force(gap, slope), by_sums(&w, gap, slope));
                for i in 0..2 {
                    assert!(
                        (ours[i] - sums[i]).abs() < 1e-8 * 100.0,
                        "{law:?} {gap} {slope}: {ours:?} {sums:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_closed_crack_is_under_its_still_pressure() {
        for law in Law::ALL {
            let [force, moment] = water(law).force(0.0, 0.0);
            assert!((force - 26.0).abs() < 1e-13);
            assert!((moment - (4.0 * 2.0 * 2.0 + 12.0 * 4.0 / 3.0 + 6.0 * 6.0)).abs() < 1e-12);
        }
    }
}
