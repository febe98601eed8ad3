//! A slender block that rocks freely: Housner's periods and his loss at an impact, and their forms for rotations that are
//! small or of any size.
//!
//! With `p^2 = W R / I_o` about the corner, `alpha` the angle of the diagonal and `t` the rotation,
//!
//! ```text
//! small, constant moment:   t'' = -p^2 sin(alpha)                      T/4 = sqrt(2 t0 / (p^2 sin(alpha)))
//! p-delta:                  t'' = -p^2 (sin(alpha) - cos(alpha) t)     T/4 = arcosh(1 / (1 - t0 / tan(alpha))) / (p sqrt(cos(alpha)))
//! finite:                   t'' = -p^2 sin(alpha - t)                  T/4 by quadrature
//! impact, e = 0, no slip:   t'+ / t'- = 1 - 3/2 sin(alpha)^2
//! ```

use heeltoe::inside::Law;
use heeltoe::rigid::varying::{self, Rotation, TurningBlock, TurningShaking};
use heeltoe::rigid::{exact, Block, EventKind, Run, Shaking, Vector, Wanted};

use crate::numbers::{near, Rectangle, GRAVITY, HEEL, OPTIONS, TOE};

const SLENDER: Rectangle = Rectangle {
    width: 1.0,
    height: 4.0,
    friction: 20.0,
    restitution: 0.0,
};

/// Rotation at the start, about the toe.
const TILT: f64 = 0.15;

fn alpha() -> f64 {
    (SLENDER.width / SLENDER.height).atan()
}

fn p_squared() -> f64 {
    let radius = SLENDER.width.hypot(SLENDER.height) / 2.0;
    SLENDER.mass() * GRAVITY * radius / SLENDER.about_corner()
}

fn rock(rotation: Option<Rotation>) -> Run {
    let block = Block::new(&SLENDER.numbers());
    let (time, still) = ([0.0, 6.0], [0.0, 0.0]);
    let shaking = Shaking::new(&time, &still, None).unwrap();
    let gap = match rotation {
        Some(Rotation::Finite) => SLENDER.width * TILT.sin(),
        _ => SLENDER.width * TILT,
    };
    let start = Some([[0.0, gap, 0.0], [0.0; 3]]);
    let wanted = Wanted {
        events: true,
        ..Wanted::default()
    };
    let Some(rotation) = rotation else {
        return exact::simulate(&block, &shaking, start, OPTIONS, wanted);
    };
    let turning = TurningBlock::new(
        &SLENDER.varying(),
        rotation,
        Law::Constant,
        vec![[0.0, 0.0], [1.0, 0.0]],
        Vec::new(),
    );
    let shaking = TurningShaking::new(shaking, None).unwrap();
    varying::simulate(&block, &turning, None, &shaking, start, OPTIONS, wanted)
}

/// Times and rates of rotation, before and after, of the first impacts.
fn impacts(run: &Run) -> Vec<(f64, f64, f64)> {
    let rate = |velocity: &Vector| (velocity[TOE] - velocity[HEEL]) / SLENDER.width;
    let struck = run
        .events
        .iter()
        .filter(|event| matches!(event.kind, EventKind::HeelStrikes | EventKind::ToeStrikes));
    struck
        .map(|event| (event.time, rate(&event.approach), rate(&event.velocity)))
        .collect()
}

#[test]
fn small_rotations_fall_in_a_parabola() {
    let torque = p_squared() * alpha().sin();
    for run in [rock(None), rock(Some(Rotation::Small))] {
        near(impacts(&run)[0].0, (2.0 * TILT / torque).sqrt(), 1e-12);
    }
}

#[test]
fn its_half_periods_and_impacts_are_housners() {
    let (limit, rate) = (alpha().tan(), (p_squared() * alpha().cos()).sqrt());
    let kept = 1.0 - 1.5 * alpha().sin().powi(2);
    let found = impacts(&rock(Some(Rotation::PDelta)));
    let quarter = |tilt: f64| (1.0 / (1.0 - tilt / limit)).acosh() / rate;
    let mut tilt = TILT;
    let mut moment = quarter(tilt);
    for (n, (time, before, after)) in found.into_iter().take(6).enumerate() {
        near(time, moment, 1e-10);
        near(after / before, kept, 1e-10);
        // As far again as the energy that is left carries it: (1 - t / limit)^2 of the next tilt.
        let left = kept * kept * (1.0 - (1.0 - tilt / limit).powi(2));
        let next = limit * (1.0 - (1.0 - left).sqrt());
        assert!(next < tilt, "{n}");
        tilt = next;
        moment += 2.0 * quarter(tilt);
    }
}

#[test]
fn a_large_rotation_falls_in_the_time_of_its_energy_integral() {
    // t = t0 - s^2 takes the root out of dt = dt / sqrt(2 p^2 (cos(alpha - t0) - cos(alpha - t))) at the start.
    let slow = |s: f64| {
        let way = if s == 0.0 {
            (alpha() - TILT).sin()
        } else {
            ((alpha() - TILT).cos() - (alpha() - TILT + s * s).cos()) / (s * s)
        };
        2.0 / (2.0 * p_squared() * way).sqrt()
    };
    let (parts, end) = (2000, TILT.sqrt());
    let step = end / f64::from(parts);
    let simpson = |k: i32| [4.0, 2.0][usize::from(k % 2 == 0)] * slow(f64::from(k) * step);
    let quarter = step / 3.0 * (slow(0.0) + slow(end) + (1..parts).map(simpson).sum::<f64>());
    let (time, before, after) = impacts(&rock(Some(Rotation::Finite)))[0];
    near(time, quarter, 1e-8);
    let speed = (2.0 * p_squared() * ((alpha() - TILT).cos() - alpha().cos())).sqrt();
    near(before, speed, 1e-8);
    near(after / before, 1.0 - 1.5 * alpha().sin().powi(2), 1e-8);
}

#[test]
fn newtons_restitution_sets_the_corner_that_strikes() {
    let bouncing = Rectangle {
        restitution: 0.3,
        ..SLENDER
    };
    let block = Block::new(&bouncing.numbers());
    let (time, still) = ([0.0, 3.0], [0.0, 0.0]);
    let shaking = Shaking::new(&time, &still, None).unwrap();
    let wanted = Wanted {
        events: true,
        ..Wanted::default()
    };
    let start = Some([[0.0, TILT, 0.0], [0.0; 3]]);
    let run = exact::simulate(&block, &shaking, start, OPTIONS, wanted);
    let strike = run
        .events
        .iter()
        .find(|event| event.kind == EventKind::HeelStrikes)
        .unwrap();
    near(
        strike.velocity[HEEL],
        -bouncing.restitution * strike.approach[HEEL],
        1e-12,
    );
    let work: f64 = (0..3)
        .map(|k| strike.impulse[k] * (strike.approach[k] + strike.velocity[k]) / 2.0)
        .sum();
    near(strike.energy_lost, -work, 1e-12 * work.abs());
    let before = bouncing.about_corner() / 2.0 * (strike.approach[HEEL] / bouncing.width).powi(2);
    assert!(strike.energy_lost > 0.0 && strike.energy_lost < before);
}
