//! From event to event, as one block goes by [`super::super::walk`].

use super::super::block::{HEEL, SLIP, TOE};
use super::super::ledger::Ledger;
use super::super::mode::Mode;
use super::super::reaction::Felt;
use super::super::result::{Event, EventKind, Moment, Outcome, Run, Summary};
use super::super::shaking::{Piece, Shaking};
use super::super::walk::{describe, Cause, Options, Wanted, CRAWL, NEAR, STANDING};
use super::blocks::{part, Six, Stack};
use super::choice::{select, Going};
use super::impact::{Approach, Corners, Impact};
use super::reaction::{Modes, Reactions};

/// What a run of two blocks returns.
#[derive(Clone, Debug)]
pub struct StackRun {
    /// What the lower and the upper crack did; energies are those of both blocks together.
    pub cracks: [Run; 2],
    /// Least and largest rotation of the lower and of the upper block, from the ground.
    pub tilts: [[f64; 2]; 2],
    /// Lost to friction and to impacts in each crack.
    pub lost: [[f64; 2]; 2],
}

/// What ended a piece, in which crack.
pub(super) type Ended = (usize, Cause);

pub(super) struct Walk<'a> {
    pub stack: &'a Stack,
    options: Options,
    wanted: Wanted<'a>,
    settle: [f64; 2],
    pub reactions: Reactions<'a>,
    pub modes: Modes,
    pub felt: [Felt; 2],
    pub position: Six,
    pub velocity: Six,
    pub closed: Corners,
    pub summaries: [Summary; 2],
    pub books: [Ledger; 2],
    pub tilts: [[f64; 2]; 2],
    pub moments: [Vec<Moment>; 2],
    events: [Vec<Event>; 2],
    time: f64,
    count: u64,
    standing: u32,
    outcome: Outcome,
}

/// Run two blocks, which stand still at first, through one motion. An event counts for the crack in which it happens and
/// for one whose mode it changes.
pub fn simulate(stack: &Stack, shaking: &Shaking, options: Options, wanted: Wanted) -> StackRun {
    let stack = &stack.under(shaking.peaks());
    let start = shaking.time[0];
    let begun = |crack: usize| Summary::at_start(&stack.blocks[crack], start, [[0.0; 3]; 2]);
    let mut walk = Walk {
        stack,
        options,
        wanted,
        settle: [0, 1].map(|crack| options.settle * stack.blocks[crack].velocity_scale()),
        reactions: Reactions::new(stack),
        modes: [Mode::Rest; 2],
        felt: [Felt::default(); 2],
        position: [0.0; 6],
        velocity: [0.0; 6],
        closed: [[true; 2]; 2],
        summaries: [begun(0), begun(1)],
        books: [Ledger::default(); 2],
        tilts: [[0.0; 2]; 2],
        moments: [Vec::new(), Vec::new()],
        events: [Vec::new(), Vec::new()],
        time: start,
        count: 0,
        standing: 0,
        outcome: Outcome::Done,
    };
    walk.run(shaking);
    walk.end()
}

