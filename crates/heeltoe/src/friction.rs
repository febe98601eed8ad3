//! Friction laws: how much shear a closed crack bears, by its normal stress, its slip and its speed.
//!
//! With the normal stress `s`, the path `d` that the crack has slipped, to and fro, and the slip's speed `v`
//!
//! | law | coefficient of friction |
//! | --- | --- |
//! | constant | `mu_p` at rest, `mu_r` sliding |
//! | linear weakening | `mu_p - (mu_p - mu_r) min(d/D, 1)` |
//! | exponential weakening | `mu_r + (mu_p - mu_r) exp(-d/D)` |
//! | speed weakening | `mu_r + (mu_p - mu_r) exp(-v/V)` |
//! | Barton-Bandis | `tan(min(phi_r + JRC log10(JCS/s), 70 deg))`, no less than `tan(phi_r)` |
//! | lift joint | `mu_r + r(s)`, r straight between points |
//!
//! and to that cohesion `c max(0, 1 - d/L)`, or up to the first slip where L is zero, while the bond is whole: a corner
//! that lifts breaks it.

use crate::table::{named, numbers};

mod series;

pub(crate) use series::{Terms, Unfolding, INVERSE, TERMS};

named! {
    /// What the coefficient of friction goes by.
    Shape {
        /// Nothing but whether it slips.
        Constant = "constant",
        /// The path, in proportion.
        Linear = "linear slip weakening",
        /// The path.
        Exponential = "exponential slip weakening",
        /// The speed.
        Speed = "speed weakening",
        /// The normal stress, by roughness and strength of the walls.
        Barton = "barton-bandis",
        /// The normal stress, by points.
        Lift = "lift joint",
    }
}

numbers! {
    /// The numbers of a law, SI; those that its shape does not use are zero.
    LawNumbers {
        /// Coefficient of friction before any slip, or at rest.
        peak,
        /// Coefficient of friction that is left, or while it slips; the basic one of a lift joint.
        residual,
        /// Path or speed over which one becomes the other (m, m/s).
        scale,
        /// Cohesion of the whole bond (Pa).
        cohesion,
        /// Path over which it is lost (m).
        loss,
        /// Joint roughness coefficient.
        roughness,
        /// Strength of the joint's walls (Pa).
        wall_strength,
        /// Residual angle of friction (rad).
        residual_angle,
    }
}

/// A friction law.
#[derive(Clone, Debug)]
pub struct Law {
    shape: Shape,
    numbers: LawNumbers,
    /// Of a lift joint: normal stress (Pa), ascending, and what roughness adds to the coefficient.
    points: Vec<[f64; 2]>,
}

/// What a crack has been through.
#[derive(Clone, Copy, Debug)]
pub struct Worn {
    /// How far it has slipped, to and fro (m).
    pub path: f64,
    /// Whether its bond is whole, but for that slip.
    pub bonded: bool,
}

impl Worn {
    /// A crack that has never slipped.
    pub const FRESH: Worn = Worn {
        path: 0.0,
        bonded: true,
    };
}

/// What friction bears about a normal force: `coefficient * N + constant`, a tangent where it is curved; at rest and
/// sliding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strength {
    /// Coefficients at rest and sliding.
    pub coefficient: [f64; 2],
    /// Forces at rest and sliding.
    pub constant: [f64; 2],
    /// On a slope: what is added to the coefficients where it slips, or would, downstream, and taken off them upstream.
    pub lean: [f64; 2],
}

/// So many lengths of an exponential law leave less than rounding of what it falls by.
const FADED: f64 = 40.0;
/// The steepest that Barton and Choubey (1977) let the angle of friction be.
const STEEPEST: f64 = 70.0 * std::f64::consts::PI / 180.0;

impl Law {
    /// A law of these numbers; `points` are those of a lift joint.
    pub fn new(shape: Shape, numbers: &LawNumbers, points: Vec<[f64; 2]>) -> Self {
        Law {
            shape,
            numbers: *numbers,
            points,
        }
    }

    /// Constant coefficients at rest and sliding.
    pub(crate) fn coulomb([peak, residual]: [f64; 2]) -> Self {
        let numbers = LawNumbers {
            peak,
            residual,
            ..LawNumbers::default()
        };
        Law::new(Shape::Constant, &numbers, Vec::new())
    }

    /// Whether the coefficient goes by the normal stress.
    pub(crate) fn by_stress(&self) -> bool {
        matches!(self.shape, Shape::Barton | Shape::Lift)
    }

    /// Whether what it bears bends downward alone: between two normal forces it is no less than on a straight line.
    pub(crate) fn sags_nowhere(&self) -> bool {
        self.shape == Shape::Barton
    }

