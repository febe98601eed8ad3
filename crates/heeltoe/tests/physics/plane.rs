//! The block that slides in the plane of its crack: closed forms, a plain stepper, and what no turn of the axes changes.
//!
//! The figures of the closed forms C1 to C6 were computed by independent programs; their formulas stand beside them.

use heeltoe::rigid::plane::{simulate, Across, CrossShaking};
use heeltoe::rigid::{
    exact, Block, BlockNumbers, Crossing, EventKind, Outcome, Run, Shaking, Vector, Wanted,
};

use crate::numbers::{near, random, OPTIONS, SLIP};

/// The programs that computed the figures.
const GRAVITY: f64 = 9.80665;

/// A slab that never lifts, of so much mass along the stream and 1 across.
pub fn slab(mass: f64, friction: [f64; 2], push: f64) -> BlockNumbers {
    BlockNumbers {
        mass_horizontal: mass,
        mass_vertical: 1.0,
        inertia: 100.0,
        height: 0.1,
        heel_distance: 500.0,
        toe_distance: 500.0,
        static_horizontal: push,
        static_vertical: -GRAVITY,
        static_moment: 0.1 * push,
        per_horizontal_horizontal: -mass,
        per_vertical_vertical: -1.0,
        per_horizontal_moment: -0.1 * mass,
        friction_static: friction[0],
        friction_kinetic: friction[1],
        ..BlockNumbers::default()
    }
}

pub const FREE: Across = Across {
    mass: 1.0,
    gap: [f64::INFINITY; 2],
    start: [0.0; 2],
};

/// Moments and ground accelerations along, across, up.
pub struct Ground {
    pub time: Vec<f64>,
    pub along: Vec<f64>,
    pub across: Vec<f64>,
    pub up: Option<Vec<f64>>,
}

impl Ground {
    /// The same accelerations all the time.
    pub fn steady([along, across]: [f64; 2], end: f64) -> Self {
        Ground {
            time: vec![0.0, end],
            along: vec![along; 2],
            across: vec![across; 2],
            up: None,
        }
    }

    fn run(&self, block: &BlockNumbers, across: &Across, thrown: bool, wanted: Wanted) -> Run {
        let level = Shaking::new(&self.time, &self.along, self.up.as_deref()).unwrap();
        let shaking = CrossShaking {
            level: &level,
            cross: &self.across,
        };
        let start: Option<[Vector; 2]> = thrown.then_some([[0.0; 3]; 2]);
        simulate(&Block::new(block), across, &shaking, start, OPTIONS, wanted)
    }
}

pub fn crossing(run: &Run) -> &Crossing {
    run.crossing.as_ref().unwrap()
}

fn events() -> Wanted<'static> {
    Wanted {
        events: true,
        ..Wanted::default()
    }
}

#[test]
fn c1_a_slab_thrown_across_is_carried_along_by_the_push() {
    // Stop at v0 R / (R^2 - f^2), x = v0^2 f / (4 (R^2 - f^2)), y = 2 v0^2 R / (4 R^2 - f^2).
    let (r, f) = (0.6 * GRAVITY, 0.2 * GRAVITY);
    let across = Across {
        start: [0.0, 1.0],
        ..FREE
    };
    let still = Ground::steady([0.0, 0.0], 1.0);
    let run = still.run(&slab(1.0, [0.6; 2], f), &across, true, events());
    near(run.summary.position[SLIP], f / (4.0 * (r * r - f * f)), 1e-13);
    near(run.summary.position[SLIP], 0.015933065827780, 1e-13);
    near(crossing(&run).position, 2.0 * r / (4.0 * r * r - f * f), 1e-13);
    near(crossing(&run).position, 0.087404246826680, 1e-13);
    let stop = run
        .events
        .iter()
        .find(|e| e.kind == EventKind::SlipStops)
        .unwrap();
    near(stop.time, 0.191196790, 1e-9);
}