impl Walk<'_> {
    fn run(&mut self, shaking: &Shaking) {
        let rest = [Mode::Rest; 2];
        if self.pick(&Piece::still(1.0)) != Some(rest) {
            self.outcome = Outcome::Unstable;
            return;
        }
        for (k, whole) in shaking.pieces(0).enumerate() {
            if whole.left <= 0.0 {
                continue;
            }
            if self.wanted.stop.asked() || !self.cross(&whole, shaking.time[k]) {
                return;
            }
        }
        let last = shaking.time.len() - 1;
        self.time = shaking.time[last];
        let piece = Piece {
            ground: shaking.at(shaking.last()),
            ..Piece::still(0.0)
        };
        if self.next_moment(f64::INFINITY).is_some() && self.pick(&piece).is_some() {
            let course = self.course(&piece);
            self.record(&course, f64::INFINITY, self.time);
        }
    }

    /// Go from event to event to the end of a piece; false where the run cannot continue.
    fn cross(&mut self, whole: &Piece<2>, time: f64) -> bool {
        let mut local = 0.0;
        let mut cause = None;
        loop {
            let piece = Piece {
                ground: whole.after(local),
                left: whole.left - local,
                ..*whole
            };
            self.time = time + local;
            if !self.choose(&piece, cause) {
                return false;
            }
            let (step, ended) = self.advance(&piece, time + local);
            let moved = local + step > local;
            local += step;
            if ended.is_none() {
                return true;
            }
            cause = ended;
            self.time = time + local;
            if !self.counted(moved) {
                return false;
            }
        }
    }

    /// Count an event; false where there have been too many, of all or in one moment.
    fn counted(&mut self, moved: bool) -> bool {
        self.standing = if moved { 0 } else { self.standing + 1 };
        self.count += 1;
        if self.count >= self.options.event_limit {
            self.outcome = Outcome::EventLimit;
        } else if self.standing > STANDING {
            self.outcome = Outcome::Cycling;
        }
        self.outcome == Outcome::Done && !self.wanted.stop.asked()
    }

    /// Deal with what ended the last piece and choose the modes of the next; false where the run cannot continue.
    fn choose(&mut self, piece: &Piece<2>, cause: Option<Ended>) -> bool {
        let approach = self.velocity;
        let mut blow = None;
        if let Some((_, Cause::Gap(_))) = cause {
            blow = self.strike();
            if blow.is_none() {
                self.outcome = Outcome::Paradox;
                return false;
            }
        }
        let mut after = self.pick(piece);
        if after.is_none() {
            if let Some(stop) = self.jam() {
                blow = Some(([Some(EventKind::Jams); 2], stop));
                after = self.pick(piece);
            }
        }
        let Some(after) = after else {
            self.outcome = Outcome::Paradox;
            return false;
        };
        let before = std::mem::replace(&mut self.modes, after);
        for crack in 0..2 {
            let own = cause.and_then(|(where_, why)| (where_ == crack).then_some(why));
            let struck = blow.as_ref().and_then(|(kinds, _)| kinds[crack]);
            if own.is_none() && struck.is_none() && before[crack] == after[crack] {
                continue;
            }
            let kind = struck.unwrap_or_else(|| describe(before[crack], after[crack], own));
            let summary = &mut self.summaries[crack];
            summary.events += 1;
            summary.slip_stops += u64::from(kind == EventKind::SlipStops);
            if !self.wanted.events {
                continue;
            }
            self.events[crack].push(Event {
                time: self.time,
                kind,
                before: before[crack],
                after: after[crack],
                position: part(&self.position, crack),
                velocity: part(&self.velocity, crack),
                approach: part(&approach, crack),
                impulse: blow.as_ref().map_or([0.0; 3], |(_, i)| part(&i.impulse, crack)),
                energy_lost: blow.as_ref().map_or(0.0, |(_, i)| i.energy_lost[crack]),
            });
        }
        true
    }

    fn pick(&mut self, piece: &Piece<2>) -> Option<Modes> {
        self.closed = [0, 1].map(|crack| {
            [HEEL, TOE].map(|gap| {
                let i = 3 * crack + gap;
                self.position[i] == 0.0 && self.velocity[i] == 0.0
            })
        });
        let going = Going {
            closed: self.closed,
            velocity: &self.velocity,
            piece,
        };
        select(&mut self.reactions, self.modes, &going, &mut self.felt)
    }

    /// Let all corners strike that touch; what that is called in each crack. `None` is a paradox.
    fn strike(&mut self) -> Option<([Option<EventKind>; 2], Impact)> {
        let mut touching = [[false; 2]; 2];
        let mut kinds = [None; 2];
        for crack in 0..2 {
            let near = NEAR * self.stack.blocks[crack].width;
            let mut strikes = [false; 2];
            for (corner, gap) in [3 * crack + HEEL, 3 * crack + TOE].into_iter().enumerate() {
                let (open, speed) = (&mut self.position[gap], self.velocity[gap]);
                if *open <= 0.0 || *open <= near && speed <= self.settle[crack] {
                    *open = 0.0;
                    touching[crack][corner] = true;
                    strikes[corner] = speed < 0.0;
                    let fastest = &mut self.summaries[crack].largest_impact_velocity;
                    *fastest = fastest.max(-speed);
                }
            }
            kinds[crack] = match strikes {
                [true, true] => Some(EventKind::BothStrike),
                [true, false] => Some(EventKind::HeelStrikes),
                [false, true] => Some(EventKind::ToeStrikes),
                [false, false] => None,
            };
            self.summaries[crack].impacts += u64::from(kinds[crack].is_some());
        }
        let approach = Approach {
            stack: self.stack,
            before: self.velocity,
            touching,
        };
        let blow = approach.impact(self.settle)?;
        self.apply(&blow);
        Some((kinds, blow))
    }

    /// Let friction jam where that is asked for, or where a slip is too slow to matter.
    fn jam(&mut self) -> Option<Impact> {
        let slips = [0, 1].map(|crack| self.velocity[3 * crack + SLIP].abs());
        let crawls = [0, 1].map(|crack| slips[crack] < CRAWL * self.settle[crack]);
        let may = [0, 1].map(|crack| slips[crack] > 0.0 && (self.options.jam || crawls[crack]));
        let approach = Approach {
            stack: self.stack,
            before: self.velocity,
            touching: self.closed,
        };
        let tried = [[may[0], false], [false, may[1]], may];
        let mut jams = tried.into_iter().filter(|jams| *jams != [false, false]);
        let (jams, stop) = jams.find_map(|jams| approach.jam(jams).map(|stop| (jams, stop)))?;
        self.apply(&stop);
        for crack in 0..2 {
            self.summaries[crack].jams += u64::from(jams[crack] && !crawls[crack]);
        }
        Some(stop)
    }

    fn apply(&mut self, blow: &Impact) {
        self.velocity = blow.velocity;
        for crack in 0..2 {
            self.books[crack].strike(blow.energy_lost[crack]);
            let pushed = part(&blow.impulse, crack) != [0.0; 3];
            self.summaries[crack].energy_limited += u64::from(blow.energy_limited && pushed);
        }
    }

    /// The next moment that is wanted, if it comes before `until`.
    pub(super) fn next_moment(&self, until: f64) -> Option<f64> {
        let next = self.wanted.times.get(self.moments[0].len()).copied();
        next.filter(|time| *time < until)
    }

    fn end(self) -> StackRun {
        let kinetic_energy = self.stack.kinetic_energy(&self.velocity);
        let [a, b] = self.books;
        let ledger = Ledger {
            start: 0.0,
            input: a.input + b.input,
            friction: a.friction + b.friction,
            impact: a.impact + b.impact,
            turnover: a.turnover + b.turnover,
        };
        let lost = [a, b].map(|book| [book.friction, book.impact]);
        let (position, velocity) = (self.position, self.velocity);
        let mut crack = 0;
        let told = self.moments.into_iter().zip(self.events);
        let mut runs = self
            .summaries
            .into_iter()
            .zip(told)
            .map(|(summary, (moments, events))| {
                let of = crack;
                crack += 1;
                Run {
                    summary: Summary {
                        outcome: self.outcome,
                        end_time: self.time,
                        mode: self.modes[of],
                        position: part(&position, of),
                        velocity: part(&velocity, of),
                        ledger,
                        kinetic_energy,
                        ..summary
                    },
                    moments,
                    events,
                    tensions: Vec::new(),
                    worn: None,
                    rough: None,
                }
            });
        let cracks = std::array::from_fn(|_| runs.next().expect("two cracks"));
        StackRun {
            cracks,
            tilts: self.tilts,
            lost,
        }
    }
}
