//! What pulls and presses in the crack, as it depends on how far the crack is open: water and anchors.
//!
//! At a distance x from the heel the crack is open by g(x), which is straight in x. The pressure there is
//!
//! | rule | pressure |
//! | --- | --- |
//! | constant | p(x) |
//! | zero while open | p(x) max(0, 1 - g/w) |
//! | full while open | p(x) + (p_full - p(x)) min(1, g/w) |
//! | follows opening | p(x) w/(w + g): the water that is there fills the wider crack |
//!
//! with the opening w over which it changes. An anchor at x pulls with max(0, P + k e), e its elongation along its axis.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    Constant,
    ZeroWhileOpen,
    FullWhileOpen,
    FollowsOpening,
}

impl Rule {
    pub const ALL: [Rule; 4] = [
        Rule::Constant,
        Rule::ZeroWhileOpen,
        Rule::FullWhileOpen,
        Rule::FollowsOpening,
    ];
    pub const NAMES: [&'static str; 4] = [
        "constant",
        "zero while open",
        "full while open",
        "follows opening",
    ];
}

/// Pressure in the crack: straight between its points (distance from the heel, pressure).
#[derive(Clone, Debug)]
pub struct Water {
    pub rule: Rule,
    pub points: Vec<[f64; 2]>,
    pub opening: f64,
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

impl Water {
    /// Force of the water across the crack and its moment about the heel, where the crack is open by
    /// `gap + slope x` at x.
    pub fn force(&self, gap: f64, slope: f64) -> [f64; 2] {
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

    /// Openings between which the pressure is smooth enough for one set of points: kinks of the rule, or doublings.
    fn bend(&self, k: u32) -> f64 {
        (2.0_f64.powi(k as i32) - 1.0) * self.opening
    }

    fn bends(&self) -> u32 {
        match self.rule {
            Rule::Constant => 0,
            Rule::ZeroWhileOpen | Rule::FullWhileOpen => 2,
            Rule::FollowsOpening => 16,
        }
    }

    fn pressure(&self, still: f64, gap: f64) -> f64 {
        let open = (gap / self.opening).max(0.0);
        match self.rule {
            Rule::Constant => still,
            Rule::ZeroWhileOpen => still * (1.0 - open).max(0.0),
            Rule::FullWhileOpen => still + (self.full - still) * open.min(1.0),
            Rule::FollowsOpening => still / (1.0 + open),
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Anchor {
    /// From the heel along the crack.
    pub distance: f64,
    /// Of its axis, along and across the crack.
    pub axis: [f64; 2],
    pub prestress: f64,
    pub axial_stiffness: f64,
    pub shear_stiffness: f64,
}

impl Anchor {
    /// Tension, and the force along and across the crack on the part above, whose end of the anchor has moved so far
    /// along and across.
    pub fn pull(&self, moved: [f64; 2]) -> (f64, [f64; 2]) {
        let longer = moved[0] * self.axis[0] + moved[1] * self.axis[1];
        let tension = (self.prestress + self.axial_stiffness * longer).max(0.0);
        let along = -tension * self.axis[0] - self.shear_stiffness * moved[0];
        (tension, [along, -tension * self.axis[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water(rule: Rule) -> Water {
        Water {
            rule,
            points: vec![[0.0, 8.0], [4.0, 2.0], [10.0, 0.0]],
            opening: 1e-3,
            full: 8.0,
        }
    }

    /// The same by very many points.
    fn by_sums(w: &Water, gap: f64, slope: f64) -> [f64; 2] {
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
        for rule in Rule::ALL {
            let w = water(rule);
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
                        "{rule:?} {gap} {slope}: {ours:?} {sums:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_closed_crack_is_under_its_still_pressure() {
        for rule in Rule::ALL {
            let [force, moment] = water(rule).force(0.0, 0.0);
            assert!((force - 26.0).abs() < 1e-13);
            assert!((moment - (4.0 * 2.0 * 2.0 + 12.0 * 4.0 / 3.0 + 6.0 * 6.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_slack_anchor_pulls_nothing() {
        let anchor = Anchor {
            distance: 0.0,
            axis: [0.6, 0.8],
            prestress: 10.0,
            axial_stiffness: 100.0,
            shear_stiffness: 50.0,
        };
        assert_eq!(anchor.pull([0.0, 0.0]), (10.0, [-6.0, -8.0]));
        let (tension, force) = anchor.pull([-0.5, 0.0]);
        assert_eq!((tension, force), (0.0, [25.0, 0.0]));
    }
}
