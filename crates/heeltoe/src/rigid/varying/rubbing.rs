//! The friction law of a crack, what the crack has been through, and how well that is known.

use super::super::block::{Block, HEEL, TOE};
use super::super::result::Wear;
use crate::friction::{Law, Worn};

/// Errors estimated of all integrated steps.
#[derive(Default)]
pub(super) struct Gathered {
    /// Of the slip (m).
    pub slip: f64,
    /// Of its velocity since the block last rested (m/s).
    pub speed: f64,
    /// Time that these steps took (s).
    pub time: f64,
}

/// Friction by a law, and what it goes by.
pub(super) struct Rubbing<'a> {
    pub(super) law: &'a Law,
    pub(super) width: f64,
    /// Normal stress under the static loads: an impulse meets the friction that goes with it.
    pub(super) still: f64,
    pub worn: Worn,
    /// Of each moment that is kept: path, and whether the bond is whole.
    pub kept: Vec<[f64; 2]>,
}

impl<'a> Rubbing<'a> {
    pub(super) fn new(law: &'a Law, worn: Worn, block: &Block) -> Self {
        let normal = -block.generalised_force[HEEL].constant - block.generalised_force[TOE].constant;
        Rubbing {
            law,
            width: block.width,
            still: (normal / block.width).max(0.0),
            worn,
            kept: Vec::new(),
        }
    }

    /// Hand over what there is to tell.
    pub(super) fn told(self, error: &Gathered) -> Wear {
        Wear {
            kept: self.kept,
            end: self.worn,
            error: error.slip,
            integrated: error.time,
        }
    }

    /// The largest force that its bond bears.
    pub(super) fn bond(&self) -> f64 {
        self.law.cohesion() * self.width
    }

    /// Whether what it bears is a straight line over the path up to the next corner.
    pub(super) fn straight(&self, pressed_evenly: bool) -> bool {
        self.law.straight(self.worn, pressed_evenly)
    }

    /// The path at which what it bears next has a corner.
    pub(super) fn corner(&self) -> f64 {
        self.law.corner(self.worn)
    }

    /// Whether what it bears is no straight line over the normal force.
    pub(super) fn bends(&self) -> bool {
        self.law.by_stress()
    }

    /// Whether nothing changes what it bears any more.
    pub(super) fn settled(&self) -> bool {
        self.law.settled(self.worn)
    }

    /// Whether it bends downward alone.
    pub(super) fn sags_nowhere(&self) -> bool {
        self.law.sags_nowhere()
    }
}
