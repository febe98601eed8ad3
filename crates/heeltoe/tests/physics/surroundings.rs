//! Water with sound and a boundary that takes energy: against one system of equations for all that moves, and by what may
//! not happen.

use heeltoe::flexible::{
    rest, simulate, Dam, Line, Modes, ReducedBody, Reservoir, RockingThresholds, Run, Scheme, Shaking, Span,
    Wanted,
};
use heeltoe::stop::Stop;

use crate::flexible::waves;
use crate::numbers::{near, Dice, GRAVITY};

const MODES: usize = 6;
const WATER: usize = 3;
const NODES: usize = 2;

/// The numbers of a body and of the water that are drawn at random.
struct Drawn {
    squares: [Vec<f64>; 2],
    damping: [Vec<f64>; 2],
    shapes: [Vec<f64>; 2],
    participation: [[Vec<f64>; 2]; 2],
    load: [Vec<f64>; 2],
    wet: [Vec<f64>; 2],
    boundary: Vec<f64>,
    water_squares: Vec<f64>,
    leaving: [Vec<f64>; 2],
    ground: [Vec<f64>; 2],
}

/// A random matrix times its transpose.
fn positive(dice: &mut Dice, size: usize, scale: f64) -> Vec<f64> {
    let a: Vec<f64> = (0..size * size).map(|_| dice.roll()).collect();
    let entry = |k: usize| {
        (0..size)
            .map(|l| a[k / size * size + l] * a[k % size * size + l])
            .sum::<f64>()
    };
    (0..size * size).map(|k| scale * entry(k)).collect()
}

impl Drawn {
    /// An upper body that moves freely along and across its crack, a lower one that is held, and water before both.
    fn new(seed: u64) -> Self {
        let mut dice = Dice(seed);
        let mut draw =
            |count: usize, scale: f64| (0..count).map(|_| scale * dice.roll()).collect::<Vec<f64>>();
        let root = 70.0_f64;
        let mut shapes = [draw(MODES * 2 * NODES, 0.01), draw(MODES * 2 * NODES, 0.01)];
        // Two rigid motions, along and across, come first.
        let rigid = 1.0 / root;
        shapes[0][..4].copy_from_slice(&[rigid, rigid, 0.0, 0.0]);
        shapes[0][4..8].copy_from_slice(&[0.0, 0.0, rigid, rigid]);
        let mut participation = [
            [draw(MODES, 9.0), draw(MODES, 9.0)],
            [draw(MODES, 9.0), draw(MODES, 9.0)],
        ];
        participation[0][0][..2].copy_from_slice(&[root, 0.0]);
        participation[0][1][..2].copy_from_slice(&[0.0, root]);
        let mut load = [draw(MODES, 40.0), draw(MODES, 40.0)];
        load[0][..2].copy_from_slice(&[0.05 * GRAVITY * root, -GRAVITY * root]);
        let squares = |first: usize| -> Vec<f64> {
            let own = |k: usize| {
                if k < first {
                    0.0
                } else {
                    (20.0 + 31.0 * k as f64).powi(2)
                }
            };
            (0..MODES).map(own).collect()
        };
        let damping = |first: usize| -> Vec<f64> {
            (0..MODES)
                .map(|k| if k < first { 0.0 } else { 1.0 + k as f64 })
                .collect()
        };
        Drawn {
            squares: [squares(2), squares(0)],
            damping: [damping(2), damping(0)],
            shapes,
            participation,
            load,
            wet: [draw(WATER * MODES, 9.0), draw(WATER * MODES, 9.0)],
            water_squares: vec![40.0, 900.0, 6000.0],
            ground: [draw(WATER, 60.0), draw(WATER, 60.0)],
            boundary: positive(&mut dice, MODES, 9.0),
            leaving: [positive(&mut dice, WATER, 1.0), positive(&mut dice, WATER, 2.0)],
        }
    }

