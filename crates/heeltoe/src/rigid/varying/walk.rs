//! From sample to sample of the record, and from event to event within each piece.

use std::cell::{Cell, OnceCell};
use std::rc::Rc;

use super::super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::super::choice::{accelerations, select, Modes, Moving};
use super::super::exact;
use super::super::mode::{Corner, Mode, Slip};
use super::super::reaction::{Felt, Reactions};
use super::super::result::{Outcome, Run};
use super::super::shaking::Piece as Level;
use super::super::walk::{Carried, Cause, Options, Single, Walk, Wanted};
use super::block::{Rotation, TurningBlock};
use super::instant::{Instant, Still};
use super::line::{Flat, Line};
use super::ready::Ready;
use super::rough::Rough;
use super::rubbing::{Gathered, Rubbing};
use super::shaking::{level, Ground, Piece, TurningShaking};
use super::step::{State, SIZE};
use crate::asperity::Asperities;
use crate::friction::{Law, Worn};
use crate::inside::Borne;

/// Relative error allowed in a step, of lengths of the crack's width and of velocities of sqrt(g B).
const TOLERANCE: f64 = 1e-12;
/// The choice of the next mode takes accelerations as linear in time; their rate enters through a ground that passes so
/// many seconds in one, so that it has no part in the sizes by which rounding is judged.
const UNIT: f64 = 1e-9;
/// A moving block's accelerations change with its motion, too: their rate is taken over at most this part of the time in
/// which the block moves by its own size.
const AHEAD: f64 = 1e-4;
/// Where what was chosen ended at once, something bends within that time: the next look is so much shorter.
const NEARER: f64 = 0.1;
/// The shortest look of all is this power of it: nearer there is rounding only.
const NEAREST: u32 = 6;

/// A block that is carried by integration.
pub(super) struct Varying<'a> {
    pub(super) walk: Walk<'a>,
    pub(super) turning: &'a TurningBlock,
    pub(super) scale: State,
    pub(super) corner: Corner,
    pub(super) state: State,
    /// Time in which the block moves by its own size (s), by which short is told from long.
    pub(super) time_scale: f64,
    /// Length that the next step may have.
    pub(super) suggested: f64,
    /// Accelerations of the contact coordinates right after an event, freed from rounding where a motion starts.
    pub(super) starting: Option<Vector>,
    pub(super) anchors: Vec<Borne>,
    /// Of a block at rest, see [`super::rest`]; none until it is asked for.
    pub(super) reserve: Option<[[f64; 4]; 4]>,
    /// Of a block that slides downstream or upstream, see [`super::slide`].
    pub(super) lines: [Cell<Option<Line>>; 2],
    /// The same by any law, see [`super::flat`].
    pub(super) flats: [Cell<Option<Flat>>; 2],
    /// The block on a rough crack seen from either corner, where its loads and its geometry stay as they are.
    pub(super) stills: [OnceCell<Still>; 2],
    /// The reactions of its modes once nothing changes its friction any more, see [`super::plain`].
    pub(super) settled: OnceCell<Rc<Ready>>,
    pub(super) rubbing: Rubbing<'a>,
    /// Whether friction goes by a law, of which there is something to tell.
    by_law: bool,
    /// Whether its loads and its geometry stay as they are, see [`super::plain`].
    pub(super) plain: bool,
    /// Whether the ground never turns.
    pub(super) level: bool,
    /// Asperities, where the crack is rough.
    pub(super) rough: Option<Rough>,
    pub(super) error: Gathered,
}

/// What the faces of a crack are like, where friction goes by a law, and what they have been through.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    /// Friction along the crack, or along the flanks of its asperities.
    pub law: &'a Law,
    /// How far it has slipped.
    pub worn: Worn,
    /// Its asperities, where it is rough; dilation (m) and plastic work (J/m2) so far.
    pub asperities: Option<(Asperities, [f64; 2])>,
}

