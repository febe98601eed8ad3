//! Reactions and accelerations in each mode of motion.
//!
//! What the mode holds does not accelerate, what slips rubs:
//!
//! `0 = b + A f` in the rows that are held, `T = -mu_k S (N_h + N_t)` where it slips, and then `w'' = b + A f`.
//!
//! Both are linear in the loads, hence affine in the ground acceleration: they are worked out once per block, and a piece
//! of the record costs a handful of multiplications.

use std::cell::OnceCell;

use super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::mode::{Mode, Slip};
use super::shaking::Piece;

/// A contact that friction leaves with less than this share of its resistance to being pushed in is Painlevé's.
const SINGULAR: f64 = 1e-9;

/// Places of the accelerations of slip, heel gap and toe gap among the quantities of a [`Reaction`]; before them stand
/// friction (downstream) and the normal forces at heel and toe.
pub(super) const ACCELERATION: usize = 3;
/// Place of what is left of the friction cone downstream, `mu_s (N_h + N_t) - T`, and of the same upstream behind it.
pub(super) const CONE: usize = 6;
const COUNT: usize = 8;

/// Reactions and accelerations of one mode, affine in the ground acceleration.
///
/// Each is a sum of terms, one per load, and where it vanishes what remains of it is the rounding of those terms. Close
/// to Painlevé's paradox, where friction all but pulls the contact in, the terms are larger than the loads by any
/// factor, and so is their rounding. Hence each comes with the size of its terms under the static loads and a ground
/// acceleration like theirs, taken as no less than that of the loads.
///
/// The accelerations of what the mode holds are exactly zero. All quantities are worked out side by side, as all that
/// happens on a piece asks for most of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reaction {
    /// False where the mode's own equations are singular or push the contact apart with a positive force (Painlevé).
    pub regular: bool,
    /// Whether (heel, toe) are held in contact.
    pub contacts: [bool; 2],
    /// Sign of the slip velocity; zero where nothing slips on anything.
    pub way: f64,
    pub size: [f64; COUNT],
    constant: [f64; COUNT],
    horizontal: [f64; COUNT],
    vertical: [f64; COUNT],
}

/// The quantities of a [`Reaction`] at the start of a piece, and how they change on it per second.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Felt {
    pub value: [f64; COUNT],
    pub slope: [f64; COUNT],
}

/// Reactions of a mode to the free acceleration `b`, or `None` where the equations are singular or Painlevé's.
pub(super) fn reaction_to(a: &[Vector; 3], friction_kinetic: f64, mode: Mode, b: &Vector) -> Option<Vector> {
    let mut force = [0.0; 3];
    match mode {
        Mode::Drift => {}
        Mode::Rest => force = all_held(a, b),
        Mode::Slide(slip) => {
            let t = -friction_kinetic * slip.sign();
            let n = |r: usize, c: usize| a[r][c] + t * a[r][SLIP];
            let m = [[n(HEEL, HEEL), n(HEEL, TOE)], [n(TOE, HEEL), n(TOE, TOE)]];
            let smooth = [[a[HEEL][HEEL], a[HEEL][TOE]], [a[TOE][HEEL], a[TOE][TOE]]];
            if determinant(m) <= SINGULAR * determinant(smooth) {
                return None;
            }
            let normal = two_held(m, [b[HEEL], b[TOE]]);
            force = [t * (normal[0] + normal[1]), normal[0], normal[1]];
        }
        Mode::Rock(corner) => {
            let i = corner.gap();
            let m = [[a[SLIP][SLIP], a[SLIP][i]], [a[i][SLIP], a[i][i]]];
            [force[SLIP], force[i]] = two_held(m, [b[SLIP], b[i]]);
        }
        Mode::SlideRock(corner, slip) => {
            let i = corner.gap();
            let t = -friction_kinetic * slip.sign();
            let stiffness = a[i][i] + t * a[i][SLIP];
            if stiffness <= SINGULAR * a[i][i] {
                return None;
            }
            let n = -b[i] / stiffness;
            force[SLIP] = t * n;
            force[i] = n;
        }
    }
    Some(force)
}

