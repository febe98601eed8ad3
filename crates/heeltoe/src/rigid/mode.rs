//! The five modes of motion, their reactions, and which of them is admissible.
//!
//! | mode | contact | reactions from |
//! | --- | --- | --- |
//! | rest | both corners, stick | `w'' = 0` in all three |
//! | slide | both, slip of sign S | both gaps `w'' = 0`, `T = -mu_k S (N_h + N_t)` |
//! | rock on heel / toe | one, stick | its gap and the slip `w'' = 0` |
//! | slide-rock on heel / toe | one, slip of sign S | its gap `w'' = 0`, `T = -mu_k S N` |
//! | drift | none | none |
//!
//! In each mode reactions and accelerations are linear in the loads, hence affine in the ground acceleration: they
//! are worked out once per block, and a piece of the record costs a handful of multiplications.

use super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};

// The next three are relative to the size of the terms that make up a quantity, see [`Reaction`]. They are thus
// changes of the loads and mean the same for every condition: the one that ends a mode and the one that admits its
// successor agree.

/// Below this a value counts as zero and the sign of its slope decides.
const TIE: f64 = 1e-13;
/// A condition counts as violated within a piece only if it falls below this. It is far above [`TIE`], so that where an
/// event is seen the slopes that decide what follows are told from rounding.
pub const VIOLATION: f64 = 1e-10;
/// Last resort where rounding makes every mode look inadmissible by a hair, as under ground accelerations a thousand
/// times the loads, by which sizes are not measured.
const HAIR: f64 = 1e-9;
/// A contact that friction leaves with less than this share of its resistance to being pushed in is Painlevé's.
const SINGULAR: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    Heel,
    Toe,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    Downstream,
    Upstream,
}