/// Run one block through one motion; `start`, `options` and `wanted` are those of [`super::super::exact::simulate`].
pub fn simulate(
    block: &Block,
    turning: &TurningBlock,
    surface: Option<&Surface>,
    shaking: &TurningShaking,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    let [position, velocity] = start.unwrap_or([[0.0; 3]; 2]);
    let constant = Law::coulomb(block.strength().coefficient);
    let (law, worn) = surface.map_or((&constant, Worn::FRESH), |surface| (surface.law, surface.worn));
    let rubbing = Rubbing::new(law, worn, block);
    let rough = surface.and_then(|surface| surface.asperities);
    let scale = turning.force_scale(shaking.peaks());
    let block = &block.under(scale.max(rubbing.bond()));
    let speed = (block.acceleration_scale() * block.width).sqrt();
    let allowed = |size: f64| TOLERANCE * size;
    let (length, turn) = (allowed(block.width), allowed(1.0));
    let (fast, spin) = (allowed(speed), allowed(speed / block.width));
    let any = f64::INFINITY;
    let mut varying = Varying {
        walk: Walk::new(
            block,
            shaking.level.time[0],
            [position, velocity],
            options,
            wanted,
        ),
        turning,
        scale: [length, length, turn, fast, fast, spin, any, any, any],
        time_scale: block.width / speed,
        corner: if position[TOE] < position[HEEL] {
            Corner::Toe
        } else {
            Corner::Heel
        },
        state: [0.0; SIZE],
        suggested: any,
        starting: None,
        anchors: turning
            .anchors
            .iter()
            .map(|anchor| Borne::new(anchor, shaking.level.time[0]))
            .collect(),
        reserve: None,
        lines: Default::default(),
        flats: Default::default(),
        stills: Default::default(),
        settled: OnceCell::new(),
        rubbing,
        by_law: surface.is_some(),
        plain: turning.stays(shaking),
        level: shaking.is_level(),
        rough: rough.map(|(asperities, before)| Rough::new(asperities, before, position[SLIP], block.width)),
        error: Gathered::default(),
    };
    varying.place(&position, &velocity);
    let theta = varying.state[2];
    varying.walk.summary.rotation_range = [theta.min(0.0), theta.max(0.0)];
    varying.walk.summary.ledger.start = varying.kinetic_energy();
    varying.strain(shaking.level.time[0]);
    match varying.run(shaking, start.is_none()) {
        Some(from) => varying.go_on_exactly(shaking, from),
        None => {
            varying.see();
            varying.end()
        }
    }
}

