//! The first event on a piece, and what is kept of the way to it: the new state, the books, extremes, the moments asked
//! for.

use super::super::block::SLIP;
use super::super::course::{Course, Earliest};
use super::super::event;
use super::super::ledger::work;
use super::super::mode::Mode;
use super::super::shaking::Piece;
use super::super::walk::{Cause, Ended};
use super::blocks::part;
use super::solve::Six;
use super::walk::Blocks;

/// How the blocks move on one piece, at either crack.
pub(super) struct Courses<'a>([Course<'a>; 2]);

impl Courses<'_> {
    #[inline(always)]
    fn position(&self, w: &Six, v: &Six, t: f64) -> Six {
        std::array::from_fn(|i| self.0[i / 3].position(i % 3, w[i], v[i], t))
    }
}

impl Blocks<'_> {
    /// How the blocks begin to move in their present modes.
    pub(super) fn courses<'p>(&mut self, piece: &'p Piece<2>) -> Courses<'p> {
        let modes = self.modes();
        let reactions = self.reactions.of(modes);
        Courses([0, 1].map(|crack| {
            let (felt, slips) = (self.felt[crack], self.velocity[3 * crack + SLIP]);
            let free = modes[crack].free();
            Course::begin(&reactions[crack], felt, free, slips, self.closed[crack], piece)
        }))
    }

    /// Move to the next event or to the end of the piece; the time that took and what ended it.
    pub(super) fn move_to_event(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Ended>) {
        let courses = self.courses(piece);
        let Earliest { step, ended } = self.first_event(&courses);
        self.record(&courses, time + step, time);
        self.move_on(&courses, step);
        match ended {
            Some((crack, Cause::Stop)) => self.velocity[3 * crack + SLIP] = 0.0,
            Some((crack, Cause::Gap(gap))) => self.position[3 * crack + gap] = 0.0,
            _ => {}
        }
        (step, ended)
    }

    fn first_event(&mut self, courses: &Courses) -> Earliest {
        let mut earliest = Earliest {
            step: courses.0[0].piece.left,
            ended: None,
        };
        let modes = self.modes();
        let reactions = self.reactions.of(modes);
        for (crack, course) in courses.0.iter().enumerate() {
            let (w, v) = (part(&self.position, crack), part(&self.velocity, crack));
            course.first_event_in(modes[crack], &reactions[crack], [&w, &v], crack, &mut earliest);
        }
        earliest
    }

    /// Take over the end of a step.
    fn move_on(&mut self, courses: &Courses, step: f64) {
        let (before, speed) = (self.position, self.velocity);
        let piece = courses.0[0].piece;
        let modes = self.modes();
        for (crack, mode) in modes.into_iter().enumerate() {
            self.walks[crack].summary.time_by_mode[mode.kind()] += step;
        }
        if modes == [Mode::Rest; 2] {
            return;
        }
        let end = courses.position(&before, &speed, step);
        for i in 0..6 {
            let (crack, place) = (i / 3, i % 3);
            if !modes[crack].free()[place] {
                continue;
            }
            let load = self.stack.load(i);
            let load = [load.at(piece.ground), load.slope(piece.rate)];
            self.books[crack].apply(work(load, speed[i], courses.0[crack].motion[place], step));
            // The root that ended the piece is exact to rounding; so is the gap.
            self.position[i] = if place == SLIP { end[i] } else { end[i].max(0.0) };
            self.velocity[i] = courses.0[crack].velocity(place, speed[i], step);
        }
        for (crack, mode) in modes.into_iter().enumerate() {
            let slip = 3 * crack + SLIP;
            if mode.slip().is_some() {
                let felt = &self.felt[crack];
                let rub = [felt.value[SLIP], felt.slope[SLIP]];
                self.books[crack].rub(work(rub, speed[slip], courses.0[crack].motion[SLIP], step));
            }
            self.walks[crack].summary.slip_by_mode[mode.kind()] += self.position[slip] - before[slip];
        }
        let end = self.position;
        self.widen(&end);
        if modes.into_iter().any(|mode| mode.contacts() != [true, true]) {
            self.turning_points(&before, &speed, courses, step);
        }
    }

    /// Take slips, gaps and rotations of a moment into the extremes.
    fn widen(&mut self, at: &Six) {
        for crack in 0..2 {
            let own = part(at, crack);
            let turn = self.stack.blocks[crack].rotation(&own);
            self.walks[crack].summary.widen(&own, turn);
        }
        for (range, turn) in self.tilts.iter_mut().zip(self.stack.rotations(at)) {
            *range = [range[0].min(turn), range[1].max(turn)];
        }
    }

    /// Extremes inside a piece, where a velocity changes sign.
    fn turning_points(&mut self, w: &Six, v: &Six, courses: &Courses, step: f64) {
        let [first, second]: [Six; 2] =
            [0, 1].map(|k| std::array::from_fn(|i| courses.0[i / 3].motion[i % 3][k]));
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
                let at = courses.position(w, v, t);
                self.widen(&at);
            }
        }
    }

    /// Keep the blocks at every wanted moment before `until`; `since` is when the present piece began.
    pub(super) fn record(&mut self, courses: &Courses, until: f64, since: f64) {
        while let Some(time) = self.walks[0].next_moment(until) {
            let t = (time - since).clamp(0.0, courses.0[0].piece.left);
            for (crack, walk) in self.walks.iter_mut().enumerate() {
                let (w, v) = (part(&self.position, crack), part(&self.velocity, crack));
                walk.keep(courses.0[crack].moment(walk.mode, &w, &v, t));
            }
        }
    }
}
