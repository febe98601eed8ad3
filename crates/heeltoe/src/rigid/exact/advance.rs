//! To the first event on a piece, or to its end.

use super::super::block::SLIP;
use super::super::course::{Course, Earliest};
use super::super::mode::{Corner, Mode};
use super::super::shaking::Piece;
use super::super::walk::{Cause, Ended};
use super::walk::Exact;

impl Exact<'_> {
    /// Move to the next event or to the end of the piece; returns the time that took and what ended it.
    #[inline(always)]
    pub(super) fn move_to_event(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Ended>) {
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
    ) -> (f64, Option<Ended>) {
        let reaction = self.reactions.of(self.walk.mode);
        debug_assert_eq!([S, H, T], self.walk.mode.free());
        let summary = &self.walk.summary;
        let slips = summary.velocity[SLIP];
        let course = Course::begin(reaction, self.felt, [S, H, T], slips, self.touching, piece);
        let mut earliest = Earliest {
            step: piece.left,
            ended: None,
        };
        course.first_event::<S, H, T>(reaction, &summary.position, &summary.velocity, 0, &mut earliest);
        let Earliest { step, ended } = earliest;
        self.move_on::<S, H, T>(&course, step, time);
        match ended {
            Some((_, Cause::Stop)) => self.walk.summary.velocity[SLIP] = 0.0,
            Some((_, Cause::Gap(gap))) => self.walk.summary.position[gap] = 0.0,
            _ => {}
        }
        (step, ended)
    }
}