    fn body(&self, side: usize, gap: f64, wet: &[f64]) -> ReducedBody {
        let across = if side == 0 { gap } else { 0.0 };
        ReducedBody::new(&Modes {
            omega_squared: &self.squares[side],
            damping: [&self.damping[side]; 2],
            load: &self.load[side],
            participation: [&self.participation[side][0], &self.participation[side][1]],
            start: &[0.0; MODES],
            shapes: &self.shapes[side],
            position: &[0.0, 10.0, across, across],
            directions: 2,
            dampers: &[],
            damper_signs: &[],
            wet,
            boundary: if side == 1 { &self.boundary } else { &[] },
        })
        .unwrap()
    }

    fn dam(&self, gap: f64) -> Dam {
        self.tied(gap, &self.wet, self.reservoir())
    }

    fn reservoir(&self) -> Reservoir {
        let leaving = [&self.leaving[0][..], &self.leaving[1]];
        Reservoir::new(&self.water_squares, leaving, [&self.ground[0], &self.ground[1]]).unwrap()
    }

    /// With these rows that tie the bodies to the reservoir.
    fn tied(&self, gap: f64, wet: &[Vec<f64>], reservoir: Reservoir) -> Dam {
        let dam = Dam {
            bodies: vec![self.body(0, gap, &wet[0]), self.body(1, gap, &wet[1])],
            cracks: vec![Line {
                nodes: [Span {
                    first: 0,
                    count: NODES,
                }; 2],
                ..Line::only([NODES, NODES], [0.5; 2], RockingThresholds::default())
            }],
            contactors: 1,
            reservoir: Some(reservoir),
            still: None,
        };
        dam.check().unwrap();
        dam
    }
}

fn shake(dam: &Dam, ground: &[[f64; 2]], dt: f64, theta: f64) -> Run {
    let shaking = Shaking {
        ground,
        dt,
        scale: [1.0; 2],
        rising: &[],
        across: None,
    };
    let wanted = Wanted {
        stride: 1,
        modes: true,
        ..Wanted::default()
    };
    simulate(dam, &shaking, &Scheme::Exact(theta), wanted)
}

