//! The walk from event to event, whatever carries the block from one to the next.
//!
//! In each mode of motion some of the contact coordinates w are held, and
//!
//! `w'' = b + A (T, N_h, N_t)`
//!
//! with the reactions that hold them. An event is where a normal force, what is left of the friction cone
//! `mu_s (N_h + N_t) -/+ T`, the slip velocity or a gap falls through zero. Between two events [`super::exact`] and
//! [`super::varying`] carry the block, each in its own way. At an event, here, a corner strikes by the law of
//! [`super::impact`], and the first mode that is admissible is the next one; where none is, friction may jam.

use std::borrow::Cow;

use super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::impact::{impact, jam, Impact};
use super::mode::Mode;
use super::result::{Event, EventKind, Moment, Outcome, Run, Summary};
use crate::stop::Stop;

/// A slip slower than this many times the bound of bounces may jam unasked; it would end within a nanometre or so.
pub(super) const CRAWL: f64 = 100.0;
/// Events in which time does not move, after which it never will.
pub(super) const STANDING: u32 = 1000;
/// Corners nearer than this part of the width touch: it is rounding.
pub(super) const NEAR: f64 = 1e-13;

/// How a block is to move.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Bounces slower than `settle * sqrt(g' B)` end the bouncing (g' the vertical force per mass, B the width).
    pub settle: f64,
    /// Most events before the run stops.
    pub event_limit: u64,
    /// Resolve a Painlevé paradox by a tangential impact instead of stopping there.
    pub jam: bool,
}

/// What is wanted of a run beside its summary.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// Moments, ascending, at which the block is to be seen; at an event, after it.
    pub times: &'a [f64],
    /// Whether events are to be told.
    pub events: bool,
    /// What ends the run before its time.
    pub stop: Stop<'a>,
}

/// What ended a piece before its time.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Cause {
    Normal,
    Cone,
    Stop,
    Gap(usize),
    /// A block in the air passes a valley or a peak of a rough crack, or slides over a peak.
    Turn,
}

/// What every walk knows, and what it has seen.
pub(super) struct Walk<'a> {
    pub block: &'a Block,
    pub options: Options,
    /// Velocity of the slowest bounce.
    pub settle: f64,
    pub mode: Mode,
    pub summary: Summary,
    wanted: Wanted<'a>,
    moments: Vec<Moment>,
    events: Vec<Event>,
    /// Events since time last moved.
    pub standing: u32,
}

impl<'a> Walk<'a> {
    /// Begin at `time` with these contact coordinates and velocities.
    pub(super) fn new(
        block: &'a Block,
        time: f64,
        start: [Vector; 2],
        options: Options,
        wanted: Wanted<'a>,
    ) -> Self {
        Walk {
            block,
            options,
            settle: options.settle * block.velocity_scale(),
            mode: Mode::Rest,
            summary: Summary::at_start(block, time, start),
            wanted,
            moments: Vec::with_capacity(wanted.times.len()),
            events: Vec::new(),
            standing: 0,
        }
    }

    /// Hand over what there is to tell.
    pub(super) fn end(self, kinetic_energy: f64, tensions: Vec<f64>) -> Run {
        let summary = Summary {
            kinetic_energy,
            ..self.summary
        };
        Run {
            summary,
            moments: self.moments,
            events: self.events,
            tensions,
            worn: None,
            rough: None,
        }
    }

    /// How near is touching.
    pub(super) fn near(&self) -> f64 {
        NEAR * self.block.width
    }

    /// Whether a corner touches as the other one strikes: one that has just left is not put back.
    pub(super) fn touches(&self, gap: f64, velocity: f64) -> bool {
        gap <= 0.0 || gap <= self.near() && velocity <= self.settle
    }

    /// Whether any moments are wanted.
    pub(super) fn observed(&self) -> bool {
        !self.wanted.times.is_empty()
    }

    /// The next moment that is wanted, if it comes before `until`.
    pub(super) fn next_moment(&self, until: f64) -> Option<f64> {
        let next = self.wanted.times.get(self.moments.len()).copied();
        next.filter(|time| *time < until)
    }

    pub(super) fn keep(&mut self, moment: Moment) {
        self.moments.push(moment);
    }

    /// Count an event that ended a piece; false where there have been too many, of all or in one moment.
    pub(super) fn count(&mut self, moved: bool) -> bool {
        self.standing = if moved { 0 } else { self.standing + 1 };
        self.summary.events += 1;
        if self.summary.events >= self.options.event_limit {
            self.summary.outcome = Outcome::EventLimit;
        } else if self.standing > STANDING {
            self.summary.outcome = Outcome::Cycling;
        }
        self.summary.outcome == Outcome::Done && !self.stopped()
    }

    /// Whether somebody has stopped the run.
    #[inline(always)]
    pub(super) fn stopped(&self) -> bool {
        self.wanted.stop.asked()
    }
}

