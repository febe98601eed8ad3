//! Stretches of the record in which nothing happens to the block: it goes through them as fast as they can be read.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::choice::{admissible, Moving, TIE};
use super::super::course::{Course, Earliest};
use super::super::event;
use super::super::ledger::work;
use super::super::mode::{Mode, Slip};
use super::super::reaction::{Felt, CONE};
use super::super::shaking::{Piece, Shaking};
use super::super::walk::{Carried, Cause, Ended};
use super::walk::{Exact, Halt};

/// A normal force that is more than this part of its size is not zero: no rounding makes it so.
const CLEAR: f64 = 1e-9;

impl Exact<'_> {
    /// Go on in the present mode while nothing happens; return the last sample before something may.
    pub(super) fn pass(&mut self, shaking: &Shaking, from: usize) -> usize {
        match self.walk.mode {
            Mode::Rest => self.rest_until(shaking, from),
            Mode::Slide(_) if !self.walk.observed() => self.slide_until(shaking, from),
            _ => from,
        }
    }

    /// The same across starts and stops of a slip that presses both corners clear of every limit, where the modes of one
    /// corner are no choice and no event is wanted: to the bit as from event to event. `None` where the run ends.
    pub(super) fn glide(&mut self, shaking: &Shaking, from: usize) -> Option<Halt> {
        let mut k = from;
        loop {
            k = self.pass(shaking, k);
            if self.walk.mode.contacts() != [true, true] || self.walk.stopped() {
                return Some(Halt::at(k));
            }
            let piece = shaking.pieces(k).next().filter(|piece| piece.left > 0.0);
            let Some(whole) = piece else {
                return Some(Halt::at(k));
            };
            let (local, cause) = self.glide_over(&whole, shaking.time[k])?;
            if local < whole.left {
                return Some(Halt { k, local, cause });
            }
            k += 1;
        }
    }

    /// Go over a piece that begins at `time`; return how far that leads, and what ended the way if it is not to the end.
    fn glide_over(&mut self, whole: &Piece<2>, time: f64) -> Option<(f64, Option<Ended>)> {
        let (mut local, mut cause) = (0.0, None);
        loop {
            let piece = whole.rest(local);
            let mut felt = Felt::default();
            let Some(mode) = self.clear_mode(&piece, cause, &mut felt) else {
                return Some((local, cause));
            };
            let reaction = self.reactions.of(mode);
            let slips = mode != Mode::Rest;
            let s = &mut self.walk.summary;
            let free = [slips, false, false];
            let course = Course::begin(reaction, felt, free, s.velocity[SLIP], [true; 2], &piece);
            let mut earliest = Earliest {
                step: piece.left,
                ended: None,
            };
            course.first_event_in(mode, reaction, [&s.position, &s.velocity], 0, &mut earliest);
            let Earliest { step, ended } = earliest;
            // An event at either end of a piece is left to the walk.
            if ended.is_some() && (step <= 0.0 || step >= piece.left || local + step >= whole.left) {
                return Some((local, cause));
            }
            s.mode = mode;
            s.slip_stops += u64::from(matches!(cause, Some((_, Cause::Stop))));
            self.walk.mode = mode;
            if slips {
                self.move_on::<true, false, false>(&course, step, time + local);
            } else {
                self.move_on::<false, false, false>(&course, step, time + local);
            }
            if ended.is_none() {
                return Some((whole.left, None));
            }
            if slips {
                self.walk.summary.velocity[SLIP] = 0.0;
            }
            let moved = local + step > local;
            local += step;
            cause = ended;
            if !self.count(moved) {
                self.walk.summary.end_time = time + local;
                return None;
            }
        }
    }

    /// The mode after what ended the way here, where both corners stay pressed on all of a piece; what is felt there is in
    /// `felt` then.
    fn clear_mode(&self, piece: &Piece<2>, cause: Option<Ended>, felt: &mut Felt) -> Option<Mode> {
        let velocity = self.walk.summary.velocity[SLIP];
        let moving = Moving {
            closed: [true; 2],
            velocity,
            piece,
        };
        let mut fits = |mode: Mode| admissible(self.reactions.of(mode), &moving, TIE, felt);
        let mode = match cause {
            None => {
                let mode = self.walk.mode;
                let stands = mode != Mode::Rest && velocity == 0.0;
                (!stands && fits(mode)).then_some(mode)
            }
            Some((_, Cause::Cone | Cause::Stop)) => {
                let rest = self.reactions.of(Mode::Rest);
                let mut held = Felt::default();
                rest.on(piece, &mut held);
                // Pressed at rest, it rocks about no corner.
                if [HEEL, TOE]
                    .into_iter()
                    .any(|i| held.value[i] <= CLEAR * rest.size[i])
                {
                    return None;
                }
                let slides = [Slip::Downstream, Slip::Upstream].map(Mode::Slide);
                let mut modes = [Mode::Rest].into_iter().chain(slides);
                modes.find(|mode| fits(*mode))
            }
            Some(_) => None,
        }?;
        let size = self.reactions.of(mode).size;
        let stays = |i: usize| {
            let clear = CLEAR * size[i];
            felt.value[i] > clear && felt.value[i] + felt.slope[i] * piece.left > clear
        };
        (stays(HEEL) && stays(TOE)).then_some(mode)
    }

    /// While the block rests nothing moves: return the last sample before rest may end, and keep the block at the moments
    /// that are wanted until then.
    fn rest_until(&mut self, shaking: &Shaking, from: usize) -> usize {
        let rest = self.reactions.of(Mode::Rest);
        let limits = [HEEL, TOE, CONE, CONE + 1].map(|i| rest.quantity(i));
        // The first sample is looked at too: right behind a jump it is new.
        let k = shaking.first_below(&limits, from).max(from + 1) - 1;
        self.walk.summary.time_by_mode[Mode::Rest.kind()] += shaking.time[k] - shaking.time[from];
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
        let reaction = self.reactions.of(self.walk.mode);
        let clear = [HEEL, TOE].map(|i| CLEAR * reaction.size[i]);
        let load = self.walk.block.generalised_force[SLIP];
        let kind = self.walk.mode.kind();
        let s = &mut self.walk.summary;
        let [mut position, mut velocity] = [s.position[SLIP], s.velocity[SLIP]];
        let (mut ledger, mut gathered, mut time) = (s.ledger, s.slip_by_mode[kind], s.time_by_mode[kind]);
        let mut path = self.wear.as_ref().map_or(0.0, |wear| wear.end.path);
        let mut k = from;
        for piece in shaking.pieces(from) {
            let step = piece.left;
            if step > 0.0 {
                let [value, slope] = reaction.sliding(piece.ground, piece.rate);
                let [a0, a1] = [value[3], slope[3]];
                let pushed = [HEEL, TOE]
                    .into_iter()
                    .zip(clear)
                    .all(|(i, clear)| value[i] > clear && value[i] + slope[i] * step > clear);
                let way = reaction.way;
                let stops = || event::quadratic(way * velocity, way * a0, way * a1 / 2.0, step).is_some();
                if !pushed || velocity == 0.0 || stops() {
                    break;
                }
                let force = [load.at(piece.ground), load.slope(piece.rate)];
                ledger.apply(work(force, velocity, [a0, a1], step));
                ledger.rub(work([value[SLIP], slope[SLIP]], velocity, [a0, a1], step));
                let before = position;
                position += step * (velocity + step * (a0 / 2.0 + step * a1 / 6.0));
                velocity += step * (a0 + step * a1 / 2.0);
                gathered += position - before;
                path += (position - before).abs();
                time += step;
            }
            k += 1;
        }
        // It goes one way alone.
        if let Some(wear) = &mut self.wear {
            wear.end.path = path;
        }
        s.slip_range = [s.slip_range[0].min(position), s.slip_range[1].max(position)];
        (s.position[SLIP], s.velocity[SLIP]) = (position, velocity);
        (s.ledger, s.slip_by_mode[kind], s.time_by_mode[kind]) = (ledger, gathered, time);
        k
    }
}
