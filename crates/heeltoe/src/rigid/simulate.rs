//! The walk from event to event.
//!
//! On each piece of the record (from one sample or event to the next) the mode's accelerations are linear in time.
//! The next event is the earliest root of: a normal force (linear), what is left of the friction cone (linear), the
//! slip velocity (quadratic), an open gap (cubic). The state is moved there exactly, the event is dealt with, the
//! next mode is chosen, and the walk goes on.

use super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::event;
use super::impact::{impact, jam, Impact};
use super::ledger::work;
use super::mode::{accelerations, select, Mode, Piece, Reactions, Slip, VIOLATION};
use super::result::{Event, EventKind, Histories, Outcome, Summary};

/// A slip slower than this many times the bound of bounces may jam unasked; it would end within a nanometre or so.
pub(super) const CRAWL: f64 = 100.0;

/// Ground motion as read by the kernel: linear between samples; a repeated time is a jump.
#[derive(Clone, Copy)]
pub struct Motion<'a> {
    pub time: &'a [f64],
    pub horizontal: &'a [f64],
    pub vertical: Option<&'a [f64]>,
    /// Factors on the two accelerations.
    pub scale: [f64; 2],
}

impl Motion<'_> {
    #[inline]
    fn at(&self, k: usize) -> [f64; 2] {
        let up = self.vertical.map_or(0.0, |v| v[k] * self.scale[1]);
        [self.horizontal[k] * self.scale[0], up]
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Bounces slower than `settle * sqrt(g' B)` end the bouncing (g' the vertical force per mass, B the width).
    pub settle: f64,
    pub event_limit: u64,
    /// Resolve a Painlevé paradox by a tangential impact instead of stopping there.
    pub jam: bool,
}

/// What ended a piece before its time.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Cause {
    Normal,
    Cone,
    Stop,
    Gap(usize),
}

/// How the block moves on one piece: reactions, acceleration and slope of each coordinate, the ground.
struct Course<'a> {
    force: &'a [Affine; 3],
    motion: &'a [[f64; 2]; 3],
    piece: &'a Piece,
}

struct Walk<'a, 'h> {
    block: &'a Block,
    reactions: &'a Reactions,
    options: Options,
    settle: f64,
    mode: Mode,
    summary: Summary,
    log: Option<&'a mut Vec<Event>>,
    histories: Option<&'a mut Histories<'h>>,
    /// Events since time last moved.
    standing: u32,
}

/// Run one block through one motion.
///
/// `start` gives contact coordinates and their velocities at the first sample; without it the block stands still in
/// contact and must be able to do so under its static loads.
pub fn simulate<'h>(
    block: &Block,
    motion: &Motion,
    start: Option<[Vector; 2]>,
    options: Options,
    log: Option<&mut Vec<Event>>,
    histories: Option<&mut Histories<'h>>,
) -> Summary {
    let [position, velocity] = start.unwrap_or([[0.0; 3]; 2]);
    let g = -block.generalised_force[HEEL].constant - block.generalised_force[TOE].constant;
    let speed = (g.abs() / block.mass() * block.width).sqrt();
    let reactions = Reactions::new(block);
    let mut walk = Walk {
        block,
        reactions: &reactions,
        options,
        settle: options.settle * speed,
        mode: Mode::Rest,
        summary: Summary::at_start(block, motion.time[0], position, velocity),
        log,
        histories,
        standing: 0,
    };
    walk.run(motion, start.is_none());
    walk.summary.kinetic_energy = block.kinetic_energy(&walk.summary.velocity);
    walk.summary
}

