//! The first event on a piece, and what is kept of the way to it: the new state, the books, extremes, the moments asked
//! for.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::choice::{accelerations, VIOLATION};
use super::super::event;
use super::super::ledger::work;
use super::super::mode::{Mode, Slip};
use super::super::reaction::CONE;
use super::super::result::Moment;
use super::super::shaking::Piece;
use super::super::walk::Cause;
use super::blocks::{part, Six};
use super::walk::{Ended, Walk};

/// How the blocks move on one piece: acceleration and slope of each coordinate, the ground.
pub(super) struct Course<'a> {
    motion: [[f64; 2]; 6],
    piece: &'a Piece<2>,
}

impl Course<'_> {
    fn position(&self, w: &Six, v: &Six, t: f64) -> Six {
        std::array::from_fn(|i| {
            let [a0, a1] = self.motion[i];
            w[i] + t * (v[i] + t * (a0 / 2.0 + t * a1 / 6.0))
        })
    }

    fn velocity(&self, v: &Six, t: f64) -> Six {
        std::array::from_fn(|i| {
            let [a0, a1] = self.motion[i];
            v[i] + t * (a0 + t * a1 / 2.0)
        })
    }
}

/// Which of a crack's coordinates are free to move.
fn free(mode: Mode, place: usize) -> bool {
    mode.free()[place]
}

