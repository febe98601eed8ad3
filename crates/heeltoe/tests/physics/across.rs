//! Bonds and anchors of a mass that the ground shakes along its crack and across the valley: nothing prefers a direction
//! in the plane of the crack where the mass is held alike in both, as that on two nodes of [`super::flexible`] is here.

use heeltoe::flexible::{
    simulate, BondLaw, CrossShaking, Crossing, Dam, FaceAnchor, Frames, Modes, ReducedBody, Run, Scheme,
    Shaking, Wanted,
};

use crate::bonds::{BOND, LENGTH};
use crate::flexible::{pair_of_nodes, Pair};
use crate::numbers::{near, GRAVITY};

/// A spring that holds it off the plane, and one in each direction of slip.
const HELD: Pair = Pair {
    omega: [100.0, 100.0],
    ..Pair::FREE
};
const DT: f64 = 1e-4;

/// The mass across the valley: its mean and the difference of its nodes, as along the crack.
fn sideways(pair: &Pair) -> ReducedBody {
    let root = pair.mass.sqrt();
    let share = 1.0 / root;
    ReducedBody::new(&Modes {
        omega_squared: &[pair.omega[0].powi(2), 4e4],
        damping: [&[0.0; 2]; 2],
        load: &[0.0; 2],
        participation: [&[root, 0.0], &[0.0; 2]],
        start: &[0.0; 2],
        shapes: &[share, share, -share, share],
        position: &[0.0; 2],
        directions: 1,
        dampers: &[],
        damper_signs: &[],
        wet: &[],
        boundary: &[],
    })
    .unwrap()
}

/// Shake it by accelerations along the crack, across its faces and across the valley.
fn shake(dam: &Dam, pair: &Pair, ground: &[[f64; 3]]) -> Run {
    let plane: Vec<_> = ground.iter().map(|a| [a[0], a[1]]).collect();
    let cross: Vec<_> = ground.iter().map(|a| a[2]).collect();
    let bodies = [sideways(pair)];
    dam.check_across(&bodies).unwrap();
    let shaking = Shaking {
        across: Some(CrossShaking {
            bodies: &bodies,
            gap: [f64::INFINITY; 2],
            ground: &cross,
            crest: None,
        }),
        ..pair.shaking(&plane, DT)
    };
    let wanted = Wanted {
        stride: 1,
        ..Wanted::default()
    };
    simulate(dam, &shaking, &Scheme::Exact(0.5), wanted)
}

fn column(run: &Run, name: &str) -> Vec<f64> {
    let place = Frames::FIELDS.iter().position(|field| *field == name).unwrap();
    run.frames.rows.iter().map(|row| row[place]).collect()
}

/// Slips along and across the valley at all frames, turned back by an angle.
fn slips(run: &Run, angle: f64) -> Vec<[f64; 2]> {
    let (sine, cosine) = angle.sin_cos();
    let pairs = column(run, "slip").into_iter().zip(column(run, "slip_cross"));
    pairs
        .map(|(x, y)| [cosine * x + sine * y, cosine * y - sine * x])
        .collect()
}

fn turned(ground: &[[f64; 3]], angle: f64) -> Vec<[f64; 3]> {
    let (sine, cosine) = angle.sin_cos();
    let turn = |a: &[f64; 3]| [cosine * a[0] - sine * a[2], a[1], sine * a[0] + cosine * a[2]];
    ground.iter().map(turn).collect()
}

fn bonded(bond: BondLaw) -> Dam {
    let mut dam = pair_of_nodes(&HELD);
    dam.cracks[0].bond = Some(bond);
    dam.check().unwrap();
    dam
}

/// A push that grows evenly to this acceleration.
fn growing(steps: usize, size: f64) -> Vec<[f64; 3]> {
    (0..steps)
        .map(|k| [size * (k as f64 + 0.5) / steps as f64, 0.0, 0.0])
        .collect()
}

#[test]
fn a_bond_bears_and_breaks_alike_in_all_directions_of_slip() {
    let (ground, dam) = (growing(20_000, 600.0), bonded(BOND));
    let alone = shake(&dam, &HELD, &ground);
    let expected = slips(&alone, 0.0);
    let way = -expected[expected.len() - 1][0];
    assert!(way > 2.0 * BOND.energy[1] / BOND.cohesion, "{way}");
    for angle in [0.5 * std::f64::consts::PI, 0.4, -2.0, 3.0] {
        let run = shake(&dam, &HELD, &turned(&ground, angle));
        for (found, expected) in slips(&run, angle).iter().zip(&expected) {
            near(found[0], expected[0], 1e-8 * way);
            near(found[1], 0.0, 1e-8 * way);
        }
        let crack = &run.cracks[0];
        // By hand: the energy of the law, and friction under the weight over the way that it slips.
        near(crack.cracked.energy, LENGTH * BOND.energy[1], 0.3);
        near(
            crack.ledger.friction,
            HELD.friction * HELD.mass * GRAVITY * way,
            1.0,
        );
        near(crack.cross.slip_path, way, 1e-8 * way);
        assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
        assert!(crack.residual < 1e-8, "{}", crack.residual);
    }
}

