//! The block at any rotation: how its corners and its points move.
//!
//! Coordinates are the displacement (X, Z) along and across the crack of one corner c, heel or toe, and the rotation
//! theta. A point of the base, ahead of that corner by b, is at
//!
//! `(X + b (cos theta - 1), Z + b sin theta)`, with small rotations `(X, Z + b theta)`;
//!
//! the gaps are the Z of both corners. The slip is the X of the corner that is lower: of the one that the block stands on,
//! and of a block in the air, of the one that would land first. Both corners are at the same X where theta = 0, so that it
//! nowhere jumps; rocking leaves it where it is, and a block that is back on its base has slipped as far as it has moved.

use super::super::block::Vector;
use super::super::mode::Corner;
use super::shaking::TurningShaking;
use super::step::State;
use super::water::FollowingWater;
use crate::inside::{Anchor, Law};
use crate::table::{named, numbers};

named! {
    /// How the geometry goes by the rotation.
    Rotation {
        /// As if there were none.
        Small = "small",
        /// Small, but the moment of the weight changes with it.
        PDelta = "p-delta",
        /// Of any size.
        Finite = "finite",
    }
}

/// Loads that stay as they are: along, across, moment about the heel (counter-clockwise), and the sum of force times
/// distance from the heel, which says how the moment changes as the points of the block turn.
pub(super) type Dead = [f64; 4];

numbers! {
    /// The numbers that describe the block beyond those of the exact kernel; SI, per metre of dam; along and across the
    /// crack, from the heel.
    VaryingNumbers {
        /// Mass of the concrete.
        mass,
        /// Its moment of inertia about its centroid.
        inertia,
        /// Place of the centroid.
        centroid_along,
        /// Place of the centroid.
        centroid_across,
        /// Mass of the water that moves horizontally with the block.
        water_mass,
        /// Its place.
        water_along,
        /// Its place.
        water_across,
        /// The horizontal, downstream.
        horizontal_along,
        /// The horizontal, downstream.
        horizontal_across,
        /// Acceleration of gravity.
        gravity,
        /// Width of the crack.
        width,
        /// Loads that stay as they are.
        dead_along,
        /// Loads that stay as they are.
        dead_across,
        /// Their moment about the heel, counter-clockwise.
        dead_moment,
        /// Sum of these forces times their distance from the heel: how the moment changes as the block turns.
        dead_virial,
        /// Loads per unit of upward ground acceleration, the weight left out.
        per_vertical_along,
        /// Loads per unit of upward ground acceleration, the weight left out.
        per_vertical_across,
        /// Their moment.
        per_vertical_moment,
        /// Their virial.
        per_vertical_virial,
        /// Opening over which the pressure in the crack changes.
        opening,
        /// Pressure of the reservoir at the crack.
        full_pressure,
    }
}

/// A block with all that changes as it moves.
#[derive(Clone, Debug)]
pub struct TurningBlock {
    pub(in super::super) rotation: Rotation,
    pub(super) mass: f64,
    pub(super) inertia: f64,
    pub(super) centroid: [f64; 2],
    pub(super) water_mass: f64,
    pub(super) water_place: [f64; 2],
    /// The horizontal, downstream, along and across the crack.
    pub(super) horizontal: [f64; 2],
    pub(super) gravity: f64,
    pub(super) width: f64,
    pub(super) dead: Dead,
    /// Per unit of upward ground acceleration, the weight left out.
    pub(super) per_vertical: Dead,
    pub(super) water: FollowingWater,
    /// By their distance from the heel along the crack.
    pub(in super::super) anchors: Vec<Anchor<f64>>,
}

impl TurningBlock {
    /// A block whose crack holds water by this law and pressure while it is closed (distance from the heel in m, pressure
    /// in Pa; straight in between), and anchors by their distance from the heel.
    pub fn new(
        p: &VaryingNumbers,
        rotation: Rotation,
        law: Law,
        pressure: Vec<[f64; 2]>,
        anchors: Vec<Anchor<f64>>,
    ) -> Self {
        TurningBlock {
            rotation,
            mass: p.mass,
            inertia: p.inertia,
            centroid: [p.centroid_along, p.centroid_across],
            water_mass: p.water_mass,
            water_place: [p.water_along, p.water_across],
            horizontal: [p.horizontal_along, p.horizontal_across],
            gravity: p.gravity,
            width: p.width,
            dead: [p.dead_along, p.dead_across, p.dead_moment, p.dead_virial],
            per_vertical: [
                p.per_vertical_along,
                p.per_vertical_across,
                p.per_vertical_moment,
                p.per_vertical_virial,
            ],
            water: FollowingWater::new(law, pressure, p.opening, p.full_pressure),
            anchors,
        }
    }

