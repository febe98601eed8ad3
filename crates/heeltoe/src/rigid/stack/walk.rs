//! From event to event, as one block goes by [`super::super::walk`].

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::ledger::Ledger;
use super::super::mode::Mode;
use super::super::reaction::Felt;
use super::super::result::{EventKind, Outcome, Run};
use super::super::shaking::{Piece, Shaking};
use super::super::walk::{Blow, Carried, Ended, Exactly, Options, Walk, Wanted, CRAWL};
use super::blocks::{part, Stack};
use super::choice::{select, Going};
use super::impact::{Approach, Corners, Impact};
use super::reaction::{Modes, Reactions};
use super::solve::Six;

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

/// Two blocks that are carried exactly.
pub(super) struct Blocks<'a> {
    pub stack: &'a Stack,
    /// What is known of the lower and of the upper crack; where the blocks are is copied there at events.
    pub walks: [Walk<'a>; 2],
    pub reactions: Reactions<'a>,
    pub felt: [Felt; 2],
    pub position: Six,
    pub velocity: Six,
    pub closed: Corners,
    pub books: [Ledger; 2],
    pub tilts: [[f64; 2]; 2],
}

/// Run two blocks, which stand still at first, through one motion. An event counts for the crack in which it happens and
/// for one whose mode it changes.
pub fn simulate(stack: &Stack, shaking: &Shaking, options: Options, wanted: Wanted) -> StackRun {
    let stack = &stack.under(shaking.peaks());
    let start = shaking.time[0];
    let begun = |crack: usize| Walk::new(&stack.blocks[crack], start, [[0.0; 3]; 2], options, wanted);
    let mut blocks = Blocks {
        stack,
        walks: [begun(0), begun(1)],
        reactions: Reactions::new(stack),
        felt: [Felt::default(); 2],
        position: [0.0; 6],
        velocity: [0.0; 6],
        closed: [[true; 2]; 2],
        books: [Ledger::default(); 2],
        tilts: [[0.0; 2]; 2],
    };
    blocks.run(shaking);
    blocks.end()
}

impl Blocks<'_> {
    fn run(&mut self, shaking: &Shaking) {
        if self.find_modes(&Piece::still(1.0)) != Some([Mode::Rest; 2]) {
            self.give_up(Outcome::Unstable);
            return;
        }
        for (k, whole) in shaking.pieces(0).enumerate() {
            if whole.left <= 0.0 {
                continue;
            }
            if self.walks[0].stopped() || !self.cross(&whole, shaking.time[k]) {
                return;
            }
        }
        let end = shaking.time[shaking.time.len() - 1];
        self.set_time(end);
        let piece = Piece {
            ground: shaking.at(shaking.last()),
            ..Piece::still(0.0)
        };
        if self.walks[0].next_moment(f64::INFINITY).is_some() && self.find_modes(&piece).is_some() {
            let courses = self.courses(&piece);
            self.record(&courses, f64::INFINITY, end);
        }
    }

    pub(super) fn modes(&self) -> Modes {
        self.walks.each_ref().map(|walk| walk.mode)
    }

    fn apply(&mut self, blow: &Impact) {
        self.velocity = blow.velocity;
        for (crack, walk) in self.walks.iter_mut().enumerate() {
            self.books[crack].strike(blow.energy_lost[crack]);
            let pushed = part(&blow.impulse, crack) != [0.0; 3];
            walk.summary.energy_limited += u64::from(blow.energy_limited && pushed);
        }
    }

    fn end(mut self) -> StackRun {
        self.enter();
        let kinetic_energy = self.stack.kinetic_energy(&self.velocity);
        let [a, b] = self.books;
        let ledger = Ledger {
            start: 0.0,
            input: a.input + b.input,
            friction: a.friction + b.friction,
            impact: a.impact + b.impact,
            turnover: a.turnover + b.turnover,
        };
        StackRun {
            cracks: self.walks.map(|mut walk| {
                walk.summary.ledger = ledger;
                walk.end(kinetic_energy, Vec::new())
            }),
            tilts: self.tilts,
            lost: [a, b].map(|book| [book.friction, book.impact]),
        }
    }
}

