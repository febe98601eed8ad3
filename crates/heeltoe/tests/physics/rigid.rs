//! The exact walk of one block: sliding, dropping, and the energy of a motion in which all happens.

use heeltoe::rigid::{exact, Block, BlockNumbers, EventKind, Mode, Outcome, Run, Shaking, Wanted};

use crate::numbers::{near, random, Rectangle, GRAVITY, HEEL, OPTIONS, SLIP, TOE};

/// Wide enough to slide alone.
const FLAT: Rectangle = Rectangle {
    width: 10.0,
    height: 1.0,
    friction: 0.5,
    restitution: 0.0,
};

/// With its events.
fn events() -> Wanted<'static> {
    Wanted {
        events: true,
        ..Wanted::default()
    }
}

fn walk(rectangle: &Rectangle, shaking: &Shaking, wanted: Wanted) -> Run {
    let block = Block::new(&rectangle.numbers());
    exact::simulate(&block, shaking, None, OPTIONS, wanted)
}

#[test]
fn a_pulse_makes_it_slip_by_newmarks_closed_form() {
    // The ground goes upstream with 0.9 g and up with 0.2 g for 0.7 s: friction is pressed harder meanwhile.
    let (push, lift, last) = (0.9 * GRAVITY, 0.2 * GRAVITY, 0.7);
    let time = [0.0, 0.1, 0.1, 0.1 + last, 0.1 + last, 4.0];
    let across = [0.0, 0.0, -push, -push, 0.0, 0.0];
    let up = [0.0, 0.0, lift, lift, 0.0, 0.0];
    let run = walk(&FLAT, &Shaking::new(&time, &across, Some(&up)).unwrap(), events());
    let gain = push - FLAT.friction * (GRAVITY + lift);
    let speed = gain * last;
    let brake = FLAT.friction * GRAVITY;
    near(
        run.summary.position[SLIP],
        speed * speed / 2.0 * (1.0 / gain + 1.0 / brake),
        1e-12,
    );
    near(run.events[1].time, 0.1 + last + speed / brake, 1e-12);
    let lost = FLAT.mass()
        * FLAT.friction
        * ((GRAVITY + lift) * speed * last / 2.0 + GRAVITY * speed * speed / brake / 2.0);
    near(run.summary.ledger.friction, lost, 1e-12 * lost);
}

#[test]
fn it_slips_and_lifts_the_moment_a_growing_acceleration_passes_its_limits() {
    // a = -r t: it slips from t = mu g / r on, by r t^3 / 6 since then.
    let rate = 4.0;
    let (time, across) = ([0.0, 3.0], [0.0, -3.0 * rate]);
    let shaking = Shaking::new(&time, &across, None).unwrap();
    let run = walk(&FLAT, &shaking, events());
    let start = FLAT.friction * GRAVITY / rate;
    assert_eq!(run.events[0].kind, EventKind::SlipStarts);
    near(run.events[0].time, start, 1e-14);
    near(
        run.summary.position[SLIP],
        rate * (3.0 - start).powi(3) / 6.0,
        1e-12,
    );
    // Where friction holds it lifts its heel from t = g B / (H r) on.
    let slender = Rectangle {
        width: 1.0,
        height: 4.0,
        friction: 2.0,
        ..FLAT
    };
    let run = walk(&slender, &shaking, events());
    assert_eq!(run.events[0].kind, EventKind::HeelLifts);
    near(
        run.events[0].time,
        GRAVITY * slender.width / (slender.height * rate),
        1e-14,
    );
}

#[test]
fn a_slide_to_and_fro_is_that_of_a_plain_stepper() {
    let (samples, last) = (401, 4.0);
    let time: Vec<f64> = (0..samples)
        .map(|k| last * f64::from(k) / f64::from(samples - 1))
        .collect();
    let across: Vec<f64> = time
        .iter()
        .map(|t| 0.9 * GRAVITY * ((7.0 * t).sin() + 0.4 * (16.0 * t + 1.0).sin()))
        .collect();
    let run = walk(
        &FLAT,
        &Shaking::new(&time, &across, None).unwrap(),
        Wanted::default(),
    );
    // Velocity by the impulses of the ground and of friction, which takes no more than there is.
    let (mut slip, mut speed, mut least, mut most): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    let parts = 2000;
    let step = last / f64::from((samples - 1) * parts);
    for pair in across.windows(2) {
        for k in 0..parts {
            let ground = pair[0] + (pair[1] - pair[0]) * (f64::from(k) + 0.5) / f64::from(parts);
            let pushed = speed - step * ground;
            let after = pushed.signum() * (pushed.abs() - step * FLAT.friction * GRAVITY).max(0.0);
            slip += step * (speed + after) / 2.0;
            speed = after;
            (least, most) = (least.min(slip), most.max(slip));
        }
    }
    let summary = &run.summary;
    assert!(summary.slip_stops > 4 && most - least > 0.3, "{summary:?}");
    near(summary.position[SLIP], slip, step);
    near(summary.slip_range[0], least, step);
    near(summary.slip_range[1], most, step);
}

