//! The first event on a piece: the earliest root of what must not fall through zero.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::choice::{accelerations, VIOLATION};
use super::super::event;
use super::super::mode::{Corner, Mode};
use super::super::reaction::{Felt, Reaction, CONE};
use super::super::shaking::Piece;
use super::super::walk::Cause;
use super::walk::Exact;

/// How the block moves on one piece: reactions, acceleration and slope of each coordinate, the ground.
pub(super) struct Course<'a> {
    pub felt: &'a Felt,
    pub motion: [[f64; 2]; 3],
    pub piece: &'a Piece<2>,
}

impl Exact<'_> {
    /// Move to the next event or to the end of the piece; returns the time that took and what ended it.
    #[inline(always)]
    pub(super) fn advance(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Cause>) {
        // What slips and which corners are free decides what there is to do: each has its own machine code.
        match self.walk.mode {
            Mode::Rest => self.advance_free::<false, false, false>(piece, time),
            Mode::Slide(_) => self.advance_free::<true, false, false>(piece, time),
            Mode::Rock(Corner::Heel) => self.advance_free::<false, false, true>(piece, time),
            Mode::Rock(Corner::Toe) => self.advance_free::<false, true, false>(piece, time),
            Mode::SlideRock(Corner::Heel, _) => self.advance_free::<true, false, true>(piece, time),
            Mode::SlideRock(Corner::Toe, _) => self.advance_free::<true, true, false>(piece, time),
            Mode::Drift => self.advance_free::<true, true, true>(piece, time),
        }
    }

    /// The same where it is known what of slip, heel gap and toe gap is free to move.
    fn advance_free<const S: bool, const H: bool, const T: bool>(
        &mut self,
        piece: &Piece<2>,
        time: f64,
    ) -> (f64, Option<Cause>) {
        let reaction = self.reactions.of(self.walk.mode);
        let starts = [
            if S && self.walk.summary.velocity[SLIP] == 0.0 {
                reaction.way
            } else {
                0.0
            },
            f64::from(H && self.touching[0]),
            f64::from(T && self.touching[1]),
        ];
        let felt = self.felt;
        let course = Course {
            motion: accelerations(reaction, &felt, starts, piece.left),
            felt: &felt,
            piece,
        };
        debug_assert_eq!([S, H, T], self.walk.mode.free());
        let (step, cause) = self.first_event::<S, H, T>(reaction, &course);
        self.move_on::<S, H, T>(&course, step, time);
        match cause {
            Some(Cause::Stop) => self.walk.summary.velocity[SLIP] = 0.0,
            Some(Cause::Gap(gap)) => self.walk.summary.position[gap] = 0.0,
            _ => {}
        }
        (step, cause)
    }

    /// When the piece ends, and what ends it before its time.
    #[inline(always)]
    fn first_event<const S: bool, const H: bool, const T: bool>(
        &self,
        reaction: &Reaction,
        course: &Course,
    ) -> (f64, Option<Cause>) {
        let Course { felt, motion, piece } = course;
        let (position, velocity) = (&self.walk.summary.position, &self.walk.summary.velocity);
        let mut step = piece.left;
        let mut cause = None;
        let mut earlier = |t: f64, why: Cause| {
            if t < step || (t == step && cause.is_none()) {
                step = t;
                cause = Some(why);
            }
        };
        let mut falls = |i: usize, why: Cause| {
            let (value, slope) = (felt.value[i], felt.slope[i]);
            if value + slope * piece.left < -VIOLATION * reaction.size[i] && slope < 0.0 {
                earlier(event::linear(value, slope, piece.left), why);
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
            let [a0, a1] = motion[SLIP];
            if let Some(t) = event::quadratic(s * velocity[SLIP], s * a0, s * a1 / 2.0, piece.left) {
                earlier(t, Cause::Stop);
            }
        }
        for (free, gap) in [(H, HEEL), (T, TOE)] {
            if !free {
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