#[test]
fn c2_two_masses_start_straight_by_the_secular_equation() {
    let run = Ground::steady([-1.2 / 1.5 * GRAVITY, -0.9 * GRAVITY], 1.0).run(
        &slab(1.5, [1.0; 2], 0.0),
        &FREE,
        true,
        Wanted::default(),
    );
    // The equation to 40 digits.
    near(run.summary.position[SLIP], 1.437_309_409_938_579_5, 1e-14);
    near(crossing(&run).position, 1.227_962_036_141_289, 1e-14);
    let speed = run.summary.velocity[SLIP].hypot(crossing(&run).velocity);
    near(speed, 3.780872440113, 5e-12);
    near(run.summary.velocity[SLIP] / speed, 0.760305687, 1e-9);
    near(crossing(&run).path, speed / 2.0, 1e-12);
}

/// A ground that goes round `rate` times a second with 1 g, for some seconds.
fn turning(rate: f64, end: f64, samples: usize) -> Ground {
    let time: Vec<f64> = (0..=samples).map(|k| k as f64 * end / samples as f64).collect();
    let angle = |t: &f64| 2.0 * std::f64::consts::PI * rate * t;
    Ground {
        along: time.iter().map(|t| -GRAVITY * angle(t).cos()).collect(),
        across: time.iter().map(|t| -GRAVITY * angle(t).sin()).collect(),
        time,
        up: None,
    }
}

#[test]
fn c3_a_turning_ground_keeps_a_steady_speed() {
    let run = turning(5.0, 10.0, 10_000).run(&slab(1.0, [0.6; 2], 0.0), &FREE, true, Wanted::default());
    let speed = run.summary.velocity[SLIP].hypot(crossing(&run).velocity);
    let omega = 10.0 * std::f64::consts::PI;
    // The samples are joined by straight lines: of the amplitude sinc^2(omega dt / 2) is left.
    let half = omega * 1e-3 / 2.0;
    let left = (half.sin() / half).powi(2);
    near(speed, (left * left - 0.36).sqrt() * GRAVITY / omega, 3e-9);
    near(speed, 0.2497243, 2e-4 * 0.2497243);
}

#[test]
fn c4_a_small_push_drifts_along_and_across_on_a_turning_ground() {
    let ground = turning(5.0, 12.0, 24_000);
    let whole: Vec<f64> = (0..=60).map(|k| 0.2 * f64::from(k)).collect();
    let wanted = Wanted {
        times: &whole,
        ..Wanted::default()
    };
    let drift = |push: f64| {
        let run = ground.run(&slab(1.0, [0.6; 2], push * GRAVITY), &FREE, true, wanted);
        let kept = &crossing(&run).kept;
        let place = |k: usize| [run.moments[k].position[SLIP], kept[k][0]];
        let (a, b) = (place(30), place(59));
        [0, 1].map(|i| (b[i] - a[i]) / (whole[59] - whole[30]))
    };
    let (with, without) = (drift(0.006), drift(0.0));
    near(with[0] - without[0], 4.99449e-3, 5e-6);
    near((with[1] - without[1]).abs(), 9.36466e-4, 9.4e-6);
}

#[test]
fn c5_fast_shaking_across_lets_a_small_push_creep() {
    // f / R = (2 / pi) (r / sqrt(1 + r^2)) K(1 / (1 + r^2)), r = v / V: 0.02164 m/s of 0.05, 0.4877 m/s of 0.5.
    let samples = 20_000;
    let (amplitude, omega, end) = (100.0 * GRAVITY, 200.0 * std::f64::consts::PI, 2.0);
    let time: Vec<f64> = (0..=samples)
        .map(|k| f64::from(k) * end / f64::from(samples))
        .collect();
    let ground = Ground {
        along: vec![0.0; time.len()],
        across: time.iter().map(|t| amplitude * (omega * t).cos()).collect(),
        time,
        up: None,
    };
    for (push, speed) in [(0.05, 0.02164), (0.5, 0.4877)] {
        let wanted = [1.8, 2.0];
        let wanted = Wanted {
            times: &wanted,
            ..Wanted::default()
        };
        let run = ground.run(&slab(1.0, [0.6; 2], 0.6 * push * GRAVITY), &FREE, true, wanted);
        let mean = (run.moments[1].position[SLIP] - run.moments[0].position[SLIP]) / 0.2;
        near(mean, speed, 0.004 * speed);
    }
}

