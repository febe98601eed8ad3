//! Friction by a law: what it bears in a mode, at a state, and what the crack has been through.
//!
//! Where the strength bends with the normal force, `T = -S (mu(N) N + c)` is solved by tangents (Newton's method).

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::mode::{Mode, Slip};
use super::super::reaction::reaction_to;
use super::instant::Instant;
use super::step::State;
use super::walk::Varying;
use crate::friction::{Strength, Worn};

/// Tangents before giving up; two or three do, one where the normal force does not go by friction.
const TANGENTS: usize = 30;
/// The normal force is found to this part of the forces.
const FOUND: f64 = 1e-14;

impl Varying<'_> {
    /// What the crack has been through at a state of the present step.
    fn worn_at(&self, state: &State) -> Worn {
        let worn = self.rubbing.worn;
        let slips = self.walk.mode.slip().is_some();
        let way = if slips {
            (state[0] - self.state[0]).abs()
        } else {
            0.0
        };
        Worn {
            path: worn.path + way,
            ..worn
        }
    }

    /// What friction bears about a normal force in a mode at a state of the present step.
    pub(super) fn strength(&self, mode: Mode, normal: f64, state: &State) -> Strength {
        self.strength_on(mode, normal, state, self.slope(state).slope)
    }

    /// The same on a flank whose slope is known.
    fn strength_on(&self, mode: Mode, normal: f64, state: &State, slope: f64) -> Strength {
        let (rubbing, worn) = (&self.rubbing, self.worn_at(state));
        let bonded = worn.bonded && mode.contacts() == [true, true];
        let speed = state[3].abs();
        let strength = rubbing
            .law
            .strength(rubbing.width, normal, speed, Worn { bonded, ..worn });
        self.leaning(strength, state, slope)
    }

    /// Reactions in a mode at a state of the present step, and what friction bears there; none where friction makes the
    /// reactions infinite.
    pub(super) fn rubbed(&self, mode: Mode, state: &State, instant: &Instant) -> Option<(Vector, Strength)> {
        let mut normal = self.rubbing.still * self.rubbing.width;
        let bends = self.rubbing.bends();
        let mut strength = self.strength_on(mode, normal, state, instant.slope);
        let mut reactions = under(&strength, mode, instant)?;
        for _ in 0..TANGENTS {
            let now = reactions[HEEL] + reactions[TOE];
            if !bends || (now - normal).abs() <= FOUND * self.walk.block.force_scale {
                break;
            }
            normal = now;
            strength = self.strength_on(mode, normal, state, instant.slope);
            reactions = under(&strength, mode, instant)?;
        }
        Some((reactions, strength))
    }

    /// How much more the base that slips now would be pulled after a short while, under the same normal forces.
    pub(super) fn changed_pull(&self, reactions: &Vector, later: &State) -> f64 {
        let slip = self.state[3];
        if self.rubbing.settled() || slip == 0.0 {
            return 0.0;
        }
        let normal = reactions[HEEL] + reactions[TOE];
        let [now, then] = [&self.state, later].map(|state| {
            let Strength {
                coefficient: [_, coefficient],
                constant: [_, constant],
                lean: [_, lean],
            } = self.strength(self.walk.mode, normal, state);
            (coefficient + slip.signum() * lean) * normal + constant
        });
        -slip.signum() * (then - now)
    }

    /// The friction that an impulse meets.
    pub(super) fn struck(&self) -> Strength {
        let rubbing = &self.rubbing;
        let speed = self.state[3].abs();
        let strength = Strength {
            coefficient: rubbing.law.coefficients(rubbing.still, speed, rubbing.worn.path),
            ..Strength::default()
        };
        self.leaning(strength, &self.state, self.slope(&self.state).slope)
    }

    /// Note how far the base has slipped on the way to `end`; true where that went past a corner of the law.
    pub(super) fn wear(&mut self, end: &State) -> bool {
        let worn = self.worn_at(end);
        let past = worn.path > self.rubbing.corner();
        self.rubbing.worn = worn;
        past
    }

    /// Note that the path has come to a corner of the law: it lies exactly there.
    pub(super) fn turn_corner(&mut self, corner: f64) {
        self.rubbing.worn.path = corner;
    }

    /// Note that a corner has lifted, where one has.
    pub(super) fn lift(&mut self) {
        let lies = self.walk.mode.contacts() == [true, true];
        self.rubbing.worn.bonded &= lies;
    }

    /// Break the bond; false where there is none.
    pub(super) fn break_bond(&mut self) -> bool {
        std::mem::take(&mut self.rubbing.worn.bonded) && self.rubbing.bond() > 0.0
    }

    /// Keep what the crack has been through at a state of the present step.
    pub(super) fn keep_worn(&mut self, state: &State) {
        let worn = self.worn_at(state);
        self.rubbing.kept.push([worn.path, f64::from(worn.bonded)]);
    }
}

/// Reactions of a mode where friction bears this.
pub(super) fn under(strength: &Strength, mode: Mode, instant: &Instant) -> Option<Vector> {
    let way = mode.slip().map_or(0.0, Slip::sign);
    let coefficient = strength.coefficient[1] + way * strength.lean[1];
    let pull = -way * strength.constant[1];
    if pull == 0.0 {
        return reaction_to(&instant.compliance, coefficient, mode, &instant.free_acceleration);
    }
    let mut free = instant.free_acceleration;
    for (value, row) in free.iter_mut().zip(&instant.compliance) {
        *value += row[SLIP] * pull;
    }
    let mut reactions = reaction_to(&instant.compliance, coefficient, mode, &free)?;
    reactions[SLIP] += pull;
    Some(reactions)
}
