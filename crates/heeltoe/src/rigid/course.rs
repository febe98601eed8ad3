//! The way of a block on a piece of the record, cubic in time, and the first event on it: the earliest root of what must
//! not fall through zero.

use super::block::{Vector, HEEL, SLIP, TOE};
use super::choice::{accelerations, VIOLATION};
use super::event;
use super::mode::{Corner, Mode};
use super::reaction::{Felt, Reaction, CONE};
use super::result::Moment;
use super::shaking::Piece;
use super::walk::{Cause, Ended};

/// How a block moves on one piece: reactions, acceleration and slope of each coordinate, the ground.
pub(super) struct Course<'a> {
    pub felt: Felt,
    pub motion: [[f64; 2]; 3],
    pub piece: &'a Piece<2>,
}

/// When a piece ends, and what ends it before its time.
pub(super) struct Earliest {
    pub step: f64,
    pub ended: Option<Ended>,
}

impl Earliest {
    #[inline(always)]
    pub(super) fn note(&mut self, t: f64, ended: Ended) {
        if t < self.step || (t == self.step && self.ended.is_none()) {
            self.step = t;
            self.ended = Some(ended);
        }
    }
}

impl<'a> Course<'a> {
    /// How it begins to move in a mode in which so much of slip, heel gap and toe gap is free; `closed` are the corners
    /// that lie.
    #[inline(always)]
    pub(super) fn begin(
        reaction: &Reaction,
        felt: Felt,
        free: [bool; 3],
        slip_velocity: f64,
        closed: [bool; 2],
        piece: &'a Piece<2>,
    ) -> Self {
        let starts = [
            if free[SLIP] && slip_velocity == 0.0 {
                reaction.way
            } else {
                0.0
            },
            f64::from(free[HEEL] && closed[0]),
            f64::from(free[TOE] && closed[1]),
        ];
        Course {
            motion: accelerations(reaction, &felt, starts, piece.left),
            felt,
            piece,
        }
    }

    /// A coordinate that began at `w` with the velocity `v`, after a time.
    #[inline(always)]
    pub(super) fn position(&self, i: usize, w: f64, v: f64, t: f64) -> f64 {
        let [a0, a1] = self.motion[i];
        w + t * (v + t * (a0 / 2.0 + t * a1 / 6.0))
    }

    /// Its velocity.
    #[inline(always)]
    pub(super) fn velocity(&self, i: usize, v: f64, t: f64) -> f64 {
        let [a0, a1] = self.motion[i];
        v + t * (a0 + t * a1 / 2.0)
    }

    /// The block after a time.
    pub(super) fn moment(&self, mode: Mode, w: &Vector, v: &Vector, t: f64) -> Moment {
        let [slip, heel, toe] = [SLIP, HEEL, TOE].map(|i| self.position(i, w[i], v[i], t));
        Moment {
            mode,
            position: [slip, heel.max(0.0), toe.max(0.0)],
            velocity: [SLIP, HEEL, TOE].map(|i| self.velocity(i, v[i], t)),
            acceleration: self.motion.map(|[start, slope]| start + slope * t),
            reaction: [SLIP, HEEL, TOE].map(|i| self.felt.value[i] + self.felt.slope[i] * t),
        }
    }

    /// Look for the first event of the crack of this number in a mode.
    #[inline(always)]
    pub(super) fn first_event_in(
        &self,
        mode: Mode,
        reaction: &Reaction,
        [w, v]: [&Vector; 2],
        crack: usize,
        earliest: &mut Earliest,
    ) {
        match mode {
            Mode::Rest => self.first_event::<false, false, false>(reaction, w, v, crack, earliest),
            Mode::Slide(_) => self.first_event::<true, false, false>(reaction, w, v, crack, earliest),
            Mode::Rock(Corner::Heel) => {
                self.first_event::<false, false, true>(reaction, w, v, crack, earliest)
            }
            Mode::Rock(Corner::Toe) => {
                self.first_event::<false, true, false>(reaction, w, v, crack, earliest)
            }
            Mode::SlideRock(Corner::Heel, _) => {
                self.first_event::<true, false, true>(reaction, w, v, crack, earliest);
            }
            Mode::SlideRock(Corner::Toe, _) => {
                self.first_event::<true, true, false>(reaction, w, v, crack, earliest);
            }
            Mode::Drift => self.first_event::<true, true, true>(reaction, w, v, crack, earliest),
        }
    }

    /// The same where it is known what of slip, heel gap and toe gap is free to move.
    #[inline(always)]
    pub(super) fn first_event<const S: bool, const H: bool, const T: bool>(
        &self,
        reaction: &Reaction,
        position: &Vector,
        velocity: &Vector,
        crack: usize,
        earliest: &mut Earliest,
    ) {
        let (felt, left) = (&self.felt, self.piece.left);
        let mut falls = |i: usize, why: Cause| {
            let (value, slope) = (felt.value[i], felt.slope[i]);
            if value + slope * left < -VIOLATION * reaction.size[i] && slope < 0.0 {
                earliest.note(event::linear(value, slope, left), (crack, why));
            }
        };
        if !H {
            falls(HEEL, Cause::Normal);
        }
        if !T {
            falls(TOE, Cause::Normal);
        }
        if !S {
            falls(CONE, Cause::Cone);
            falls(CONE + 1, Cause::Cone);
        }
        // In the air nothing rubs, and the slip may turn.
        if S && !(H && T) {
            let s = reaction.way;
            let [a0, a1] = self.motion[SLIP];
            if let Some(t) = event::quadratic(s * velocity[SLIP], s * a0, s * a1 / 2.0, left) {
                earliest.note(t, (crack, Cause::Stop));
            }
        }
        for (free, gap) in [(H, HEEL), (T, TOE)] {
            if !free {
                continue;
            }
            let [a0, a1] = self.motion[gap];
            let root = event::cubic(position[gap], velocity[gap], a0 / 2.0, a1 / 6.0, left);
            if let Some(t) = root {
                earliest.note(t, (crack, Cause::Gap(gap)));
            }
        }
    }
}