impl Slip {
    pub fn sign(self) -> f64 {
        match self {
            Slip::Downstream => 1.0,
            Slip::Upstream => -1.0,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Rest,
    Slide(Slip),
    Rock(Corner),
    SlideRock(Corner, Slip),
    Drift,
}

use Corner::{Heel, Toe};
use Slip::{Downstream, Upstream};

impl Mode {
    /// All modes; where two are admissible at once the earlier one is taken. Stick comes before slip, contact
    /// before lift-off.
    pub const ALL: [Mode; 9] = [
        Mode::Rest,
        Mode::Rock(Heel),
        Mode::Rock(Toe),
        Mode::Slide(Downstream),
        Mode::Slide(Upstream),
        Mode::SlideRock(Heel, Downstream),
        Mode::SlideRock(Heel, Upstream),
        Mode::SlideRock(Toe, Downstream),
        Mode::SlideRock(Toe, Upstream),
    ];
    pub const COUNT: usize = 10;

    /// Number under which the mode leaves the kernel.
    pub fn index(self) -> usize {
        match self {
            Mode::Rest => 0,
            Mode::Rock(Heel) => 1,
            Mode::Rock(Toe) => 2,
            Mode::Slide(Downstream) => 3,
            Mode::Slide(Upstream) => 4,
            Mode::SlideRock(Heel, Downstream) => 5,
            Mode::SlideRock(Heel, Upstream) => 6,
            Mode::SlideRock(Toe, Downstream) => 7,
            Mode::SlideRock(Toe, Upstream) => 8,
            Mode::Drift => 9,
        }
    }

    pub const NAMES: [&'static str; 10] = [
        "rest",
        "rock on heel",
        "rock on toe",
        "slide downstream",
        "slide upstream",
        "slide-rock on heel downstream",
        "slide-rock on heel upstream",
        "slide-rock on toe downstream",
        "slide-rock on toe upstream",
        "drift",
    ];

    /// Which of the five kinds it is: rest, slide, rock, slide-rock, drift.
    pub fn kind(self) -> usize {
        match self {
            Mode::Rest => 0,
            Mode::Slide(_) => 1,
            Mode::Rock(_) => 2,
            Mode::SlideRock(..) => 3,
            Mode::Drift => 4,
        }
    }

    /// Whether (heel, toe) are held in contact.
    pub fn contacts(self) -> [bool; 2] {
        match self {
            Mode::Rest | Mode::Slide(_) => [true, true],
            Mode::Rock(c) | Mode::SlideRock(c, _) => [c == Heel, c == Toe],
            Mode::Drift => [false, false],
        }
    }

    pub fn slip(self) -> Option<Slip> {
        match self {
            Mode::Slide(s) | Mode::SlideRock(_, s) => Some(s),
            _ => None,
        }
    }

    pub fn sticks(self) -> bool {
        matches!(self, Mode::Rest | Mode::Rock(_))
    }
}

/// Reactions and accelerations of one mode, affine in the ground acceleration.
///
/// Each is a sum of terms, one per load, and where it vanishes what remains of it is the rounding of those terms. Close
/// to Painlevé's paradox, where friction all but pulls the contact in, the terms are larger than the loads by any
/// factor, and so is their rounding. Hence each comes with the size of its terms under the static loads and a ground
/// acceleration like theirs, taken as no less than that of the loads.
#[derive(Clone, Copy, Debug)]
pub struct Reaction {
    /// False where the mode's own equations are singular or push the contact apart with a positive force (Painlevé).
    pub regular: bool,
    /// Friction (downstream), normal force at the heel, at the toe.
    pub force: [Affine; 3],
    pub force_size: [f64; 3],
    /// Accelerations of slip, heel gap, toe gap; exactly zero where the mode holds them.
    pub acceleration: [Affine; 3],
    pub acceleration_size: [f64; 3],
    /// What is left of the friction cone downstream and upstream, `mu_s (N_h + N_t) -/+ T`.
    pub cone: [Affine; 2],
    pub cone_size: f64,
}

/// Reactions of a mode to the free acceleration `b`, or `None` where the equations are singular or Painlevé's.
pub fn reaction_to(a: &[Vector; 3], friction_kinetic: f64, mode: Mode, b: &Vector) -> Option<Vector> {
    let load = |i: usize| b[i];
    let determinant = |m: [[f64; 2]; 2]| m[0][0] * m[1][1] - m[0][1] * m[1][0];
    let solve2 = |i: usize, k: usize, m: [[f64; 2]; 2]| -> [f64; 2] {
        let det = determinant(m);
        [
            (-load(i) * m[1][1] + load(k) * m[0][1]) / det,
            (-load(k) * m[0][0] + load(i) * m[1][0]) / det,
        ]
    };
    let mut force = [0.0; 3];
    match mode {
        Mode::Drift => {}
        Mode::Rest => {
            // Solve A f = -b by Cramer's rule; A is positive definite.
            let cofactor = |r: usize, c: usize| {
                let (r1, r2) = ((r + 1) % 3, (r + 2) % 3);
                let (c1, c2) = ((c + 1) % 3, (c + 2) % 3);
                a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1]
            };
            let det: f64 = (0..3).map(|c| a[0][c] * cofactor(0, c)).sum();
            for (i, f) in force.iter_mut().enumerate() {
                *f = -(0..3).map(|column| cofactor(column, i) * b[column]).sum::<f64>() / det;
            }
        }
        Mode::Slide(slip) => {
            let t = -friction_kinetic * slip.sign();
            let n = |r: usize, c: usize| a[r][c] + t * a[r][SLIP];
            let m = [[n(HEEL, HEEL), n(HEEL, TOE)], [n(TOE, HEEL), n(TOE, TOE)]];
            let smooth = [[a[HEEL][HEEL], a[HEEL][TOE]], [a[TOE][HEEL], a[TOE][TOE]]];
            if determinant(m) <= SINGULAR * determinant(smooth) {
                return None;
            }
            let normal = solve2(HEEL, TOE, m);
            force = [t * (normal[0] + normal[1]), normal[0], normal[1]];
        }
        Mode::Rock(corner) => {
            let i = corner_index(corner);
            let m = [[a[SLIP][SLIP], a[SLIP][i]], [a[i][SLIP], a[i][i]]];
            let [t, n] = solve2(SLIP, i, m);
            force[SLIP] = t;
            force[i] = n;
        }
        Mode::SlideRock(corner, slip) => {
            let i = corner_index(corner);
            let t = -friction_kinetic * slip.sign();
            let stiffness = a[i][i] + t * a[i][SLIP];
            if stiffness <= SINGULAR * a[i][i] {
                return None;
            }
            let n = -load(i) / stiffness;
            force[SLIP] = t * n;
            force[i] = n;
        }
    }
    Some(force)
}

pub fn corner_index(corner: Corner) -> usize {
    match corner {
        Heel => HEEL,
        Toe => TOE,
    }
}

impl Reaction {
    fn new(block: &Block, mode: Mode) -> Self {
        let free = &block.free_acceleration;
        let (forces, accelerations) = (block.force_scale, block.acceleration_scale());
        let size = |q: &Affine| q.constant.abs() + accelerations * (q.horizontal.abs() + q.vertical.abs());
        let mut reaction = Reaction {
            regular: true,
            force: [Affine::default(); 3],
            force_size: [0.0; 3],
            acceleration: *free,
            acceleration_size: free.map(|q| size(&q)),
            cone: [Affine::default(); 2],
            cone_size: 0.0,
        };
        for (column, load) in free.iter().enumerate() {
            let mut one = [0.0; 3];
            one[column] = 1.0;
            let Some(unit) = reaction_to(&block.compliance, block.friction_kinetic, mode, &one) else {
                reaction.regular = false;
                return reaction;
            };
            for i in 0..3 {
                let from = |k: f64, to: &mut Affine, terms: &mut f64| {
                    to.constant += k * load.constant;
                    to.horizontal += k * load.horizontal;
                    to.vertical += k * load.vertical;
                    *terms += k.abs() * size(load);
                };
                from(unit[i], &mut reaction.force[i], &mut reaction.force_size[i]);
                let coupling: f64 = (0..3).map(|k| block.compliance[i][k] * unit[k]).sum();
                from(
                    coupling,
                    &mut reaction.acceleration[i],
                    &mut reaction.acceleration_size[i],
                );
            }
        }
        reaction.force_size = reaction.force_size.map(|terms| terms.max(forces));
        reaction.acceleration_size = reaction.acceleration_size.map(|terms| terms.max(accelerations));
        reaction.cone = [1.0, -1.0].map(|direction| cone(block, &reaction.force, direction));
        let [friction, heel, toe] = reaction.force_size;
        reaction.cone_size = block.friction_static * (heel + toe) + friction;
        let held = [mode.sticks(), mode.contacts()[0], mode.contacts()[1]];
        for (acceleration, held) in reaction.acceleration.iter_mut().zip(held) {
            if held {
                *acceleration = Affine::default();
            }
        }
        reaction
    }
}

/// The reactions of all modes of one block.
pub struct Reactions([Reaction; Mode::COUNT]);

impl Reactions {
    pub fn new(block: &Block) -> Self {
        let mut table = [Reaction::new(block, Mode::Drift); Mode::COUNT];
        for mode in Mode::ALL {
            table[mode.index()] = Reaction::new(block, mode);
        }
        Reactions(table)
    }

