//! What is kept of a step: the new state, the books, extremes, tension of anchors, histories.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::event;
use super::super::mode::{corner_index, Mode};
use super::ground::Stretch;
use super::step::State;
use super::walk::Walk;

impl Walk<'_, '_> {
    /// Take over the end of a step.
    pub(super) fn move_on(
        &mut self,
        start: &State,
        rate: &State,
        end: &State,
        stretch: &Stretch,
        taken: f64,
        time: f64,
    ) {
        self.record(start, stretch, time + taken, time);
        let kind = self.mode.kind();
        self.summary.time_by_mode[kind] += taken;
        if self.mode == Mode::Rest || taken == 0.0 {
            return;
        }
        self.turning_points(start, rate, end, stretch, taken);
        self.state = *end;
        let (work, rubbed) = (end[6], end[7]);
        self.state[6] = 0.0;
        self.state[7] = 0.0;
        let ledger = &mut self.summary.ledger;
        ledger.input += work;
        ledger.friction -= rubbed;
        ledger.turnover += work.abs() + rubbed.abs();
        let contacts = self.mode.contacts();
        if contacts[corner_index(self.corner) - HEEL] {
            self.state[1] = 0.0;
            self.state[4] = 0.0;
        }
        self.summary.slip_by_mode[kind] += self.state[0] - start[0];
        self.see();
        let at = self.summary.position;
        self.widen(&at, self.state[2]);
        self.strain();
    }

    /// Write the state as slip, gaps and velocities into the summary.
    pub(super) fn see(&mut self) {
        let [heel, toe] = self.turning.gaps(self.corner, &self.state);
        self.summary.position = [self.state[0], heel.max(0.0), toe.max(0.0)];
        self.summary.velocity = self.turning.contact_velocity(self.corner, &self.state);
    }

    fn widen(&mut self, at: &Vector, theta: f64) {
        let s = &mut self.summary;
        s.slip_range = [s.slip_range[0].min(at[SLIP]), s.slip_range[1].max(at[SLIP])];
        s.rotation_range = [s.rotation_range[0].min(theta), s.rotation_range[1].max(theta)];
        s.largest_gap = [s.largest_gap[0].max(at[HEEL]), s.largest_gap[1].max(at[TOE])];
    }

    pub(super) fn strain(&mut self) {
        for (peak, anchor) in self.peak_tension.iter_mut().zip(&self.turning.anchors) {
            let (tension, _) = anchor.pull(self.turning.anchor_moves(self.corner, &self.state, anchor));
            *peak = peak.max(tension);
        }
    }

    /// Extremes inside a step, where a velocity changes sign.
    fn turning_points(&mut self, start: &State, rate: &State, end: &State, stretch: &Stretch, taken: f64) {
        let velocities = |y: &State| {
            let [slip, heel, toe] = self.turning.contact_velocity(self.corner, y);
            [slip, heel, toe, y[5]]
        };
        let (speeds, last) = (velocities(start), velocities(end));
        if (0..4).all(|i| speeds[i] * last[i] >= 0.0) {
            return;
        }
        let instant = self.turning.at(self.corner, start, &stretch.ground);
        let [slip, heel, toe] = instant.contact_acceleration(&self.reactions(&instant));
        for (i, a0) in [slip, heel, toe, rate[5]].into_iter().enumerate() {
            let (v0, v1) = (speeds[i], last[i]);
            if v0 * v1 >= 0.0 {
                continue;
            }
            let bend = (v1 - v0 - a0 * taken) / (taken * taken);
            for t in event::sign_changes(v0, a0, bend, taken).into_iter().flatten() {
                let at = self.moved(start, rate, stretch, t);
                let [heel, toe] = self.turning.gaps(self.corner, &at);
                self.widen(&[at[0], heel, toe], at[2]);
            }
        }
    }

    /// Write the state at every wanted moment before `until`; `since` is when the present step began.
    pub(super) fn record(&mut self, start: &State, stretch: &Stretch, until: f64, since: f64) {
        let Some(h) = self.histories.take() else {
            return;
        };
        let rate = self.rates(start, &stretch.ground);
        while h.rows.len() < h.times.len() && h.times[h.rows.len()] < until {
            let t = if stretch.left > 0.0 {
                (h.times[h.rows.len()] - since).max(0.0)
            } else {
                0.0
            };
            let state = self.moved(start, &rate, stretch, t);
            let ground = stretch.after(t);
            let instant = self.turning.at(self.corner, &state, &ground);
            let reactions = self.reactions(&instant);
            let mut acceleration = instant.contact_acceleration(&reactions);
            let contacts = self.mode.contacts();
            for (held, i) in [
                (self.mode.sticks(), SLIP),
                (contacts[0], HEEL),
                (contacts[1], TOE),
            ] {
                if held {
                    acceleration[i] = 0.0;
                }
            }
            let gaps = self.turning.gaps(self.corner, &state);
            let velocity = self.turning.contact_velocity(self.corner, &state);
            let mut row = [0.0; 12];
            row[SLIP] = state[0];
            row[HEEL] = gaps[0].max(0.0);
            row[TOE] = gaps[1].max(0.0);
            row[3..6].copy_from_slice(&velocity);
            row[6..9].copy_from_slice(&acceleration);
            row[9..12].copy_from_slice(&reactions);
            h.rows.push(row);
            h.modes.push(self.mode.index() as u8);
        }
        self.histories = Some(h);
    }
}
