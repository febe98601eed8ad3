//! Two blocks, one on the other: with one crack pressed together they are the one block of the other, and what has no
//! closed form keeps its books, mirrors and scales.

use heeltoe::rigid::stack::{many, simulate, Place, Stack, StackRun};
use heeltoe::rigid::{exact, Block, BlockNumbers, Outcome, Run, Shaking, Wanted};
use heeltoe::stop::Stop;

use crate::numbers::{near, GRAVITY as G, HEEL, OPTIONS, SLIP, TOE};

const DENSITY: f64 = 2400.0;
/// Two rectangles, width and height, the upper one's middle so far downstream; friction and restitution of the cracks;
/// water's push on the upper half and uplift in both cracks as parts of the weight.
#[derive(Clone, Copy, Debug)]
struct Two {
    lower: [f64; 2],
    upper: [f64; 2],
    offset: f64,
    friction: [f64; 2],
    restitution: [f64; 2],
    push: f64,
    uplift: [f64; 2],
}

const SLENDER: Two = Two {
    lower: [6.0, 10.0],
    upper: [4.0, 9.0],
    offset: -0.5,
    friction: [0.7, 0.6],
    restitution: [0.3, 0.4],
    push: 0.05,
    uplift: [0.3, 0.2],
};

/// Mass, centre and inertia of some rectangles, each by width, height, middle and foot.
fn together(of: &[[f64; 4]]) -> [f64; 4] {
    let mass: f64 = of.iter().map(|r| DENSITY * r[0] * r[1]).sum();
    let mean =
        |place: fn(&[f64; 4]) -> f64| of.iter().map(|r| DENSITY * r[0] * r[1] * place(r)).sum::<f64>() / mass;
    let (x, z) = (mean(|r| r[2]), mean(|r| r[3] + r[1] / 2.0));
    let turning = |r: &[f64; 4]| {
        let own = (r[0] * r[0] + r[1] * r[1]) / 12.0;
        let apart = (r[2] - x).powi(2) + (r[3] + r[1] / 2.0 - z).powi(2);
        DENSITY * r[0] * r[1] * (own + apart)
    };
    [mass, x, z, of.iter().map(turning).sum()]
}

impl Two {
    fn numbers(&self) -> ([BlockNumbers; 2], Place) {
        let upper = [self.upper[0], self.upper[1], self.offset, self.lower[1]];
        let lower = [self.lower[0], self.lower[1], 0.0, 0.0];
        let bodies = [together(&[lower, upper]), together(&[upper])];
        let foot = [
            [self.lower[0], 0.0, 0.0],
            [self.upper[0], self.offset, self.lower[1]],
        ];
        let push = self.push * bodies[1][0] * G;
        let numbers = [0, 1].map(|i| {
            let ([mass, x, z, inertia], [width, middle, floor]) = (bodies[i], foot[i]);
            let lift = self.uplift[i] * mass * G;
            // The push acts at the middle of the upper block, uplift at a third of the crack.
            let arm = self.lower[1] + self.upper[1] / 2.0 - z;
            BlockNumbers {
                mass_horizontal: mass,
                mass_vertical: mass,
                inertia,
                height: z - floor,
                heel_distance: x - middle + width / 2.0,
                toe_distance: middle + width / 2.0 - x,
                static_horizontal: push,
                static_vertical: lift - mass * G,
                static_moment: lift * (middle - width / 6.0 - x) - push * arm,
                per_horizontal_horizontal: -mass,
                per_vertical_vertical: -mass,
                friction_static: self.friction[i],
                friction_kinetic: 0.9 * self.friction[i],
                restitution: self.restitution[i],
                ..BlockNumbers::default()
            }
        });
        let place = Place {
            along: bodies[1][1] - bodies[0][1],
            across: bodies[1][2] - bodies[0][2],
            turned: 0.0,
        };
        (numbers, place)
    }

    fn stack(&self) -> Stack {
        let ([lower, upper], place) = self.numbers();
        Stack::new(&lower, &upper, &place).unwrap()
    }
}

/// Press a crack together so that it stays bonded: a pair of forces on its two faces.
fn clamp(numbers: &mut BlockNumbers) {
    numbers.static_vertical *= 1e3;
    numbers.friction_static = 50.0;
}