impl Varying<'_> {
    /// Hand over what there is to tell.
    fn end(self) -> Run {
        let energy = self.kinetic_energy();
        let worn = self.by_law.then(|| self.rubbing.told(&self.error));
        Run {
            worn,
            rough: self.rough.map(Rough::end),
            ..self.walk.end(energy, self.anchors)
        }
    }

    /// Whether the block is one of the exact walk by now: its loads and its geometry never change, its friction no more,
    /// and there is no error in its velocity that would grow.
    fn is_exact(&self) -> bool {
        self.plain && self.rough.is_none() && self.rubbing.settled() && self.error.speed == 0.0
    }

    /// Leave the rest of the motion to the exact walk.
    fn go_on_exactly(mut self, shaking: &TurningShaking, from: usize) -> Run {
        self.see();
        let strength = self.struck();
        let block = self.walk.block.rubbing(&strength);
        let wear = self.by_law.then(|| self.rubbing.told(&self.error));
        exact::go_on(self.walk.with(&block), &shaking.level, from, wear)
    }

    /// Take over slip, gaps and their velocities.
    fn place(&mut self, position: &Vector, velocity: &Vector) {
        let own = self.corner.gap();
        let ratio = self.walk.block.rotation(position);
        let finite = self.turning.rotation == Rotation::Finite;
        let theta = if finite {
            ratio.clamp(-1.0, 1.0).asin()
        } else {
            ratio
        };
        let cosine = if finite { theta.cos() } else { 1.0 };
        let rate = self.walk.block.rotation(velocity) / cosine;
        self.state = [
            position[SLIP],
            position[own],
            theta,
            velocity[SLIP],
            velocity[own],
            rate,
            0.0,
            0.0,
            0.0,
        ];
    }

    pub(super) fn instant(&self, ground: &Ground) -> Instant {
        self.seen_from(self.corner, &self.state, ground)
    }

    fn kinetic_energy(&self) -> f64 {
        self.instant(&[0.0; 3]).kinetic_energy(&self.state)
    }

    /// Go through the motion; returns the sample from which the exact walk can go on, where there is one.
    fn run(&mut self, shaking: &TurningShaking, stands: bool) -> Option<usize> {
        if stands && self.pick(&Piece::still(1.0)) != Some(Mode::Rest) {
            self.walk.summary.outcome = Outcome::Unstable;
            return None;
        }
        let time = shaking.level.time;
        let mut held = false;
        let mut k = 0;
        while k + 1 < time.len() {
            if self.is_exact() {
                return Some(k);
            }
            let mut local = 0.0;
            if held {
                (k, local) = match self.walk.mode {
                    Mode::Rest => (self.rest_until(shaking, k), 0.0),
                    Mode::Slide(_) => self.slide_until(shaking, k),
                    _ => (k, 0.0),
                };
                if k + 1 >= time.len() {
                    break;
                }
            }
            let (from, t0) = (k, time[k] + local);
            k += 1;
            if time[k] <= t0 {
                continue;
            }
            let whole = shaking.piece(from);
            let whole = whole.rest(local);
            // What ends a motion is watched all the time: it goes on where the ground does.
            let chosen = held && self.walk.mode != Mode::Rest && (local > 0.0 || t0 > time[from - 1]);
            let Ok(cause) = self.cross(&whole, t0, chosen) else {
                return None;
            };
            held = cause.is_none();
            // An event on the very end of the piece belongs to the next.
            let after = Piece {
                ground: shaking.at(k),
                ..Piece::still(1e-9 * whole.left)
            };
            if cause.is_some() && !self.choose(&after, cause.map(|why| (0, why))) {
                return None;
            }
        }
        let end = time.len() - 1;
        self.walk.summary.end_time = time[end];
        let last = Piece {
            ground: shaking.at(shaking.level.last()),
            ..Piece::still(0.0)
        };
        let state = self.state;
        self.record(&state, &last, f64::INFINITY, time[end]);
        None
    }

    /// Go from event to event to the end of a piece that begins at `time`, in the present mode if that has been `chosen`
    /// for it, and return what happened at its very end; an error where the run cannot continue.
    fn cross(&mut self, whole: &Piece, time: f64, mut chosen: bool) -> Result<Option<Cause>, ()> {
        let mut local = 0.0;
        let mut cause = None;
        while local < whole.left {
            let piece = whole.rest(local);
            self.walk.summary.end_time = time + local;
            if (cause.is_some() || !chosen) && !self.choose(&piece, cause.map(|why| (0, why))) {
                return Err(());
            }
            chosen = true;
            let (taken, ended) = self.advance(&piece, time + local);
            let moved = local + taken > local;
            local = if taken == piece.left {
                whole.left
            } else {
                local + taken
            };
            self.walk.summary.end_time = time + local;
            if self.lies() {
                self.walk.summary.outcome = Outcome::Overturned;
                return Err(());
            }
            cause = ended;
            if cause.is_some() && !self.count(moved) || self.walk.stopped() {
                return Err(());
            }
        }
        Ok(cause)
    }

    /// Whether the block has turned onto its side.
    fn lies(&self) -> bool {
        self.turning.rotation != Rotation::Small && self.state[2].abs() >= std::f64::consts::FRAC_PI_2
    }

    /// The block as it is now, and how its free accelerations change as it and the ground go on.
    fn ahead(&self, piece: &Piece, now: &Instant) -> Block {
        let still = self.state[3..6] == [0.0; 3];
        let far = if still {
            piece.left
        } else {
            piece.left.min(AHEAD * self.time_scale)
        };
        let ahead = far * NEARER.powi((self.walk.standing % (NEAREST + 1)) as i32);
        let mut later = self.state;
        for (value, rate) in later.iter_mut().zip(self.rates(&self.state, &piece.ground)) {
            *value += ahead * rate;
        }
        let then = self.seen_from(self.corner, &later, &piece.after(ahead));
        // Where modes are at a tie they share their reactions, by which the compliance changes the accelerations, too.
        let (reactions, _) = self.reactions(&self.state, now);
        let pull = self.changed_pull(&reactions, &later);
        let affine = [SLIP, HEEL, TOE].map(|i| {
            let stiffer: f64 = (0..3)
                .map(|k| (then.compliance[i][k] - now.compliance[i][k]) * reactions[k])
                .sum();
            let stiffer = stiffer + now.compliance[i][SLIP] * pull;
            Affine {
                constant: now.free_acceleration[i],
                horizontal: (then.free_acceleration[i] - now.free_acceleration[i] + stiffer) / ahead * UNIT,
                vertical: 0.0,
            }
        });
        self.walk.block.at(now.compliance, affine)
    }

    /// The reactions of all modes as the block is now.
    pub(super) fn reactions_ahead(&self, piece: &Piece) -> Reactions {
        let now = self.instant(&piece.ground);
        let ahead = self.ahead(piece, &now);
        Reactions::each(&ahead, |mode| {
            let (_, strength) = self.rubbed(mode, &self.state, &now)?;
            Some(ahead.rubbing(&strength))
        })
    }

    /// The mode in which the block can go on with its bond as it is.
    pub(super) fn chosen(&mut self, piece: &Piece) -> Option<Mode> {
        if self.rough.is_none() && self.closed() == [false; 2] {
            let [[a, b, c], _] = self.turning.flight(self.corner, &self.state, &piece.ground);
            let rate = [0.0, 0.0, 0.0, a, b, c, 0.0, 0.0, 0.0];
            let starting = self.turning.contact_acceleration(self.corner, &self.state, &rate);
            self.starting = Some(starting);
            return Some(Mode::Drift);
        }
        if let Some((reactions, upstream)) = self.ready(piece) {
            return self.choose_among(&*reactions, upstream, &level(piece));
        }
        let level = Level {
            ground: [0.0; 2],
            rate: [1.0 / UNIT, 0.0],
            left: piece.left,
        };
        if self.rough.is_none() && self.rubbing.settled() {
            let ahead = self.ahead(piece, &self.instant(&piece.ground));
            let block = ahead.rubbing(&self.strength(Mode::Rest, 0.0, &self.state));
            return self.choose_among(&Ready::new([block.clone(), block], None), false, &level);
        }
        let (reactions, upstream) = self.reactions_about(piece);
        self.choose_among(&reactions, upstream, &level)
    }

    /// The first of the modes in which it can go on; what it starts with is kept.
    fn choose_among(&mut self, reactions: &impl Modes, upstream: bool, piece: &Level<2>) -> Option<Mode> {
        let closed = self.closed();
        let slip = self.velocity()[SLIP];
        let moving = Moving {
            closed,
            velocity: slip,
            piece,
        };
        let mut felt = Felt::default();
        let mode = select(reactions, self.walk.mode, &moving, &mut felt)?;
        self.take_side(mode, upstream);
        let starts = [
            if slip == 0.0 {
                mode.slip().map_or(0.0, Slip::sign)
            } else {
                0.0
            },
            f64::from(closed[0]),
            f64::from(closed[1]),
        ];
        let first = accelerations(reactions.of(mode), &felt, starts, piece.left).map(|[value, _]| value);
        self.starting = Some(first);
        Some(mode)
    }

    /// Go over to the other corner, which is in contact: its gap is exactly zero.
    pub(super) fn turn_to(&mut self, corner: Corner) {
        self.state = self.turning.other_corner(self.corner, &self.state);
        self.corner = corner;
        if self.state[1].abs() <= self.walk.near() {
            self.state[1] = 0.0;
        }
    }
}
