//! The block that rocks while the ground shakes along the stream and across the valley: figures of independent programs,
//! a plain stepper, flight, impacts, its books.

use heeltoe::rigid::plane::{simulate, Across, CrossShaking};
use heeltoe::rigid::{Block, BlockNumbers, Crossing, EventKind, Outcome, Run, Shaking, Vector, Wanted};

use crate::numbers::{near, Dice, HEEL, OPTIONS, SLIP, TOE};

/// The programs that computed the figures.
const GRAVITY: f64 = 9.80665;

/// A block of 2500 kg/m3 on a level crack, without rebound unless it has some.
#[derive(Clone, Copy)]
struct Rectangle {
    width: f64,
    height: f64,
    friction: [f64; 2],
    restitution: f64,
}

impl Rectangle {
    fn mass(&self) -> f64 {
        2500.0 * self.width * self.height
    }

    fn numbers(&self) -> BlockNumbers {
        let mass = self.mass();
        BlockNumbers {
            mass_horizontal: mass,
            mass_vertical: mass,
            inertia: mass * (self.width.powi(2) + self.height.powi(2)) / 12.0,
            height: self.height / 2.0,
            heel_distance: self.width / 2.0,
            toe_distance: self.width / 2.0,
            static_vertical: -mass * GRAVITY,
            per_horizontal_horizontal: -mass,
            per_vertical_vertical: -mass,
            friction_static: self.friction[0],
            friction_kinetic: self.friction[1],
            restitution: self.restitution,
            ..BlockNumbers::default()
        }
    }

    fn across(&self) -> Across {
        Across {
            mass: self.mass(),
            gap: [f64::INFINITY; 2],
            start: [0.0; 2],
        }
    }
}

/// Moments and ground accelerations along, across, up.
#[derive(Clone)]
struct Ground {
    time: Vec<f64>,
    along: Vec<f64>,
    across: Vec<f64>,
    up: Option<Vec<f64>>,
}

impl Ground {
    fn run(&self, block: &BlockNumbers, across: &Across, start: Option<[Vector; 2]>, wanted: Wanted) -> Run {
        let level = Shaking::new(&self.time, &self.along, self.up.as_deref()).unwrap();
        let shaking = CrossShaking {
            level: &level,
            cross: &self.across,
        };
        simulate(&Block::new(block), across, &shaking, start, OPTIONS, wanted)
    }

    fn still(end: f64) -> Self {
        Ground {
            time: vec![0.0, end],
            along: vec![0.0; 2],
            across: vec![0.0; 2],
            up: None,
        }
    }
}

fn crossing(run: &Run) -> &Crossing {
    run.crossing.as_ref().unwrap()
}

/// A sine along and another one across for a second, sampled at 0.005 s.
fn sines(across: f64) -> Ground {
    let pi = std::f64::consts::PI;
    let time: Vec<f64> = (0..=400).map(|k| f64::from(k) * 0.005).collect();
    let shakes = |k: usize| k <= 200;
    let at = |k: usize, value: f64| if shakes(k) { value } else { 0.0 };
    let series = |value: &dyn Fn(f64) -> f64| -> Vec<f64> {
        time.iter().enumerate().map(|(k, t)| at(k, value(*t))).collect()
    };
    let along = series(&|t| GRAVITY * (4.0 * pi * t).sin());
    let mut cross = series(&|t| across * GRAVITY * (6.0 * pi * t + 0.5).sin());
    cross[0] = 0.0;
    Ground {
        along,
        across: cross,
        time,
        up: None,
    }
}

const SHAKEN: Rectangle = Rectangle {
    width: 2.0,
    height: 3.0,
    friction: [0.6; 2],
    restitution: 0.0,
};

#[test]
fn r1_a_block_that_slides_both_ways_does_not_rock() {
    let run = sines(0.8).run(&SHAKEN.numbers(), &SHAKEN.across(), None, Wanted::default());
    near(run.summary.position[SLIP], -23.136558856e-3, 1e-12);
    near(crossing(&run).position, 6.672569229e-3, 1e-12);
    assert_eq!(run.summary.rotation_range, [0.0; 2]);
    let alone = sines(0.0).run(&SHAKEN.numbers(), &SHAKEN.across(), None, Wanted::default());
    near(alone.summary.position[SLIP], 0.836019784e-3, 1e-12);
}

