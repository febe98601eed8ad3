//! A motion in the plane on a stretch of time: velocities and speed as polynomials, and where they do what.

use super::super::ledger::Work;
use super::polynomial::{Polynomial, TERMS};

/// One over each number.
pub(super) const INVERSE: [f64; TERMS + 2] = {
    let mut inverse = [f64::INFINITY; TERMS + 2];
    let mut k = 1;
    while k < TERMS + 2 {
        inverse[k] = 1.0 / k as f64;
        k += 1;
    }
    inverse
};

/// Along, across and the speed: polynomials of the velocity and of its size.
pub(super) type Terms = [[f64; 3]; TERMS];

/// Coefficients of one number.
pub(super) type Series = [f64; TERMS];

/// How the block moves for `length` seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    /// Time of the polynomials at the start (s).
    pub begin: f64,
    /// How long they hold (s).
    pub length: f64,
    /// Velocity along and across, and its size (m/s).
    pub terms: Terms,
    /// Friction per mass (m/s2), where it goes by a law.
    pub friction: Option<Series>,
}

/// Integrals of along, across and the speed from the start of a flight: ways, and moments of them about its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ways {
    pub way: [f64; 3],
    pub moment: [f64; 3],
}

impl Ways {
    /// Work of the force `f0 + f1 t` along one of them, and its size.
    pub(super) fn work(&self, i: usize, [f0, f1]: [f64; 2]) -> Work {
        let (steady, changing) = (f0 * self.way[i], f1 * self.moment[i]);
        Work {
            net: steady + changing,
            size: steady.abs() + changing.abs(),
        }
    }
}

/// Values of the polynomials.
#[inline]
pub(super) fn value(terms: &Terms, t: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for term in terms.iter().rev() {
        for i in 0..3 {
            sum[i] = sum[i] * t + term[i];
        }
    }
    sum
}

/// Integrals from zero of the polynomials, and of them times the time.
#[inline]
fn integrals(terms: &Terms, t: f64) -> [[f64; 3]; 2] {
    let mut sums = [[0.0; 3]; 2];
    for k in (0..TERMS).rev() {
        for i in 0..3 {
            sums[0][i] = sums[0][i] * t + terms[k][i] * INVERSE[k + 1];
            sums[1][i] = sums[1][i] * t + terms[k][i] * INVERSE[k + 2];
        }
    }
    [sums[0].map(|sum| sum * t), sums[1].map(|sum| sum * t * t)]
}

impl Flight {
    /// A block that goes on as it does for no time.
    pub(super) fn moment(velocity: [f64; 2]) -> Self {
        let mut terms = [[0.0; 3]; TERMS];
        terms[0] = [velocity[0], velocity[1], velocity[0].hypot(velocity[1])];
        Flight {
            begin: 0.0,
            length: 0.0,
            terms,
            friction: None,
        }
    }

    /// Friction per mass after a time, where it goes by a law.
    pub(super) fn friction(&self, t: f64) -> Option<f64> {
        let t = self.begin + t;
        self.friction
            .map(|terms| terms.iter().rev().fold(0.0, |sum, term| sum * t + term))
    }

    /// Work of that friction per mass up to a time: the integral of its product with the speed.
    pub(super) fn rubbed(&self, friction: &Series, t: f64) -> f64 {
        let power = |n: usize| -> f64 {
            (n.saturating_sub(TERMS - 1)..=n.min(TERMS - 1))
                .map(|k| friction[k] * self.terms[n - k][2])
                .sum()
        };
        let up_to = |t: f64| {
            t * (0..2 * TERMS - 1)
                .rev()
                .fold(0.0, |sum, n| sum * t + power(n) / (n + 1) as f64)
        };
        up_to(self.begin + t) - up_to(self.begin)
    }