/// A motion that grows, comes and goes: times, horizontal and vertical accelerations.
fn motion(size: f64) -> [Vec<f64>; 3] {
    let time: Vec<f64> = (0..=600).map(|k| f64::from(k) * 0.01).collect();
    let across = time.iter().map(|t| {
        let fade = (-0.5 * ((t - 2.0) / 0.8).powi(2)).exp();
        size * fade * ((7.0 * t).sin() + 0.6 * (19.0 * t + 1.0).sin())
    });
    let up = time
        .iter()
        .map(|t| 0.4 * size * (-(t - 2.2).powi(2)).exp() * (23.0 * t).sin());
    let (across, up) = (across.collect(), up.collect());
    [time, across, up]
}

fn run(stack: &Stack, [time, across, up]: &[Vec<f64>; 3], wanted: Wanted) -> StackRun {
    let shaking = Shaking::new(time, across, Some(up)).unwrap();
    simulate(stack, &shaking, OPTIONS, wanted)
}

fn alike(one: &Run, other: &Run, allowed: f64) {
    let (a, b) = (&one.summary, &other.summary);
    assert_eq!(a.outcome, b.outcome);
    assert_eq!(a.impacts, b.impacts);
    for i in [SLIP, HEEL, TOE] {
        near(a.position[i], b.position[i], allowed);
    }
    for k in 0..2 {
        near(a.slip_range[k], b.slip_range[k], allowed);
        near(a.rotation_range[k], b.rotation_range[k], allowed);
        near(a.largest_gap[k], b.largest_gap[k], allowed);
    }
}

/// Press one crack together, and compare with the other alone on so many samples of a motion.
fn compare(two: &Two, bonded: usize, size: f64, samples: usize) -> Run {
    let shaking = motion(size * G).map(|series| series[..samples].to_vec());
    let series = Shaking::new(&shaking[0], &shaking[1], Some(&shaking[2])).unwrap();
    let (mut numbers, place) = two.numbers();
    let alone = Block::new(&numbers[1 - bonded]);
    clamp(&mut numbers[bonded]);
    let stack = Stack::new(&numbers[0], &numbers[1], &place).unwrap();
    let found = run(&stack, &shaking, Wanted::default());
    let expected = exact::simulate(&alone, &series, None, OPTIONS, Wanted::default());
    assert_eq!(found.cracks[bonded].summary.events, 0);
    assert_eq!(found.lost[bonded], [0.0; 2]);
    alike(&found.cracks[1 - bonded], &expected, 1e-10);
    expected
}

#[test]
fn a_bonded_lower_crack_leaves_the_upper_block() {
    // A force that presses is none to a blow: no blow above a wide base pulls that.
    let two = Two {
        lower: [20.0, 5.0],
        ..SLENDER
    };
    let alone = compare(&two, 0, 0.7, 601).summary;
    assert!(alone.impacts > 100 && alone.slip_range[1] > 0.01 && alone.largest_gap[0] > 0.1);
}

#[test]
fn a_bonded_upper_crack_leaves_the_lower_block() {
    let low = Two {
        lower: [8.0, 3.0],
        upper: [5.0, 3.0],
        ..SLENDER
    };
    let alone = compare(&low, 1, 1.5, 601).summary;
    assert!(alone.slip_range[1] - alone.slip_range[0] > 0.5);
    // A block that rocks, until it strikes.
    let alone = compare(&SLENDER, 1, 0.7, 140).summary;
    assert!(alone.largest_gap[0].max(alone.largest_gap[1]) > 0.01, "{alone:?}");
}

#[test]
fn both_blocks_slide_rock_and_strike_and_the_books_close() {
    let shaking = motion(0.8 * G);
    let wanted = Wanted {
        events: true,
        ..Wanted::default()
    };
    let found = run(&SLENDER.stack(), &shaking, wanted);
    for crack in &found.cracks {
        let s = &crack.summary;
        assert_eq!(s.outcome, Outcome::Done);
        assert!(s.impacts > 5 && s.slip_range[1] - s.slip_range[0] > 1e-3, "{s:?}");
        assert!(s.ledger.residual(s.kinetic_energy) < 1e-12, "{s:?}");
        assert!(crack.events.windows(2).all(|pair| pair[0].time <= pair[1].time));
    }
}

#[test]
fn below_what_moves_them_they_rest_to_the_last_bit() {
    let found = run(&SLENDER.stack(), &motion(0.1 * G), Wanted::default());
    for (crack, lost) in found.cracks.iter().zip(found.lost) {
        assert_eq!(crack.summary.events, 0);
        assert_eq!(crack.summary.position, [0.0; 3]);
        assert_eq!(crack.summary.slip_range, [0.0; 2]);
        assert_eq!(lost, [0.0; 2]);
        near(crack.summary.time_by_mode[0], 6.0, 1e-12);
    }
}