/// The block of R2: one that rocks.
const ROCKING: Rectangle = Rectangle {
    friction: [0.8; 2],
    ..SHAKEN
};

#[test]
fn r2_a_block_that_rocks_slides_on_its_corners_as_it_is_shaken_across() {
    let run = sines(0.5).run(&ROCKING.numbers(), &ROCKING.across(), None, Wanted::default());
    let s = &run.summary;
    assert_eq!(s.outcome, Outcome::Done);
    near(s.position[SLIP], 4.92780e-3, 2e-8);
    near(crossing(&run).position, 3.0468e-3, 1e-7);
    // To their last digit.
    near(s.rotation_range[1], 0.0359852, 1e-7);
    near(s.rotation_range[0], -0.0411941, 1e-7);
    assert!(s.slip_by_mode[3] != 0.0 && s.time_by_mode[2] > 1.0);
    assert!(s.ledger.residual(s.kinetic_energy) < 1e-13);
    let alone = sines(0.0).run(&ROCKING.numbers(), &ROCKING.across(), None, Wanted::default());
    assert_eq!(alone.summary.position[SLIP], 0.0);
    near(alone.summary.rotation_range[1], 0.0357880, 1e-7);
    near(alone.summary.rotation_range[0], -0.0432972, 1e-7);
}

/// Where a plain stepper of step h puts a block: free motion, then impulses of the corners that are closed and of
/// friction, at most mu times theirs, until all of them agree. Its slip, gaps and place across.
fn plain(block: &BlockNumbers, across: f64, ground: &Ground, h: f64) -> [f64; 4] {
    let masses = [block.mass_horizontal, block.mass_vertical, block.inertia];
    // Slip, heel gap, toe gap of downstream, upward, rotation.
    let rows = [
        [1.0, 0.0, block.height],
        [0.0, 1.0, -block.heel_distance],
        [0.0, 1.0, block.toe_distance],
    ];
    let moved = |i: usize, load: [f64; 3]| (0..3).map(|c| rows[i][c] * load[c] / masses[c]).sum::<f64>();
    let compliance = [0, 1, 2].map(|i| rows.map(|row| moved(i, row)));
    let still = [
        block.static_horizontal,
        block.static_vertical,
        block.static_moment,
    ];
    let sample = ground.time[1] - ground.time[0];
    let at = |series: &[f64], t: f64| {
        let k = ((t / sample) as usize).min(series.len() - 2);
        series[k] + (t / sample - k as f64) * (series[k + 1] - series[k])
    };
    let (mut v, mut q, mut p) = ([0.0_f64; 4], [0.0_f64; 4], [0.0_f64; 4]);
    let steps = (ground.time.last().unwrap() / h).round() as usize;
    let small = 1e-13 * h * block.mass_vertical * GRAVITY;
    for k in 0..steps {
        let t = (k as f64 + 0.5) * h;
        let up = ground.up.as_ref().map_or(0.0, |up| at(up, t));
        let mut load = still;
        load[0] += block.per_horizontal_horizontal * at(&ground.along, t);
        load[1] += block.per_vertical_vertical * up;
        let before = v;
        let mut free = [0, 1, 2, 3].map(|i| if i < 3 { v[i] + h * moved(i, load) } else { v[3] });
        free[3] -= h * at(&ground.across, t);
        let closed = [HEEL, TOE].map(|gap| q[gap] + 0.5 * h * before[gap] <= 0.0);
        if closed == [false; 2] {
            p = [0.0; 4];
        }
        let push = |i: usize, p: &[f64; 4]| (0..3).map(|j| compliance[i][j] * p[j]).sum::<f64>();
        for _ in 0..400 {
            let old = p;
            for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
                let short = free[gap] + push(gap, &p) + block.restitution * before[gap].min(0.0);
                let held = (p[gap] - short / compliance[gap][gap]).max(0.0);
                p[gap] = if closed[corner] { held } else { 0.0 };
            }
            let stiffest = compliance[SLIP][SLIP].max(1.0 / across);
            let wanted = [
                p[SLIP] - (free[SLIP] + push(SLIP, &p)) / stiffest,
                p[3] - (free[3] + p[3] / across) / stiffest,
            ];
            let limit = block.friction_kinetic * (p[HEEL] + p[TOE]);
            let part = (limit / wanted[0].hypot(wanted[1])).min(1.0);
            (p[SLIP], p[3]) = (wanted[0] * part, wanted[1] * part);
            if (0..4).map(|i| (p[i] - old[i]).abs()).sum::<f64>() <= small {
                break;
            }
        }
        v = [0, 1, 2, 3].map(|i| {
            let pushed = if i < 3 { push(i, &p) } else { p[3] / across };
            free[i] + pushed
        });
        for i in 0..4 {
            q[i] += 0.5 * h * (before[i] + v[i]);
        }
    }
    q
}

