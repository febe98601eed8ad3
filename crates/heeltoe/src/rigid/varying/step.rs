//! One step of the explicit Runge-Kutta method of order 8 by Dormand and Prince with its error estimate of orders 5 and 3
//! (Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd edition, section II.5: DOP853).

/// Displacement of the corner along and across the crack, rotation; their velocities; work of the loads, friction; how far
/// the flank of a rough crack has risen under the block.
pub(super) const SIZE: usize = 9;
/// The components over which the error is a mean: all but the rise, which follows from the others.
pub(super) const COUNTED: usize = 8;
pub(super) type State = [f64; SIZE];

const STAGES: usize = 12;

/// Result of a step: the state at its end, its rate of change there, and the error estimate, relative to the tolerance:
/// at most 1 is good.
pub(super) struct Step {
    pub end: State,
    pub rate: State,
    pub error: f64,
}

/// Step from `start`, whose rate is `rate`, over `length`; `rates(since, state)` gives the rate of change, `scale` the
/// absolute error that is allowed in each component, infinite where none counts.
pub(super) fn step(
    start: &State,
    rate: &State,
    length: f64,
    scale: &State,
    rates: &mut impl FnMut(f64, &State) -> State,
) -> Step {
    let mut k = [[0.0; SIZE]; STAGES];
    k[0] = *rate;
    for i in 1..STAGES {
        let at = along(start, length, &A[i - 1][..i], &k);
        k[i] = rates(C[i] * length, &at);
    }
    let end = along(start, length, &B, &k);
    let last = rates(length, &end);
    let (mut fifth, mut third) = (0.0, 0.0);
    for j in 0..COUNTED {
        if scale[j].is_infinite() {
            continue;
        }
        let weigh = |weights: &[f64; STAGES], of_last: f64| {
            let sum: f64 = (0..STAGES).map(|i| weights[i] * k[i][j]).sum();
            (sum + of_last * last[j]) / scale[j]
        };
        fifth += weigh(&E5, E5_LAST).powi(2);
        third += weigh(&E3, E3_LAST).powi(2);
    }
    let together = fifth + 0.01 * third;
    let error = if together == 0.0 {
        0.0
    } else {
        length * fifth / (together * COUNTED as f64).sqrt()
    };
    Step {
        end,
        rate: last,
        error,
    }
}

/// Displacements, rotation and velocities at a moment `t` of a step, on the polynomial of degree 5 through both ends with
/// their velocities and accelerations; the works are left at zero.
pub(super) fn between(ends: [&State; 2], rates: [&State; 2], length: f64, t: f64) -> State {
    let mut at = [0.0; SIZE];
    let s = t / length;
    for j in 0..3 {
        let [y0, y1] = ends.map(|y| y[j]);
        let [v0, v1] = ends.map(|y| length * y[j + 3]);
        let [a0, a1] = rates.map(|y| length * length * y[j + 3]);
        // What is left at the end of the parabola from the start: of the displacement, its first and second rate.
        let (y, v, a) = (y1 - y0 - v0 - 0.5 * a0, v1 - v0 - a0, a1 - a0);
        let (c3, c4, c5) = (
            10.0 * y - 4.0 * v + 0.5 * a,
            -15.0 * y + 7.0 * v - a,
            6.0 * y - 3.0 * v + 0.5 * a,
        );
        at[j] = y0 + s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5))));
        at[j + 3] = (v0 + s * (a0 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / length;
    }
    at
}

fn along(start: &State, length: f64, weights: &[f64], k: &[State; STAGES]) -> State {
    let mut at = *start;
    for (weight, rate) in weights.iter().zip(k).filter(|(weight, _)| **weight != 0.0) {
        for (value, slope) in at.iter_mut().zip(rate) {
            *value += length * weight * slope;
        }
    }
    at
}

