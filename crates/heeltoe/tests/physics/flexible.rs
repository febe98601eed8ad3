//! The steps of the flexible model where they are simple: a mass on two nodes, held by a spring along the crack.
//!
//! Its modes are the mean and the difference of both nodes along and across the crack; so the two nodes are two contacts
//! that say different things, while nothing but the means ever moves:
//!
//! ```text
//! m x'' + c x' + k x = -m a_x + p_t,      m z'' = -W - m a_z + p_n,      z >= 0,  |p_t| <= mu p_n
//! ```

use heeltoe::flexible::{
    many, simulate, Dam, Line, Modes, ReducedBody, RockingThresholds, Run, Scheme, Shaking, State, Wanted,
};
use heeltoe::friction::Law;
use heeltoe::stop::Stop;

use crate::numbers::{near, GRAVITY};

/// A mass on two nodes.
#[derive(Clone)]
pub struct Pair {
    pub mass: f64,
    /// Circular frequencies along and across the crack (1/s).
    pub omega: [f64; 2],
    /// Share of critical damping along the crack.
    pub damping: f64,
    /// Where the spring along the crack is let go (m).
    pub pulled: f64,
    pub friction: f64,
    pub law: Option<Law>,
    /// Above the plane (m).
    pub gap: f64,
}

impl Pair {
    /// Nothing but its weight.
    pub const FREE: Pair = Pair {
        mass: 5000.0,
        omega: [0.0, 0.0],
        damping: 0.0,
        pulled: 0.0,
        friction: 0.3,
        law: None,
        gap: 0.0,
    };

    pub fn shaking<'a>(&self, ground: &'a [[f64; 2]], dt: f64) -> Shaking<'a> {
        Shaking {
            ground,
            dt,
            scale: [1.0; 2],
            rising: &[],
            across: None,
        }
    }
}

pub fn pair_of_nodes(pair: &Pair) -> Dam {
    let root = pair.mass.sqrt();
    let share = 1.0 / root;
    // Means along and across, differences along and across.
    let omega_squared = [pair.omega[0].powi(2), pair.omega[1].powi(2), 4e4, 4e4];
    let damping = [2.0 * pair.damping * pair.omega[0], 0.0, 0.0, 0.0];
    let shapes = [
        [share, share, 0.0, 0.0],
        [0.0, 0.0, share, share],
        [-share, share, 0.0, 0.0],
        [0.0, 0.0, -share, share],
    ];
    let modes = Modes {
        omega_squared: &omega_squared,
        damping: [&damping; 2],
        load: &[0.0, -GRAVITY * root, 0.0, 0.0],
        participation: [&[root, 0.0, 0.0, 0.0], &[0.0, root, 0.0, 0.0]],
        start: &[pair.pulled * root, 0.0, 0.0, 0.0],
        shapes: shapes.as_flattened(),
        position: &[pair.pulled, 10.0 + pair.pulled, pair.gap, pair.gap],
        directions: 2,
        dampers: &[],
        damper_signs: &[],
        wet: &[],
        boundary: &[],
    };
    let line = Line::only([2, 0], [pair.friction; 2], RockingThresholds::default());
    let dam = Dam {
        bodies: vec![ReducedBody::new(&modes).unwrap()],
        cracks: vec![Line {
            law: pair.law.clone(),
            ..line
        }],
        contactors: 1,
        reservoir: None,
        still: None,
    };
    dam.check().unwrap();
    dam
}

fn shake(pair: &Pair, ground: &[[f64; 2]], dt: f64, theta: f64) -> Run {
    let wanted = Wanted {
        stride: 1,
        ..Wanted::default()
    };
    simulate(
        &pair_of_nodes(pair),
        &pair.shaking(ground, dt),
        &Scheme::Exact(theta),
        wanted,
    )
}

/// Slips at all frames.
fn slips(run: &Run) -> Vec<f64> {
    let column = heeltoe::flexible::Frames::FIELDS
        .iter()
        .position(|name| *name == "slip")
        .unwrap();
    run.frames.rows.iter().map(|row| row[column]).collect()
}