#[test]
fn a_block_and_a_dam_that_rock_go_where_a_plain_stepper_puts_them() {
    let mass = ROCKING.mass();
    let dam = BlockNumbers {
        mass_horizontal: 1.3 * mass,
        per_horizontal_horizontal: -1.3 * mass,
        static_horizontal: 0.1 * mass * GRAVITY,
        static_vertical: -0.8 * mass * GRAVITY,
        static_moment: -0.05 * mass * GRAVITY,
        ..ROCKING.numbers()
    };
    let shaken_up = Ground {
        up: Some(sines(0.4).across),
        ..sines(0.7)
    };
    for (block, ground) in [(ROCKING.numbers(), sines(0.5)), (dam, shaken_up)] {
        let run = ground.run(&block, &ROCKING.across(), None, Wanted::default());
        let s = &run.summary;
        let ours = [s.position[SLIP], crossing(&run).position];
        assert!(s.time_by_mode[3] > 0.05);
        // First order: an event up to a step too late shifts the block by no more than its velocity times that.
        for h in [1e-4, 2.5e-5] {
            let q = plain(&block, mass, &ground, h);
            near(q[SLIP], ours[0], 0.4 * h);
            near(q[3], ours[1], 0.4 * h);
        }
    }
}

/// Random samples 0.02 s apart, and a second of rest.
fn shaken(dice: &mut Dice, strength: f64, samples: usize, vertical: bool) -> Ground {
    let mut series = |size: f64| -> Vec<f64> {
        let mut value = 0.0;
        (0..samples)
            .map(|k| {
                value = 0.7 * value + size * dice.roll();
                if k + 50 > samples {
                    0.0
                } else {
                    value
                }
            })
            .collect()
    };
    Ground {
        along: series(strength * GRAVITY),
        across: series(strength * GRAVITY),
        up: vertical.then(|| series(0.3 * strength * GRAVITY)),
        time: (0..samples).map(|k| k as f64 * 0.02).collect(),
    }
}

#[test]
fn a_breath_across_leaves_the_motion_along_the_stream() {
    // Rocking, slide-rocking, flight and impacts of the exact walk, by the walk in the plane.
    let mut dice = Dice(5);
    let mut rocked = 0;
    for number in 0..40 {
        let block = Rectangle {
            width: 1.0,
            height: 2.2 + dice.roll(),
            friction: [0.7 + 0.3 * dice.roll(); 2],
            restitution: if number % 2 == 0 { 0.0 } else { 0.3 },
        };
        let ground = shaken(&mut dice, 0.8, 80, number % 3 == 0);
        let breath = Ground {
            across: ground.across.iter().map(|a| 1e-9 * a).collect(),
            ..ground.clone()
        };
        let still = Ground {
            across: vec![0.0; ground.time.len()],
            ..ground
        };
        let [one, two] = [&still, &breath]
            .map(|ground| ground.run(&block.numbers(), &block.across(), None, Wanted::default()));
        assert_eq!(one.summary.outcome, two.summary.outcome, "{number}");
        let (a, b) = (&one.summary, &two.summary);
        near(b.position[SLIP], a.position[SLIP], 1e-8);
        near(b.rotation_range[0], a.rotation_range[0], 1e-8);
        near(b.rotation_range[1], a.rotation_range[1], 1e-8);
        rocked += u32::from(a.time_by_mode[2] + a.time_by_mode[3] + a.time_by_mode[4] > 0.1);
    }
    assert!(rocked > 20, "{rocked}");
}

