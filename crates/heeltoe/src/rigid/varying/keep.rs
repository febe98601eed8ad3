//! What is kept of a step: the new state, the books, extremes, forces of anchors, histories.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::event;
use super::super::mode::{Corner, Mode};
use super::super::result::Moment;
use super::advance::Trial;
use super::shaking::Piece;
use super::step::{State, COUNTED};
use super::unfolding::Flight;
use super::walk::Varying;

/// By how much more than the polynomial through the ends of a step the motion may have moved.
const BEYOND: f64 = 1.0 + 1e-6;

impl Varying<'_> {
    /// Take over the state `end` after so much of a step that began at `time`.
    pub(super) fn move_on(&mut self, trial: &Trial, end: &State, taken: f64, time: f64) {
        self.record(&trial.start, trial.piece, time + taken, time);
        let kind = self.walk.mode.kind();
        self.walk.summary.time_by_mode[kind] += taken;
        if self.walk.mode == Mode::Rest || taken == 0.0 {
            self.error.speed = 0.0;
            return;
        }
        self.turning_points(trial, end, taken);
        let past = self.wear(end);
        self.gather_error(trial, past, taken);
        self.rise_to(&trial.start, end);
        self.state = *end;
        self.book();
        let contacts = self.walk.mode.contacts();
        if contacts[self.corner.gap() - HEEL] {
            self.state[1] = 0.0;
            self.state[4] = 0.0;
        }
        self.walk.summary.slip_by_mode[kind] += self.slipping(end).1[0] - self.slipping(&trial.start).1[0];
        self.see();
        let at = self.walk.summary.position;
        self.walk.summary.widen(&at, self.state[2]);
        self.strain(time + taken);
    }

    /// Take the works of the last step over from the state into the ledger.
    pub(super) fn book(&mut self) {
        let [work, rubbed, _] = [6, 7, 8].map(|i| std::mem::take(&mut self.state[i]));
        let ledger = &mut self.walk.summary.ledger;
        ledger.input += work;
        ledger.friction -= rubbed;
        ledger.turnover += work.abs() + rubbed.abs();
    }

    /// Add the error of a step to those before, and what theirs in the velocity has come to on its way.
    pub(super) fn gather_error(&mut self, trial: &Trial, past_a_corner: bool, taken: f64) {
        let sum = &mut self.error;
        sum.slip += sum.speed * taken;
        if !trial.integrated {
            return;
        }
        // A corner of a law between the stages of a step spoils its estimate: it is no more than what is allowed. All of
        // what is a mean over the components may be the slip's.
        let error = if past_a_corner { 1.0 } else { trial.error.min(1.0) };
        let parts = error * (COUNTED as f64).sqrt();
        sum.slip += parts * self.scale[0];
        sum.speed += parts * self.scale[3];
        sum.time += taken;
    }

    /// A state as seen from the corner whose way along the crack is the slip; where one is in contact, it is that one.
    pub(super) fn slipping(&self, state: &State) -> (Corner, State) {
        let corner = match self.walk.mode {
            Mode::Drift => self.turning.lower(self.corner, state[2]),
            _ => self.corner,
        };
        if corner == self.corner {
            (corner, *state)
        } else {
            (corner, self.turning.other_corner(self.corner, state))
        }
    }

    /// Slip and gaps at a state, and their velocities.
    pub(super) fn contact(&self, state: &State) -> [Vector; 2] {
        let (corner, state) = self.slipping(state);
        let [heel, toe] = self.turning.gaps(corner, &state);
        [
            [state[0], heel.max(0.0), toe.max(0.0)],
            self.turning.contact_velocity(corner, &state),
        ]
    }

    /// Write the state as slip, gaps and velocities into the summary.
    pub(super) fn see(&mut self) {
        [self.walk.summary.position, self.walk.summary.velocity] = self.contact(&self.state);
    }

    /// Note what the anchors bear at a moment.
    pub(super) fn strain(&mut self, time: f64) {
        for (noted, anchor) in self.anchors.iter_mut().zip(&self.turning.anchors) {
            let moved = self.turning.anchor_moves(self.corner, &self.state, anchor);
            noted.note(anchor, anchor.borne(moved, anchor.elongation(moved)), time);
        }
    }

    /// Extremes inside a step, where a velocity changes sign.
    fn turning_points(&mut self, trial: &Trial, end: &State, taken: f64) {
        let Trial {
            start, rate, piece, ..
        } = trial;
        let velocities = |y: &State| {
            let [_, [slip, heel, toe]] = self.contact(y);
            [slip, heel, toe, y[5]]
        };
        let (speeds, last) = (velocities(start), velocities(end));
        if (0..4).all(|i| speeds[i] * last[i] >= 0.0) {
            return;
        }
        if let Some(flight) = trial.flight {
            self.turns_of(flight, start, taken, [speeds, last]);
            return;
        }
        let (corner, seen) = self.slipping(start);
        let instant = self.seen_from(corner, &seen, &piece.ground);
        let [slip, heel, toe] = instant.contact_acceleration(&self.reactions(&seen, &instant).0);
        for (i, a0) in [slip, heel, toe, rate[5]].into_iter().enumerate() {
            let (v0, v1) = (speeds[i], last[i]);
            if v0 * v1 >= 0.0 {
                continue;
            }
            let bend = (v1 - v0 - a0 * taken) / (taken * taken);
            for t in event::sign_changes(v0, a0, bend, taken).into_iter().flatten() {
                if trial.integrated {
                    let about = self.between(trial, t).map(|value| BEYOND * value);
                    let [position, _] = self.contact(&about);
                    if self.walk.summary.covers(&position, about[2]) {
                        continue;
                    }
                }
                let at = self.moved(start, rate, piece, t);
                let [position, _] = self.contact(&at);
                self.walk.summary.widen(&position, at[2]);
            }
        }
    }

    /// The same of a flight, with the velocities of slip, gaps and rotation at its start and at its end.
    fn turns_of(&mut self, flight: &Flight, start: &State, taken: f64, [speeds, last]: [[f64; 4]; 2]) {
        let ([[slip, heel, toe], _], reach) = (self.contact(start), flight.swing(self.turning.width));
        let summary = &self.walk.summary;
        let [heels, toes] = summary.largest_gap.map(|gap| [0.0, gap]);
        let (from, known) = (
            [slip, heel, toe, start[2]],
            [summary.slip_range, heels, toes, summary.rotation_range],
        );
        for (i, (before, behind)) in speeds.into_iter().zip(last).enumerate() {
            let [least, most] = known[i];
            let turns = before * behind < 0.0;
            // It turns back from where it goes first.
            let beyond =
                from[i] + reach[i] > most && before > 0.0 || from[i] - reach[i] < least && before < 0.0;
            if !(turns && beyond) {
                continue;
            }
            let speed = |t: f64| {
                let state = flight.state_after(start, t);
                before.signum()
                    * if i < 3 {
                        self.contact(&state)[1][i]
                    } else {
                        state[5]
                    }
            };
            let aside = 1e-3 * taken;
            let slope = |t: f64| (speed(t + aside) - speed(t - aside)) / (2.0 * aside);
            let turn = event::bracketed(speed, slope, [0.0, taken], 0.5 * taken);
            let at = flight.state_after(start, turn);
            let [position, _] = self.contact(&at);
            self.walk.summary.widen(&position, at[2]);
        }
    }

    /// Keep the block at every wanted moment before `until`; `since` is when the present step began.
    pub(super) fn record(&mut self, start: &State, piece: &Piece, until: f64, since: f64) {
        if self.walk.next_moment(until).is_none() {
            return;
        }
        let rate = self.rates(start, &piece.ground);
        while let Some(time) = self.walk.next_moment(until) {
            let t = if piece.left > 0.0 {
                (time - since).max(0.0)
            } else {
                0.0
            };
            let state = self.moved(start, &rate, piece, t);
            let (corner, seen) = self.slipping(&state);
            let instant = self.seen_from(corner, &seen, &piece.after(t));
            let (mut reaction, _) = self.reactions(&seen, &instant);
            let mut acceleration = instant.contact_acceleration(&reaction);
            let contacts = self.walk.mode.contacts();
            let held = [self.walk.mode.sticks(), contacts[0], contacts[1]];
            for (acceleration, held) in acceleration.iter_mut().zip(held) {
                if held {
                    *acceleration = 0.0;
                }
            }
            if self.walk.whole() {
                self.keep_worn(&state);
                self.keep_rough(start, &state);
            }
            reaction[SLIP] -= self.slope(&state).slope * (reaction[HEEL] + reaction[TOE]);
            let [position, velocity] = self.contact(&state);
            self.walk.keep(Moment {
                mode: self.walk.mode,
                position,
                velocity,
                acceleration,
                reaction,
            });
        }
    }
}
