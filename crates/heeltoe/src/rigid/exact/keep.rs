//! What is kept of a piece: the new state, the books, extremes, the moments asked for.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::course::Course;
use super::super::event;
use super::super::ledger::work;
use super::super::mode::{Corner, Mode, Slip};
use super::super::shaking::Piece;
use super::stretch::Stretch;
use super::walk::Exact;

impl Exact<'_> {
    /// Where the block rests or slides in another mode than before, from this time on: put what was into the summary.
    #[inline(always)]
    pub(super) fn turn_over(&mut self, time: f64) {
        if self.stretch.mode != Some(self.walk.mode) {
            self.close(time);
        }
    }

    /// Put the stretch that ends at this time into the summary, and begin another.
    pub(super) fn close(&mut self, time: f64) {
        let s = &mut self.walk.summary;
        let stretch = &self.stretch;
        if let Some(mode) = stretch.mode.filter(|mode| mode.contacts() == [true, true]) {
            let kind = mode.kind();
            s.time_by_mode[kind] += time - stretch.since;
            if mode != Mode::Rest {
                s.slip_by_mode[kind] += stretch.slip;
                let friction = self.reactions.of(mode).quantity(SLIP);
                s.ledger
                    .apply(stretch.work(&self.walk.block.generalised_force[SLIP]));
                s.ledger.rub(stretch.work(&friction));
            }
        }
        self.stretch = Stretch::begin(self.walk.mode, time);
    }

    /// Take over the end of a step.
    #[inline(always)]
    pub(super) fn move_on<const S: bool, const H: bool, const T: bool>(
        &mut self,
        course: &Course,
        step: f64,
        time: f64,
    ) {
        let Course { felt, motion, piece } = course;
        if self.walk.observed() {
            self.record(course, time + step, time);
        }
        if !(H || T) {
            if S {
                self.slide_by(motion[SLIP], piece, step);
            }
            return;
        }
        let block = self.walk.block;
        let kind = match (S, H, T) {
            (_, true, true) => Mode::Drift.kind(),
            (true, ..) => Mode::SlideRock(Corner::Heel, Slip::Downstream).kind(),
            (false, ..) => Mode::Rock(Corner::Heel).kind(),
        };
        self.walk.summary.time_by_mode[kind] += step;
        let before = self.walk.summary.position;
        let speed = self.walk.summary.velocity;
        let s = &mut self.walk.summary;
        for (i, moves) in [(SLIP, S), (HEEL, H), (TOE, T)] {
            if !moves {
                continue;
            }
            let [a0, a1] = motion[i];
            let load = &block.generalised_force[i];
            let load = [load.at(piece.ground), load.slope(piece.rate)];
            s.ledger.apply(work(load, speed[i], motion[i], step));
            s.position[i] += step * (speed[i] + step * (a0 / 2.0 + step * a1 / 6.0));
            s.velocity[i] += step * (a0 + step * a1 / 2.0);
        }
        // Nothing rubs in the air.
        if S && !(H && T) {
            let rub = [felt.value[SLIP], felt.slope[SLIP]];
            s.ledger.rub(work(rub, speed[SLIP], motion[SLIP], step));
            if let Some(wear) = &mut self.wear {
                wear.end.path += (s.position[SLIP] - before[SLIP]).abs();
            }
        }
        for gap in [HEEL, TOE] {
            // The root that ended the piece is exact to rounding; so is the gap.
            s.position[gap] = s.position[gap].max(0.0);
        }
        s.slip_by_mode[kind] += s.position[SLIP] - before[SLIP];
        let end = s.position;
        s.widen(&end, block.rotation(&end));
        self.turning_points(&before, &speed, motion, step);
    }

    /// Slide on both corners: both gaps stay closed and the slip keeps its sign.
    #[inline(always)]
    fn slide_by(&mut self, acceleration: [f64; 2], piece: &Piece<2>, step: f64) {
        let s = &mut self.walk.summary;
        let velocity = s.velocity[SLIP];
        let path = self.stretch.slide::<false>(velocity, acceleration, piece, step);
        s.position[SLIP] += path;
        s.velocity[SLIP] += step * (acceleration[0] + step * acceleration[1] / 2.0);
        let slip = s.position[SLIP];
        s.slip_range = [s.slip_range[0].min(slip), s.slip_range[1].max(slip)];
        if let Some(wear) = &mut self.wear {
            wear.end.path += path.abs();
        }
    }

    /// Extremes inside a piece, where a velocity changes sign.
    fn turning_points(&mut self, w: &Vector, v: &Vector, a: &[[f64; 2]; 3], step: f64) {
        let block = self.walk.block;
        let turn = |value: &Vector| block.rotation(value);
        let (turn_0, turn_1) = (
            turn(&[a[0][0], a[1][0], a[2][0]]),
            turn(&[a[0][1], a[1][1], a[2][1]]),
        );
        let rates = [
            [v[SLIP], a[SLIP][0], a[SLIP][1]],
            [v[HEEL], a[HEEL][0], a[HEEL][1]],
            [v[TOE], a[TOE][0], a[TOE][1]],
            [turn(v), turn_0, turn_1],
        ];
        let reach =
            |c: usize| step * (v[c].abs() + step * (a[c][0].abs() / 2.0 + step * a[c][1].abs() / 6.0));
        let [slide, rise_heel, rise_toe] = [SLIP, HEEL, TOE].map(reach);
        let (now, spin, s) = (turn(w), (rise_heel + rise_toe) / block.width, &self.walk.summary);
        // Where one of them cannot go beyond what has been on this piece, there is no need to look where it turns.
        let beyond = [
            w[SLIP] + slide > s.slip_range[1] || w[SLIP] - slide < s.slip_range[0],
            w[HEEL] + rise_heel > s.largest_gap[0],
            w[TOE] + rise_toe > s.largest_gap[1],
            now + spin > s.rotation_range[1] || now - spin < s.rotation_range[0],
        ];
        for (rate, beyond) in rates.into_iter().zip(beyond) {
            if !beyond || rate == [0.0; 3] {
                continue;
            }
            let moments = event::sign_changes(rate[0], rate[1], rate[2] / 2.0, step);
            for t in moments.into_iter().flatten() {
                let mut at = *w;
                for i in 0..3 {
                    at[i] += t * (v[i] + t * (a[i][0] / 2.0 + t * a[i][1] / 6.0));
                }
                self.walk.summary.widen(&at, turn(&at));
            }
        }
    }

    /// Keep the block at every wanted moment before `until`; `since` is when the present piece began.
    pub(super) fn record(&mut self, course: &Course, until: f64, since: f64) {
        while let Some(time) = self.walk.next_moment(until) {
            let (w, v) = (&self.walk.summary.position, &self.walk.summary.velocity);
            let t = (time - since).clamp(0.0, course.piece.left);
            let moment = course.moment(self.walk.mode, w, v, t);
            if let Some(wear) = self.wear.as_mut().filter(|_| self.walk.whole()) {
                let slipped = match self.walk.mode.slip() {
                    Some(_) => (moment.position[SLIP] - w[SLIP]).abs(),
                    None => 0.0,
                };
                wear.kept
                    .push([wear.end.path + slipped, f64::from(wear.end.bonded)]);
            }
            self.walk.keep(moment);
        }
    }
}