#[test]
fn c6_a_neighbour_stops_it_across_and_friction_is_left_along() {
    // Wall at t1 = sqrt(2 d / (A e_y)), one-dimensional from there on.
    let across = Across {
        gap: [0.05, f64::INFINITY],
        ..FREE
    };
    let push = [-0.7 * GRAVITY, -0.8 * GRAVITY];
    let run = Ground::steady(push, 1.0).run(&slab(1.0, [0.6; 2], 0.0), &across, true, events());
    near(run.summary.position[SLIP], 0.804666568620, 1e-12);
    let c = crossing(&run);
    assert_eq!((c.position, c.side_strikes), (0.05, 1));
    let force = 0.7_f64.hypot(0.8);
    let strike = (0.1 / (0.8 / force * (force - 0.6) * GRAVITY)).sqrt();
    near(run.events.last().unwrap().time, strike, 1e-12);
    near(c.time_at_side, 1.0 - strike, 1e-12);
    let speed = (2.0 * 0.05 * 0.8 / force * (force - 0.6) * GRAVITY).sqrt();
    near(c.side_impulse, speed + 0.8 * GRAVITY * (1.0 - strike), 1e-11);
}

#[test]
fn c7_a_force_that_grows_past_friction_begins_by_the_onset() {
    // F = (R + j t, k t): x = j t^3 / 6, y = j k t^4 / (8 R), to a relative O(t).
    let (r, j, k) = (0.6 * GRAVITY, 2.0, 1.5);
    for end in [1e-3, 1e-4] {
        let ground = Ground {
            time: vec![0.0, end],
            along: vec![-r, -r - j * end],
            across: vec![0.0, -k * end],
            up: None,
        };
        let run = ground.run(&slab(1.0, [0.6; 2], 0.0), &FREE, true, Wanted::default());
        let (x, y) = (j * end.powi(3) / 6.0, j * k * end.powi(4) / (8.0 * r));
        near(run.summary.position[SLIP], x, end * x);
        near(crossing(&run).position, y, 2.0 * end * y);
    }
}

/// A shaking of random samples, 0.01 s apart.
pub fn shaken(seed: u64, strength: f64, samples: usize, vertical: bool) -> Ground {
    let mut next = random(seed);
    let mut series = |size: f64| -> Vec<f64> {
        let mut value = 0.0;
        (0..samples)
            .map(|_| {
                value = 0.8 * value + size * (next() - 0.5);
                value
            })
            .collect()
    };
    let along = series(strength * GRAVITY);
    let across = series(strength * GRAVITY);
    let up = vertical.then(|| series(0.4 * strength * GRAVITY));
    Ground {
        time: (0..samples).map(|k| k as f64 * 0.01).collect(),
        along,
        across,
        up,
    }
}

#[test]
fn a_turn_of_both_components_turns_the_slip() {
    let block = slab(1.0, [0.4; 2], 0.0);
    let ground = shaken(3, 1.5, 1500, false);
    let run = ground.run(&block, &FREE, false, Wanted::default());
    let [x, y] = [run.summary.position[SLIP], crossing(&run).position];
    assert!(x.hypot(y) > 0.01, "{x} {y}");
    for angle in [0.3_f64, 1.7, 4.0] {
        let (s, c) = angle.sin_cos();
        let both = || ground.along.iter().zip(&ground.across);
        let turned = Ground {
            time: ground.time.clone(),
            along: both().map(|(a, b)| c * a - s * b).collect(),
            across: both().map(|(a, b)| s * a + c * b).collect(),
            up: None,
        };
        let run = turned.run(&block, &FREE, false, Wanted::default());
        near(run.summary.position[SLIP], c * x - s * y, 1e-11);
        near(crossing(&run).position, s * x + c * y, 1e-11);
    }
}

