//! The state of a dam before the earthquake; [`super::start`] finds it.

use super::bodies::Sides;
use super::body::ReducedBody;
use super::bond::Bonds;
use super::law::worked::Worked;
use super::simd::Group;
use super::status::Status;

/// A dam at rest.
#[derive(Clone, Debug)]
pub struct Still {
    /// Modes of both parts.
    pub(super) modes: [Vec<Group>; 2],
    /// Positions of the crack nodes of both faces.
    pub(super) position: [Vec<f64>; 2],
    /// Forces of contact on them.
    pub force: [Vec<f64>; 2],
    /// Force and state of each contact.
    pub(super) contact: Vec<f64>,
    pub(super) status: Vec<Status>,
    /// What contacts of cracks with a law have been through.
    pub(super) worked: Vec<Worked>,
    /// The bonds of joints.
    pub(super) bonds: Option<Bonds>,
    /// By how much each crack has slipped since it was bonded, from the crest down.
    pub slip: Vec<f64>,
    /// Number of contacts of each that are open.
    pub open: Vec<usize>,
}

impl Still {
    /// Amplitudes of the modes of the upper and of the lower body.
    pub fn amplitudes(&self, bodies: &Sides<ReducedBody>) -> [Vec<f64>; 2] {
        let kept = |body: &ReducedBody, modes: &[Group]| modes.as_flattened()[..body.modes].to_vec();
        let lower = bodies.lower.as_ref();
        [
            kept(&bodies.upper, &self.modes[0]),
            lower.map_or(Vec::new(), |body| kept(body, &self.modes[1])),
        ]
    }
}
