//! A block whose loads and geometry stay as they are, whatever its friction: where friction stays, too, or has no part in
//! the motion, the way is the cubic one of the exact walk.
//!
//! That is so at rest, in the air and as it rocks without slip, and in a slide whose law has come to a constant; on a
//! rough crack in coordinates counted from the flank, `g = g* + k s`:
//!
//! `b* = (b_s, b_h - k b_s, b_t - k b_s)`, `F_s* = F_s + k (F_h + F_t)`.

use std::rc::Rc;

use super::super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::super::choice::Modes;
use super::super::course::{Course, Earliest};
use super::super::event;
use super::super::ledger::work;
use super::super::mode::Mode;
use super::super::reaction::{Felt, Reaction};
use super::super::walk::Cause;
use super::advance::Trial;
use super::instant::Slope;
use super::ready::{Blocks, Ready};
use super::shaking::{level, Piece};
use super::step::State;
use super::walk::Varying;

/// A cubic way on what is left of a piece of the record.
pub(super) struct Cubic {
    position: Vector,
    velocity: Vector,
    felt: Felt,
    motion: [[f64; 2]; 3],
    /// Forces that do work on slip and gaps, and how they change.
    load: [[f64; 2]; 3],
    rubs: bool,
}

impl Cubic {
    /// How far each coordinate has come, how fast it is, and the works of the loads and of friction.
    fn at(&self, t: f64) -> ([Vector; 2], [f64; 2]) {
        let at = |i: usize| {
            let [a0, a1] = self.motion[i];
            self.position[i] + t * (self.velocity[i] + t * (a0 / 2.0 + t * a1 / 6.0))
        };
        let speed = |i: usize| {
            let [a0, a1] = self.motion[i];
            self.velocity[i] + t * (a0 + t * a1 / 2.0)
        };
        let worked = |i: usize| work(self.load[i], self.velocity[i], self.motion[i], t).net;
        let rubbed = if self.rubs {
            let friction = [self.felt.value[SLIP], self.felt.slope[SLIP]];
            work(friction, self.velocity[SLIP], self.motion[SLIP], t).net
        } else {
            0.0
        };
        let all = [SLIP, HEEL, TOE];
        (
            [all.map(at), all.map(speed)],
            [all.map(worked).iter().sum(), rubbed],
        )
    }
}