fn determinant(m: [[f64; 2]; 2]) -> f64 {
    m[0][0] * m[1][1] - m[0][1] * m[1][0]
}

/// Solve `m f = -b`.
fn two_held(m: [[f64; 2]; 2], b: [f64; 2]) -> [f64; 2] {
    let det = determinant(m);
    [
        (-b[0] * m[1][1] + b[1] * m[0][1]) / det,
        (-b[1] * m[0][0] + b[0] * m[1][0]) / det,
    ]
}

/// Solve `A f = -b` by Cramer's rule; A is positive definite.
fn all_held(a: &[Vector; 3], b: &Vector) -> Vector {
    let cofactor = |r: usize, c: usize| {
        let (r1, r2) = ((r + 1) % 3, (r + 2) % 3);
        let (c1, c2) = ((c + 1) % 3, (c + 2) % 3);
        a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1]
    };
    let det: f64 = (0..3).map(|c| a[0][c] * cofactor(0, c)).sum();
    [0, 1, 2].map(|i| -(0..3).map(|column| cofactor(column, i) * b[column]).sum::<f64>() / det)
}

impl Reaction {
    pub(super) fn new(block: &Block, mode: Mode) -> Self {
        let (pull, free) = &pulled(block, mode);
        let accelerations = block.acceleration_scale();
        let size = |i: usize| {
            let Affine {
                constant,
                horizontal,
                vertical,
            } = free[i];
            let terms = constant.abs() + accelerations * (horizontal.abs() + vertical.abs());
            terms.max(block.free_terms[i])
        };
        let mut force = [Affine::default(); 3];
        force[SLIP].constant = *pull;
        let mut acceleration = *free;
        let mut force_size = [pull.abs(), 0.0, 0.0];
        let mut acceleration_size = [SLIP, HEEL, TOE].map(size);
        let mut regular = true;
        let way = mode.slip().map_or(0.0, Slip::sign);
        let friction_kinetic = block.friction_kinetic_towards(way);
        for (column, load) in free.iter().enumerate() {
            let mut one = [0.0; 3];
            one[column] = 1.0;
            let Some(unit) = reaction_to(&block.compliance, friction_kinetic, mode, &one) else {
                regular = false;
                break;
            };
            for i in 0..3 {
                let from = |k: f64, to: &mut Affine, terms: &mut f64| {
                    to.constant += k * load.constant;
                    to.horizontal += k * load.horizontal;
                    to.vertical += k * load.vertical;
                    *terms += k.abs() * size(column);
                };
                from(unit[i], &mut force[i], &mut force_size[i]);
                let coupling: f64 = (0..3).map(|k| block.compliance[i][k] * unit[k]).sum();
                from(coupling, &mut acceleration[i], &mut acceleration_size[i]);
            }
        }
        Reaction::made(
            block,
            mode,
            regular,
            (force, force_size),
            (acceleration, acceleration_size),
        )
    }

    /// Of forces and accelerations that have been worked out, each with the size of its terms.
    pub(super) fn made(
        block: &Block,
        mode: Mode,
        regular: bool,
        (force, force_size): ([Affine; 3], Vector),
        (mut acceleration, acceleration_size): ([Affine; 3], Vector),
    ) -> Self {
        let (forces, accelerations) = (block.force_scale, block.acceleration_scale());
        let [friction, heel, toe] = force_size.map(|terms| terms.max(forces));
        let [along, left, right] = acceleration_size.map(|terms| terms.max(accelerations));
        let cone_size = block.friction_static * (heel + toe) + friction + block.cohesion[0].abs();
        let held = [mode.sticks(), mode.contacts()[0], mode.contacts()[1]];
        for (acceleration, held) in acceleration.iter_mut().zip(held) {
            if held {
                *acceleration = Affine::default();
            }
        }
        let cones = [1.0, -1.0].map(|direction| cone(block, &force, direction));
        let ([a, b, c], [d, e, f], [g, h]) = (force, acceleration, cones);
        let all = [a, b, c, d, e, f, g, h];
        let row = |part: fn(&Affine) -> f64| all.each_ref().map(part);
        Reaction {
            regular,
            contacts: mode.contacts(),
            way: mode.slip().map_or(0.0, Slip::sign),
            size: [friction, heel, toe, along, left, right, cone_size, cone_size],
            constant: row(|q| q.constant),
            horizontal: row(|q| q.horizontal),
            vertical: row(|q| q.vertical),
        }
    }

