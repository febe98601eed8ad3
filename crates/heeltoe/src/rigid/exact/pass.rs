//! Stretches of the record in which nothing happens to the block: it goes through them as fast as they can be read.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::course::Course;
use super::super::event;
use super::super::ledger::work;
use super::super::mode::Mode;
use super::super::reaction::{Felt, CONE};
use super::super::shaking::Shaking;
use super::walk::Exact;

/// A normal force that is more than this part of its size is not zero: no rounding makes it so.
const CLEAR: f64 = 1e-9;

impl Exact<'_> {
    /// While the block rests nothing moves: return the last sample before rest may end, and keep the block at the moments
    /// that are wanted until then.
    pub(super) fn rest_until(&mut self, shaking: &Shaking, from: usize) -> usize {
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
    pub(super) fn slide_until(&mut self, shaking: &Shaking, from: usize) -> usize {
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
                if !pushed || !event::stays_positive(reaction.way * velocity, a0, a1 / 2.0, step) {
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
