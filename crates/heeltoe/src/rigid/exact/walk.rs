//! From piece to piece of the record, and from event to event within each.

use std::borrow::Cow;
use std::cell::OnceCell;

use super::super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::super::choice::{accelerations, select, Moving};
use super::super::course::Course;
use super::super::mode::Mode;
use super::super::reaction::{Felt, ReactionsOf};
use super::super::result::{Outcome, Run, Wear};
use super::super::shaking::{Limits, Piece, Shaking};
use super::super::walk::{Ended, Exactly, Options, Single, Walk, Wanted};
use super::stretch::Stretch;
use crate::friction::Worn;

/// A block that is carried exactly; its state is in the summary.
pub(super) struct Exact<'a> {
    pub(super) walk: Walk<'a>,
    pub(super) reactions: &'a ReactionsOf<'a>,
    /// What is felt in the present mode on the present piece.
    pub(super) felt: Felt,
    /// Which corners lie at its start.
    pub(super) touching: [bool; 2],
    /// What the crack has been through, where it is kept.
    pub(super) wear: Option<Wear>,
    /// Rest, or a slide, that goes on.
    pub(super) stretch: Stretch,
    /// How far the ground may go while it rests.
    pub(super) limits_of_rest: OnceCell<Limits>,
}

/// Where the block is when something may happen to it: how far behind which sample, and what ended the way there.
pub(super) struct Halt {
    pub k: usize,
    pub local: f64,
    pub cause: Option<Ended>,
}

impl Halt {
    pub(super) fn at(k: usize) -> Self {
        Halt {
            k,
            local: 0.0,
            cause: None,
        }
    }
}

/// Run one block through one motion.
///
/// `start` gives contact coordinates and their velocities at the first sample; without it the block stands still in
/// contact and must be able to do so under its static loads.
pub fn simulate(
    block: &Block,
    shaking: &Shaking,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    walk(block, shaking, start, options, wanted, None)
}

/// The same with the length of the path of its slip kept.
pub(in super::super) fn simulate_with_path(
    block: &Block,
    shaking: &Shaking,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    let wear = Wear {
        kept: Vec::new(),
        end: Worn::FRESH,
        error: 0.0,
        integrated: 0.0,
    };
    walk(block, shaking, start, options, wanted, Some(wear))
}

fn walk(
    block: &Block,
    shaking: &Shaking,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
    wear: Option<Wear>,
) -> Run {
    let block = &block.under(block.inertia_force(shaking.peaks()));
    let reactions = ReactionsOf::new(block);
    let from = start.unwrap_or([[0.0; 3]; 2]);
    let mut exact = Exact {
        walk: Walk::new(block, shaking.time[0], from, options, wanted),
        reactions: &reactions,
        felt: Felt::default(),
        touching: [false; 2],
        wear,
        stretch: Stretch::default(),
        limits_of_rest: OnceCell::new(),
    };
    if start.is_none() && !exact.rests(&Piece::still(1.0)) {
        exact.walk.summary.outcome = Outcome::Unstable;
    } else {
        exact.run(shaking, 0);
    }
    exact.end()
}

/// Go on from a sample with a block whose friction has come to a constant; its crack slips, and lifts, as before.
pub(in super::super) fn go_on(walk: Walk, shaking: &Shaking, from: usize, wear: Option<Wear>) -> Run {
    let reactions = ReactionsOf::new(walk.block);
    let mut exact = Exact {
        walk,
        reactions: &reactions,
        felt: Felt::default(),
        touching: [false; 2],
        wear,
        stretch: Stretch::default(),
        limits_of_rest: OnceCell::new(),
    };
    exact.run(shaking, from);
    exact.end()
}