#[test]
fn a_mirror_across_the_valley_keeps_the_bits_of_the_slip_along() {
    let block = slab(1.6, [0.5, 0.4], 1.5);
    for gap in [[f64::INFINITY; 2], [0.002, 0.01]] {
        let ground = shaken(5, 1.5, 1500, true);
        let across = Across { gap, ..FREE };
        let mirrored = Across {
            gap: [gap[1], gap[0]],
            ..FREE
        };
        let run = ground.run(&block, &across, false, Wanted::default());
        let mirror = Ground {
            across: ground.across.iter().map(|a| -a).collect(),
            time: ground.time.clone(),
            along: ground.along.clone(),
            up: ground.up.clone(),
        };
        let other = mirror.run(&block, &mirrored, false, Wanted::default());
        assert_eq!(run.summary.outcome, Outcome::Done);
        assert_eq!(run.summary.position, other.summary.position);
        assert_eq!(crossing(&run).position, -crossing(&other).position);
        assert_eq!(crossing(&run).path.to_bits(), crossing(&other).path.to_bits());
    }
}

#[test]
fn a_ground_that_is_still_across_gives_the_bits_of_the_exact_walk() {
    let block = slab(1.6, [0.5, 0.4], 1.5);
    let ground = Ground {
        across: vec![0.0; 1500],
        ..shaken(7, 1.5, 1500, true)
    };
    let run = ground.run(&block, &FREE, false, events());
    let level = Shaking::new(&ground.time, &ground.along, ground.up.as_deref()).unwrap();
    let one = exact::simulate(&Block::new(&block), &level, None, OPTIONS, events());
    assert_eq!(
        run.summary.row().map(f64::to_bits),
        one.summary.row().map(f64::to_bits)
    );
    assert_eq!(run.events.len(), one.events.len());
    let held = Across {
        gap: [0.0; 2],
        ..FREE
    };
    let held = shaken(7, 1.5, 1500, true).run(&block, &held, false, events());
    assert_eq!(
        held.summary.row().map(f64::to_bits),
        one.summary.row().map(f64::to_bits)
    );
}

/// Where a plain stepper of step h puts the block: free motion, then the impulse of friction, at most mu N h, that
/// slows it down most; the neighbours stop it.
fn plain(block: &BlockNumbers, across: &Across, ground: &Ground, steps: usize) -> [f64; 2] {
    let friction = [block.friction_static, block.friction_kinetic];
    plain_by(block, across, ground, steps, |rests, _, _| {
        friction[usize::from(!rests)]
    })
}

/// The same with a coefficient of friction by whether the block rests, its path and its speed.
pub fn plain_by(
    block: &BlockNumbers,
    across: &Across,
    ground: &Ground,
    steps: usize,
    friction: impl Fn(bool, f64, f64) -> f64,
) -> [f64; 2] {
    let mut path = 0.0;
    let mut u = [0.0_f64; 2];
    let mut q = [0.0_f64; 2];
    let mass = [block.mass_horizontal, across.mass];
    let mut rests = true;
    for k in 1..ground.time.len() {
        let h = (ground.time[k] - ground.time[k - 1]) / steps as f64;
        for j in 0..steps {
            let part = (j as f64 + 0.5) / steps as f64;
            let at = |series: &[f64]| series[k - 1] + part * (series[k] - series[k - 1]);
            let up = ground.up.as_ref().map_or(0.0, |up| at(up));
            let force = [
                block.static_horizontal - block.mass_horizontal * at(&ground.along),
                -across.mass * at(&ground.across),
            ];
            let normal = -block.static_vertical + block.mass_vertical * up;
            let speed = u[0].hypot(u[1]);
            let mu = friction(rests, path, speed);
            let free = [0, 1].map(|i| u[i] + h * force[i] / mass[i]);
            let limit = mu * normal * h;
            let lies = across.gap[0] <= q[1] && free[1] > 0.0 || -across.gap[1] >= q[1] && free[1] < 0.0;
            let free = if lies { [free[0], 0.0] } else { free };
            let needed = (mass[0] * free[0]).hypot(mass[1] * free[1]);
            if needed <= limit {
                u = [0.0; 2];
                rests = true;
            } else {
                let rub = friction(false, path, speed) * normal * h;
                // u = (M + l)^-1 M free with l |u| = rub.
                let (mut least, mut most) = (0.0, 1e4);
                let slowed = |l: f64| [0, 1].map(|i| mass[i] * free[i] / (mass[i] + l));
                for _ in 0..60 {
                    let l = 0.5 * (least + most);
                    let v = slowed(l);
                    if l * v[0].hypot(v[1]) < rub {
                        least = l;
                    } else {
                        most = l;
                    }
                }
                u = slowed(least);
                rests = false;
            }
            path += h * u[0].hypot(u[1]);
            q = [q[0] + h * u[0], q[1] + h * u[1]];
            q[1] = q[1].clamp(-across.gap[1], across.gap[0]);
        }
    }
    q
}