/// Ground accelerations of so many steps: waves along and across.
pub fn waves(steps: u32, dt: f64, size: f64) -> Vec<[f64; 2]> {
    let wave = |t: f64, a: f64, b: f64| size * GRAVITY * ((a * t).sin() + 0.7 * (b * t + 1.0).sin());
    (0..steps)
        .map(|k| (f64::from(k) + 0.5) * dt)
        .map(|t| [wave(t, 9.0, 23.0), 1.3 * wave(t, 13.0, 31.0)])
        .collect()
}

#[test]
fn friction_takes_the_same_off_every_swing_of_a_spring() {
    // Every half swing ends 2 mu W / k nearer, until the spring no longer overcomes friction.
    let pair = Pair {
        omega: [10.0, 0.0],
        pulled: 0.32,
        ..Pair::FREE
    };
    let nearer = 2.0 * pair.friction * GRAVITY / pair.omega[0].powi(2);
    let half = std::f64::consts::PI / pair.omega[0];
    let steps = 2000;
    let dt = half / f64::from(steps);
    let run = shake(&pair, &vec![[0.0; 2]; 8 * steps as usize], dt, 0.5);
    let found = slips(&run);
    let (mut place, mut side) = (pair.pulled, 1.0);
    for swing in 1..=5_usize {
        place = -side * (side * place - nearer);
        side = -side;
        near(found[swing * steps as usize], place - pair.pulled, 1e-6);
    }
    // 0.32 - 5 x 0.05886 = 0.0257 < 0.0294: there it stays.
    near(run.cracks[0].slip, place - pair.pulled, 1e-6);
    assert_eq!(run.cracks[0].final_state, State::Rest);
}

#[test]
fn without_contact_it_swings_as_an_oscillator_does() {
    let pair = Pair {
        omega: [12.0, 5.0],
        damping: 0.05,
        gap: 50.0,
        ..Pair::FREE
    };
    let (push, steps) = (2.0, 4000);
    let dt = 1.0 / f64::from(steps);
    let run = shake(&pair, &vec![[-push, 0.0]; steps as usize], dt, 0.5);
    let omega = pair.omega[0];
    let damped = omega * (1.0 - pair.damping.powi(2)).sqrt();
    for (k, slip) in slips(&run).into_iter().enumerate().step_by(500) {
        let t = k as f64 * dt;
        let ratio = pair.damping * omega / damped;
        let fade = (-pair.damping * omega * t).exp() * ((damped * t).cos() + ratio * (damped * t).sin());
        near(slip, push / omega.powi(2) * (1.0 - fade), 1e-7);
    }
    assert_eq!(run.cracks[0].impacts, 0);
}

/// The scheme written out for the two means, which the modes, groups and contact problem of the kernel come down to.
struct Twin {
    omega_squared: [f64; 2],
    damping: [f64; 2],
    load: [f64; 2],
    place: [f64; 2],
    speed: [f64; 2],
    /// From where the springs pull.
    pulled: [f64; 2],
    friction: f64,
}

impl Twin {
    fn step(&mut self, ground: [f64; 2], dt: f64, theta: f64) {
        let late = 1.0 - theta;
        let answer = [0, 1].map(|k| {
            1.0 / (1.0 + theta * dt * self.damping[k] + theta * theta * dt * dt * self.omega_squared[k])
        });
        let free: [f64; 2] = [0, 1].map(|k| {
            let (x, v) = (self.place[k] + self.pulled[k], self.speed[k]);
            let force = self.load[k]
                - ground[k]
                - self.damping[k] * late * v
                - self.omega_squared[k] * (x + dt * theta * late * v);
            answer[k] * (v + dt * force)
        });
        let room = (self.place[1].max(0.0) / dt).max(late / theta * self.speed[1]);
        let push = ((-room - free[1]) / answer[1]).max(0.0);
        let hold = -free[0] / answer[0];
        let rub = hold.clamp(-self.friction * push, self.friction * push);
        for (k, impulse) in [rub, push].into_iter().enumerate() {
            let new = free[k] + answer[k] * impulse;
            self.place[k] += dt * (theta * new + late * self.speed[k]);
            self.speed[k] = new;
        }
    }
}