impl Walk<'_, '_> {
    fn run(&mut self, motion: &Motion, stands: bool) {
        let still = Piece {
            ground: [0.0; 2],
            rate: [0.0; 2],
            left: 1.0,
        };
        if stands && !self.rests(&still) {
            self.summary.outcome = Outcome::Unstable;
            return;
        }
        let n = motion.time.len();
        let mut k = 0;
        // Whether the present mode was chosen by the state as it is now.
        let mut settled = false;
        while k + 1 < n {
            if settled && self.mode == Mode::Rest && self.histories.is_none() {
                k = self.rest_until(motion, k);
                if k + 1 >= n {
                    break;
                }
            }
            let (t0, t1) = (motion.time[k], motion.time[k + 1]);
            let (a0, a1) = (motion.at(k), motion.at(k + 1));
            k += 1;
            let length = t1 - t0;
            if length <= 0.0 {
                continue;
            }
            let inverse = 1.0 / length;
            let rate = [(a1[0] - a0[0]) * inverse, (a1[1] - a0[1]) * inverse];
            let mut local = 0.0;
            let mut cause = None;
            loop {
                let ground = [a0[0] + rate[0] * local, a0[1] + rate[1] * local];
                let piece = Piece {
                    ground,
                    rate,
                    left: length - local,
                };
                self.summary.end_time = t0 + local;
                if !self.choose(&piece, cause) {
                    return;
                }
                settled = true;
                let (step, ended) = self.advance(&piece, t0 + local);
                // A step may be too short to move the clock.
                let moved = local + step > local;
                local += step;
                let Some(why) = ended else { break };
                cause = Some(why);
                self.standing = if moved { 0 } else { self.standing + 1 };
                self.summary.events += 1;
                let stop = if self.summary.events >= self.options.event_limit {
                    Outcome::EventLimit
                } else if self.standing > 1000 {
                    Outcome::Cycling
                } else {
                    continue;
                };
                self.summary.outcome = stop;
                self.summary.end_time = t0 + local;
                return;
            }
        }
        self.summary.end_time = motion.time[n - 1];
        self.summary.mode = self.mode;
        self.record(None, f64::INFINITY, 0.0);
    }

    fn rests(&self, piece: &Piece) -> bool {
        let closed = [true, true];
        select(self.reactions, Mode::Rest, closed, 0.0, piece) == Some(Mode::Rest)
    }

    /// While the block rests nothing moves: go through the samples as fast as they can be read and return the last
    /// one before rest may end.
    fn rest_until(&mut self, motion: &Motion, from: usize) -> usize {
        let rest = self.reactions.of(Mode::Rest);
        let limits = [rest.force[HEEL], rest.force[TOE], rest.cone[0], rest.cone[1]];
        let holds = |k: usize| {
            let ground = motion.at(k);
            limits.iter().all(|limit| limit.at(ground) >= 0.0)
        };
        let mut k = from;
        // The first sample is looked at too: right behind a jump it is new.
        if holds(k) {
            while k + 1 < motion.time.len() && holds(k + 1) {
                k += 1;
            }
        }
        self.summary.time_by_mode[Mode::Rest.kind()] += motion.time[k] - motion.time[from];
        k
    }

    fn closed(&self) -> [bool; 2] {
        let s = &self.summary;
        [HEEL, TOE].map(|gap| s.position[gap] == 0.0 && s.velocity[gap] == 0.0)
    }

    /// Deal with what ended the last piece and choose the mode of the next; false where the run cannot continue.
    fn choose(&mut self, piece: &Piece, cause: Option<Cause>) -> bool {
        let before = self.mode;
        let approach = self.summary.velocity;
        let mut blow: Option<(EventKind, Impact)> = None;
        if let Some(Cause::Gap(_)) = cause {
            let Some(struck) = self.strike() else {
                self.summary.outcome = Outcome::Paradox;
                return false;
            };
            blow = Some(struck);
        }
        let pick = |walk: &Self| {
            let velocity = walk.summary.velocity[SLIP];
            select(walk.reactions, walk.mode, walk.closed(), velocity, piece)
        };
        let mut after = pick(self);
        // A slip too slow to matter may jam unasked.
        let crawls = self.summary.velocity[SLIP].abs() < CRAWL * self.settle;
        if after.is_none() && (self.options.jam || crawls) {
            let closed = self.closed();
            if let Some(stop) = jam(self.block, &self.summary.velocity, closed) {
                self.apply(&stop);
                self.summary.jams += u64::from(!crawls);
                blow = Some((EventKind::Jams, stop));
                after = pick(self);
            }
        }
        let Some(after) = after else {
            self.summary.outcome = Outcome::Paradox;
            return false;
        };
        self.mode = after;
        self.summary.mode = after;
        // A mode may also change at a sample, where a jump of the ground acceleration is the cause.
        if cause.is_some() || after != before || blow.is_some() {
            if cause.is_none() {
                self.summary.events += 1;
            }
            let kind = blow.map_or_else(|| describe(before, after, cause), |(kind, _)| kind);
            self.summary.slip_stops += u64::from(kind == EventKind::SlipStops);
            if let Some(log) = self.log.as_deref_mut() {
                log.push(Event {
                    time: self.summary.end_time,
                    kind,
                    before,
                    after,
                    position: self.summary.position,
                    velocity: self.summary.velocity,
                    approach,
                    impulse: blow.map_or([0.0; 3], |(_, i)| i.impulse),
                    energy_lost: blow.map_or(0.0, |(_, i)| i.energy_lost),
                });
            }
        }
        true
    }

