//! A block that bounces while its geometry and the water in its crack change: the series between its impacts beside the
//! integrator, which an anchor that bears nothing calls, and their books.

use heeltoe::inside::{Anchor, Law};
use heeltoe::rigid::varying::{self, Rotation, TurningBlock, TurningShaking, VaryingNumbers};
use heeltoe::rigid::{Block, BlockNumbers, Options, Outcome, Run, Shaking, Wanted};

use crate::numbers::{near, Rectangle, GRAVITY, HEEL, OPTIONS, SLIP, TOE};

const DAM: Rectangle = Rectangle {
    width: 20.0,
    height: 36.0,
    friction: 1.5,
    restitution: 0.5,
};
const WATER: f64 = 4e5;
const PRESSURE: [[f64; 2]; 3] = [[0.0, 2e5], [6.0, 1.2e5], [20.0, 0.0]];
const NOTHING: Anchor<f64> = Anchor {
    place: 5.0,
    axis: [0.0, 1.0],
    prestress: 0.0,
    axial_stiffness: 0.0,
    shear_stiffness: 0.0,
    capacity: f64::INFINITY,
};

/// Some of the water moves with it, at a place of its own; loads push it downstream.
fn numbers() -> (BlockNumbers, VaryingNumbers) {
    let (push, mass) = (4e6, DAM.mass());
    let lift: f64 = PRESSURE
        .windows(2)
        .map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]))
        .sum();
    let still = BlockNumbers {
        mass_horizontal: mass + WATER,
        static_horizontal: push,
        static_vertical: lift - mass * GRAVITY,
        per_horizontal_horizontal: -mass - WATER,
        ..DAM.numbers()
    };
    let varying = VaryingNumbers {
        water_mass: WATER,
        water_along: 3.0,
        water_across: 0.5 * DAM.height,
        dead_along: push,
        dead_moment: -push * 8.0,
        dead_virial: 2e7,
        opening: 1e-3,
        full_pressure: 3e5,
        ..DAM.varying()
    };
    (still, varying)
}

fn run(rotation: Rotation, law: Law, anchors: Vec<Anchor<f64>>, turning: Option<&[f64]>) -> Run {
    let (still, varying) = numbers();
    let time: Vec<f64> = (0..400).map(|k| 0.01 * f64::from(k)).collect();
    let across: Vec<f64> = time
        .iter()
        .map(|t| 7.0 * (9.0 * t).sin() * (-0.5 * t).exp())
        .collect();
    let up: Vec<f64> = time.iter().map(|t| 2.0 * (14.0 * t).cos()).collect();
    let level = Shaking::new(&time, &across, Some(&up)).unwrap();
    let shaking = TurningShaking::new(level, turning).unwrap();
    let block = TurningBlock::new(&varying, rotation, law, PRESSURE.to_vec(), anchors);
    let options = Options {
        settle: 1e-4,
        ..OPTIONS
    };
    varying::simulate(
        &Block::new(&still),
        &block,
        None,
        &shaking,
        None,
        options,
        Wanted::default(),
    )
}

const ROTATIONS: [Rotation; 3] = [Rotation::Small, Rotation::PDelta, Rotation::Finite];

#[test]
fn series_go_where_the_integrator_goes() {
    let turning: Vec<f64> = (0..400).map(|k| 0.02 * (0.1 * f64::from(k)).sin()).collect();
    for rotation in ROTATIONS {
        for law in Law::ALL {
            let [ours, theirs] =
                [vec![], vec![NOTHING]].map(|anchors| run(rotation, law, anchors, Some(&turning)).summary);
            let what = format!("{rotation:?} {law:?}");
            assert!(
                ours.outcome == Outcome::Done && ours.impacts > 20,
                "{what}: {}",
                ours.impacts
            );
            assert_eq!(ours.impacts, theirs.impacts, "{what}");
            // The integrator passes over kinks of the water's force.
            let smooth = matches!(law, Law::Constant | Law::FollowsOpening);
            let allowed = if smooth { 1e-9 } else { 1e-6 };
            for i in [SLIP, HEEL, TOE] {
                near(ours.position[i], theirs.position[i], allowed);
            }
            for (gap, other) in ours.largest_gap.into_iter().zip(theirs.largest_gap) {
                near(gap, other, allowed);
            }
        }
    }
}

#[test]
fn its_books_are_kept_to_rounding_whatever_the_water_does() {
    for rotation in ROTATIONS {
        for law in Law::ALL {
            let summary = run(rotation, law, vec![], None).summary;
            let residual = summary.ledger.residual(summary.kinetic_energy);
            assert!(residual < 1e-13, "{rotation:?} {law:?}: {residual:e}");
        }
    }
}
