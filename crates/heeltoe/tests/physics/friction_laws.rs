//! A block on a crack whose friction goes by a law, pushed by a ground that goes upstream with a constant `A`:
//!
//! ```text
//! linear in the slip:       s = c / l^2 (cosh(l t) - 1),  c = A - mu_p g,  l^2 = g (mu_p - mu_r) / D
//! exponential in the slip:  v^2 / 2 = (A - mu_r g) s - g (mu_p - mu_r) D (1 - exp(-s / D))
//! falling with the speed:   t = V / a ln((a exp(v / V) - b) / (a - b)),  a = A - mu_r g,  b = g (mu_p - mu_r)
//! ```

use heeltoe::flexible;
use heeltoe::friction::{Law, LawNumbers, Shape, Worn};
use heeltoe::inside::Law as WaterLaw;
use heeltoe::rigid::varying::{self, Rotation, Surface, TurningBlock, TurningShaking};
use heeltoe::rigid::{Block, Moment, Shaking, Wanted};

use crate::flexible::{pair_of_nodes, Pair};
use crate::numbers::{near, Rectangle, GRAVITY, OPTIONS, SLIP};

const FLAT: Rectangle = Rectangle {
    width: 10.0,
    height: 1.0,
    friction: 0.7,
    restitution: 0.0,
};
const PEAK: f64 = 0.7;
const RESIDUAL: f64 = 0.3;
const PUSH: f64 = 0.75 * GRAVITY;

fn law(shape: Shape, scale: f64) -> Law {
    let numbers = LawNumbers {
        peak: PEAK,
        residual: RESIDUAL,
        scale,
        ..LawNumbers::default()
    };
    Law::new(shape, &numbers, Vec::new())
}

/// The block at these moments of the push.
fn slide(law: &Law, times: &[f64]) -> Vec<Moment> {
    let block = Block::new(&FLAT.numbers());
    let pressure = vec![[0.0, 0.0], [FLAT.width, 0.0]];
    let turning = TurningBlock::new(
        &FLAT.varying(),
        Rotation::Small,
        WaterLaw::Constant,
        pressure,
        Vec::new(),
    );
    let (time, across) = ([0.0, 1.0], [-PUSH, -PUSH]);
    let shaking = TurningShaking::new(Shaking::new(&time, &across, None).unwrap(), None).unwrap();
    let surface = Surface {
        law,
        worn: Worn::FRESH,
        asperities: None,
    };
    let wanted = Wanted {
        times,
        ..Wanted::default()
    };
    varying::simulate(&block, &turning, Some(&surface), &shaking, None, OPTIONS, wanted).moments
}

const TIMES: [f64; 4] = [0.1, 0.25, 0.4, 0.6];

/// Slip and speed of the block whose friction falls in proportion to the slip, until all of it is lost.
fn weakening(scale: f64, time: f64) -> [f64; 2] {
    let start = PUSH - PEAK * GRAVITY;
    let growth = (GRAVITY * (PEAK - RESIDUAL) / scale).sqrt();
    let turn = (1.0 + scale * growth * growth / start).acosh() / growth;
    let early = time.min(turn);
    let slip = start / growth.powi(2) * ((growth * early).cosh() - 1.0);
    let speed = start / growth * (growth * early).sinh();
    let (late, gain) = (time - early, PUSH - RESIDUAL * GRAVITY);
    [slip + late * (speed + gain * late / 2.0), speed + gain * late]
}

#[test]
fn friction_that_falls_with_the_slip_lets_it_grow_as_a_hyperbolic_cosine() {
    let scale = 0.1;
    for (moment, time) in slide(&law(Shape::Linear, scale), &TIMES).iter().zip(TIMES) {
        let [slip, speed] = weakening(scale, time);
        near(moment.position[SLIP], slip, 1e-11);
        near(moment.velocity[SLIP], speed, 1e-11);
    }
    assert!(
        weakening(scale, TIMES[3])[0] > scale,
        "the last moment is behind the loss"
    );
}

#[test]
fn friction_that_falls_off_over_the_slip_keeps_the_energy() {
    let scale = 0.1;
    for moment in slide(&law(Shape::Exponential, scale), &TIMES) {
        let (slip, speed) = (moment.position[SLIP], moment.velocity[SLIP]);
        let worn = GRAVITY * (PEAK - RESIDUAL) * scale * (1.0 - (-slip / scale).exp());
        near(
            speed * speed / 2.0,
            (PUSH - RESIDUAL * GRAVITY) * slip - worn,
            1e-10,
        );
    }
}

#[test]
fn friction_that_falls_with_the_speed_takes_its_time() {
    let scale = 0.5;
    let (a, b) = (PUSH - RESIDUAL * GRAVITY, GRAVITY * (PEAK - RESIDUAL));
    for (moment, time) in slide(&law(Shape::Speed, scale), &TIMES).iter().zip(TIMES) {
        let speed = moment.velocity[SLIP];
        near(
            scale / a * ((a * (speed / scale).exp() - b) / (a - b)).ln(),
            time,
            1e-9,
        );
    }
}

#[test]
fn the_steps_of_the_flexible_model_come_to_the_same_slide() {
    let pair = Pair {
        law: Some(law(Shape::Linear, 0.2)),
        ..Pair::FREE
    };
    let dam = pair_of_nodes(&pair);
    let slip = |steps: u32| {
        let dt = 0.4 / f64::from(steps);
        let ground = vec![[-PUSH, 0.0]; steps as usize];
        flexible::simulate(
            &dam,
            &pair.shaking(&ground, dt),
            &flexible::Scheme::Exact(0.5),
            flexible::Wanted::default(),
        )
        .cracks[0]
            .slip
    };
    let expected = weakening(0.2, 0.4)[0];
    let apart = [400, 800].map(|steps| (slip(steps) - expected).abs());
    assert!(apart[1] < 1e-4 * expected, "{apart:?} of {expected}");
    assert!(apart[1] < 0.6 * apart[0], "{apart:?}");
}
