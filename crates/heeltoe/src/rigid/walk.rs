//! The walk from event to event, whatever carries the block from one to the next.
//!
//! In each mode of motion some of the contact coordinates w are held, and
//!
//! `w'' = b + A (T, N_h, N_t)`
//!
//! with the reactions that hold them. An event is where a normal force, what is left of the friction cone
//! `mu_s (N_h + N_t) -/+ T`, the slip velocity or a gap falls through zero. Between two events [`super::exact`] and
//! [`super::varying`] carry a block on one crack, and [`super::stack`] two blocks with a crack below either, each in its own
//! way. At an event, here, corners strike, and the first modes that are admissible are the next ones; where none are,
//! friction may jam. One block strikes and jams by the law of [`super::impact`].

use std::borrow::Cow;

use super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::impact::{impact, jam, Impact, Sideways};
use super::mode::Mode;
use super::result::{Event, EventKind, Moment, Outcome, Run, Summary};
use super::shaking::Piece;
use crate::inside::Borne;
use crate::stop::Stop;

/// A slip slower than this many times the bound of bounces may jam unasked; it would end within a nanometre or so.
pub(super) const CRAWL: f64 = 100.0;
/// Events in which time does not move, after which it never will.
const STANDING: u32 = 1000;
/// Corners nearer than this part of the width touch: it is rounding.
const NEAR: f64 = 1e-13;

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
    /// Which of them are wanted whole, with the place at each; all of them, and no places, where this is empty.
    pub whole: &'a [bool],
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
    /// A corner comes down, or a side against its neighbour.
    Gap(usize),
    /// A block in the air passes a valley or a peak of a rough crack, or slides over a peak.
    Turn,
}

/// What ended a piece before its time, in which crack.
pub(super) type Ended = (usize, Cause);

/// What a blow or a jam has done in each of the cracks: what it is called there, its impulses, the energy lost.
pub(super) struct Blow<const N: usize> {
    pub kinds: [Option<EventKind>; N],
    pub impulse: [Vector; N],
    pub energy_lost: [f64; N],
}

