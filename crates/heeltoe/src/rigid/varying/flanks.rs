//! A block on a rough crack: both corners on flanks of one slope, from which the gaps count.
//!
//! With the slip X and the gaps counted from the flank, `Z = Z* + D`, `D' = k X'`, the block obeys its equations of motion
//! in other coordinates (see [`Instant::on`]), with the friction of [`crate::asperity`]. A flank ends at a valley or a peak,
//! where the velocities of the gaps change by (k_before - k_behind) X': at a peak the block flies off, in a valley it
//! strikes the next flank.
//!
//! Work wears the flank that is climbed while it is climbed, `k = tan(i_0 exp(-c W))`; the other flanks are found worn once
//! the block turns to them: a flank that gave way as the block comes down would grind it down the faster the more it does.

use super::super::block::{HEEL, SLIP};
use super::super::impact::impact;
use super::super::mode::{Corner, Mode, Slip};
use super::super::reaction::Reactions;
use super::super::walk::{Cause, Single};
use super::instant::{Instant, Slope, Still};
use super::ready::goes_upstream;
use super::rough::Rough;
use super::shaking::{Ground, Piece};
use super::step::State;
use super::walk::Varying;
use crate::asperity::{on_slopes, rise};
use crate::friction::Strength;

impl Varying<'_> {
    /// The block at a state, seen from a corner.
    pub(super) fn seen_from(&self, corner: Corner, state: &State, ground: &Ground) -> Instant {
        self.on_flank(corner, state, ground, self.slope(state))
    }

    /// The same on a flank whose slope is known.
    pub(super) fn on_flank(&self, corner: Corner, state: &State, ground: &Ground, slope: Slope) -> Instant {
        if self.rough.is_none() {
            return self.turning.at(corner, state, ground);
        }
        if !self.plain {
            return self.turning.at(corner, state, ground).on(slope);
        }
        self.still(corner).under(ground).on(slope)
    }

    /// The block seen from a corner, where its loads and its geometry stay as they are.
    pub(super) fn still(&self, corner: Corner) -> &Still {
        self.stills[corner.gap() - HEEL].get_or_init(|| Still::of(self.turning, corner))
    }

    /// Angle of the flank at a state of the present step: it wears as it is climbed.
    fn angle(&self, rough: &Rough, state: &State) -> f64 {
        if self.gives_way(rough) {
            rough.angle * rough.asperities.kept(-state[7] / rough.area)
        } else {
            rough.angle
        }
    }

    /// Slope of the flank at a state of the present step, and how friction wears it.
    pub(super) fn slope(&self, state: &State) -> Slope {
        let Some(rough) = &self.rough else {
            return Slope::default();
        };
        let (sign, angle) = (rise(rough.flank), self.angle(rough, state));
        let slope = sign * angle.tan();
        let mut wear = 0.0;
        if state[3] * sign > 0.0 {
            let per_work = -sign * rough.asperities.wear() * angle * (1.0 + slope * slope);
            wear = per_work * state[3] * state[3] / rough.area;
        }
        Slope { slope, wear }
    }

    /// What friction bears where the block is on its asperities, on a flank of the slope `own`.
    pub(super) fn leaning(&self, strength: Strength, state: &State, own: f64) -> Strength {
        let Some(rough) = &self.rough else {
            return strength;
        };
        let mut sides = [own; 2];
        if let Some([before, behind]) = self.stands_between(state) {
            let slope = |flank: i64| rise(flank) * rough.asperities.worn(rough.work).tan();
            sides = [slope(before), slope(behind)];
        }
        on_slopes(&strength, sides, own)
    }

    /// The flanks on both sides of a block that stands in a valley or on a peak, downstream or upstream neither way.
    pub(super) fn stands_between(&self, state: &State) -> Option<[i64; 2]> {
        let rough = self.rough.as_ref()?;
        if state[3] != 0.0 {
            return None;
        }
        let at = |flank: i64| state[0] == rough.asperities.turn(flank);
        if at(rough.flank) {
            Some([rough.flank - 1, rough.flank])
        } else if at(rough.flank + 1) {
            Some([rough.flank, rough.flank + 1])
        } else {
            None
        }
    }

    /// How far it is to the upstream and to the downstream end of the flank.
    pub(super) fn before_turns(&self, state: &State) -> [f64; 2] {
        let Some(rough) = &self.rough else {
            return [f64::INFINITY; 2];
        };
        let turn = |flank: i64| rough.asperities.turn(flank);
        [state[0] - turn(rough.flank), turn(rough.flank + 1) - state[0]]
    }

    /// Go over to the next flank, and say what that does: strike it, or leave the last one.
    pub(super) fn turn(&mut self) -> Cause {
        let before = self.slope(&self.state).slope;
        let [left, right] = self.before_turns(&self.state);
        if let Some(rough) = &mut self.rough {
            let next = if left.abs() < right.abs() {
                rough.flank - 1
            } else {
                rough.flank + 1
            };
            self.state[0] = rough.asperities.turn(rough.flank.max(next));
            rough.turn_to(next);
        }
        self.state[4] += (before - self.slope(&self.state).slope) * self.state[3];
        self.see();
        let lies = self.walk.mode.slip().is_some();
        if lies && self.state[4] < 0.0 {
            Cause::Gap(self.corner.gap())
        } else {
            Cause::Turn
        }
    }

    /// Reactions of all modes, where the block stands in a valley or on a peak each on the flank that it moves to; and
    /// what is on the flank upstream.
    pub(super) fn reactions_about(&mut self, piece: &Piece) -> (Reactions, bool) {
        let Some([before, behind]) = self.stands_between(&self.state) else {
            return (self.reactions_ahead(piece), false);
        };
        let mut on = |flank: i64| {
            self.stand_on(flank);
            self.reactions_ahead(piece)
        };
        let (upstream, downstream) = (on(before), on(behind));
        let falls = self.instant(&piece.ground).free_acceleration[SLIP] < 0.0;
        let either = downstream.or(&upstream, |mode| goes_upstream(mode, falls));
        (either, falls)
    }

    /// Be on the flank to which the mode goes that has been chosen.
    pub(super) fn take_side(&mut self, mode: Mode, falls: bool) {
        if let Some([before, behind]) = self.stands_between(&self.state) {
            self.stand_on(if goes_upstream(mode, falls) {
                before
            } else {
                behind
            });
        }
    }

    pub(super) fn stand_on(&mut self, flank: i64) {
        if let Some(rough) = &mut self.rough {
            rough.turn_to(flank);
        }
    }

    /// A block that comes down right in a valley or on a peak strikes the flank to which the blow sends it.
    pub(super) fn strike_on(&mut self, touching: [bool; 2]) {
        let Some([before, behind]) = self.stands_between(&self.state) else {
            return;
        };
        self.stand_on(behind);
        let velocity = self.velocity();
        let blow = impact(&self.block(), &velocity, None, touching, self.walk.settle);
        if blow.is_none_or(|blow| blow.velocity[SLIP] < 0.0) {
            self.stand_on(before);
        }
    }

    /// Where the block stands still along the crack, its flank is found as worn as the asperities are.
    pub(super) fn catch_up(&mut self) {
        let still = self.state[3] == 0.0;
        if let Some(rough) = self.rough.as_mut().filter(|_| still) {
            rough.turn_to(rough.flank);
        }
    }

    /// How far the flank has risen under the block on the way from `start` to `end`: while it wears, as integrated.
    fn risen(&self, rough: &Rough, start: &State, end: &State) -> f64 {
        if self.gives_way(rough) {
            end[8]
        } else {
            self.slope(start).slope * (end[0] - start[0])
        }
    }

    /// Whether the block climbs a flank that wears.
    pub(super) fn gives_way(&self, rough: &Rough) -> bool {
        let way = self.walk.mode.slip().map_or(0.0, Slip::sign);
        rough.asperities.wear() > 0.0 && way * rise(rough.flank) > 0.0
    }

    /// Note how far the flank has risen and worn on the way to `end`.
    pub(super) fn rise_to(&mut self, start: &State, end: &State) {
        let Some(rough) = &self.rough else {
            return;
        };
        let (risen, angle) = (self.risen(rough, start, end), self.angle(rough, end));
        let lies = self.walk.mode.slip().is_some();
        if let Some(rough) = &mut self.rough {
            rough.angle = angle;
            rough.work -= end[7] / rough.area;
            rough.level += risen;
            if lies {
                rough.highest = rough.highest.max(rough.level);
            }
        }
    }

    /// Keep the asperities at a state of the present step.
    pub(super) fn keep_rough(&mut self, start: &State, state: &State) {
        let Some(rough) = &self.rough else {
            return;
        };
        let risen = self.risen(rough, start, state);
        if let Some(rough) = &mut self.rough {
            let work = rough.work - state[7] / rough.area;
            rough
                .kept
                .push([rough.level + risen, rough.asperities.worn(work), work]);
        }
    }
}
