//! Stretches of the record in which nothing happens to the block: it goes through them as fast as they can be read.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::course::Course;
use super::super::event;
use super::super::mode::Mode;
use super::super::reaction::{Felt, ACCELERATION, CONE};
use super::super::shaking::{Limits, Shaking};
use super::glide::{felt, Pressed, CLEAR};
use super::walk::Exact;

impl Exact<'_> {
    /// Go on in the present mode while nothing happens; return the last sample before something may.
    pub(super) fn pass(&mut self, shaking: &Shaking, from: usize) -> usize {
        match self.walk.mode {
            Mode::Rest => self.rest_until(shaking, from),
            Mode::Slide(_) if !self.walk.observed() => self.slide_until(shaking, from),
            _ => from,
        }
    }

    /// While the block rests nothing moves: return the last sample before rest may end, and keep the block at the moments
    /// that are wanted until then.
    fn rest_until(&mut self, shaking: &Shaking, from: usize) -> usize {
        let rest = self.reactions.of(Mode::Rest);
        let limits = self
            .limits_of_rest
            .get_or_init(|| Limits::new([HEEL, TOE, CONE, CONE + 1].map(|i| rest.quantity(i))));
        // The first sample is looked at too: right behind a jump it is new.
        let k = shaking.first_below(limits, from).max(from + 1) - 1;
        if self.walk.observed() {
            let mut felt = Felt::default();
            // What is wanted at a jump is kept at the start of the piece behind it: the jump itself has no rates.
            let pieces = shaking.pieces(from).zip(from..k);
            for (piece, j) in pieces.filter(|(piece, _)| piece.left > 0.0) {
                rest.on(&piece, &mut felt);
                let course = Course {
                    felt,
                    motion: [[0.0; 2]; 3],
                    piece: &piece,
                };
                self.record(&course, shaking.time[j + 1], shaking.time[j]);
            }
        }
        k
    }

    /// While the block slides on both corners, clear of every limit, do what would be done piece by piece; return the last
    /// sample before that may end.
    fn slide_until(&mut self, shaking: &Shaking, from: usize) -> usize {
        match (shaking.is_level(), self.wear.is_some()) {
            (true, false) => self.slide_on::<true, false>(shaking, from),
            (true, true) => self.slide_on::<true, true>(shaking, from),
            (false, false) => self.slide_on::<false, false>(shaking, from),
            (false, true) => self.slide_on::<false, true>(shaking, from),
        }
    }

    /// The same where it is known whether the ground moves on a LEVEL, and whether the PATH is kept.
    fn slide_on<const LEVEL: bool, const PATH: bool>(&mut self, shaking: &Shaking, from: usize) -> usize {
        let reaction = self.reactions.of(self.walk.mode);
        let way = reaction.way;
        // All of it goes one way: counted that way, each sign is spared, and no bit changes.
        let along = reaction.quantity(ACCELERATION + SLIP).times(way);
        let pressed = Pressed::new(reaction);
        let peaks = shaking.peaks();
        let always = LEVEL && pressed.within(peaks[0]);
        // No piece changes a velocity by more than this times its length.
        let most = 2.0 * along.largest(peaks);
        let mut stretch = self.stretch.turned(way);
        let s = &mut self.walk.summary;
        let [mut position, mut velocity] = [way * s.position[SLIP], way * s.velocity[SLIP]];
        if velocity == 0.0 {
            return from;
        }
        let mut path = self.wear.as_ref().map_or(0.0, |wear| wear.end.path);
        let mut k = from;
        for piece in shaking.pieces_on::<LEVEL>(from) {
            let step = piece.left;
            if step > 0.0 {
                let [a0, a1] = felt::<LEVEL>(&along, &piece);
                let next = velocity + step * (a0 + step * (a1 / 2.0));
                let dips = a0 < 0.0 && a0 + step * a1 > 0.0;
                let stops = || event::quadratic(velocity, a0, a1 / 2.0, step).is_some();
                if !(always || pressed.stays::<LEVEL>(&piece))
                    || (next <= CLEAR * (velocity + step * most) || dips) && stops()
                {
                    break;
                }
                let far = stretch.slide::<LEVEL>(velocity, [a0, a1], &piece, step);
                position += far;
                velocity = next;
                if PATH {
                    path += far.abs();
                }
            }
            k += 1;
        }
        self.stretch = stretch.turned(way);
        (s.position[SLIP], s.velocity[SLIP]) = (way * position, way * velocity);
        let slip = s.position[SLIP];
        s.slip_range = [s.slip_range[0].min(slip), s.slip_range[1].max(slip)];
        if let Some(wear) = &mut self.wear {
            wear.end.path = path;
        }
        k
    }
}