/// What every walk knows of a crack, and what it has seen there.
pub(super) struct Walk<'a> {
    pub block: &'a Block,
    pub options: Options,
    /// Velocity of the slowest bounce.
    pub settle: f64,
    pub mode: Mode,
    pub summary: Summary,
    wanted: Wanted<'a>,
    /// How many of the moments that are wanted are over.
    over: usize,
    moments: Vec<Moment>,
    places: Vec<Vector>,
    events: Vec<Event>,
    /// All events of the run, and those since time last moved; of several cracks the first one has them.
    count: u64,
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
            over: 0,
            moments: Vec::with_capacity(match wanted.whole {
                [] => wanted.times.len(),
                whole => whole.iter().filter(|whole| **whole).count(),
            }),
            places: Vec::with_capacity(wanted.whole.len()),
            events: Vec::new(),
            count: 0,
            standing: 0,
        }
    }

    /// Go on with another block in the same place.
    pub(super) fn with(self, block: &'a Block) -> Self {
        Walk { block, ..self }
    }

    /// Hand over what there is to tell.
    pub(super) fn end(self, kinetic_energy: f64, anchors: Vec<Borne>) -> Run {
        let summary = Summary {
            kinetic_energy,
            ..self.summary
        };
        Run {
            summary,
            moments: self.moments,
            places: self.places,
            events: self.events,
            anchors,
            worn: None,
            rough: None,
            crossing: None,
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

    /// Close the gaps that are nearer than rounding, so that their corners strike together, and say which.
    pub(super) fn land(&mut self) -> [bool; 2] {
        [HEEL, TOE].map(|gap| {
            let touches = self.touches(self.summary.position[gap], self.summary.velocity[gap]);
            if touches {
                self.summary.position[gap] = 0.0;
            }
            touches
        })
    }

    /// Whether any moments are wanted.
    pub(super) fn observed(&self) -> bool {
        !self.wanted.times.is_empty()
    }

    /// The next moment that is wanted, if it comes before `until`.
    pub(super) fn next_moment(&self, until: f64) -> Option<f64> {
        let next = self.wanted.times.get(self.over).copied();
        next.filter(|time| *time < until)
    }

    /// Whether it is wanted whole.
    pub(super) fn whole(&self) -> bool {
        self.wanted.whole.get(self.over).is_none_or(|whole| *whole)
    }

    /// Keep what is wanted of it.
    pub(super) fn keep(&mut self, moment: Moment) {
        if self.whole() {
            self.moments.push(moment);
        }
        if !self.wanted.whole.is_empty() {
            self.places.push(moment.position);
        }
        self.over += 1;
    }

    /// Tell of an event, where they are wanted.
    pub(super) fn tell(&mut self, event: Event) {
        if self.wanted.events {
            self.events.push(event);
        }
    }

    /// Whether no event is wanted and no moment: the summary alone.
    pub(super) fn summarises(&self) -> bool {
        !self.wanted.events && !self.observed()
    }

    /// Whether somebody has stopped the run.
    #[inline(always)]
    pub(super) fn stopped(&self) -> bool {
        self.wanted.stop.asked()
    }
}

/// Blocks above N cracks that are carried from event to event.
pub(super) trait Carried<'a, const N: usize> {
    /// The ground from here on.
    type Piece;

    /// What is known of each crack.
    fn walks(&mut self) -> &mut [Walk<'a>; N];

    /// Velocities of slip and gaps at each.
    fn velocities(&self) -> [Vector; N];

    /// The modes in which the blocks can go on; what it takes to begin in them is kept. `None` is a Painlevé paradox.
    fn find_modes(&mut self, piece: &Self::Piece) -> Option<[Mode; N]>;

    /// Begin to move in the modes that have been chosen; slips and gaps stand in the summaries then.
    fn enter(&mut self);

    /// Let corners strike where a gap has closed; `None` is a paradox.
    fn collide(&mut self, gap: usize) -> Option<Blow<N>>;

    /// Let friction jam where that is asked for, or where a slip is too slow to matter.
    fn seize(&mut self) -> Option<Blow<N>>;

    /// End the run.
    fn give_up(&mut self, outcome: Outcome) -> bool {
        for walk in self.walks() {
            walk.summary.outcome = outcome;
        }
        false
    }

    /// Note what time it is.
    #[inline(always)]
    fn set_time(&mut self, time: f64) {
        for walk in self.walks() {
            walk.summary.end_time = time;
        }
    }

    /// Count an event that ended a piece; false where there have been too many, of all or in one moment.
    fn count(&mut self, moved: bool) -> bool {
        let walk = &mut self.walks()[0];
        walk.standing = if moved { 0 } else { walk.standing + 1 };
        walk.count += 1;
        if N == 1 {
            // Of several cracks an event counts for those where it has done something.
            walk.summary.events += 1;
        }
        if walk.count >= walk.options.event_limit {
            return self.give_up(Outcome::EventLimit);
        }
        if walk.standing > STANDING {
            return self.give_up(Outcome::Cycling);
        }
        walk.summary.outcome == Outcome::Done && !walk.stopped()
    }

    /// Deal with what ended the last piece and choose the modes of the next; false where the run cannot continue.
    fn choose(&mut self, piece: &Self::Piece, cause: Option<Ended>) -> bool {
        let approach = self.velocities();
        let mut blow: Option<Blow<N>> = None;
        if let Some((_, Cause::Gap(gap))) = cause {
            blow = self.collide(gap);
            if blow.is_none() {
                return self.give_up(Outcome::Paradox);
            }
        }
        let mut after = self.find_modes(piece);
        if after.is_none() {
            if let Some(stop) = self.seize() {
                blow = Some(stop);
                after = self.find_modes(piece);
            }
        }
        let Some(after) = after else {
            return self.give_up(Outcome::Paradox);
        };
        let walks = self.walks();
        let before: [Mode; N] =
            std::array::from_fn(|crack| std::mem::replace(&mut walks[crack].mode, after[crack]));
        for (walk, after) in walks.iter_mut().zip(after) {
            walk.summary.mode = after;
        }
        self.enter();
        // A mode may also change at a sample, where a jump of the ground acceleration is the cause.
        self.walks()[0].count += u64::from(cause.is_none() && (after != before || blow.is_some()));
        for crack in 0..N {
            let own = cause.and_then(|(place, why)| (place == crack).then_some(why));
            let struck = blow.as_ref().and_then(|blow| blow.kinds[crack]);
            let (before, after) = (before[crack], after[crack]);
            if own.is_none() && struck.is_none() && before == after {
                continue;
            }
            let walk = &mut self.walks()[crack];
            walk.summary.events += u64::from(N > 1 || cause.is_none());
            let kind = struck.unwrap_or_else(|| describe(before, after, own));
            walk.summary.slip_stops += u64::from(kind == EventKind::SlipStops);
            walk.tell(Event {
                time: walk.summary.end_time,
                kind,
                before,
                after,
                position: walk.summary.position,
                velocity: walk.summary.velocity,
                approach: approach[crack],
                impulse: blow.as_ref().map_or([0.0; 3], |blow| blow.impulse[crack]),
                energy_lost: blow.as_ref().map_or(0.0, |blow| blow.energy_lost[crack]),
            });
        }
        true
    }
}

/// Blocks that are carried to the next event, whatever the length of the way, on a ground of G components.
pub(super) trait Exactly<'a, const N: usize, const G: usize>:
    Carried<'a, N, Piece = Piece<G>>
{
    /// Move to the next event or to the end of the piece; returns the time that took and what ended it.
    fn advance(&mut self, piece: &Piece<G>, time: f64) -> (f64, Option<Ended>);

    /// Go from event to event to the end of a piece that begins at `time`; false where the run cannot continue.
    #[inline(always)]
    fn cross(&mut self, whole: &Piece<G>, time: f64) -> bool {
        self.cross_from(whole, time, 0.0, None)
    }

    /// The same from so far into the piece on, after what ended the way there.
    #[inline(always)]
    fn cross_from(&mut self, whole: &Piece<G>, time: f64, mut local: f64, mut cause: Option<Ended>) -> bool {
        loop {
            let piece = whole.rest(local);
            self.set_time(time + local);
            if !self.choose(&piece, cause) {
                return false;
            }
            let (step, ended) = self.advance(&piece, time + local);
            // A step may be too short to move the clock.
            let moved = local + step > local;
            local += step;
            if ended.is_none() {
                return true;
            }
            cause = ended;
            if !self.count(moved) {
                self.set_time(time + local);
                return false;
            }
        }
    }
}

/// A block above one crack: what is asked of it beside its motion, so that it strikes and jams as one block does.
pub(super) trait Single<'a> {
    /// The ground from here on.
    type Piece;

    fn walk(&mut self) -> &mut Walk<'a>;

    /// Velocities of slip and gaps.
    fn velocity(&self) -> Vector;

    /// Which corners lie: neither their gap nor its velocity is other than zero.
    fn closed(&self) -> [bool; 2];

    /// Its motion across the valley, if it has any.
    fn sideways(&self) -> Option<Sideways> {
        None
    }

    /// Take over the velocity across the valley after an impact.
    fn set_sideways(&mut self, _velocity: f64) {}

    /// Come to rest against a neighbour across the valley, if that is what closes this gap.
    fn stop_aside(&mut self, _gap: usize) -> Option<Impact> {
        None
    }

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

    /// Let the corner of this gap strike, with the other if that is as near; `None` is a paradox.
    fn strike(&mut self, gap: usize) -> Option<(EventKind, Impact)> {
        if let Some(blow) = self.stop_aside(gap) {
            return Some((EventKind::SideStrikes, blow));
        }
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
        let blow = impact(&self.block(), &velocity, self.sideways(), touching, settle)?;
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
        let (velocity, sideways) = (self.velocity(), self.sideways());
        let walk = self.walk();
        let slip = sideways.map_or(velocity[SLIP].abs(), |aside| velocity[SLIP].hypot(aside.velocity));
        let crawls = slip < CRAWL * walk.settle;
        if !walk.options.jam && !crawls {
            return None;
        }
        let stop = jam(&self.block(), &velocity, sideways, self.closed())?;
        self.apply(&stop);
        self.walk().summary.jams += u64::from(!crawls);
        Some(stop)
    }

    /// Take over what an impact has done.
    fn apply(&mut self, blow: &Impact) {
        self.set_velocity(&blow.velocity);
        self.set_sideways(blow.across[0]);
        let summary = &mut self.walk().summary;
        summary.ledger.strike(blow.energy_lost);
        summary.energy_limited += u64::from(blow.energy_limited);
    }
}

