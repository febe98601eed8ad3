//! The state of a dam before the earthquake; [`super::start`] finds it.

use super::body::ReducedBody;
use super::bond::Bonds;
use super::crack_line::Line;
use super::faces::Faces;
use super::law::worked::Worked;
use super::place::Place;
use super::simd::Group;
use super::status::Status;
use crate::table::named;

named! {
    /// Why a dam has no state of rest.
    #[derive(Default)]
    Unrest {
        /// It was not sought, or somebody has stopped the search.
        #[default]
        NotSought = "not sought",
        /// A part moves on and on: nothing holds it.
        MovesAway = "moves away",
        /// The search has ended before it was at rest, which shows neither that the dam stands nor that it does not.
        NotFound = "not found",
    }
}

/// A dam at rest.
#[derive(Clone, Debug)]
pub struct Still {
    /// Modes of all parts, from the crest down.
    pub(super) modes: Vec<Vec<Group>>,
    /// Positions of the crack nodes of each part.
    pub(super) position: Vec<Vec<f64>>,
    /// Forces of contact on them.
    pub(super) force: Vec<Vec<f64>>,
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
    /// Amplitudes of the modes of all parts.
    pub fn amplitudes(&self, bodies: &[ReducedBody]) -> Vec<Vec<f64>> {
        let own = |(body, modes): (&ReducedBody, &Vec<Group>)| body.without_filling(modes).to_vec();
        bodies.iter().zip(&self.modes).map(own).collect()
    }

    /// Forces of contact on the upper face of each crack (N), all along it, then all across it.
    pub fn forces(&self, cracks: &[Line]) -> Vec<Vec<f64>> {
        let places = Place::all(cracks).into_iter().enumerate();
        let own = |(crack, place): (usize, Place)| {
            let upper = place.of(Faces::around(crack, &self.force, |force| force)).upper;
            [upper.along, upper.across].concat()
        };
        places.map(own).collect()
    }
}
