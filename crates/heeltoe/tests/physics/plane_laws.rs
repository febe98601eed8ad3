//! Friction by a law in the plane of the crack: its path is that of the vector of slip, its speed the size of its velocity.
//!
//! Pushed in one direction a block whose masses are equal slides straight, whatever the angle, by the closed forms of
//! [`crate::friction_laws`].

use heeltoe::asperity::{Asperities, AsperityNumbers};
use heeltoe::friction::{Law, LawNumbers, Shape, Worn};
use heeltoe::inside::{Anchor, Law as WaterLaw};
use heeltoe::rigid::plane::{simulate_varying, Across, CrossShaking};
use heeltoe::rigid::varying::{self, Rotation, Surface, TurningBlock, TurningShaking};
use heeltoe::rigid::{Block, BlockNumbers, Outcome, Run, Shaking, Vector, Wanted};

use crate::numbers::{near, random, Rectangle, OPTIONS, SLIP};
use crate::plane::{crossing, plain_by, shaken, slab, Ground, FREE};

const GRAVITY: f64 = 9.80665;
const PEAK: f64 = 0.7;
const RESIDUAL: f64 = 0.3;
const PUSH: f64 = 0.75 * GRAVITY;
const ANGLES: [f64; 4] = [0.3, 1.2, 2.5, -2.0];
const TIMES: [f64; 4] = [0.1, 0.25, 0.4, 0.6];
const FLAT: Rectangle = Rectangle {
    width: 10.0,
    height: 1.0,
    friction: PEAK,
    restitution: 0.0,
};

fn law(shape: Shape, scale: f64) -> Law {
    law_from(PEAK, shape, scale)
}

fn law_from(peak: f64, shape: Shape, scale: f64) -> Law {
    let numbers = LawNumbers {
        peak,
        residual: RESIDUAL,
        scale,
        ..LawNumbers::default()
    };
    Law::new(shape, &numbers, Vec::new())
}

fn turning() -> TurningBlock {
    let pressure = vec![[0.0, 0.0], [FLAT.width, 0.0]];
    TurningBlock::new(
        &FLAT.varying(),
        Rotation::Small,
        WaterLaw::Constant,
        pressure,
        Vec::new(),
    )
}

fn run(block: &BlockNumbers, across: &Across, ground: &Ground, law: &Law, wanted: Wanted) -> Run {
    let level = Shaking::new(&ground.time, &ground.along, ground.up.as_deref()).unwrap();
    let shaking = CrossShaking {
        level: &level,
        cross: &ground.across,
    };
    let surface = Surface {
        law,
        worn: Worn::FRESH,
        asperities: None,
    };
    let varying = (&turning(), Some(&surface));
    simulate_varying(
        &Block::new(block),
        across,
        &shaking,
        varying,
        None,
        OPTIONS,
        wanted,
    )
}

/// Slip in the direction of the push, slip across that, and the speed, of a slab that is pushed at an angle.
fn pushed(law: &Law, angle: f64) -> Vec<[f64; 3]> {
    let direction = [angle.cos(), angle.sin()];
    let ground = Ground::steady(direction.map(|part| -PUSH * part), 0.7);
    let wanted = Wanted {
        times: &TIMES,
        ..Wanted::default()
    };
    let ran = run(&slab(1.0, [PEAK; 2], 0.0), &FREE, &ground, law, wanted);
    assert_eq!(ran.summary.outcome, Outcome::Done);
    let residual = ran.summary.ledger.residual(ran.summary.kinetic_energy);
    assert!(residual < 1e-12, "{residual:e}");
    let worn = ran.worn.as_ref().unwrap();
    near(worn.end.path, crossing(&ran).path, 1e-12);
    let [c, s] = direction;
    let kept = ran.moments.iter().zip(&crossing(&ran).kept).zip(&worn.kept);
    kept.map(|((moment, [y, v, _]), [path, _])| {
        let (x, u) = (moment.position[SLIP], moment.velocity[SLIP]);
        near(*path, x.hypot(*y), 1e-12);
        [c * x + s * y, c * y - s * x, u.hypot(*v)]
    })
    .collect()
}

#[test]
fn friction_that_falls_with_the_path_lets_a_straight_slip_grow_at_any_angle() {
    let scale = 0.1;
    let start = PUSH - PEAK * GRAVITY;
    let growth = (GRAVITY * (PEAK - RESIDUAL) / scale).sqrt();
    let turn = (1.0 + scale * growth * growth / start).acosh() / growth;
    assert!(turn < TIMES[3], "the last moment is behind the loss");
    for angle in ANGLES {
        for (found, time) in pushed(&law(Shape::Linear, scale), angle).into_iter().zip(TIMES) {
            let early = time.min(turn);
            let slip = start / growth.powi(2) * ((growth * early).cosh() - 1.0);
            let speed = start / growth * (growth * early).sinh();
            let (late, gain) = (time - early, PUSH - RESIDUAL * GRAVITY);
            near(found[0], slip + late * (speed + gain * late / 2.0), 1e-11);
            near(found[1], 0.0, 1e-12);
            near(found[2], speed + gain * late, 1e-11);
        }
    }
}

