//! What is in a crack beside contact, as data: water and anchors; [`super::crack_forces`] is the same under way.

use crate::error::Error;
use crate::inside::{Anchor, Law};

/// Water in a crack; forces of each node across the crack, of the upper and of the lower face.
#[derive(Clone, Debug)]
pub struct FollowingWater {
    /// What its pressure does as the crack opens.
    pub law: Law,
    /// Opening over which it does (m).
    pub opening: f64,
    /// Forces at the static pressure (N).
    pub still: [Vec<f64>; 2],
    /// Forces at the reservoir's.
    pub full: [Vec<f64>; 2],
}

impl FollowingWater {
    /// Change of the force of a node, where it has a gap.
    #[inline(always)]
    pub(super) fn change(&self, face: usize, node: usize, gap: f64) -> f64 {
        let (still, full) = (self.still[face][node], self.full[face][node]);
        self.law.change(still, full, gap, self.opening)
    }
}

/// Water in a crack whose pressure changes with time, whatever the crack does; its forces are those beyond what the
/// bodies and other such water bear.
#[derive(Clone, Debug)]
pub struct RisingWater {
    /// Which crack, from the crest down.
    pub crack: usize,
    /// From when to when it changes, evenly (s).
    pub span: [f64; 2],
    /// Change of the forces of each node across the crack, of the upper and of the lower face (N).
    pub change: [Vec<f64>; 2],
}

impl RisingWater {
    /// How much of the change there is at a moment.
    pub(super) fn share(&self, time: f64) -> f64 {
        let [begin, end] = self.span;
        ((time - begin) / (end - begin)).clamp(0.0, 1.0)
    }
}

/// A point of a face: its nodes with their weights.
pub type Point = [(usize, f64); 3];

/// Where an anchor crosses a crack.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Which anchor of the dam it is.
    pub anchor: usize,
    /// Points that face each other before the earthquake: on the upper face and on the lower one, the latter not used on a
    /// rigid plane.
    pub points: [Point; 2],
}

/// An anchor at one of its cracks.
pub type FaceAnchor = Anchor<Crossing>;

/// All that acts in a crack beside contact.
#[derive(Clone, Debug, Default)]
pub struct Inside {
    /// Water whose pressure follows the opening.
    pub water: Option<FollowingWater>,
    /// Anchors that stretch.
    pub anchors: Vec<FaceAnchor>,
}

impl Inside {
    /// Whether nothing does.
    pub fn is_empty(&self) -> bool {
        self.water.is_none() && self.anchors.is_empty()
    }

    /// Whether all that acts is at nodes that are there, of faces of so many.
    ///
    /// # Errors
    /// Says what is not.
    pub(super) fn check(&self, counts: [usize; 2]) -> Result<(), Error> {
        let forces = |water: &[Vec<f64>; 2]| [water[0].len(), water[1].len()] == counts;
        if let Some(water) = &self.water {
            if !forces(&water.still) || !forces(&water.full) {
                return Err(Error::Water("the water needs a force for each crack node"));
            }
        }
        let there = |anchor: &FaceAnchor| {
            let mut faces = anchor.place.points.iter().zip(counts);
            faces.all(|(point, count)| point.iter().all(|(node, _)| *node < count.max(1)))
        };
        if !self.anchors.iter().all(there) {
            return Err(Error::Dam("an anchor needs nodes that are there"));
        }
        Ok(())
    }
}