#[test]
fn in_flight_it_goes_on_across_as_the_ground_goes_back() {
    let block = Rectangle {
        restitution: 0.5,
        ..SHAKEN
    };
    let across = Across {
        start: [0.0, 0.3],
        ..block.across()
    };
    // Flat, 0.1 m up: down after sqrt(2 h / g).
    let start = [[0.0, 0.1, 0.1], [0.2, 0.0, 0.0]];
    let falls = (0.2_f64 / GRAVITY).sqrt();
    let ground = Ground {
        across: vec![1.0, 1.0 + falls],
        ..Ground::still(falls * 0.999)
    };
    let run = ground.run(&block.numbers(), &across, Some(start), Wanted::default());
    let t = falls * 0.999;
    let jerk = falls / t;
    near(
        crossing(&run).position,
        0.3 * t - t * t / 2.0 - jerk * t * t * t / 6.0,
        1e-15,
    );
    near(run.summary.position[SLIP], 0.2 * t, 1e-15);
    assert_eq!(run.summary.slip_by_mode[4], run.summary.position[SLIP]);
    assert_eq!(crossing(&run).path, 0.0);
}

#[test]
fn a_block_that_lands_flat_as_it_moves_across_loses_friction_times_the_blow() {
    // u2 = u1 (1 - mu v / |u1|), v the velocity of the fall; it sticks where that is negative.
    let fall = (2.0 * GRAVITY * 0.1_f64).sqrt();
    for (u, sticks) in [([1.2, -0.9], false), ([0.3, 0.2], true)] {
        let across = Across {
            start: [0.0, u[1]],
            ..SHAKEN.across()
        };
        let start = [[0.0, 0.1, 0.1], [u[0], 0.0, 0.0]];
        let wanted = Wanted {
            events: true,
            ..Wanted::default()
        };
        let end = (0.2_f64 / GRAVITY).sqrt() + 1e-9;
        let run = Ground::still(end).run(&SHAKEN.numbers(), &across, Some(start), wanted);
        let left = (1.0 - 0.6 * fall / u[0].hypot(u[1])).max(0.0);
        assert_eq!(left == 0.0, sticks);
        let s = &run.summary;
        near(s.velocity[SLIP], u[0] * left, 1e-8);
        near(crossing(&run).velocity, u[1] * left, 1e-8);
        let blow = run
            .events
            .iter()
            .find(|e| e.kind == EventKind::BothStrike)
            .unwrap();
        let mass = SHAKEN.mass();
        let speeds = |part: f64| 0.5 * mass * part * part * (u[0] * u[0] + u[1] * u[1]);
        let lost = 0.5 * mass * fall * fall + speeds(1.0) - speeds(left);
        near(blow.energy_lost, lost, 1e-10 * lost);
    }
}

#[test]
fn a_mirror_across_the_valley_keeps_the_bits_of_a_block_that_rocks() {
    let mut dice = Dice(9);
    for number in 0..20 {
        let block = Rectangle {
            friction: [0.7 + 0.2 * dice.roll(); 2],
            restitution: 0.2,
            ..SHAKEN
        };
        let ground = shaken(&mut dice, 1.0, 100, number % 2 == 0);
        let mirror = Ground {
            across: ground.across.iter().map(|a| -a).collect(),
            ..ground.clone()
        };
        let gap = [f64::INFINITY, 0.002];
        let across = Across {
            gap,
            ..block.across()
        };
        let mirrored = Across {
            gap: [gap[1], gap[0]],
            ..across
        };
        let run = ground.run(&block.numbers(), &across, None, Wanted::default());
        let other = mirror.run(&block.numbers(), &mirrored, None, Wanted::default());
        assert_eq!(
            run.summary.row().map(f64::to_bits),
            other.summary.row().map(f64::to_bits)
        );
        assert_eq!(crossing(&run).position, -crossing(&other).position);
    }
}