    #[inline]
    pub fn of(&self, mode: Mode) -> &Reaction {
        &self.0[mode.index()]
    }
}

/// Ground acceleration from here to the end of the piece: value, rate of change, time left.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub ground: [f64; 2],
    pub rate: [f64; 2],
    pub left: f64,
}

/// Sign of a quantity at the start of a piece: of its value or, where that is zero to rounding, of its slope.
fn sign(q: Affine, size: f64, piece: &Piece, tie: f64) -> i8 {
    let value = q.at(piece.ground);
    if value.abs() > tie * size {
        return if value > 0.0 { 1 } else { -1 };
    }
    let change = q.slope(piece.rate) * piece.left;
    if change.abs() > tie * size {
        return if change > 0.0 { 1 } else { -1 };
    }
    0
}

/// `mu_s (N_h + N_t) - direction * T`: what is left of the friction cone.
fn cone(block: &Block, force: &[Affine; 3], direction: f64) -> Affine {
    let left = |f: fn(&Affine) -> f64| {
        block.friction_static * (f(&force[HEEL]) + f(&force[TOE])) - direction * f(&force[SLIP])
    };
    Affine {
        constant: left(|q| q.constant),
        horizontal: left(|q| q.horizontal),
        vertical: left(|q| q.vertical),
    }
}