    fn apply(&mut self, blow: &Impact) {
        self.summary.velocity = blow.velocity;
        self.summary.ledger.strike(blow.energy_lost);
        self.summary.energy_limited += u64::from(blow.energy_limited);
    }

    fn strike(&mut self) -> Option<(EventKind, Impact)> {
        let s = &mut self.summary;
        // Corners nearer than rounding strike together.
        let near = 1e-13 * self.block.width;
        let mut touching = [false; 2];
        let mut strikes = [false; 2];
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if s.position[gap] <= near {
                s.position[gap] = 0.0;
                touching[corner] = true;
                strikes[corner] = s.velocity[gap] < 0.0;
                s.largest_impact_velocity = s.largest_impact_velocity.max(-s.velocity[gap]);
            }
        }
        s.impacts += 1;
        let result = impact(self.block, &s.velocity, touching, self.settle)?;
        self.apply(&result);
        let kind = match strikes {
            [true, true] => EventKind::BothStrike,
            [true, false] => EventKind::HeelStrikes,
            _ => EventKind::ToeStrikes,
        };
        Some((kind, result))
    }

    /// Move to the next event or to the end of the piece; returns the time that took and what ended it.
    fn advance(&mut self, piece: &Piece, time: f64) -> (f64, Option<Cause>) {
        let reaction = self.reactions.of(self.mode);
        let contacts = self.mode.contacts();
        let closed = self.closed();
        let velocity = self.summary.velocity;
        let position = self.summary.position;
        let slip = self.mode.slip();
        let starts = [
            if velocity[SLIP] == 0.0 {
                slip.map_or(0.0, Slip::sign)
            } else {
                0.0
            },
            f64::from(closed[0]),
            f64::from(closed[1]),
        ];
        let motion = accelerations(reaction, starts, piece);

        let mut step = piece.left;
        let mut cause = None;
        let mut earlier = |t: f64, why: Cause| {
            if t < step || (t == step && cause.is_none()) {
                step = t;
                cause = Some(why);
            }
        };
        let mut falls = |q: Affine, size: f64, why: Cause| {
            let (value, slope) = (q.at(piece.ground), q.slope(piece.rate));
            if value + slope * piece.left < -VIOLATION * size && slope < 0.0 {
                earlier(event::linear(value, slope, piece.left), why);
            }
        };
        if contacts[0] {
            falls(reaction.force[HEEL], reaction.force_size[HEEL], Cause::Normal);
        }
        if contacts[1] {
            falls(reaction.force[TOE], reaction.force_size[TOE], Cause::Normal);
        }
        if self.mode.sticks() {
            falls(reaction.cone[0], reaction.cone_size, Cause::Cone);
            falls(reaction.cone[1], reaction.cone_size, Cause::Cone);
        }
        if let Some(slip) = slip {
            let s = slip.sign();
            let [a0, a1] = motion[SLIP];
            if let Some(t) = event::quadratic(s * velocity[SLIP], s * a0, s * a1 / 2.0, piece.left) {
                earlier(t, Cause::Stop);
            }
        }
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if contacts[corner] {
                continue;
            }
            let [a0, a1] = motion[gap];
            let root = event::cubic(position[gap], velocity[gap], a0 / 2.0, a1 / 6.0, piece.left);
            if let Some(t) = root {
                earlier(t, Cause::Gap(gap));
            }
        }
        let course = Course {
            force: &reaction.force,
            motion: &motion,
            piece,
        };
        self.move_on(&course, step, time);
        match cause {
            Some(Cause::Stop) => self.summary.velocity[SLIP] = 0.0,
            Some(Cause::Gap(gap)) => self.summary.position[gap] = 0.0,
            _ => {}
        }
        (step, cause)
    }

    fn move_on(&mut self, course: &Course, step: f64, time: f64) {
        let Course { force, motion, piece } = *course;
        self.record(Some(course), time + step, time);
        let block = self.block;
        let kind = self.mode.kind();
        self.summary.time_by_mode[kind] += step;
        if self.mode == Mode::Rest {
            return;
        }
        let contacts = self.mode.contacts();
        let moves = [!self.mode.sticks(), !contacts[0], !contacts[1]];
        let before = self.summary.position;
        let speed = self.summary.velocity;
        let s = &mut self.summary;
        for i in 0..3 {
            if !moves[i] {
                continue;
            }
            let [a0, a1] = motion[i];
            let load = &block.generalised_force[i];
            let load = [load.at(piece.ground), load.slope(piece.rate)];
            s.ledger.apply(work(load, speed[i], motion[i], step));
            s.position[i] += step * (speed[i] + step * (a0 / 2.0 + step * a1 / 6.0));
            s.velocity[i] += step * (a0 + step * a1 / 2.0);
        }
        if self.mode.slip().is_some() {
            let rub = [force[SLIP].at(piece.ground), force[SLIP].slope(piece.rate)];
            s.ledger.rub(work(rub, speed[SLIP], motion[SLIP], step));
        }
        for gap in [HEEL, TOE] {
            // The root that ended the piece is exact to rounding; so is the gap.
            s.position[gap] = s.position[gap].max(0.0);
        }
        s.slip_by_mode[kind] += s.position[SLIP] - before[SLIP];
        if contacts == [true, true] {
            // Both gaps stay closed and the slip keeps its sign.
            s.slip_range = [
                s.slip_range[0].min(s.position[SLIP]),
                s.slip_range[1].max(s.position[SLIP]),
            ];
        } else {
            let end = s.position;
            s.widen(&end, block);
            self.turning_points(&before, &speed, motion, step);
        }
    }

    /// Extremes inside a piece, where a velocity changes sign.
    fn turning_points(&mut self, w: &Vector, v: &Vector, a: &[[f64; 2]; 3], step: f64) {
        let block = self.block;
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
        let (now, spin, s) = (turn(w), (rise_heel + rise_toe) / block.width, &self.summary);
        // Where nothing on this piece can go beyond what has been, there is no need to look where it turns.
        if w[SLIP] + slide <= s.slip_range[1]
            && w[SLIP] - slide >= s.slip_range[0]
            && w[HEEL] + rise_heel <= s.largest_gap[0]
            && w[TOE] + rise_toe <= s.largest_gap[1]
            && now + spin <= s.rotation_range[1]
            && now - spin >= s.rotation_range[0]
        {
            return;
        }
        for rate in rates {
            let moments = event::sign_changes(rate[0], rate[1], rate[2] / 2.0, step);
            for t in moments.into_iter().flatten() {
                let mut at = *w;
                for i in 0..3 {
                    at[i] += t * (v[i] + t * (a[i][0] / 2.0 + t * a[i][1] / 6.0));
                }
                self.summary.widen(&at, block);
            }
        }
    }

    /// Write the state at every wanted moment before `until`; `since` is when the present piece began.
    fn record(&mut self, course: Option<&Course>, until: f64, since: f64) {
        let Some(h) = self.histories.as_deref_mut() else {
            return;
        };
        while h.rows.len() < h.times.len() && h.times[h.rows.len()] < until {
            let mut row = h.rows.last().copied().unwrap_or([0.0; 12]);
            let (w, v) = (&self.summary.position, &self.summary.velocity);
            let dt = h.times[h.rows.len()] - since;
            for i in 0..3 {
                let [a0, a1] = course.map_or([0.0; 2], |c| c.motion[i]);
                let t = if course.is_some() { dt.max(0.0) } else { 0.0 };
                row[i] = w[i] + t * (v[i] + t * (a0 / 2.0 + t * a1 / 6.0));
                row[3 + i] = v[i] + t * (a0 + t * a1 / 2.0);
                if let Some(c) = course {
                    row[6 + i] = a0 + a1 * t;
                    row[9 + i] = c.force[i].at(c.piece.ground) + c.force[i].slope(c.piece.rate) * t;
                }
            }
            row[HEEL] = row[HEEL].max(0.0);
            row[TOE] = row[TOE].max(0.0);
            h.rows.push(row);
            h.modes.push(self.mode.index() as u8);
        }
    }
}

pub(super) fn describe(before: Mode, after: Mode, cause: Option<Cause>) -> EventKind {
    let (was, is) = (before.contacts(), after.contacts());
    if cause == Some(Cause::Stop) {
        EventKind::SlipStops
    } else if was[0] && !is[0] {
        EventKind::HeelLifts
    } else if was[1] && !is[1] {
        EventKind::ToeLifts
    } else if before.sticks() && after.slip().is_some() {
        EventKind::SlipStarts
    } else {
        EventKind::ModeChanges
    }
}
