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
}

// Gauss-Legendre of order 6 on (-1, 1).
const PLACES: [f64; 3] = [
    0.238_619_186_083_196_9,
    0.661_209_386_466_264_5,
    0.932_469_514_203_152,
];
const WEIGHTS: [f64; 3] = [
    0.467_913_934_572_691,
    0.360_761_573_048_138_6,
    0.171_324_492_379_170_36,
];

impl FollowingWater {
    /// Force of the water across the crack and its moment about the heel, where the crack is open by
    /// `gap + slope x` at x.
    pub(super) fn force(&self, gap: f64, slope: f64) -> [f64; 2] {
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
                for (place, weight) in PLACES.iter().zip(WEIGHTS) {
                    for side in [-1.0, 1.0] {
                        let x = middle + side * place * half;
                        let pressure = self.pressure(p0 + rise * (x - x0), gap + slope * x);
                        sum[0] += half * weight * pressure;
                        sum[1] += half * weight * pressure * x;
                    }
                }
                start = end;
            };
            for k in 0..self.bends() {
                let bend = if slope > 0.0 { k } else { self.bends() - 1 - k };
                let end = (self.bend(bend) - gap) / slope;
                // Where the crack is open by the same everywhere, this is nowhere.
                if end > x0 && end < x1 {
                    stretch(end);
                }
            }
            stretch(x1);
        }
        sum
    }

    /// Openings between which the pressure is smooth enough for one set of points: kinks of the law, or doublings.
    fn bend(&self, k: u32) -> f64 {
        (2.0_f64.powi(k as i32) - 1.0) * self.opening
    }

    fn bends(&self) -> u32 {
        match self.law {
            Law::Constant => 0,
            Law::ZeroWhileOpen | Law::FullWhileOpen => 2,
            Law::FollowsOpening => 16,
        }
    }

    fn pressure(&self, still: f64, gap: f64) -> f64 {
        self.law.pressure(still, self.full, gap, self.opening)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water(law: Law) -> FollowingWater {
        FollowingWater {
            law,
            points: vec![[0.0, 8.0], [4.0, 2.0], [10.0, 0.0]],
            opening: 1e-3,
            full: 8.0,
        }
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
                let p = w.pressure(p0 + (p1 - p0) * (x - x0) / (x1 - x0), gap + slope * x);
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
                        (ours[i] - sums[i]).abs() < 1e-6 * 100.0,
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