/// Whether the block can move on in `mode` from the contact state at hand.
///
/// `closed` are the corners whose gap and gap velocity are zero; `velocity` is the slip velocity.
fn admissible(
    reaction: &Reaction,
    mode: Mode,
    closed: [bool; 2],
    velocity: f64,
    piece: &Piece,
    tie: f64,
) -> bool {
    let contacts = mode.contacts();
    if (contacts[0] && !closed[0]) || (contacts[1] && !closed[1]) || !reaction.regular {
        return false;
    }
    let (force, acceleration) = (&reaction.force, &reaction.acceleration);
    let (force_size, acceleration_size) = (&reaction.force_size, &reaction.acceleration_size);
    for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
        if contacts[corner] {
            if sign(force[gap], force_size[gap], piece, tie) < 0 {
                return false;
            }
        } else if closed[corner] && sign(acceleration[gap], acceleration_size[gap], piece, tie) < 0 {
            return false;
        }
    }
    match mode {
        Mode::Drift => true,
        Mode::Rest | Mode::Rock(_) => {
            velocity == 0.0
                && reaction
                    .cone
                    .into_iter()
                    .all(|left| sign(left, reaction.cone_size, piece, tie) >= 0)
        }
        Mode::Slide(slip) | Mode::SlideRock(_, slip) => {
            let s = slip.sign();
            if velocity != 0.0 {
                return velocity * s > 0.0;
            }
            // A slip that starts must grow; at the friction limit its acceleration is zero and its slope decides.
            let growth = sign(acceleration[SLIP], acceleration_size[SLIP], piece, tie);
            f64::from(growth) * s > 0.0 || (tie >= HAIR && growth == 0)
        }
    }
}

/// The mode in which the block goes on: the present one if it is still admissible, else the first of [`Mode::ALL`]
/// that is, or drift; `None` is a Painlevé paradox.
pub fn select(
    reactions: &Reactions,
    present: Mode,
    closed: [bool; 2],
    velocity: f64,
    piece: &Piece,
) -> Option<Mode> {
    for tie in [TIE, HAIR] {
        // A base that has come to stand is held by static friction if that can hold it: sticking goes first.
        let goes_on = velocity != 0.0 || present.slip().is_none();
        let mut candidates = goes_on
            .then_some(present)
            .into_iter()
            .chain(Mode::ALL)
            .chain(std::iter::once(Mode::Drift));
        let found =
            candidates.find(|&mode| admissible(reactions.of(mode), mode, closed, velocity, piece, tie));
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Acceleration and its slope of each contact coordinate on a piece. `starts` has the way, 1 or -1, in which a
/// coordinate starts to move in this very moment, and 0 for the others. What starts has its rounding removed, and that
/// against its way up to the hair by which [`select`] may have let it: it must not end the moment it begins.
pub fn accelerations(reaction: &Reaction, starts: [f64; 3], piece: &Piece) -> [[f64; 2]; 3] {
    let mut result = [[0.0; 2]; 3];
    for i in 0..3 {
        let size = reaction.acceleration_size[i];
        let nothing = |value: f64, way: f64| {
            value.abs() <= TIE * size || (value * way < 0.0 && value.abs() <= HAIR * size)
        };
        let mut value = reaction.acceleration[i].at(piece.ground);
        let mut slope = reaction.acceleration[i].slope(piece.rate);
        if starts[i] != 0.0 && nothing(value, starts[i]) {
            value = 0.0;
            if nothing(slope * piece.left, starts[i]) {
                slope = 0.0;
            }
        }
        result[i] = [value, slope];
    }
    result
}