/// Solve a system by Gauss with pivots.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n)
            .max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))
            .unwrap();
        a.swap(k, best);
        b.swap(k, best);
        let (row, known) = (a[k].clone(), b[k]);
        for (other, b) in a.iter_mut().zip(&mut b).skip(k + 1) {
            let factor = other[k] / row[k];
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
            *b -= factor * known;
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|c| a[k][c] * b[c]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

#[test]
fn bodies_and_water_apart_move_as_one_system_of_equations() {
    let (dt, steps) = (2e-3, 300);
    for (seed, theta) in [(3, 0.5), (4, 0.6), (5, 1.0)] {
        let drawn = Drawn::new(seed);
        let ground = waves(steps, dt, 0.3);
        // Far above the plane nothing touches.
        let run = shake(&drawn.dam(1e3), &ground, dt, theta);
        let size = 2 * MODES + WATER;
        let squares: Vec<f64> = [&drawn.squares[0][..], &drawn.squares[1], &drawn.water_squares].concat();
        // x'' + B x' + Omega^2 x = f - gamma a + g v, with the tie in the skew part of B.
        let mut b = vec![vec![0.0; size]; size];
        for (side, damping) in drawn.damping.iter().enumerate() {
            for k in 0..MODES {
                b[side * MODES + k][side * MODES + k] += damping[k];
            }
        }
        for r in 0..MODES {
            for c in 0..MODES {
                b[MODES + r][MODES + c] += drawn.boundary[r * MODES + c];
            }
        }
        for r in 0..WATER {
            for c in 0..WATER {
                b[2 * MODES + r][2 * MODES + c] +=
                    drawn.leaving[0][r * WATER + c] + drawn.leaving[1][r * WATER + c];
            }
            for side in 0..2 {
                for k in 0..MODES {
                    let row = drawn.wet[side][r * MODES + k];
                    b[2 * MODES + r][side * MODES + k] -= row;
                    b[side * MODES + k][2 * MODES + r] += row;
                }
            }
        }
        let (mut x, mut v, mut speed) = (vec![0.0; size], vec![0.0; size], [0.0; 2]);
        for a in &ground {
            let change = a.map(|a| a * dt);
            let mean_speed = [0, 1].map(|k| speed[k] + theta * change[k]);
            let right: Vec<f64> = (0..size)
                .map(|k| {
                    let pushed = if k < 2 * MODES {
                        let (side, k) = (k / MODES, k % MODES);
                        let share = &drawn.participation[side];
                        drawn.load[side][k] * dt - share[0][k] * change[0] - share[1][k] * change[1]
                    } else {
                        let k = k - 2 * MODES;
                        dt * (drawn.ground[0][k] * mean_speed[0] + drawn.ground[1][k] * mean_speed[1])
                    };
                    v[k] + theta * (pushed - dt * squares[k] * x[k])
                })
                .collect();
            let mut system = b.clone();
            for (k, row) in system.iter_mut().enumerate() {
                row.iter_mut().for_each(|value| *value *= theta * dt);
                row[k] += 1.0 + theta * theta * dt * dt * squares[k];
            }
            let mean = solve(system, right);
            for k in 0..size {
                x[k] += dt * mean[k];
                v[k] = (mean[k] - (1.0 - theta) * v[k]) / theta;
            }
            speed = [0, 1].map(|k| speed[k] + change[k]);
        }
        let frames = &run.frames;
        let ours = &frames.modes;
        for side in 0..2 {
            let last = &ours[side][ours[side].len() - MODES..];
            let most = last.iter().fold(0.0_f64, |a, q| a.max(q.abs()));
            for k in 0..MODES {
                assert!(
                    (last[k] - x[side * MODES + k]).abs() < 1e-11 * most,
                    "{seed} {side} {k}"
                );
            }
        }
        let last = &frames.water[frames.water.len() - WATER..];
        let most = last.iter().fold(0.0_f64, |a, q| a.max(q.abs()));
        for k in 0..WATER {
            assert!((last[k] - v[2 * MODES + k]).abs() < 1e-10 * most, "{seed} {k}");
        }
        assert!(run.cracks[0].ledger.residual() < 1e-13);
    }
}

#[test]
fn the_ledger_closes_while_it_slides_lifts_and_lands() {
    let (dt, steps) = (1e-3, 4000);
    let mut moved = 0;
    for seed in 0..40 {
        let dam = rest(Drawn::new(seed).dam(0.0), Stop::default());
        let run = shake(
            &dam,
            &waves(steps, dt, 0.25),
            dt,
            if seed % 2 == 0 { 0.5 } else { 0.6 },
        );
        let summary = &run.cracks[0];
        let ledger = summary.ledger;
        assert!(ledger.residual() < 1e-11, "{seed}: {}", ledger.residual());
        assert!(summary.residual < 1e-9, "{seed}: {}", summary.residual);
        for taken in [ledger.boundary, ledger.floor, ledger.far_end, ledger.damping] {
            assert!(taken > 0.0, "{seed}: {ledger:?}");
        }
        // A step in which slip turns back may book a little: a matter of its length.
        assert!(ledger.gained < 1e-5 * ledger.turnover, "{seed}: {ledger:?}");
        moved += u32::from(
            summary.slip.abs() > 1e-3 && summary.opening_upstream.max(summary.opening_downstream) > 1e-5,
        );
    }
    assert!(moved > 10, "{moved}");
}

#[test]
fn as_few_rows_as_there_are_dimensions_tie_the_water_as_all_do() {
    let (dt, ground) = (1e-3, waves(3000, 1e-3, 0.25));
    for (seed, dimensions) in [(2, 1), (5, 2), (9, 3)] {
        let mut drawn = Drawn::new(seed);
        for rows in &mut drawn.wet {
            // The other rows are sums of the first ones, alike in both bodies.
            for k in dimensions * MODES..WATER * MODES {
                let first = k % MODES;
                rows[k] = 0.7 * rows[first] - f64::from(u8::from(dimensions > 1)) * rows[k - MODES];
            }
        }
        let mut reservoir = drawn.reservoir();
        let few = reservoir.tie(&[&drawn.wet[0], &drawn.wet[1]]).unwrap();
        assert_eq!(
            [few[0].len(), few[1].len()],
            [dimensions * MODES; 2],
            "{dimensions}"
        );
        let all = shake(&rest(drawn.dam(0.0), Stop::default()), &ground, dt, 0.6);
        let tied = shake(
            &rest(drawn.tied(0.0, &few, reservoir), Stop::default()),
            &ground,
            dt,
            0.6,
        );
        assert!(all.cracks[0].slip.abs() > 1e-4, "{}", all.cracks[0].slip);
        near(
            tied.cracks[0].slip,
            all.cracks[0].slip,
            1e-9 * all.cracks[0].slip.abs(),
        );
        let (one, other) = (tied.cracks[0].ledger, all.cracks[0].ledger);
        for (one, other) in [
            (one.floor, other.floor),
            (one.far_end, other.far_end),
            (one.stored, other.stored),
        ] {
            near(one, other, 1e-9 * other.abs());
        }
        let most = all.frames.water.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        for (one, other) in tied.frames.water.iter().zip(&all.frames.water) {
            near(*one, *other, 1e-9 * most);
        }
    }
}

#[test]
fn water_that_wets_nothing_leaves_the_dam_alone() {
    let (dt, ground) = (1e-3, waves(2000, 1e-3, 0.25));
    let mut drawn = Drawn::new(4);
    drawn.wet.iter_mut().for_each(|rows| rows.fill(0.0));
    let mut reservoir = drawn.reservoir();
    let rows = reservoir.tie(&[&drawn.wet[0], &drawn.wet[1]]).unwrap();
    let run = shake(
        &rest(drawn.tied(0.0, &rows, reservoir), Stop::default()),
        &ground,
        dt,
        0.6,
    );
    let all = shake(&rest(drawn.dam(0.0), Stop::default()), &ground, dt, 0.6);
    near(run.cracks[0].slip, all.cracks[0].slip, 1e-12);
}

#[test]
fn without_an_earthquake_nothing_moves_to_the_last_bit() {
    for seed in 0..20 {
        let dam = rest(Drawn::new(seed).dam(0.0), Stop::default());
        if dam.still.is_none() {
            continue;
        }
        let run = shake(&dam, &[[0.0; 2]; 200], 1e-3, 0.5);
        assert_eq!(run.cracks[0].slip, 0.0);
        assert!(run.frames.water.iter().all(|velocity| *velocity == 0.0));
        assert_eq!(run.cracks[0].ledger.input, 0.0);
    }
}

#[test]
fn a_boundary_that_damps_each_mode_alone_is_its_damping() {
    let (dt, ground) = (1e-3, waves(3000, 1e-3, 0.25));
    let mut drawn = Drawn::new(8);
    drawn.boundary = (0..MODES * MODES)
        .map(|k| {
            if k / MODES == k % MODES {
                3.0 + (k % MODES) as f64
            } else {
                0.0
            }
        })
        .collect();
    let one = shake(&rest(drawn.dam(0.0), Stop::default()), &ground, dt, 0.6);
    for k in 0..MODES {
        drawn.damping[1][k] += drawn.boundary[k * (MODES + 1)];
    }
    drawn.boundary = vec![0.0; MODES * MODES];
    let other = shake(&rest(drawn.dam(0.0), Stop::default()), &ground, dt, 0.6);
    near(one.cracks[0].slip, other.cracks[0].slip, 1e-9);
    let (one, other) = (one.cracks[0].ledger, other.cracks[0].ledger);
    near(one.damping + one.boundary, other.damping, 1e-9);
}