const C: [f64; STAGES] = [
    0.0,
    0.05260015195876773,
    0.0789002279381516,
    0.1183503419072274,
    0.2816496580927726,
    0.3333333333333333,
    0.25,
    0.3076923076923077,
    0.6512820512820513,
    0.6,
    0.8571428571428571,
    1.0,
];
const A: [[f64; STAGES - 1]; STAGES - 1] = [
    [
        0.05260015195876773,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.0197250569845379,
        0.0591751709536137,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.02958758547680685,
        0.0,
        0.08876275643042054,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.2413651341592667,
        0.0,
        -0.8845494793282861,
        0.924834003261792,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.037037037037037035,
        0.0,
        0.0,
        0.17082860872947386,
        0.12546768756682242,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.037109375,
        0.0,
        0.0,
        0.17025221101954405,
        0.06021653898045596,
        -0.017578125,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.03709200011850479,
        0.0,
        0.0,
        0.17038392571223998,
        0.10726203044637328,
        -0.015319437748624402,
        0.008273789163814023,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.6241109587160757,
        0.0,
        0.0,
        -3.3608926294469414,
        -0.868219346841726,
        27.59209969944671,
        20.154067550477894,
        -43.48988418106996,
        0.0,
        0.0,
        0.0,
    ],
    [
        0.47766253643826434,
        0.0,
        0.0,
        -2.4881146199716677,
        -0.590290826836843,
        21.230051448181193,
        15.279233632882423,
        -33.28821096898486,
        -0.020331201708508627,
        0.0,
        0.0,
    ],
    [
        -0.9371424300859873,
        0.0,
        0.0,
        5.186372428844064,
        1.0914373489967295,
        -8.149787010746927,
        -18.52006565999696,
        22.739487099350505,
        2.4936055526796523,
        -3.0467644718982196,
        0.0,
    ],
    [
        2.273310147516538,
        0.0,
        0.0,
        -10.53449546673725,
        -2.0008720582248625,
        -17.9589318631188,
        27.94888452941996,
        -2.8589982771350235,
        -8.87285693353063,
        12.360567175794303,
        0.6433927460157636,
    ],
];
const B: [f64; STAGES] = [
    0.054293734116568765,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    0.3111643669578199,
    -0.1521609496625161,
    0.20136540080403034,
    0.04471061572777259,
];
const E3: [f64; STAGES] = [
    -0.18980075407240762,
    0.0,
    0.0,
    0.0,
    0.0,
    4.450312892752409,
    1.8915178993145003,
    -5.801203960010585,
    -0.4226823213237919,
    -0.1521609496625161,
    0.20136540080403034,
    0.02265179219836082,
];
const E3_LAST: f64 = 0.0;
const E5: [f64; STAGES] = [
    0.01312004499419488,
    0.0,
    0.0,
    0.0,
    0.0,
    -1.2251564463762044,
    -0.4957589496572502,
    1.6643771824549864,
    -0.35032884874997366,
    0.3341791187130175,
    0.08192320648511571,
    -0.022355307863886294,
];
const E5_LAST: f64 = 0.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_of_eighth_order() {
        // x'' = x, x(0) = 1, x'(0) = 0: cosh.
        let error = |length: f64| {
            let mut rates = |_: f64, y: &State| [y[3], 0.0, 0.0, y[0], 0.0, 0.0, 0.0, 0.0, 0.0];
            let start = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            let rate = rates(0.0, &start);
            let taken = step(&start, &rate, length, &[1.0; SIZE], &mut rates);
            (taken.end[0] - length.cosh()).abs()
        };
        let ratio = error(1.6) / error(0.8);
        assert!((300.0..1500.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn between_its_ends_a_quintic_is_exact() {
        let (y, v, a) = (
            |t: f64| t.powi(5),
            |t: f64| 5.0 * t.powi(4),
            |t: f64| 20.0 * t.powi(3),
        );
        let state = |t: f64| [y(t), 0.0, -y(t), v(t), 0.0, -v(t), 1.0, 1.0, 1.0];
        let rate = |t: f64| [v(t), 0.0, -v(t), a(t), 0.0, -a(t), 0.0, 0.0, 0.0];
        let found = between([&state(1.0), &state(3.0)], [&rate(1.0), &rate(3.0)], 2.0, 1.0);
        assert!((found[0] - 32.0).abs() < 1e-12 && (found[3] - 80.0).abs() < 1e-12);
        assert!((found[2] + 32.0).abs() < 1e-12 && (found[5] + 80.0).abs() < 1e-12);
        assert_eq!([found[1], found[4], found[6], found[7], found[8]], [0.0; 5]);
    }

    #[test]
    fn the_error_estimate_bounds_the_error() {
        let mut rates = |t: f64, _: &State| [t.powi(9), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let start = [0.0; SIZE];
        let rate = rates(0.0, &start);
        let taken = step(&start, &rate, 2.0, &[1.0; SIZE], &mut rates);
        assert!((taken.end[0] - 102.4).abs() < taken.error * 10.0);
    }
}