impl Exact<'_> {
    /// Hand over what there is to tell.
    fn end(mut self) -> Run {
        self.close(self.walk.summary.end_time);
        let energy = self.walk.block.kinetic_energy(&self.walk.summary.velocity);
        Run {
            worn: self.wear,
            ..self.walk.end(energy, Vec::new())
        }
    }

    /// From a sample to the end of the record.
    fn run(&mut self, shaking: &Shaking, from: usize) {
        let n = shaking.time.len();
        let mut k = from;
        // Whether the present mode was chosen by the state as it is now.
        let mut settled = false;
        let glides = self.walk.summarises() && self.wear.is_none();
        while k + 1 < n {
            let (mut local, mut cause): (f64, Option<Ended>) = (0.0, None);
            if settled {
                let halt = if glides {
                    self.glide(shaking, k)
                } else {
                    Some(Halt::at(self.pass(shaking, k)))
                };
                let Some(halt) = halt else {
                    return;
                };
                Halt { k, local, cause } = halt;
                if k + 1 >= n {
                    break;
                }
            }
            let start = shaking.time[k];
            let Some(whole) = shaking.pieces(k).next() else {
                break;
            };
            k += 1;
            if whole.left <= 0.0 {
                continue;
            }
            if self.walk.stopped() {
                return;
            }
            if !self.cross_from(&whole, start, local, cause) {
                return;
            }
            settled = true;
        }
        self.walk.summary.end_time = shaking.time[n - 1];
        self.walk.summary.mode = self.walk.mode;
        self.record_end(shaking);
    }

    /// Keep the block at the moments that are left, all of them at the end.
    fn record_end(&mut self, shaking: &Shaking) {
        if !self.walk.observed() {
            return;
        }
        let piece = Piece {
            ground: shaking.at(shaking.last()),
            ..Piece::still(0.0)
        };
        let reaction = self.reactions.of(self.walk.mode);
        let mut felt = Felt::default();
        reaction.on(&piece, &mut felt);
        let course = Course {
            motion: accelerations(reaction, &felt, [0.0; 3], 0.0),
            felt,
            piece: &piece,
        };
        self.record(&course, f64::INFINITY, self.walk.summary.end_time);
    }

    fn rests(&self, piece: &Piece<2>) -> bool {
        let moving = Moving {
            closed: [true, true],
            velocity: 0.0,
            piece,
        };
        select(self.reactions, Mode::Rest, &moving, &mut Felt::default()) == Some(Mode::Rest)
    }
}

impl<'a> Single<'a> for Exact<'a> {
    type Piece = Piece<2>;

    fn walk(&mut self) -> &mut Walk<'a> {
        &mut self.walk
    }

    fn velocity(&self) -> Vector {
        self.walk.summary.velocity
    }

    fn closed(&self) -> [bool; 2] {
        let s = &self.walk.summary;
        [HEEL, TOE].map(|gap| s.position[gap] == 0.0 && s.velocity[gap] == 0.0)
    }

    fn block(&self) -> Cow<'_, Block> {
        Cow::Borrowed(self.walk.block)
    }

    fn pick(&mut self, piece: &Piece<2>) -> Option<Mode> {
        self.touching = self.closed();
        let moving = Moving {
            closed: self.touching,
            velocity: self.walk.summary.velocity[SLIP],
            piece,
        };
        select(self.reactions, self.walk.mode, &moving, &mut self.felt)
    }

    /// Both gaps may have closed: corners nearer than rounding strike together.
    fn land(&mut self, _gap: usize) -> [bool; 2] {
        self.walk.land()
    }

    fn set_velocity(&mut self, velocity: &Vector) {
        self.walk.summary.velocity = *velocity;
    }

    fn begin(&mut self) {
        let lies = self.walk.mode.contacts() == [true, true];
        if let Some(wear) = &mut self.wear {
            wear.end.bonded &= lies;
        }
        self.turn_over(self.walk.summary.end_time);
    }
}

impl<'a> Exactly<'a, 1, 2> for Exact<'a> {
    #[inline(always)]
    fn advance(&mut self, piece: &Piece<2>, time: f64) -> (f64, Option<Ended>) {
        self.move_to_event(piece, time)
    }
}