#[test]
fn a_bond_that_falls_with_the_path_does_so_too() {
    // Cohesion c over the width B of a slab of mass 1 adds c B / m; it is lost over L.
    let (cohesion, loss) = (1e-3, 0.2);
    let numbers = LawNumbers {
        peak: RESIDUAL,
        residual: RESIDUAL,
        cohesion,
        loss,
        ..LawNumbers::default()
    };
    let law = Law::new(Shape::Constant, &numbers, Vec::new());
    let added = cohesion * 1000.0;
    let start = PUSH - RESIDUAL * GRAVITY - added;
    let growth = (added / loss).sqrt();
    for angle in ANGLES {
        let found = pushed(&law, angle)[1];
        let slip = start / growth.powi(2) * ((growth * TIMES[1]).cosh() - 1.0);
        assert!(slip < loss);
        near(found[0], slip, 1e-12);
    }
}

#[test]
fn friction_that_falls_off_over_the_path_keeps_the_energy_at_any_angle() {
    let scale = 0.1;
    for angle in ANGLES {
        for [slip, aside, speed] in pushed(&law(Shape::Exponential, scale), angle) {
            let worn = GRAVITY * (PEAK - RESIDUAL) * scale * (1.0 - (-slip / scale).exp());
            near(
                speed * speed / 2.0,
                (PUSH - RESIDUAL * GRAVITY) * slip - worn,
                1e-11,
            );
            near(aside, 0.0, 1e-12);
        }
    }
}

#[test]
fn friction_that_falls_with_the_speed_takes_its_time_at_any_angle() {
    let scale = 0.5;
    let (a, b) = (PUSH - RESIDUAL * GRAVITY, GRAVITY * (PEAK - RESIDUAL));
    for angle in ANGLES {
        for ([_, _, speed], time) in pushed(&law(Shape::Speed, scale), angle).into_iter().zip(TIMES) {
            near(
                scale / a * ((a * (speed / scale).exp() - b) / (a - b)).ln(),
                time,
                1e-10,
            );
        }
    }
}

#[test]
fn a_turn_of_both_components_turns_the_slip_by_a_law() {
    for (seed, shape, scale) in [
        (31, Shape::Linear, 0.05),
        (32, Shape::Exponential, 0.02),
        (33, Shape::Speed, 0.3),
    ] {
        let ground = shaken(seed, 1.6, 400, true);
        let (c, s) = (0.7_f64.cos(), 0.7_f64.sin());
        let turned = Ground {
            time: ground.time.clone(),
            along: ground
                .along
                .iter()
                .zip(&ground.across)
                .map(|(x, y)| c * x - s * y)
                .collect(),
            across: ground
                .along
                .iter()
                .zip(&ground.across)
                .map(|(x, y)| s * x + c * y)
                .collect(),
            up: ground.up.clone(),
        };
        let law = law_from(0.5, shape, scale);
        let slip = |ground: &Ground| {
            let ran = run(&slab(1.0, [0.5; 2], 0.0), &FREE, ground, &law, Wanted::default());
            assert_eq!(ran.summary.outcome, Outcome::Done);
            [ran.summary.position[SLIP], crossing(&ran).position]
        };
        let ([x, y], [turned_x, turned_y]) = (slip(&ground), slip(&turned));
        assert!(x.hypot(y) > 1e-3);
        near(turned_x, c * x - s * y, 1e-10);
        near(turned_y, s * x + c * y, 1e-10);
    }
}

#[test]
fn random_slabs_go_by_a_law_where_a_plain_stepper_puts_them() {
    let mut next = random(12);
    for seed in 0..6 {
        let (shape, scale) = [
            (Shape::Linear, 0.05),
            (Shape::Exponential, 0.02),
            (Shape::Speed, 0.3),
        ][seed as usize % 3];
        let law = law_from(0.5, shape, scale);
        let block = slab(1.0 + next(), [0.5; 2], 0.1 * GRAVITY * next());
        let ground = shaken(50 + seed, 1.6, 300, seed % 2 == 0);
        let ran = run(&block, &FREE, &ground, &law, Wanted::default());
        assert_eq!(ran.summary.outcome, Outcome::Done);
        let residual = ran.summary.ledger.residual(ran.summary.kinetic_energy);
        assert!(residual < 1e-10, "{seed}: {residual:e}");
        let friction = |rests: bool, path: f64, speed: f64| {
            law.coefficients(1.0, if rests { 0.0 } else { speed }, path)[1]
        };
        let [coarse, fine] = [50, 200].map(|steps| plain_by(&block, &FREE, &ground, steps, friction));
        let ours = [ran.summary.position[SLIP], crossing(&ran).position];
        for i in 0..2 {
            near(ours[i], fine[i], 2e-5 + (fine[i] - coarse[i]).abs());
        }
    }
}