/// A block that is carried from event to event.
pub(super) trait Carried<'a> {
    /// The ground from here on.
    type Piece;

    fn walk(&mut self) -> &mut Walk<'a>;

    /// Velocities of slip and gaps.
    fn velocity(&self) -> Vector;

    /// Which corners lie: neither their gap nor its velocity is other than zero.
    fn closed(&self) -> [bool; 2];

    /// The block with the compliance of this moment.
    fn block(&self) -> Cow<'_, Block>;

    /// The mode in which the block can go on; what it takes to begin in it is kept. `None` is a Painlevé paradox.
    fn pick(&mut self, piece: &Self::Piece) -> Option<Mode>;

    /// Bring a corner whose gap has closed into contact, and say which corners touch.
    fn land(&mut self, gap: usize) -> [bool; 2];

    /// Take over the velocities after an impact.
    fn set_velocity(&mut self, velocity: &Vector);

    /// Begin to move in the mode that has been chosen.
    fn begin(&mut self);

    /// Deal with what ended the last piece and choose the mode of the next; false where the run cannot continue.
    fn choose(&mut self, piece: &Self::Piece, cause: Option<Cause>) -> bool {
        let approach = self.velocity();
        let mut blow: Option<(EventKind, Impact)> = None;
        if let Some(Cause::Gap(gap)) = cause {
            blow = self.strike(gap);
            if blow.is_none() {
                self.walk().summary.outcome = Outcome::Paradox;
                return false;
            }
        }
        let mut after = self.pick(piece);
        if after.is_none() {
            if let Some(stop) = self.jam() {
                blow = Some((EventKind::Jams, stop));
                after = self.pick(piece);
            }
        }
        let walk = self.walk();
        let Some(after) = after else {
            walk.summary.outcome = Outcome::Paradox;
            return false;
        };
        let before = std::mem::replace(&mut walk.mode, after);
        walk.summary.mode = after;
        self.begin();
        // A mode may also change at a sample, where a jump of the ground acceleration is the cause.
        if cause.is_some() || after != before || blow.is_some() {
            let walk = self.walk();
            walk.summary.events += u64::from(cause.is_none());
            let kind = blow.map_or_else(|| describe(before, after, cause), |(kind, _)| kind);
            walk.summary.slip_stops += u64::from(kind == EventKind::SlipStops);
            if walk.wanted.events {
                walk.events.push(Event {
                    time: walk.summary.end_time,
                    kind,
                    before,
                    after,
                    position: walk.summary.position,
                    velocity: walk.summary.velocity,
                    approach,
                    impulse: blow.map_or([0.0; 3], |(_, i)| i.impulse),
                    energy_lost: blow.map_or(0.0, |(_, i)| i.energy_lost),
                });
            }
        }
        true
    }

    /// Let the corner of this gap strike, with the other if that is as near; `None` is a paradox.
    fn strike(&mut self, gap: usize) -> Option<(EventKind, Impact)> {
        let touching = self.land(gap);
        let velocity = self.velocity();
        let strikes = [
            touching[0] && velocity[HEEL] < 0.0,
            touching[1] && velocity[TOE] < 0.0,
        ];
        let walk = self.walk();
        walk.summary.impacts += 1;
        for (touches, gap) in touching.into_iter().zip([HEEL, TOE]) {
            if touches {
                let fastest = &mut walk.summary.largest_impact_velocity;
                *fastest = fastest.max(-velocity[gap]);
            }
        }
        let settle = walk.settle;
        let blow = impact(&self.block(), &velocity, touching, settle)?;
        self.apply(&blow);
        let kind = match strikes {
            [true, true] => EventKind::BothStrike,
            [true, false] => EventKind::HeelStrikes,
            [false, true] => EventKind::ToeStrikes,
            // It has come down without a velocity.
            [false, false] if gap == HEEL => EventKind::HeelStrikes,
            [false, false] => EventKind::ToeStrikes,
        };
        Some((kind, blow))
    }

    /// Let friction jam where that is asked for, or where the slip is too slow to matter.
    fn jam(&mut self) -> Option<Impact> {
        let velocity = self.velocity();
        let walk = self.walk();
        let crawls = velocity[SLIP].abs() < CRAWL * walk.settle;
        if !walk.options.jam && !crawls {
            return None;
        }
        let stop = jam(&self.block(), &velocity, self.closed())?;
        self.apply(&stop);
        self.walk().summary.jams += u64::from(!crawls);
        Some(stop)
    }

    /// Take over what an impact has done.
    fn apply(&mut self, blow: &Impact) {
        self.set_velocity(&blow.velocity);
        let summary = &mut self.walk().summary;
        summary.ledger.strike(blow.energy_lost);
        summary.energy_limited += u64::from(blow.energy_limited);
    }
}

/// The name of an event in which nothing strikes.
pub(super) fn describe(before: Mode, after: Mode, cause: Option<Cause>) -> EventKind {
    let (was, is) = (before.contacts(), after.contacts());
    if cause == Some(Cause::Turn) {
        EventKind::AsperityPassed
    } else if cause == Some(Cause::Stop) {
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