#[test]
fn a_path_that_bends_while_its_bond_softens_turns_with_the_ground() {
    // Lifted now and then, so that the bond opens and slips together.
    let wave = |k: usize, rate: f64, phase: f64| (rate * (k as f64 + 0.5) * DT + phase).sin();
    let ground: Vec<_> = (0..10_000)
        .map(|k| {
            let grows = (k as f64 / 5_000.0).min(1.0);
            [
                260.0 * grows * wave(k, 14.0, 0.0),
                -60.0 * grows * wave(k, 31.0, 0.5),
                230.0 * grows * wave(k, 19.0, 1.0),
            ]
        })
        .collect();
    let dam = bonded(BOND);
    let one = shake(&dam, &HELD, &ground);
    let expected = slips(&one, 0.0);
    let reach = |k: usize| expected.iter().map(|slip| slip[k].abs()).fold(0.0, f64::max);
    assert!(reach(0) > 1e-3 && reach(1) > 1e-3, "{} {}", reach(0), reach(1));
    assert!(one.cracks[0].cracked.energy > 0.2 * LENGTH * BOND.energy[1]);
    let other = shake(&dam, &HELD, &turned(&ground, 1.0));
    for (found, expected) in slips(&other, 1.0).iter().zip(&expected) {
        (0..2).for_each(|k| near(found[k], expected[k], 1e-6 * reach(k)));
    }
    for run in [&one, &other] {
        let crack = &run.cracks[0];
        near(crack.ledger.fracture, crack.cracked.energy, 1e-9);
        near(
            crack.ledger.fracture,
            one.cracks[0].ledger.fracture,
            1e-6 * one.cracks[0].ledger.fracture,
        );
        assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
        assert!(
            crack.ledger.gained < 0.01 * crack.ledger.fracture,
            "{:?}",
            crack.ledger
        );
    }
}

#[test]
fn the_shear_of_both_components_breaks_what_neither_does_alone() {
    let limit = (LENGTH * BOND.cohesion + HELD.friction * HELD.mass * GRAVITY) / HELD.mass;
    let dam = bonded(BOND);
    let push = growing(20_000, 0.9 * limit);
    for (angle, factor, breaks) in [(0.0, 1.0, false), (0.7, 1.0, false), (0.7, 1.2, true)] {
        let stronger: Vec<_> = push.iter().map(|a| a.map(|a| factor * a)).collect();
        let run = shake(&dam, &HELD, &turned(&stronger, angle));
        assert_eq!(run.cracks[0].cracked.lengths[3] > 0.0, breaks, "{angle} {factor}");
    }
}

#[test]
fn a_bond_without_strength_is_that_of_a_crack() {
    let none = BondLaw {
        tensile: 0.0,
        cohesion: 0.0,
        ..BOND
    };
    let ground = turned(&growing(2_000, 60.0), 0.8);
    let [one, other] = [bonded(none), pair_of_nodes(&HELD)].map(|dam| shake(&dam, &HELD, &ground));
    assert!(slips(&one, 0.0) == slips(&other, 0.0));
    assert!(one.cracks[0].slip.abs() > 1e-4);
}

/// A steady push against friction and a dowel: half a cosine to twice what holds the push at rest, and there the mass
/// stays, as the push is less than three times the friction.
#[test]
fn a_dowel_stops_a_mass_where_the_closed_form_says_in_every_direction() {
    let (push, stiffness) = (0.5 * GRAVITY, 4e6);
    let mut dam = pair_of_nodes(&Pair::FREE);
    let middle = [(0, 0.5), (1, 0.5), (0, 0.0)];
    dam.cracks[0].inside.anchors = vec![FaceAnchor {
        place: Crossing {
            anchor: 0,
            points: [middle, [(0, 0.0); 3]],
        },
        axis: [0.0, 1.0],
        prestress: 0.0,
        axial_stiffness: 0.0,
        shear_stiffness: stiffness,
        capacity: f64::INFINITY,
    }];
    dam.check().unwrap();
    let way = 2.0 * (push - Pair::FREE.friction * GRAVITY) * Pair::FREE.mass / stiffness;
    let ground = vec![[-push, 0.0, 0.0]; 3_000];
    for angle in [0.5 * std::f64::consts::PI, 0.6, -2.5] {
        let run = shake(&dam, &Pair::FREE, &turned(&ground, angle));
        let crack = &run.cracks[0];
        let end = *slips(&run, angle).last().unwrap();
        near(end[0], way, 1e-3 * way);
        near(end[1], 0.0, 1e-9 * way);
        near(
            crack.ledger.springs,
            0.5 * stiffness * way * way,
            3e-3 * 0.5 * stiffness * way * way,
        );
        near(crack.anchors[0].force, stiffness * way, 1e-3 * stiffness * way);
        assert!(crack.ledger.residual() < 1e-12, "{:?}", crack.ledger);
    }
}