#[test]
fn a_ground_that_is_still_across_gives_the_bits_of_the_walk_along() {
    let ground = Ground {
        across: vec![0.0; 300],
        ..shaken(7, 3.0, 300, false)
    };
    let level = Shaking::new(&ground.time, &ground.along, None).unwrap();
    let law = law(Shape::Linear, 0.05);
    let across = Across {
        mass: FLAT.mass(),
        ..FREE
    };
    let surface = Surface {
        law: &law,
        worn: Worn::FRESH,
        asperities: None,
    };
    let start: Option<[Vector; 2]> = None;
    let shaking = TurningShaking::new(level, None).unwrap();
    let block = Block::new(&FLAT.numbers());
    let wanted = Wanted::default();
    let alone = varying::simulate(
        &block,
        &turning(),
        Some(&surface),
        &shaking,
        start,
        OPTIONS,
        wanted,
    );
    let both = run(&FLAT.numbers(), &across, &ground, &law, wanted);
    assert!(alone.summary.position[SLIP].abs() > 1e-3);
    assert_eq!(alone.summary.row(), both.summary.row());
    near(crossing(&both).path, alone.worn.unwrap().end.path, 0.0);
    // A hair of motion across changes no more than a hair.
    let hair = Ground {
        across: ground.along.iter().map(|a| 1e-9 * a).collect(),
        ..ground
    };
    let nearly = run(&FLAT.numbers(), &across, &hair, &law, wanted);
    near(nearly.summary.position[SLIP], both.summary.position[SLIP], 1e-8);
}

#[test]
fn a_neighbour_that_holds_it_leaves_the_law_along_the_stream() {
    // Held from the start on the left by a steady push that way, free to the right.
    let across = Across {
        gap: [0.0, f64::INFINITY],
        ..FREE
    };
    let law = law(Shape::Linear, 0.1);
    let ground = Ground::steady([-PUSH, -0.5 * GRAVITY], 0.4);
    let held = run(
        &slab(1.0, [PEAK; 2], 0.0),
        &across,
        &ground,
        &law,
        Wanted::default(),
    );
    let start = PUSH - PEAK * GRAVITY;
    let growth = (GRAVITY * (PEAK - RESIDUAL) / 0.1).sqrt();
    near(
        held.summary.position[SLIP],
        start / growth.powi(2) * ((growth * 0.4).cosh() - 1.0),
        1e-11,
    );
    near(crossing(&held).position, 0.0, 0.0);
}

#[test]
fn a_block_that_would_lift_ends_without_a_result() {
    let slender = BlockNumbers {
        height: 3.0,
        heel_distance: 0.5,
        toe_distance: 0.5,
        per_horizontal_moment: -3.0,
        ..slab(1.0, [0.9; 2], 0.0)
    };
    let ground = shaken(4, 2.0, 500, false);
    let ran = run(
        &slender,
        &FREE,
        &ground,
        &law(Shape::Linear, 0.05),
        Wanted::default(),
    );
    assert_eq!(ran.summary.outcome, Outcome::LiftsAcross);
}

#[test]
fn what_else_varies_is_refused() {
    let ground = Ground::steady([1.0, 1.0], 1.0);
    let level = Shaking::new(&ground.time, &ground.along, None).unwrap();
    let turns = vec![0.1; ground.time.len()];
    let [straight, turned] =
        [None, Some(&turns[..])].map(|turning| TurningShaking::new(level.clone(), turning).unwrap());
    let block = |rotation: Rotation, anchors: Vec<Anchor<f64>>| {
        let pressure = vec![[0.0, 0.0], [FLAT.width, 0.0]];
        TurningBlock::new(&FLAT.varying(), rotation, WaterLaw::Constant, pressure, anchors)
    };
    let anchor = Anchor {
        place: 5.0,
        axis: [0.0, 1.0],
        prestress: 1e3,
        axial_stiffness: 1e6,
        shear_stiffness: 0.0,
        capacity: 1e5,
    };
    let [falls, by_stress] = [Shape::Linear, Shape::Barton].map(|shape| law(shape, 0.1));
    let surface = |law, asperities| Surface {
        law,
        worn: Worn::FRESH,
        asperities,
    };
    let asperities = (Asperities::new(&AsperityNumbers::default()), [0.0; 2]);
    let plain = block(Rotation::Small, Vec::new());
    let check = |block: &TurningBlock, surface: &Surface, shaking: &TurningShaking| {
        Across::check_varying((block, Some(surface)), shaking)
    };
    let smooth = surface(&falls, None);
    assert_eq!(check(&plain, &smooth, &straight), Ok(()));
    let refused = [
        check(&block(Rotation::PDelta, Vec::new()), &smooth, &straight),
        check(&block(Rotation::Small, vec![anchor]), &smooth, &straight),
        check(&plain, &surface(&falls, Some(asperities)), &straight),
        check(&plain, &surface(&by_stress, None), &straight),
        check(&plain, &smooth, &turned),
    ];
    let why = refused.map(|found| found.unwrap_err().to_string());
    for (word, why) in ["rotates", "anchors", "asperities", "stress", "turn"]
        .iter()
        .zip(why)
    {
        assert!(why.contains(word), "{why}");
    }
}