impl<'a, T: Single<'a>> Carried<'a, 1> for T {
    type Piece = <T as Single<'a>>::Piece;

    #[inline(always)]
    fn walks(&mut self) -> &mut [Walk<'a>; 1] {
        std::array::from_mut(self.walk())
    }

    #[inline(always)]
    fn velocities(&self) -> [Vector; 1] {
        [self.velocity()]
    }

    #[inline(always)]
    fn find_modes(&mut self, piece: &<T as Single<'a>>::Piece) -> Option<[Mode; 1]> {
        self.pick(piece).map(|mode| [mode])
    }

    #[inline(always)]
    fn enter(&mut self) {
        self.begin();
    }

    fn collide(&mut self, gap: usize) -> Option<Blow<1>> {
        self.strike(gap).map(|(kind, impact)| alone(kind, &impact))
    }

    fn seize(&mut self) -> Option<Blow<1>> {
        self.jam().map(|stop| alone(EventKind::Jams, &stop))
    }
}

/// What an impact of one block has done.
fn alone(kind: EventKind, impact: &Impact) -> Blow<1> {
    Blow {
        kinds: [Some(kind)],
        impulse: [impact.impulse],
        energy_lost: [impact.energy_lost],
    }
}

/// The name of an event in which nothing strikes.
fn describe(before: Mode, after: Mode, cause: Option<Cause>) -> EventKind {
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
