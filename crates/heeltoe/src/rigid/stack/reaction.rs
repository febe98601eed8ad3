//! Reactions and accelerations of both cracks in a pair of modes: as [`super::super::reaction`], with six equations.

use super::super::block::{Affine, HEEL, SLIP, TOE};
use super::super::mode::Mode;
use super::super::reaction::Reaction;
use super::blocks::{part, Stack};
use super::solve::{Factors, Six, Square};

/// Modes of the lower and of the upper crack.
pub(super) type Modes = [Mode; 2];

/// Modes whose equations friction leaves with less than this share of their determinant are Painlevé's.
const SINGULAR: f64 = 1e-9;

/// The reactions of all pairs of modes, each worked out when it is asked for.
pub(super) struct Reactions<'a> {
    stack: &'a Stack,
    known: Vec<Option<Box<[Reaction; 2]>>>,
}

impl<'a> Reactions<'a> {
    pub(super) fn new(stack: &'a Stack) -> Self {
        Reactions {
            stack,
            known: vec![None; Mode::COUNT * Mode::COUNT],
        }
    }

    /// Those of the lower and of the upper crack.
    pub(super) fn of(&mut self, modes: Modes) -> &[Reaction; 2] {
        let place = modes[0].index() * Mode::COUNT + modes[1].index();
        let stack = self.stack;
        self.known[place].get_or_insert_with(|| Box::new(reactions(stack, modes)))
    }
}

/// The equations of a pair of modes: what is held does not accelerate, what slips rubs with so many times the friction.
fn equations(stack: &Stack, modes: Modes, share: f64) -> Square {
    let a = &stack.compliance;
    let mut rows = [[0.0; 6]; 6];
    for (crack, mode) in modes.into_iter().enumerate() {
        let first = 3 * crack;
        let held = held_by(mode);
        for i in 0..3 {
            let row = &mut rows[first + i];
            if held[i] {
                *row = a[first + i];
            } else {
                row[first + i] = a[first + i][first + i];
            }
        }
        if let Some(slip) = mode.slip() {
            let pull = share * slip.sign() * stack.blocks[crack].friction_kinetic;
            let size = a[first + SLIP][first + SLIP];
            rows[first + SLIP][first + HEEL] = pull * size;
            rows[first + SLIP][first + TOE] = pull * size;
        }
    }
    rows
}

fn held_by(mode: Mode) -> [bool; 3] {
    let [heel, toe] = mode.contacts();
    [mode.sticks(), heel, toe]
}

fn reactions(stack: &Stack, modes: Modes) -> [Reaction; 2] {
    let factors = Factors::new(equations(stack, modes, 1.0));
    let smooth = Factors::new(equations(stack, modes, 0.0));
    let regular = factors.determinant > SINGULAR * smooth.determinant;
    let scale = stack
        .blocks
        .each_ref()
        .map(|b| b.acceleration_scale())
        .into_iter()
        .fold(0.0, f64::max);
    let sizes: Six = std::array::from_fn(|i| {
        let load = &stack.free[i];
        load.constant.abs() + scale * (load.horizontal.abs() + load.vertical.abs())
    });
    let mut force = [Affine::default(); 6];
    let mut force_size = [0.0; 6];
    let mut acceleration = stack.free;
    let mut acceleration_size = sizes;
    for column in 0..6 {
        let held = held_by(modes[column / 3])[column % 3];
        if !held || !regular {
            continue;
        }
        let mut right = [0.0; 6];
        right[column] = -1.0;
        let unit = factors.solve(&right);
        let load = stack.free[column];
        for i in 0..6 {
            add(&mut force[i], unit[i], &load);
            force_size[i] += unit[i].abs() * sizes[column];
            let coupling: f64 = (0..6).map(|k| stack.compliance[i][k] * unit[k]).sum();
            add(&mut acceleration[i], coupling, &load);
            acceleration_size[i] += coupling.abs() * sizes[column];
        }
    }
    [0, 1].map(|crack| {
        let three = |of: &[Affine; 6]| [SLIP, HEEL, TOE].map(|i| of[3 * crack + i]);
        Reaction::made(
            &stack.blocks[crack],
            modes[crack],
            regular,
            (three(&force), part(&force_size, crack)),
            (three(&acceleration), part(&acceleration_size, crack)),
        )
    })
}

fn add(to: &mut Affine, factor: f64, load: &Affine) {
    to.constant += factor * load.constant;
    to.horizontal += factor * load.horizontal;
    to.vertical += factor * load.vertical;
}