impl Walk<'_> {
    /// How the blocks begin to move in their present modes.
    pub(super) fn course<'p>(&mut self, piece: &'p Piece<2>) -> Course<'p> {
        let mut motion = [[0.0; 2]; 6];
        let reactions = self.reactions.of(self.modes);
        for (crack, reaction) in reactions.iter().enumerate() {
            let (mode, first) = (self.modes[crack], 3 * crack);
            let slips = mode.slip().is_some() && self.velocity[first + SLIP] == 0.0;
            let starts = [
                if slips {
                    mode.slip().map_or(0.0, Slip::sign)
                } else {
                    0.0
                },
                f64::from(free(mode, HEEL) && self.closed[crack][0]),
                f64::from(free(mode, TOE) && self.closed[crack][1]),
            ];
            let own = accelerations(reaction, &self.felt[crack], starts, piece.left);
            motion[first..first + 3].copy_from_slice(&own);
        }
        Course { motion, piece }
    }

    /// Move to the next event or to the end of the piece; the time that took and what ended it.
    pub(super) fn advance(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Ended>) {
        let course = self.course(piece);
        let (step, ended) = self.first_event(&course);
        self.record(&course, time + step, time);
        self.move_on(&course, step);
        match ended {
            Some((crack, Cause::Stop)) => self.velocity[3 * crack + SLIP] = 0.0,
            Some((crack, Cause::Gap(gap))) => self.position[3 * crack + gap] = 0.0,
            _ => {}
        }
        (step, ended)
    }

    /// When the piece ends, and what ends it before its time.
    fn first_event(&mut self, course: &Course) -> (f64, Option<Ended>) {
        let mut step = course.piece.left;
        let mut ended = None;
        let reactions = self.reactions.of(self.modes);
        for (crack, reaction) in reactions.iter().enumerate() {
            let (mode, first) = (self.modes[crack], 3 * crack);
            let felt = &self.felt[crack];
            let mut earlier = |t: f64, why: Cause| {
                if t < step || (t == step && ended.is_none()) {
                    step = t;
                    ended = Some((crack, why));
                }
            };
            let left = course.piece.left;
            let mut falls = |i: usize, why: Cause| {
                let (value, slope) = (felt.value[i], felt.slope[i]);
                if value + slope * left < -VIOLATION * reaction.size[i] && slope < 0.0 {
                    earlier(event::linear(value, slope, left), why);
                }
            };
            for gap in [HEEL, TOE] {
                if !free(mode, gap) {
                    falls(gap, Cause::Normal);
                }
            }
            if mode.sticks() {
                falls(CONE, Cause::Cone);
                falls(CONE + 1, Cause::Cone);
            }
            if let Some(slip) = mode.slip() {
                let (s, [a0, a1]) = (slip.sign(), course.motion[first + SLIP]);
                let speed = self.velocity[first + SLIP];
                if let Some(t) = event::quadratic(s * speed, s * a0, s * a1 / 2.0, left) {
                    earlier(t, Cause::Stop);
                }
            }
            for gap in [HEEL, TOE] {
                if !free(mode, gap) {
                    continue;
                }
                let (i, [a0, a1]) = (first + gap, course.motion[first + gap]);
                let root = event::cubic(self.position[i], self.velocity[i], a0 / 2.0, a1 / 6.0, left);
                if let Some(t) = root {
                    earlier(t, Cause::Gap(gap));
                }
            }
        }
        (step, ended)
    }

    /// Take over the end of a step.
    fn move_on(&mut self, course: &Course, step: f64) {
        let (before, speed) = (self.position, self.velocity);
        let piece = course.piece;
        let modes = self.modes;
        for (crack, mode) in modes.into_iter().enumerate() {
            self.summaries[crack].time_by_mode[mode.kind()] += step;
        }
        if modes == [Mode::Rest; 2] {
            return;
        }
        let end = course.position(&before, &speed, step);
        let fast = course.velocity(&speed, step);
        for i in 0..6 {
            let (crack, place) = (i / 3, i % 3);
            if !free(modes[crack], place) {
                continue;
            }
            let load = self.stack.load(i);
            let load = [load.at(piece.ground), load.slope(piece.rate)];
            self.books[crack].apply(work(load, speed[i], course.motion[i], step));
            // The root that ended the piece is exact to rounding; so is the gap.
            self.position[i] = if place == SLIP { end[i] } else { end[i].max(0.0) };
            self.velocity[i] = fast[i];
        }
        for (crack, mode) in modes.into_iter().enumerate() {
            let slip = 3 * crack + SLIP;
            if mode.slip().is_some() {
                let felt = &self.felt[crack];
                let rub = [felt.value[SLIP], felt.slope[SLIP]];
                self.books[crack].rub(work(rub, speed[slip], course.motion[slip], step));
            }
            self.summaries[crack].slip_by_mode[mode.kind()] += self.position[slip] - before[slip];
        }
        let end = self.position;
        self.widen(&end);
        if modes.into_iter().any(|mode| mode.contacts() != [true, true]) {
            self.turning_points(&before, &speed, course, step);
        }
    }

    /// Take slips, gaps and rotations of a moment into the extremes.
    fn widen(&mut self, at: &Six) {
        for crack in 0..2 {
            let own = part(at, crack);
            let turn = self.stack.blocks[crack].rotation(&own);
            self.summaries[crack].widen(&own, turn);
        }
        for (range, turn) in self.tilts.iter_mut().zip(self.stack.rotations(at)) {
            *range = [range[0].min(turn), range[1].max(turn)];
        }
    }

    /// Extremes inside a piece, where a velocity changes sign.
    fn turning_points(&mut self, w: &Six, v: &Six, course: &Course, step: f64) {
        let [first, second] = [0, 1].map(|k| course.motion.map(|motion| motion[k]));
        let turns = [v, &first, &second].map(|of| {
            let upper = self.stack.blocks[1].rotation(&part(of, 1));
            let [lower, both] = self.stack.rotations(of);
            [lower, upper, both]
        });
        let moving = (0..6).map(|i| [v[i], first[i], second[i]]);
        let turning = (0..3).map(|i| turns.map(|of| of[i]));
        for [speed, rate, change] in moving.chain(turning) {
            for t in event::sign_changes(speed, rate, change / 2.0, step)
                .into_iter()
                .flatten()
            {
                let at = course.position(w, v, t);
                self.widen(&at);
            }
        }
    }

    /// Keep the blocks at every wanted moment before `until`; `since` is when the present piece began.
    pub(super) fn record(&mut self, course: &Course, until: f64, since: f64) {
        while let Some(time) = self.next_moment(until) {
            let t = (time - since).clamp(0.0, course.piece.left);
            let position = course.position(&self.position, &self.velocity, t);
            let velocity = course.velocity(&self.velocity, t);
            let acceleration = course.motion.map(|[start, slope]| start + slope * t);
            for crack in 0..2 {
                let felt = &self.felt[crack];
                let [slip, heel, toe] = part(&position, crack);
                self.moments[crack].push(Moment {
                    mode: self.modes[crack],
                    position: [slip, heel.max(0.0), toe.max(0.0)],
                    velocity: part(&velocity, crack),
                    acceleration: part(&acceleration, crack),
                    reaction: [SLIP, HEEL, TOE].map(|i| felt.value[i] + felt.slope[i] * t),
                });
            }
        }
    }
}