#[test]
fn random_blocks_that_rock_close_their_books() {
    let mut dice = Dice(21);
    let mut rocked = 0;
    for number in 0..300 {
        let kinetic = 0.8 + 0.6 * dice.roll();
        let friction = [kinetic * [1.0, 1.2][number % 2], kinetic];
        let block = Rectangle {
            width: 1.0,
            height: 2.0 + 1.5 * dice.roll(),
            friction,
            restitution: [0.0, 0.4, 0.8][number % 3],
        };
        let mut numbers = block.numbers();
        // Water before and under it, as of a dam.
        if number % 4 == 0 {
            let mass = block.mass();
            numbers.mass_horizontal = 1.5 * mass;
            numbers.per_horizontal_horizontal = -1.5 * mass;
            numbers.static_horizontal = 0.1 * mass * GRAVITY;
            numbers.static_vertical = -0.7 * mass * GRAVITY;
            numbers.static_moment = -0.02 * mass * GRAVITY;
        }
        let gap = [f64::INFINITY, 0.01][number % 2];
        let across = Across {
            gap: [gap, 2.0 * gap],
            ..block.across()
        };
        let mut ground = shaken(&mut dice, 0.8, 120, number % 5 < 3);
        ground.time[40] = ground.time[39];
        if number % 7 == 0 {
            ground.across[20..60].fill(0.0);
        }
        let times: Vec<f64> = (0..50).map(|k| 0.05 * f64::from(k)).collect();
        let wanted = Wanted {
            times: &times,
            ..Wanted::default()
        };
        let run = ground.run(&numbers, &across, None, wanted);
        let (s, c) = (&run.summary, crossing(&run));
        let residual = s.ledger.residual(s.kinetic_energy);
        assert_eq!(s.outcome, Outcome::Done, "{number}");
        let finite = |row: &[f64]| row.iter().all(|value| value.is_finite());
        assert!(finite(&s.row()) && finite(&c.row()), "{number}");
        assert!(residual < 1e-11, "{number}: {residual:e}");
        assert!(c.range[0] >= -2.0 * gap && c.range[1] <= gap, "{number}");
        for (moment, kept) in run.moments.iter().zip(&c.kept) {
            let [x, heel, toe] = moment.reaction;
            let normal = heel + toe;
            assert!(heel >= -1e-6 && toe >= -1e-6, "{number}");
            assert!(
                x.hypot(kept[2]) <= friction[0] * normal * (1.0 + 1e-6) + 1e-3,
                "{number}"
            );
            assert!(moment.position[HEEL] >= 0.0 && moment.position[TOE] >= 0.0);
            assert!(s.slip_range[0] <= moment.position[SLIP] + 1e-12);
            assert!(s.slip_range[1] >= moment.position[SLIP] - 1e-12);
        }
        rocked += u32::from(s.time_by_mode[2] + s.time_by_mode[3] > 0.05);
    }
    assert!(rocked > 150, "{rocked}");
}

#[test]
fn only_the_part_of_the_slip_along_the_stream_jams_a_corner() {
    // On the heel, going upstream: no motion where mu e_x H b >= J / m + b^2, here 3.47.
    let slender = Rectangle {
        width: 0.4,
        height: 4.0,
        friction: [4.0; 2],
        restitution: 0.0,
    };
    let start = [[0.0, 0.0, 0.02], [-1.0, 0.0, 0.0]];
    for (speed, jams) in [(0.01, 1), (1.0, 0)] {
        let across = Across {
            start: [0.0, speed],
            ..slender.across()
        };
        let run = Ground::still(0.05).run(&slender.numbers(), &across, Some(start), Wanted::default());
        let s = &run.summary;
        assert_eq!((s.outcome, s.jams), (Outcome::Done, jams));
        assert!(s.ledger.residual(s.kinetic_energy) < 1e-12);
        if jams == 1 {
            // It ends the slip both ways at once.
            assert!(crossing(&run).path < 1e-12 && s.slip_stops == 0);
        }
    }
}