    /// A force of the size of all that acts in a ground with these peaks, before it balances: what rounding is a part of.
    pub(super) fn force_scale(&self, [horizontal, up, spin]: [f64; 3]) -> f64 {
        let [lift, _] = self.water.force(0.0, 0.0);
        let held: f64 = self.anchors.iter().map(|anchor| anchor.prestress).sum();
        let [along, across, moment, _] = self.dead.map(f64::abs);
        let moved = (self.mass + self.water_mass) * horizontal + self.mass * (self.gravity + up);
        let arm = self.centroid[1].abs() + self.width;
        along + across + moment / self.width + lift.abs() + held + moved + self.mass * arm * spin
    }

    /// Whether loads and geometry stay as they are as it moves on this ground.
    pub(super) fn stays(&self, shaking: &TurningShaking) -> bool {
        self.rotation == Rotation::Small
            && self.water.law == Law::Constant
            && self.anchors.is_empty()
            && shaking.is_level()
    }

    /// Distance of the corner from the heel.
    pub(super) fn place(&self, corner: Corner) -> f64 {
        match corner {
            Corner::Heel => 0.0,
            Corner::Toe => self.width,
        }
    }

    /// How far the other corner is ahead of this one.
    pub(super) fn ahead(&self, corner: Corner) -> f64 {
        match corner {
            Corner::Heel => self.width,
            Corner::Toe => -self.width,
        }
    }

    /// Sine and cosine that the geometry goes by.
    pub(super) fn turned(&self, theta: f64) -> [f64; 2] {
        match self.rotation {
            Rotation::Finite => [theta.sin(), theta.cos()],
            _ => [0.0, 1.0],
        }
    }

    /// How far a point of the base, `ahead` of the corner, is lifted above it by the rotation.
    pub(super) fn lift(&self, ahead: f64, theta: f64) -> f64 {
        match self.rotation {
            Rotation::Finite => ahead * theta.sin(),
            _ => ahead * theta,
        }
    }

    /// Velocity of that lift, with the rotation and its rate.
    pub(super) fn lift_velocity(&self, ahead: f64, theta: f64, rate: f64) -> f64 {
        ahead * self.turned(theta)[1] * rate
    }

    /// Gaps at heel and toe.
    pub(super) fn gaps(&self, corner: Corner, state: &State) -> [f64; 2] {
        match corner {
            Corner::Heel => [state[1], state[1] + self.lift(self.width, state[2])],
            Corner::Toe => [state[1] + self.lift(-self.width, state[2]), state[1]],
        }
    }

    /// Velocities of slip, heel gap and toe gap.
    pub(super) fn contact_velocity(&self, corner: Corner, state: &State) -> Vector {
        match corner {
            Corner::Heel => [
                state[3],
                state[4],
                state[4] + self.lift_velocity(self.width, state[2], state[5]),
            ],
            Corner::Toe => [
                state[3],
                state[4] + self.lift_velocity(-self.width, state[2], state[5]),
                state[4],
            ],
        }
    }

    /// Accelerations of slip, heel gap and toe gap where the state changes at `rate`.
    pub(super) fn contact_acceleration(&self, corner: Corner, state: &State, rate: &State) -> Vector {
        let [sine, cosine] = self.turned(state[2]);
        let spin = state[5];
        let other = rate[4] + self.ahead(corner) * (cosine * rate[5] - sine * spin * spin);
        match corner {
            Corner::Heel => [rate[3], rate[4], other],
            Corner::Toe => [rate[3], other, rate[4]],
        }
    }

    /// The same state seen from the other corner.
    pub(super) fn other_corner(&self, corner: Corner, state: &State) -> State {
        let ahead = self.ahead(corner);
        let [sine, cosine] = self.turned(state[2]);
        let mut other = *state;
        other[0] += ahead * (cosine - 1.0);
        other[1] += self.lift(ahead, state[2]);
        other[3] -= ahead * sine * state[5];
        other[4] += ahead * cosine * state[5];
        other
    }

    /// The corner whose way along the crack is the slip of a block in the air that counts from `corner`.
    pub(super) fn lower(&self, corner: Corner, theta: f64) -> Corner {
        match self.rotation {
            Rotation::Finite if theta > 0.0 => Corner::Heel,
            Rotation::Finite if theta < 0.0 => Corner::Toe,
            _ => corner,
        }
    }

    /// How far the upper end of an anchor has moved along and across the crack.
    pub(super) fn anchor_moves(&self, corner: Corner, state: &State, anchor: &Anchor<f64>) -> [f64; 2] {
        let ahead = anchor.place - self.place(corner);
        let along = match self.rotation {
            Rotation::Finite => ahead * (state[2].cos() - 1.0),
            _ => 0.0,
        };
        [state[0] + along, state[1] + self.lift(ahead, state[2])]
    }
}