#[test]
fn a_mirrored_stack_moves_the_other_way() {
    let (numbers, place) = SLENDER.numbers();
    let mirrored = numbers.map(|n| BlockNumbers {
        heel_distance: n.toe_distance,
        toe_distance: n.heel_distance,
        static_horizontal: -n.static_horizontal,
        static_moment: -n.static_moment,
        ..n
    });
    let place = Place {
        along: -place.along,
        ..place
    };
    let [time, across, up] = motion(0.8 * G);
    let back = [time.clone(), across.iter().map(|a| -a).collect(), up.clone()];
    let one = run(&SLENDER.stack(), &[time, across, up], Wanted::default());
    let stack = Stack::new(&mirrored[0], &mirrored[1], &place).unwrap();
    let other = run(&stack, &back, Wanted::default());
    for (one, other) in one.cracks.iter().zip(&other.cracks) {
        let (a, b) = (&one.summary, &other.summary);
        near(a.position[SLIP], -b.position[SLIP], 1e-9);
        near(a.largest_gap[0], b.largest_gap[1], 1e-9);
        near(a.rotation_range[0], -b.rotation_range[1], 1e-9);
    }
}

#[test]
fn lengths_and_times_scale() {
    // Four times as long and twice as slow at the same accelerations.
    let four = |pair: [f64; 2]| pair.map(|length| 4.0 * length);
    let large = Two {
        lower: four(SLENDER.lower),
        upper: four(SLENDER.upper),
        offset: 4.0 * SLENDER.offset,
        ..SLENDER
    };
    let [time, across, up] = motion(0.8 * G);
    let slow = [time.iter().map(|t| 2.0 * t).collect(), across.clone(), up.clone()];
    let one = run(&SLENDER.stack(), &[time, across, up], Wanted::default());
    let other = run(&large.stack(), &slow, Wanted::default());
    for (one, other) in one.cracks.iter().zip(&other.cracks) {
        let (a, b) = (&one.summary, &other.summary);
        near(4.0 * a.position[SLIP], b.position[SLIP], 1e-9);
        near(4.0 * a.largest_gap[0], b.largest_gap[0], 1e-9);
        near(a.rotation_range[1], b.rotation_range[1], 1e-10);
    }
}

/// Numbers between 0 and 1, always the same.
fn dice(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn random(dice: &mut impl FnMut() -> f64) -> Two {
    let mut between = |a: f64, b: f64| a + (b - a) * dice();
    let lower = [between(2.0, 40.0), between(1.0, 40.0)];
    let upper = [lower[0] * between(0.2, 1.0), between(1.0, 40.0)];
    Two {
        lower,
        upper,
        offset: (lower[0] - upper[0]) * between(-0.5, 0.5),
        friction: [between(0.2, 1.6), between(0.2, 1.6)],
        restitution: [between(0.0, 0.9), between(0.0, 0.9)],
        push: between(0.0, 0.1),
        uplift: [between(0.0, 0.5), between(0.0, 0.5)],
    }
}

#[test]
fn random_stacks_end_with_closed_books_and_the_same_bits_on_any_threads() {
    let mut dice = dice(42);
    let shakings: Vec<_> = [0.3, 0.6, 1.0].map(|size| motion(size * G)).into();
    let mut cases = Vec::new();
    for k in 0..300 {
        let [time, across, up] = &shakings[k % 3];
        let stack = random(&mut dice).stack();
        cases.push((stack, Shaking::new(time, across, Some(up)).unwrap()));
    }
    let found = many(&cases, OPTIONS, Stop::default());
    let mut done = 0;
    for (k, run) in found.iter().enumerate() {
        for crack in &run.cracks {
            let s = &crack.summary;
            assert!(s.row().iter().all(|value| value.is_finite()), "{k} {s:?}");
            let ends = [Outcome::Done, Outcome::Unstable];
            assert!(ends.contains(&s.outcome), "{k} {s:?}");
            done += usize::from(s.outcome == Outcome::Done && s.impacts > 0);
            assert!(s.ledger.residual(s.kinetic_energy) < 1e-9, "{k} {s:?}");
            assert!(s.kinetic_energy >= 0.0 && s.ledger.impact >= 0.0 && s.ledger.friction >= 0.0);
        }
    }
    assert!(done > 200, "{done}");
    for (k, (stack, shaking)) in cases.iter().enumerate().step_by(7) {
        let alone = simulate(stack, shaking, OPTIONS, Wanted::default());
        for (one, other) in alone.cracks.iter().zip(&found[k].cracks) {
            assert_eq!(one.summary.row(), other.summary.row());
        }
    }
}