impl Varying<'_> {
    /// Whether what friction bears in the present contact is known without integrating: it does not go by the normal
    /// force, and the block stands or its law has come to a constant; no flank gives way.
    fn is_ready(&self) -> bool {
        let rubbing = &self.rubbing;
        let known = !rubbing.bends() && (self.state[3] == 0.0 || rubbing.settled());
        known && (self.plain || self.lies_level()) && self.slope(&self.state).wear == 0.0
    }

    /// Whether it lies on both corners, with nothing across the crack and on a ground that does not turn: as long as it
    /// does, loads and geometry stay as they are.
    fn lies_level(&self) -> bool {
        self.level && self.turning.anchors.is_empty() && super::super::walk::Single::closed(self) == [true; 2]
    }

    /// Whether friction stays as it is in the present slip: neither its law changes nor the flank that is climbed.
    fn rubs_evenly(&self) -> bool {
        self.rubbing.settled() && !self.rough.as_ref().is_some_and(|rough| self.gives_way(rough))
    }

    /// The block as it is on its flank, with the friction of this moment.
    fn blocks(&self) -> Blocks {
        let Slope { slope, .. } = self.slope(&self.state);
        let block = self.walk.block.counted_from(slope);
        let normal = self.rubbing.still * self.rubbing.width;
        [Mode::Rest, Mode::Drift].map(|mode| block.rubbing(&self.strength(mode, normal, &self.state)))
    }

    /// The reactions of all modes on a plane crack whose friction nothing changes any more.
    fn settled(&self) -> Option<&Rc<Ready>> {
        let settled = self.rough.is_none() && self.rubbing.settled() && !self.rubbing.bends();
        settled.then(|| {
            self.settled
                .get_or_init(|| Rc::new(Ready::new(self.blocks(), None)))
        })
    }

    /// The reactions of all modes, and whether what is chosen in the air goes upstream; none where they take more than
    /// that. Where the block stands in a valley or on a peak each is on the flank that the mode goes to.
    pub(super) fn ready(&mut self, piece: &Piece) -> Option<(Rc<Ready>, bool)> {
        if !self.is_ready() {
            return None;
        }
        if let Some(settled) = self.settled() {
            return Some((settled.clone(), false));
        }
        let (downstream, upstream) = match self.stands_between(&self.state) {
            None => (self.blocks(), None),
            Some([before, behind]) => {
                self.stand_on(before);
                let upstream = self.blocks();
                self.stand_on(behind);
                let downstream = self.blocks();
                let free = self.walk.block.free_acceleration[SLIP];
                (downstream, Some((upstream, free.at(level(piece).ground) < 0.0)))
            }
        };
        let falls = upstream.as_ref().is_some_and(|(_, falls)| *falls);
        Some((Rc::new(Ready::new(downstream, upstream)), falls))
    }

    /// The cubic way from the present state on, and the reactions by which it goes; none where it has another.
    fn cubic(&self, piece: &Piece) -> Option<(Cubic, Reaction)> {
        let mode = self.walk.mode;
        let goes = match mode {
            Mode::Drift => true,
            Mode::Rest | Mode::Rock(_) => self.is_ready(),
            Mode::Slide(_) | Mode::SlideRock(..) => self.is_ready() && self.rubs_evenly(),
        };
        // Once a corner has lifted, nothing but what never changes stays as it is.
        if !goes || !self.plain && mode.contacts() != [true, true] || piece.left <= 0.0 {
            return None;
        }
        let here;
        let ready = match self.settled() {
            Some(settled) => settled,
            None => {
                here = Rc::new(Ready::new(self.blocks(), None));
                &here
            }
        };
        let reaction = *ready.of(mode);
        if !reaction.regular {
            return None;
        }
        let level = level(piece);
        let mut felt = Felt::default();
        reaction.on(&level, &mut felt);
        let [position, velocity] = self.contact(&self.state);
        let closed = super::super::walk::Single::closed(self);
        let course = Course::begin(&reaction, felt, mode.free(), velocity[SLIP], closed, &level);
        let load = ready.block(mode).generalised_force;
        let cubic = Cubic {
            position,
            velocity,
            felt,
            motion: course.motion,
            load: load.map(|load| [load.at(level.ground), load.slope(level.rate)]),
            rubs: mode.slip().is_some(),
        };
        Some((cubic, reaction))
    }

    /// The state after `since` on a cubic way.
    pub(super) fn by_cubic(&self, start: &State, piece: &Piece, since: f64) -> Option<State> {
        let (cubic, _) = self.cubic(piece)?;
        Some(self.state_on(&cubic, start, since))
    }

    fn state_on(&self, cubic: &Cubic, start: &State, since: f64) -> State {
        let ([position, velocity], [worked, rubbed]) = cubic.at(since);
        let own = self.corner.gap();
        let block = self.walk.block;
        let mut state = *start;
        state[0] = position[SLIP];
        state[1] = position[own];
        state[3] = velocity[SLIP];
        state[4] = velocity[own];
        if self.walk.mode.contacts() != [true, true] {
            state[2] = block.rotation(&position);
            state[5] = block.rotation(&velocity);
        }
        state[6] += worked;
        state[7] += rubbed;
        state
    }

    /// Go the cubic way to the next event or to the end of the piece; returns the time that took and what ended it, or
    /// nothing where the block goes another way.
    pub(super) fn advance_exactly(&mut self, piece: &Piece, time: f64) -> Option<(f64, Option<Cause>)> {
        let (cubic, reaction) = self.cubic(piece)?;
        let level = level(piece);
        let course = Course {
            felt: cubic.felt,
            motion: cubic.motion,
            piece: &level,
        };
        let mut earliest = Earliest {
            step: piece.left,
            ended: None,
        };
        let (position, velocity) = (&cubic.position, &cubic.velocity);
        course.first_event_in(self.walk.mode, &reaction, [position, velocity], 0, &mut earliest);
        if self.rough.is_some() && self.walk.mode.free()[SLIP] {
            let [a0, a1] = cubic.motion[SLIP];
            let turns = self.before_turns(&self.state);
            for (left, way) in turns.into_iter().zip([1.0, -1.0]) {
                let root = event::cubic(
                    left,
                    way * velocity[SLIP],
                    way * a0 / 2.0,
                    way * a1 / 6.0,
                    piece.left,
                );
                if let Some(t) = root {
                    earliest.note(t, (0, Cause::Turn));
                }
            }
        }
        let (at, cause) = (earliest.step, earliest.ended.map(|(_, cause)| cause));
        let mut end = self.state_on(&cubic, &self.state, at);
        if cause == Some(Cause::Stop) {
            end[3] = 0.0;
        }
        let trial = Trial::still(self.state, self.rate_of(&cubic), piece.left, piece);
        self.move_on(&trial, &end, at, time);
        Some(match cause {
            Some(Cause::Turn) => (at, Some(self.turn())),
            _ => (at, cause),
        })
    }

    /// The rate of change of the state where a cubic way begins, but for the works.
    fn rate_of(&self, cubic: &Cubic) -> State {
        let start = cubic.motion.map(|[start, _]| start);
        let own = start[self.corner.gap()];
        let [_, _, _, slip, gap, turn, ..] = self.state;
        [
            slip,
            gap,
            turn,
            start[SLIP],
            own,
            self.walk.block.rotation(&start),
            0.0,
            0.0,
            0.0,
        ]
    }
}

impl Block {
    /// The block with its gaps counted from a slope.
    fn counted_from(&self, slope: f64) -> Block {
        let mut block = self.on_slope(slope);
        if slope == 0.0 {
            return block;
        }
        let less = |from: Affine, k: f64, what: Affine| Affine {
            constant: from.constant - k * what.constant,
            horizontal: from.horizontal - k * what.horizontal,
            vertical: from.vertical - k * what.vertical,
        };
        for gap in [HEEL, TOE] {
            block.free_acceleration[gap] =
                less(block.free_acceleration[gap], slope, block.free_acceleration[SLIP]);
            block.generalised_force[SLIP] = less(
                block.generalised_force[SLIP],
                -slope,
                block.generalised_force[gap],
            );
            for j in 0..3 {
                block.compliance[gap][j] -= slope * block.compliance[SLIP][j];
            }
        }
        for i in 0..3 {
            for gap in [HEEL, TOE] {
                block.compliance[i][gap] -= slope * block.compliance[i][SLIP];
            }
        }
        block
    }
}