    /// The path at which what it bears next has a corner.
    pub(crate) fn corner(&self, worn: Worn) -> f64 {
        let up_to = |end: f64| if worn.path < end { end } else { f64::INFINITY };
        let bond = if worn.bonded && self.numbers.cohesion > 0.0 {
            up_to(self.numbers.loss)
        } else {
            f64::INFINITY
        };
        match self.shape {
            Shape::Linear => bond.min(up_to(self.numbers.scale)),
            _ => bond,
        }
    }

    /// Whether up to the next corner it is a straight line over the path; one that is so only while the normal force stays
    /// as it is, is that where this is `pressed_evenly`.
    pub(crate) fn straight(&self, worn: Worn, pressed_evenly: bool) -> bool {
        let LawNumbers {
            peak,
            residual,
            scale,
            ..
        } = self.numbers;
        match self.shape {
            Shape::Constant => true,
            Shape::Linear => pressed_evenly || worn.path >= scale || peak == residual,
            Shape::Barton | Shape::Lift => pressed_evenly,
            Shape::Exponential => worn.path >= FADED * scale,
            Shape::Speed => false,
        }
    }

    /// Whether no further slip, no speed and no normal stress changes what it bears.
    pub(crate) fn settled(&self, worn: Worn) -> bool {
        let LawNumbers {
            peak,
            residual,
            scale,
            cohesion,
            loss,
            ..
        } = self.numbers;
        let bonded = worn.bonded && cohesion > 0.0 && (worn.path < loss || worn.path == 0.0);
        !bonded
            && match self.shape {
                Shape::Constant => true,
                Shape::Linear => worn.path >= scale || peak == residual,
                Shape::Exponential => worn.path >= FADED * scale || peak == residual,
                Shape::Speed => peak == residual,
                Shape::Barton | Shape::Lift => false,
            }
    }

    /// The larger coefficient of friction, of a law that does not go by the normal stress.
    pub(crate) fn most(&self) -> f64 {
        self.numbers.peak.max(self.numbers.residual)
    }

    /// Cohesion of the whole bond (Pa).
    pub(crate) fn cohesion(&self) -> f64 {
        self.numbers.cohesion
    }

    /// Coefficients at rest and sliding, without cohesion, under a normal stress, and how they change with it.
    fn friction(&self, stress: f64, speed: f64, path: f64) -> [[f64; 2]; 2] {
        let LawNumbers {
            peak,
            residual,
            scale,
            ..
        } = self.numbers;
        let left = |share: f64| [[residual + (peak - residual) * share, 0.0]; 2];
        match self.shape {
            Shape::Constant => [[peak, 0.0], [residual, 0.0]],
            Shape::Linear => left((1.0 - path / scale).max(0.0)),
            Shape::Exponential if path >= FADED * scale => left(0.0),
            Shape::Exponential => left((-path / scale).exp()),
            Shape::Speed => left((-speed / scale).exp()),
            Shape::Barton => [self.barton(stress); 2],
            Shape::Lift => {
                let [roughness, slope] = between(&self.points, stress);
                [[residual + roughness, slope]; 2]
            }
        }
    }

    fn barton(&self, stress: f64) -> [f64; 2] {
        let LawNumbers {
            roughness,
            wall_strength,
            residual_angle,
            ..
        } = self.numbers;
        let per_decade = roughness.to_radians();
        let added = per_decade * (wall_strength / stress).log10();
        if per_decade == 0.0 || added <= 0.0 {
            return [residual_angle.tan(), 0.0];
        }
        if residual_angle + added >= STEEPEST {
            return [STEEPEST.tan(), 0.0];
        }
        let coefficient = (residual_angle + added).tan();
        let turn = -per_decade / (std::f64::consts::LN_10 * stress);
        [coefficient, (1.0 + coefficient * coefficient) * turn]
    }

    /// Cohesion at rest and sliding (Pa).
    pub(crate) fn bond(&self, worn: Worn) -> [f64; 2] {
        let LawNumbers { cohesion, loss, .. } = self.numbers;
        if !worn.bonded || cohesion == 0.0 {
            return [0.0; 2];
        }
        if loss > 0.0 {
            return [cohesion * (1.0 - worn.path / loss).max(0.0); 2];
        }
        [if worn.path > 0.0 { 0.0 } else { cohesion }, 0.0]
    }

    /// Cohesion of what slides (Pa), and how it goes by the path up to the next corner.
    pub(crate) fn bond_over_path(&self, worn: Worn) -> [f64; 2] {
        let LawNumbers { cohesion, loss, .. } = self.numbers;
        let [_, now] = self.bond(worn);
        [now, if now > 0.0 { -cohesion / loss } else { 0.0 }]
    }

