//! A crack as data: its nodes, its friction, its shape.

use super::inside::Inside;
use crate::friction::Law;

/// Some nodes of a body that follow each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// The first.
    pub first: usize,
    /// How many.
    pub count: usize,
}

/// Strength and energy of a bonded joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondLaw {
    /// Tensile strength `f_t` (Pa).
    pub tensile: f64,
    /// Cohesion `c` (Pa), at least friction times tensile strength: there the line of the shear strength ends.
    pub cohesion: f64,
    /// Energies of opening and of shear (J/m2).
    pub energy: [f64; 2],
    /// Factor on both strengths during the earthquake.
    pub dynamic: f64,
    /// Share of the energies below the first of two lines of softening, prolonged; 1 where there is but one line.
    pub first: f64,
}

/// Share of the strength at which two lines of softening meet: that of concrete (Wittmann, Rokugo, Bruehwiler, Mihashi
/// and Simonin, Materials and Structures 21 (1988), 21-32).
const KNEE: f64 = 0.25;

impl BondLaw {
    /// Damage and share of the strength where the lines of softening meet; the end of a single one.
    pub(super) fn knee(&self) -> [f64; 2] {
        if self.first >= 1.0 {
            return [1.0, 0.0];
        }
        let first = (1.0 - KNEE) * self.first;
        [first * KNEE / (1.0 - first), KNEE]
    }

    /// Way (m) over which a tension (0) or a cohesion (1) is lost.
    pub(super) fn reach(&self, k: usize, strength: f64) -> f64 {
        let [place, share] = self.knee();
        2.0 * self.energy[k] / ((place + share) * strength)
    }
}

/// A crack.
#[derive(Clone, Debug)]
pub struct Line {
    /// Nodes of its upper face among those of the part above it, and of its lower face among those of the part below it; no
    /// lower ones on a rigid plane.
    pub nodes: [Span; 2],
    /// Coefficients of friction of a node that sticks and of one that slips.
    pub friction: [f64; 2],
    /// A friction law in their place.
    pub law: Option<Law>,
    /// The bond of a joint that is not cracked; it has no friction law.
    pub bond: Option<BondLaw>,
    /// Angles of the segments of its upper and of its lower face to the line from heel to toe (rad); none of a straight
    /// crack.
    pub angles: [Vec<f64>; 2],
    /// What tells rocking and drifting from elastic deformation.
    pub give: RockingThresholds,
    /// What acts in it beside contact.
    pub inside: Inside,
}

impl Line {
    /// Whether anything bonds it; a bond without strength is that of a crack.
    pub(super) fn bonded(&self) -> bool {
        self.bond
            .is_some_and(|law| law.tensile > 0.0 || law.cohesion > 0.0)
    }

    /// The slip that breaks its bond (m), or the opening that does where it has no cohesion; none without a bond.
    pub(super) fn lasting_slip(&self) -> f64 {
        let Some(law) = self.bond.filter(|_| self.bonded()) else {
            return 0.0;
        };
        if law.cohesion > 0.0 {
            law.reach(1, law.cohesion)
        } else {
            law.reach(0, law.tensile)
        }
    }

    /// The only crack of a dam, between faces of so many nodes.
    pub fn only(nodes: [usize; 2], friction: [f64; 2], give: RockingThresholds) -> Self {
        Line {
            nodes: nodes.map(|count| Span { first: 0, count }),
            friction,
            law: None,
            bond: None,
            angles: [Vec::new(), Vec::new()],
            give,
            inside: Inside::default(),
        }
    }
}

/// What elastic deformation alone accounts for.
#[derive(Clone, Copy, Debug, Default)]
pub struct RockingThresholds {
    /// Rotation of the crack's faces against each other.
    pub rotation: f64,
    /// Gap.
    pub gap: f64,
}