    /// The moment up to `end` at which the path is so long, if it comes to that.
    pub(super) fn walks(&self, path: f64, end: f64) -> Option<f64> {
        let left = |t: f64| path - self.ways(t).way[2];
        (left(end) <= 0.0).then(|| falls(left, 0.0, end))
    }

    /// Velocities along and across, and the speed, after a time.
    #[inline]
    pub(super) fn velocities(&self, t: f64) -> [f64; 3] {
        value(&self.terms, self.begin + t)
    }

    /// Acceleration along or across after a time.
    pub(super) fn acceleration(&self, i: usize, t: f64) -> f64 {
        let t = self.begin + t;
        let mut sum = 0.0;
        for k in (1..TERMS).rev() {
            sum = sum * t + k as f64 * self.terms[k][i];
        }
        sum
    }

    /// Ways along, across and of the path after a time.
    #[inline]
    pub(super) fn ways(&self, t: f64) -> Ways {
        let [mut way, mut moment] = integrals(&self.terms, self.begin + t);
        if self.begin > 0.0 {
            let [way_before, moment_before] = integrals(&self.terms, self.begin);
            for i in 0..3 {
                way[i] -= way_before[i];
                moment[i] -= moment_before[i] + self.begin * way[i];
            }
        }
        Ways { way, moment }
    }

    /// Moments up to `end` at which the velocity along or across changes its sign, ascending.
    pub(super) fn turns(&self, i: usize, end: f64) -> Vec<f64> {
        let mut turns = Vec::new();
        let last = self.begin + end;
        let change = self.terms[1..]
            .iter()
            .rev()
            .fold(0.0, |sum, term| (sum + term[i].abs()) * last);
        if self.terms[0][i].abs() > change {
            return turns;
        }
        let velocity = |t: f64| self.velocities(t)[i];
        let [starts, ends] = [0.0, end].map(|t| [velocity(t), self.acceleration(i, t)]);
        if starts[0] * ends[0] > 0.0 && starts[1] * ends[1] > 0.0 {
            return turns;
        }
        // A stretch over which the direction hardly turns has one turning point of a velocity at most, two where its
        // acceleration changes its sign, too.
        let mut cuts = vec![0.0];
        if let Some(t) = changes(|t| self.acceleration(i, t), 0.0, end) {
            cuts.push(t);
        }
        cuts.push(end);
        for pair in cuts.windows(2) {
            turns.extend(changes(velocity, pair[0], pair[1]));
        }
        turns
    }

    /// The first moment up to `end` at which the way along or across exceeds `limit` in the direction `way`, 1 or -1.
    pub(super) fn reaches(&self, i: usize, limit: f64, way: f64, end: f64) -> Option<f64> {
        let beyond = |t: f64| way * self.ways(t).way[i] - limit;
        let mut from = 0.0;
        for to in self.turns(i, end).into_iter().chain([end]) {
            if beyond(to) > 0.0 {
                return Some(falls(|t| -beyond(t), from, to));
            }
            from = to;
        }
        None
    }

    /// `f0 + f1 t + c a`, a the acceleration along.
    pub(super) fn pressed(&self, [f0, f1]: [f64; 2], c: f64) -> Polynomial {
        let acceleration = (1..TERMS).map(|k| k as f64 * self.terms[k][0]);
        let moved = Polynomial::new(acceleration).times(c).after(self.begin);
        moved.plus([f0, f1])
    }
}

/// Where a function changes its sign between two moments, if it has another one at the second.
fn changes(at: impl Fn(f64) -> f64, from: f64, to: f64) -> Option<f64> {
    let [a, b] = [at(from), at(to)];
    if a * b >= 0.0 {
        return None;
    }
    Some(if a > 0.0 {
        falls(at, from, to)
    } else {
        falls(|t| -at(t), from, to)
    })
}

/// Where a function falls to zero between two moments, at the second of which it is no longer positive.
fn falls(at: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    loop {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            return to;
        }
        if at(middle) > 0.0 {
            from = middle;
        } else {
            to = middle;
        }
    }
}