    /// What a crack of this width bears about a normal force.
    pub fn strength(&self, width: f64, normal: f64, speed: f64, worn: Worn) -> Strength {
        let stress = (normal / width).max(0.0);
        let bond = self.bond(worn);
        let mut strength = Strength::default();
        for (k, [coefficient, slope]) in self.friction(stress, speed, worn.path).into_iter().enumerate() {
            // mu(s) s about this stress: its slope there, and what that leaves.
            let bent = slope * stress;
            strength.coefficient[k] = coefficient + bent;
            strength.constant[k] = width * (bond[k] - bent * stress);
        }
        strength
    }

    /// Coefficients of friction at rest and sliding under a normal stress, without cohesion: what an impulse meets.
    pub fn coefficients(&self, stress: f64, speed: f64, path: f64) -> [f64; 2] {
        self.friction(stress.max(0.0), speed, path)
            .map(|[value, _]| value)
    }

    /// Shear stress borne at rest and sliding (Pa).
    pub fn shear_stress(&self, stress: f64, speed: f64, worn: Worn) -> [f64; 2] {
        let (coefficients, bond) = (self.coefficients(stress, speed, worn.path), self.bond(worn));
        [0, 1].map(|k| coefficients[k] * stress.max(0.0) + bond[k])
    }
}

/// Value and slope on straight lines between points, level beyond them.
fn between(points: &[[f64; 2]], at: f64) -> [f64; 2] {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return [0.0; 2];
    };
    if at <= first[0] {
        return [first[1], 0.0];
    }
    let next = points.iter().position(|point| at < point[0]);
    let Some(next) = next else {
        return [last[1], 0.0];
    };
    let ([x0, y0], [x1, y1]) = (points[next - 1], points[next]);
    let slope = (y1 - y0) / (x1 - x0);
    [y0 + slope * (at - x0), slope]
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Worn = Worn {
        path: 0.0,
        bonded: true,
    };

    fn barton() -> Law {
        let numbers = LawNumbers {
            roughness: 10.0,
            wall_strength: 50e6,
            residual_angle: 30f64.to_radians(),
            ..LawNumbers::default()
        };
        Law::new(Shape::Barton, &numbers, Vec::new())
    }

    #[test]
    fn a_tangent_touches_the_curve() {
        let (law, width, normal, step) = (barton(), 7.0, 7.0 * 0.8e6, 10.0);
        let borne = |normal: f64| width * law.shear_stress(normal / width, 0.0, WHOLE)[1];
        let tangent = law.strength(width, normal, 0.0, WHOLE);
        let slope = (borne(normal + step) - borne(normal - step)) / (2.0 * step);
        assert!((tangent.coefficient[1] - slope).abs() < 1e-7, "{slope}");
        let there = tangent.coefficient[1] * normal + tangent.constant[1];
        assert!((there / borne(normal) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn barton_bandis_by_hand() {
        // 30 + 10 log10(50) degrees under 1 MPa.
        let angle = (30.0 + 10.0 * 50f64.log10()).to_radians();
        let [_, found] = barton().coefficients(1e6, 0.0, 0.0);
        assert!((found - angle.tan()).abs() < 1e-14);
        assert_eq!(barton().coefficients(60e6, 0.0, 0.0)[0], 30f64.to_radians().tan());
        assert_eq!(barton().coefficients(0.0, 0.0, 0.0)[0], STEEPEST.tan());
    }

    #[test]
    fn a_bond_breaks() {
        let numbers = LawNumbers {
            peak: 1.0,
            residual: 1.0,
            cohesion: 2e5,
            ..LawNumbers::default()
        };
        let brittle = Law::new(Shape::Constant, &numbers, Vec::new());
        assert_eq!(brittle.shear_stress(1e5, 0.0, WHOLE), [3e5, 1e5]);
        let slipped = Worn { path: 1e-12, ..WHOLE };
        assert_eq!(brittle.shear_stress(1e5, 0.0, slipped), [1e5, 1e5]);
        let gradual = Law::new(Shape::Constant, &LawNumbers { loss: 0.1, ..numbers }, Vec::new());
        let half = Worn { path: 0.05, ..WHOLE };
        assert_eq!(gradual.shear_stress(1e5, 0.0, half), [2e5, 2e5]);
        let open = Worn {
            bonded: false,
            ..WHOLE
        };
        assert_eq!(gradual.shear_stress(1e5, 0.0, open), [1e5, 1e5]);
    }
}
