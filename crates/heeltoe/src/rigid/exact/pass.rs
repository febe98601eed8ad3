//! Stretches of the record in which nothing happens to the block: it goes through them as fast as they can be read.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::choice::{begun, sign, TIE};
use super::super::course::{Course, Earliest};
use super::super::event;
use super::super::ledger::work;
use super::super::mode::{Mode, Slip};
use super::super::reaction::{Felt, Reaction, ACCELERATION, CONE};
use super::super::shaking::{Piece, Shaking};
use super::super::walk::{Carried, Cause, Ended};
use super::walk::{Exact, Halt};

/// A normal force that is more than this part of its size is not zero: no rounding makes it so.
const CLEAR: f64 = 1e-9;

/// A part of a piece on which a block that stays pressed onto both corners goes on in one mode, and what ends it.
struct Leg<'p> {
    mode: Mode,
    course: Course<'p>,
    step: f64,
    ended: Option<Ended>,
}

/// Whether the normal forces at heel and toe, which start with these values, are clear of zero from one end to the other.
#[inline(always)]
fn stays_pressed(reaction: &Reaction, value: [f64; 2], slope: [f64; 2], left: f64) -> bool {
    [HEEL, TOE]
        .into_iter()
        .zip(value)
        .zip(slope)
        .all(|((gap, value), slope)| {
            let clear = CLEAR * reaction.size[gap];
            value > clear && value + slope * left > clear
        })
}

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
            let Some(Leg {
                mode,
                course,
                step,
                ended,
            }) = self.next_leg(&piece, cause)
            else {
                return Some((local, cause));
            };
            // An event at either end of a piece is left to the walk.
            if ended.is_some() && (step <= 0.0 || step >= piece.left || local + step >= whole.left) {
                return Some((local, cause));
            }
            let slips = mode != Mode::Rest;
            self.walk.mode = mode;
            self.walk.summary.mode = mode;
            self.walk.summary.slip_stops += u64::from(matches!(cause, Some((_, Cause::Stop))));
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

    /// How the block goes on after what ended the way here, where both corners stay pressed on all of a piece.
    fn next_leg<'p>(&self, piece: &'p Piece<2>, cause: Option<Ended>) -> Option<Leg<'p>> {
        let velocity = self.walk.summary.velocity[SLIP];
        match (cause, self.walk.mode) {
            (None, Mode::Rest) if velocity == 0.0 => self.lie(piece)?,
            (None, Mode::Slide(slip)) if velocity != 0.0 => self.slide(slip, piece)?,
            (None, _) => None,
            // Pressed at rest, it rocks about no corner.
            (Some((_, Cause::Cone | Cause::Stop)), _) => self
                .lie(piece)
                .or_else(|| self.slide(Slip::Downstream, piece))
                .or_else(|| self.slide(Slip::Upstream, piece))?,
            (Some(_), _) => None,
        }
    }

    /// How it lies on a piece where friction holds it; `Some(None)` where a corner may not stay pressed.
    #[inline(always)]
    fn lie<'p>(&self, piece: &'p Piece<2>) -> Option<Option<Leg<'p>>> {
        let rest = self.reactions.of(Mode::Rest);
        let mut felt = Felt::default();
        rest.on(piece, &mut felt);
        if !stays_pressed(
            rest,
            [felt.value[HEEL], felt.value[TOE]],
            [felt.slope[HEEL], felt.slope[TOE]],
            piece.left,
        ) {
            return Some(None);
        }
        if [CONE, CONE + 1]
            .into_iter()
            .any(|i| sign(felt.value[i], felt.slope[i] * piece.left, TIE * rest.size[i]) < 0)
        {
            return None;
        }
        let course = Course {
            felt,
            motion: [[0.0; 2]; 3],
            piece,
        };
        let mut earliest = Earliest {
            step: piece.left,
            ended: None,
        };
        course.first_event::<false, false, false>(rest, &[0.0; 3], &[0.0; 3], 0, &mut earliest);
        let Earliest { step, ended } = earliest;
        Some(Some(Leg {
            mode: Mode::Rest,
            course,
            step,
            ended,
        }))
    }

    /// How it slides this way on a piece, if it can; `Some(None)` where a corner may not stay pressed.
    #[inline(always)]
    fn slide<'p>(&self, slip: Slip, piece: &'p Piece<2>) -> Option<Option<Leg<'p>>> {
        let (mode, velocity) = (Mode::Slide(slip), self.walk.summary.velocity[SLIP]);
        let reaction = self.reactions.of(mode);
        let way = reaction.way;
        let [value, slope] = reaction.sliding(piece.ground, piece.rate);
        let size = reaction.size[ACCELERATION + SLIP];
        let grows = if velocity == 0.0 {
            f64::from(sign(value[3], slope[3] * piece.left, TIE * size)) * way
        } else {
            velocity * way
        };
        if !reaction.regular || grows <= 0.0 {
            return None;
        }
        if !stays_pressed(
            reaction,
            [value[HEEL], value[TOE]],
            [slope[HEEL], slope[TOE]],
            piece.left,
        ) {
            return Some(None);
        }
        let starts = if velocity == 0.0 { way } else { 0.0 };
        let [a0, a1] = begun(value[3], slope[3], size, starts, piece.left);
        let stop = event::quadratic(way * velocity, way * a0, way * a1 / 2.0, piece.left);
        let mut felt = Felt::default();
        (felt.value[SLIP], felt.slope[SLIP]) = (value[SLIP], slope[SLIP]);
        Some(Some(Leg {
            mode,
            course: Course {
                felt,
                motion: [[a0, a1], [0.0; 2], [0.0; 2]],
                piece,
            },
            step: stop.unwrap_or(piece.left),
            ended: stop.map(|_| (0, Cause::Stop)),
        }))
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
        let clear = [HEEL, TOE].map(|i| CLEAR * reaction.size[i]);
        let normal = [HEEL, TOE].map(|i| reaction.quantity(i));
        let pressed = |piece: &Piece<2>| {
            (0..2).all(|i| {
                let value = normal[i].on::<LEVEL>(piece.ground);
                value > clear[i] && value + normal[i].rate::<LEVEL>(piece.rate) * piece.left > clear[i]
            })
        };
        let [friction, along] = [SLIP, ACCELERATION + SLIP].map(|i| reaction.quantity(i));
        let load = self.walk.block.generalised_force[SLIP];
        let (kind, way) = (self.walk.mode.kind(), reaction.way);
        let s = &mut self.walk.summary;
        let [mut position, mut velocity] = [s.position[SLIP], s.velocity[SLIP]];
        let (mut input, mut rubbed, mut turnover) = (s.ledger.input, s.ledger.friction, s.ledger.turnover);
        let (mut gathered, mut time) = (s.slip_by_mode[kind], s.time_by_mode[kind]);
        let mut path = self.wear.as_ref().map_or(0.0, |wear| wear.end.path);
        let mut k = from;
        for piece in shaking.pieces_on::<LEVEL>(from) {
            let step = piece.left;
            if step > 0.0 {
                let a0 = along.on::<LEVEL>(piece.ground);
                let a1 = along.rate::<LEVEL>(piece.rate);
                if velocity == 0.0
                    || !pressed(&piece)
                    || event::quadratic(way * velocity, way * a0, way * a1 / 2.0, step).is_some()
                {
                    break;
                }
                let pushed = [load, friction].map(|force| {
                    work(
                        [force.on::<LEVEL>(piece.ground), force.rate::<LEVEL>(piece.rate)],
                        velocity,
                        [a0, a1],
                        step,
                    )
                });
                input += pushed[0].net;
                turnover += pushed[0].size;
                rubbed -= pushed[1].net;
                turnover += pushed[1].size;
                let before = position;
                position += step * (velocity + step * (a0 / 2.0 + step * a1 / 6.0));
                velocity += step * (a0 + step * a1 / 2.0);
                gathered += position - before;
                if PATH {
                    path += (position - before).abs();
                }
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
        (s.ledger.input, s.ledger.friction, s.ledger.turnover) = (input, rubbed, turnover);
        (s.slip_by_mode[kind], s.time_by_mode[kind]) = (gathered, time);
        k
    }
}