#[test]
fn it_sticks_slips_lifts_and_lands_as_its_twin_does() {
    for (theta, omega) in [(0.5, [15.0, 0.0]), (0.6, [15.0, 20.0]), (1.0, [0.0, 8.0])] {
        let pair = Pair {
            omega,
            damping: 0.04,
            ..Pair::FREE
        };
        let (steps, dt) = (4000, 0.001);
        let ground = waves(steps, dt, 0.7);
        let run = shake(&pair, &ground, dt, theta);
        let mut twin = Twin {
            omega_squared: omega.map(|omega| omega * omega),
            damping: [2.0 * pair.damping * omega[0], 0.0],
            load: [0.0, -GRAVITY],
            place: [0.0; 2],
            speed: [0.0; 2],
            pulled: [0.0; 2],
            friction: pair.friction,
        };
        let mut lifted: u32 = 0;
        for (k, (ground, slip)) in ground.iter().zip(&slips(&run)[1..]).enumerate() {
            twin.step(*ground, dt, theta);
            near(*slip, twin.place[0], 1e-10);
            near(run.frames.upper[0][4 * (k + 1) + 2], twin.place[1], 1e-10);
            lifted += u32::from(twin.place[1] > 1e-4);
        }
        let crack = &run.cracks[0];
        assert!(
            crack.impacts > 4 && lifted > 100 && lifted < steps / 2,
            "{lifted} {crack:?}"
        );
        assert!(crack.slip_max - crack.slip_min > 0.01, "{crack:?}");
        assert!(crack.ledger.residual() < 1e-12, "{:?}", crack.ledger);
        assert!(
            crack.ledger.gained <= 1e-5 * crack.ledger.turnover,
            "{:?}",
            crack.ledger
        );
    }
}

#[test]
fn a_node_that_drops_does_not_rebound_and_its_energy_is_the_impacts() {
    let pair = Pair {
        gap: 0.1,
        ..Pair::FREE
    };
    let dt = 1e-4;
    let run = shake(&pair, &vec![[0.0; 2]; 4000], dt, 0.5);
    let crack = &run.cracks[0];
    let weight = pair.mass * GRAVITY;
    near(crack.impact_velocity, (2.0 * GRAVITY * pair.gap).sqrt(), 2e-3);
    // Within the step in which it lands its weight goes on working.
    near(
        crack.ledger.impact,
        weight * pair.gap,
        weight * crack.impact_velocity * dt,
    );
    near(crack.opening_upstream, pair.gap, GRAVITY * dt * dt);
    // It is held on velocities: half a step of its speed at most.
    assert!(
        crack.penetration <= 0.500_001 * crack.impact_velocity * dt,
        "{crack:?}"
    );
    assert_eq!(crack.impacts, 2, "both nodes, once");
}

#[test]
fn many_runs_are_the_bits_of_single_ones() {
    let pair = Pair {
        omega: [15.0, 0.0],
        ..Pair::FREE
    };
    let ground = waves(1000, 0.002, 0.5);
    let (dam, shaking) = (pair_of_nodes(&pair), pair.shaking(&ground, 0.002));
    let scales = [[0.5, 0.5], [1.0, 1.0], [2.0, 0.0]];
    let scheme = Scheme::Exact(0.6);
    for (run, scale) in many::run(&dam, &shaking, &scheme, &scales, Stop::default())
        .iter()
        .zip(scales)
    {
        let alone = simulate(&dam, &Shaking { scale, ..shaking }, &scheme, Wanted::default());
        assert_eq!(run[0].row(), alone.cracks[0].row());
    }
}