/// What an impact has done in each crack.
fn told(kinds: [Option<EventKind>; 2], impact: &Impact) -> Blow<2> {
    Blow {
        kinds,
        impulse: [0, 1].map(|crack| part(&impact.impulse, crack)),
        energy_lost: impact.energy_lost,
    }
}

impl<'a> Carried<'a, 2> for Blocks<'a> {
    type Piece = Piece<2>;

    fn walks(&mut self) -> &mut [Walk<'a>; 2] {
        &mut self.walks
    }

    fn velocities(&self) -> [Vector; 2] {
        [0, 1].map(|crack| part(&self.velocity, crack))
    }

    fn enter(&mut self) {
        for (crack, walk) in self.walks.iter_mut().enumerate() {
            walk.summary.position = part(&self.position, crack);
            walk.summary.velocity = part(&self.velocity, crack);
        }
    }

    fn find_modes(&mut self, piece: &Piece<2>) -> Option<Modes> {
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
        let present = self.modes();
        select(&mut self.reactions, present, &going, &mut self.felt)
    }

    /// All corners that touch strike.
    fn collide(&mut self, _gap: usize) -> Option<Blow<2>> {
        let mut touching = [[false; 2]; 2];
        let mut kinds = [None; 2];
        for (crack, walk) in self.walks.iter_mut().enumerate() {
            let mut strikes = [false; 2];
            for (corner, gap) in [3 * crack + HEEL, 3 * crack + TOE].into_iter().enumerate() {
                let speed = self.velocity[gap];
                if walk.touches(self.position[gap], speed) {
                    self.position[gap] = 0.0;
                    touching[crack][corner] = true;
                    strikes[corner] = speed < 0.0;
                    let fastest = &mut walk.summary.largest_impact_velocity;
                    *fastest = fastest.max(-speed);
                }
            }
            kinds[crack] = match strikes {
                [true, true] => Some(EventKind::BothStrike),
                [true, false] => Some(EventKind::HeelStrikes),
                [false, true] => Some(EventKind::ToeStrikes),
                [false, false] => None,
            };
            walk.summary.impacts += u64::from(kinds[crack].is_some());
        }
        let approach = Approach {
            stack: self.stack,
            before: self.velocity,
            touching,
        };
        let blow = approach.impact(self.walks.each_ref().map(|walk| walk.settle))?;
        self.apply(&blow);
        Some(told(kinds, &blow))
    }

    fn seize(&mut self) -> Option<Blow<2>> {
        let slips = [0, 1].map(|crack| self.velocity[3 * crack + SLIP].abs());
        let crawls = [0, 1].map(|crack| slips[crack] < CRAWL * self.walks[crack].settle);
        let jam = self.walks[0].options.jam;
        let may = [0, 1].map(|crack| slips[crack] > 0.0 && (jam || crawls[crack]));
        let approach = Approach {
            stack: self.stack,
            before: self.velocity,
            touching: self.closed,
        };
        let tried = [[may[0], false], [false, may[1]], may];
        let mut jams = tried.into_iter().filter(|jams| *jams != [false, false]);
        let (jams, stop) = jams.find_map(|jams| approach.jam(jams).map(|stop| (jams, stop)))?;
        self.apply(&stop);
        for (crack, walk) in self.walks.iter_mut().enumerate() {
            walk.summary.jams += u64::from(jams[crack] && !crawls[crack]);
        }
        Some(told([Some(EventKind::Jams); 2], &stop))
    }
}

impl<'a> Exactly<'a, 2, 2> for Blocks<'a> {
    fn advance(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Ended>) {
        self.move_to_event(piece, time)
    }
}