    /// Work out all quantities on a piece.
    #[inline(always)]
    pub(super) fn on(&self, piece: &Piece<2>, felt: &mut Felt) {
        let [a, b] = piece.ground;
        let [rate_a, rate_b] = piece.rate;
        for i in 0..COUNT {
            felt.value[i] = self.constant[i] + self.horizontal[i] * a + self.vertical[i] * b;
            felt.slope[i] = self.horizontal[i] * rate_a + self.vertical[i] * rate_b;
        }
    }

    /// One of the quantities.
    pub(super) fn quantity(&self, i: usize) -> Affine {
        Affine {
            constant: self.constant[i],
            horizontal: self.horizontal[i],
            vertical: self.vertical[i],
        }
    }
}

/// The reactions of all modes of one block.
pub(super) struct Reactions([Reaction; Mode::COUNT]);

impl Reactions {
    pub(super) fn new(block: &Block) -> Self {
        let mut table = [Reaction::new(block, Mode::Drift); Mode::COUNT];
        for mode in Mode::ALL {
            table[mode.index()] = Reaction::new(block, mode);
        }
        Reactions(table)
    }

    /// Of a block whose friction is another one in each mode, and none in a mode that it jams.
    pub(super) fn each(block: &Block, rubbing: impl Fn(Mode) -> Option<Block>) -> Self {
        let mut table = [Reaction::new(block, Mode::Drift); Mode::COUNT];
        for mode in Mode::ALL {
            table[mode.index()] = match rubbing(mode) {
                Some(block) => Reaction::new(&block, mode),
                None => Reaction {
                    regular: false,
                    ..Reaction::new(block, mode)
                },
            };
        }
        Reactions(table)
    }

    /// Of each mode either these or those of another block, `there`.
    pub(super) fn or(mut self, there: &Self, which: impl Fn(Mode) -> bool) -> Self {
        for mode in Mode::ALL.into_iter().chain([Mode::Drift]) {
            if which(mode) {
                self.0[mode.index()] = there.0[mode.index()];
            }
        }
        self
    }

    #[inline]
    pub(super) fn of(&self, mode: Mode) -> &Reaction {
        &self.0[mode.index()]
    }
}

/// The reactions of one block, of each mode once it is asked for: most blocks never lift.
pub(super) struct ReactionsOf<'a> {
    block: &'a Block,
    known: [OnceCell<Reaction>; Mode::COUNT],
}

impl<'a> ReactionsOf<'a> {
    pub(super) fn new(block: &'a Block) -> Self {
        ReactionsOf {
            block,
            known: Default::default(),
        }
    }

    #[inline(always)]
    pub(super) fn of(&self, mode: Mode) -> &Reaction {
        self.known[mode.index()].get_or_init(|| Reaction::new(self.block, mode))
    }
}

/// What friction bears in a mode without a normal force, and the free acceleration with that for a load.
fn pulled(block: &Block, mode: Mode) -> (f64, [Affine; 3]) {
    let pull = -mode.slip().map_or(0.0, Slip::sign) * block.cohesion[1];
    let mut free = block.free_acceleration;
    if pull != 0.0 {
        for (load, row) in free.iter_mut().zip(&block.compliance) {
            load.constant += row[SLIP] * pull;
        }
    }
    (pull, free)
}

/// `mu_s (N_h + N_t) - direction * T`: what is left of the friction cone; friction downstream keeps from slipping upstream.
fn cone(block: &Block, force: &[Affine; 3], direction: f64) -> Affine {
    let friction_static = block.friction_static_towards(-direction);
    let left = |f: fn(&Affine) -> f64| {
        friction_static * (f(&force[HEEL]) + f(&force[TOE])) - direction * f(&force[SLIP])
    };
    Affine {
        constant: left(|q| q.constant) + block.cohesion[0],
        horizontal: left(|q| q.horizontal),
        vertical: left(|q| q.vertical),
    }
}