#[test]
fn a_block_that_drops_rebounds_in_a_geometric_row() {
    let block = Rectangle {
        restitution: 0.5,
        ..FLAT
    };
    let drop = 0.2;
    let numbers = Block::new(&block.numbers());
    let (time, still) = ([0.0, 2.0], [0.0, 0.0]);
    let shaking = Shaking::new(&time, &still, None).unwrap();
    let start = Some([[0.0, drop, drop], [0.0; 3]]);
    let run = exact::simulate(&numbers, &shaking, start, OPTIONS, events());
    let fall = (2.0 * drop / GRAVITY).sqrt();
    let (mut moment, mut speed) = (fall, GRAVITY * fall);
    // The last ones are lost in the rounding of the first.
    for event in run
        .events
        .iter()
        .skip_while(|event| event.kind != EventKind::BothStrike)
        .take(8)
    {
        assert_eq!(event.kind, EventKind::BothStrike);
        near(event.time, moment, 1e-12);
        for gap in [HEEL, TOE] {
            near(event.approach[gap], -speed, 1e-11);
            near(event.velocity[gap], block.restitution * speed, 1e-11);
        }
        near(
            event.energy_lost,
            block.mass() * speed * speed * (1.0 - 0.25) / 2.0,
            1e-9 * block.mass(),
        );
        speed *= block.restitution;
        moment += 2.0 * speed / GRAVITY;
    }
    let end = run.events.last().unwrap();
    let e = block.restitution;
    near(end.time, fall * (1.0 + e) / (1.0 - e), 1e-6);
    assert_eq!(run.summary.mode, Mode::Rest);
    let weight = block.mass() * GRAVITY;
    near(run.summary.ledger.impact, weight * drop, 1e-12 * weight);
}

#[test]
fn the_energy_of_rocking_slipping_and_flying_is_accounted_for() {
    let time: Vec<f64> = (0..=800).map(|k| f64::from(k) * 0.01).collect();
    let wave = |t: f64, a: f64, b: f64| (a * t).sin() + 0.6 * (b * t + 1.0).sin();
    let across: Vec<f64> = time.iter().map(|t| 0.5 * GRAVITY * wave(*t, 7.0, 19.0)).collect();
    let up: Vec<f64> = time
        .iter()
        .map(|t| 0.3 * GRAVITY * wave(*t, 11.0, 23.0))
        .collect();
    let shaking = Shaking::new(&time, &across, Some(&up)).unwrap();
    let block = Rectangle {
        width: 4.0,
        height: 8.0,
        friction: 0.55,
        restitution: 0.4,
    };
    let run = walk(&block, &shaking, events());
    let summary = &run.summary;
    assert_eq!(summary.outcome, Outcome::Done);
    assert!(
        summary.impacts > 10
            && summary.slip_stops > 3
            && [0, 2, 3, 4].iter().all(|k| summary.time_by_mode[*k] > 0.0),
        "{summary:?}"
    );
    assert!(
        summary.ledger.residual(summary.kinetic_energy) < 1e-12,
        "{summary:?}"
    );
    let struck: f64 = run.events.iter().map(|event| event.energy_lost).sum();
    near(struck, summary.ledger.impact, 1e-12 * struck);
    assert!(run.events.iter().all(|event| event.energy_lost >= -1e-9 * struck));
}

#[test]
fn blocks_without_wanted_events_go_the_way_of_those_with_them() {
    let mut next = random(7);
    let [mut stops, mut rocked] = [0; 2];
    for seed in 0..400 {
        let vertical = seed % 3 == 0;
        let mut series = |size: f64| -> Vec<f64> {
            let mut value = 0.0;
            (0..600)
                .map(|_| {
                    value = 0.8 * value + size * GRAVITY * (next() - 0.5);
                    value
                })
                .collect()
        };
        let (along, up) = (series(2.0), series(1.0));
        // A jump, where two samples share a moment.
        let time: Vec<f64> = (0..600)
            .map(|k| 0.01 * f64::from(k - i32::from(k > 300)))
            .collect();
        let shaking = Shaking::new(&time, &along, vertical.then_some(&up[..])).unwrap();
        let block = Rectangle {
            width: 10.0,
            height: 2.0 + 10.0 * next(),
            friction: 0.2 + 0.6 * next(),
            restitution: 0.3,
        };
        let numbers = BlockNumbers {
            friction_kinetic: block.friction * (0.6 + 0.4 * next()),
            static_horizontal: 0.1 * block.mass() * GRAVITY,
            ..block.numbers()
        };
        let run = |wanted: Wanted| exact::simulate(&Block::new(&numbers), &shaking, None, OPTIONS, wanted);
        let [quick, slow] = [run(Wanted::default()), run(events())];
        assert_eq!(
            format!("{:?}", quick.summary),
            format!("{:?}", slow.summary),
            "{seed}"
        );
        stops += slow.summary.slip_stops;
        rocked += u64::from(slow.summary.impacts > 0);
    }
    assert!(stops > 2000 && rocked > 50, "{stops} {rocked}");
}