#[test]
fn random_slabs_go_where_a_plain_stepper_puts_them() {
    let mut next = random(11);
    for seed in 0..6 {
        let mass = 1.0 + next();
        let friction = 0.3 + 0.4 * next();
        let block = slab(mass, [friction; 2], 0.5 * friction * GRAVITY * next());
        let gap = if seed % 2 == 0 {
            [f64::INFINITY; 2]
        } else {
            [0.004 * next(), 0.01 * next()]
        };
        let across = Across { gap, ..FREE };
        let ground = shaken(20 + seed, 1.6, 400, seed % 3 != 0);
        let run = ground.run(&block, &across, false, Wanted::default());
        assert_eq!(run.summary.outcome, Outcome::Done);
        let energy = run.summary.ledger.residual(run.summary.kinetic_energy);
        assert!(energy < 1e-9, "{seed}: {energy:e}");
        let ours = [run.summary.position[SLIP], crossing(&run).position];
        // Of first order: four times the step, four times the error.
        let [coarse, fine] = [50, 200].map(|steps| plain(&block, &across, &ground, steps));
        for i in 0..2 {
            near(ours[i], fine[i], 2e-5 + (fine[i] - coarse[i]).abs());
        }
    }
}

#[test]
fn what_cannot_be_run_is_refused() {
    let ground = Ground::steady([1.0, 1.0], 1.0);
    let level = Shaking::new(&ground.time, &ground.along, None).unwrap();
    let run = |cross: &[f64], across: &Across, block: &BlockNumbers| {
        let shaking = CrossShaking { level: &level, cross };
        across.check(&Block::new(block), &shaking)
    };
    let block = slab(1.0, [0.6; 2], 0.0);
    assert!(run(&[1.0], &FREE, &block).is_err());
    let massless = Across { mass: 0.0, ..FREE };
    assert!(run(&[1.0; 2], &massless, &block).is_err());
    let coupled = BlockNumbers {
        coupling_horizontal_vertical: 0.1,
        ..block
    };
    assert!(run(&[1.0; 2], &FREE, &coupled).is_err());
}

#[test]
fn random_slabs_close_their_books() {
    let mut next = random(17);
    for seed in 0..300 {
        let (friction, mass) = (0.2 + 0.6 * next(), 1.0 + next());
        let kinetic = friction * if seed % 2 == 0 { 1.0 } else { 0.7 + 0.3 * next() };
        let block = slab(
            mass,
            [friction, kinetic],
            0.9 * kinetic * GRAVITY * (next() - 0.3),
        );
        let gap = if seed % 3 == 0 {
            [f64::INFINITY; 2]
        } else {
            [0.01 * next(), if seed % 3 == 1 { 0.0 } else { 0.01 * next() }]
        };
        let mut ground = shaken(100 + seed, 2.0 * next(), 150, seed % 5 < 3);
        // Still for a while, along or across, and a jump.
        if seed % 4 == 1 {
            ground.across[60..100].fill(0.0);
        }
        if seed % 4 == 2 {
            ground.along[60..100].fill(0.0);
        }
        ground.time[80] = ground.time[79];
        let across = Across { gap, ..FREE };
        let run = ground.run(&block, &across, false, Wanted::default());
        let (s, c) = (&run.summary, crossing(&run));
        assert_eq!(s.outcome, Outcome::Done, "{seed}");
        assert!(
            s.row().iter().chain(&c.row()).all(|value| value.is_finite()),
            "{seed}"
        );
        let residual = s.ledger.residual(s.kinetic_energy);
        assert!(residual < 1e-11, "{seed}: {residual:e}");
        assert!(c.range[0] >= -gap[1] && c.range[1] <= gap[0], "{seed}");
        assert!(
            c.path >= s.position[SLIP].hypot(c.position) * (1.0 - 1e-12),
            "{seed}"
        );
    }
}
