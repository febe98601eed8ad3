//! The first event on a piece: the earliest root of what must not fall through zero.

use super::super::block::{Affine, HEEL, SLIP, TOE};
use super::super::choice::{accelerations, VIOLATION};
use super::super::event;
use super::super::mode::Slip;
use super::super::reaction::Reaction;
use super::super::shaking::Piece;
use super::super::walk::{Carried, Cause};
use super::walk::Exact;

/// How the block moves on one piece: reactions, acceleration and slope of each coordinate, the ground.
pub(super) struct Course<'a> {
    pub force: &'a [Affine; 3],
    pub motion: [[f64; 2]; 3],
    pub piece: &'a Piece<2>,
}

impl Exact<'_> {
    /// Move to the next event or to the end of the piece; returns the time that took and what ended it.
    pub(super) fn advance(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Cause>) {
        let reaction = self.reactions.of(self.walk.mode);
        let closed = self.closed();
        let starts = [
            if self.walk.summary.velocity[SLIP] == 0.0 {
                self.walk.mode.slip().map_or(0.0, Slip::sign)
            } else {
                0.0
            },
            f64::from(closed[0]),
            f64::from(closed[1]),
        ];
        let course = Course {
            force: &reaction.force,
            motion: accelerations(reaction, starts, piece),
            piece,
        };
        let (step, cause) = self.first_event(reaction, &course);
        self.move_on(&course, step, time);
        match cause {
            Some(Cause::Stop) => self.walk.summary.velocity[SLIP] = 0.0,
            Some(Cause::Gap(gap)) => self.walk.summary.position[gap] = 0.0,
            _ => {}
        }
        (step, cause)
    }

    /// When the piece ends, and what ends it before its time.
    fn first_event(&self, reaction: &Reaction, course: &Course) -> (f64, Option<Cause>) {
        let Course { motion, piece, .. } = course;
        let (mode, contacts) = (self.walk.mode, self.walk.mode.contacts());
        let (position, velocity) = (&self.walk.summary.position, &self.walk.summary.velocity);
        let mut step = piece.left;
        let mut cause = None;
        let mut earlier = |t: f64, why: Cause| {
            if t < step || (t == step && cause.is_none()) {
                step = t;
                cause = Some(why);
            }
        };
        let mut falls = |q: Affine, size: f64, why: Cause| {
            let (value, slope) = (q.at(piece.ground), q.slope(piece.rate));
            if value + slope * piece.left < -VIOLATION * size && slope < 0.0 {
                earlier(event::linear(value, slope, piece.left), why);
            }
        };
        if contacts[0] {
            falls(reaction.force[HEEL], reaction.force_size[HEEL], Cause::Normal);
        }
        if contacts[1] {
            falls(reaction.force[TOE], reaction.force_size[TOE], Cause::Normal);
        }
        if mode.sticks() {
            falls(reaction.cone[0], reaction.cone_size, Cause::Cone);
            falls(reaction.cone[1], reaction.cone_size, Cause::Cone);
        }
        if let Some(slip) = mode.slip() {
            let s = slip.sign();
            let [a0, a1] = motion[SLIP];
            if let Some(t) = event::quadratic(s * velocity[SLIP], s * a0, s * a1 / 2.0, piece.left) {
                earlier(t, Cause::Stop);
            }
        }
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if contacts[corner] {
                continue;
            }
            let [a0, a1] = motion[gap];
            let root = event::cubic(position[gap], velocity[gap], a0 / 2.0, a1 / 6.0, piece.left);
            if let Some(t) = root {
                earlier(t, Cause::Gap(gap));
            }
        }
        (step, cause)
    }
}
