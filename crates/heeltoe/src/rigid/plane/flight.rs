//! A motion in the plane on a stretch of time: velocities and speed as polynomials, and where they do what.

/// Coefficients of a velocity: order [`super::series::ORDER`], and what a start adds to it.
pub(super) const TERMS: usize = 16;

/// A polynomial of a velocity.
pub(super) type Terms = [f64; TERMS];

/// The parts of a stretch into which a bound that does not decide is cut at most.
const CUTS: u32 = 60;

/// How the block moves for `length` seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight {
    /// Time of the polynomials at the start (s).
    pub begin: f64,
    /// How long they hold (s).
    pub length: f64,
    /// Velocity along and across (m/s).
    pub velocity: [Terms; 2],
    /// Its size (m/s).
    pub speed: Terms,
}

/// Value of a polynomial.
pub(super) fn value(terms: &Terms, t: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * t + term)
}

/// Value of its derivative.
pub(super) fn slope(terms: &Terms, t: f64) -> f64 {
    let mut sum = 0.0;
    for k in (1..TERMS).rev() {
        sum = sum * t + k as f64 * terms[k];
    }
    sum
}

/// Integral from zero.
pub(super) fn integral(terms: &Terms, t: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..TERMS).rev() {
        sum = sum * t + terms[k] / (k + 1) as f64;
    }
    sum * t
}

/// Integral from zero of the polynomial times the time.
fn moment(terms: &Terms, t: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..TERMS).rev() {
        sum = sum * t + terms[k] / (k + 2) as f64;
    }
    sum * t * t
}

impl Flight {
    /// Velocity along or across after a time.
    pub(super) fn velocity(&self, i: usize, t: f64) -> f64 {
        value(&self.velocity[i], self.begin + t)
    }

    /// Acceleration along or across after a time.
    pub(super) fn acceleration(&self, i: usize, t: f64) -> f64 {
        slope(&self.velocity[i], self.begin + t)
    }

    /// Way along or across after a time.
    pub(super) fn way(&self, i: usize, t: f64) -> f64 {
        let terms = &self.velocity[i];
        integral(terms, self.begin + t) - integral(terms, self.begin)
    }

    /// Length of the path after a time.
    pub(super) fn path(&self, t: f64) -> f64 {
        integral(&self.speed, self.begin + t) - integral(&self.speed, self.begin)
    }

    /// Work of the force `f0 + f1 t` on one of the velocities, or on the speed, and its size.
    pub(super) fn work(&self, terms: &Terms, [f0, f1]: [f64; 2], t: f64) -> [f64; 2] {
        let (from, to) = (self.begin, self.begin + t);
        let way = integral(terms, to) - integral(terms, from);
        let turning = moment(terms, to) - moment(terms, from) - from * way;
        let (steady, changing) = (f0 * way, f1 * turning);
        [steady + changing, steady.abs() + changing.abs()]
    }

    /// Moments up to `end` at which the velocity along or across changes its sign, ascending.
    pub(super) fn turns(&self, i: usize, end: f64) -> Vec<f64> {
        let mut turns = Vec::new();
        let [starts, ends] = [0.0, end].map(|t| [self.velocity(i, t), self.acceleration(i, t)]);
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
            turns.extend(changes(|t| self.velocity(i, t), pair[0], pair[1]));
        }
        turns
    }

    /// The first moment up to `end` at which the way along or across exceeds `limit` in the direction `way`, 1 or -1.
    pub(super) fn reaches(&self, i: usize, limit: f64, way: f64, end: f64) -> Option<f64> {
        if limit == f64::INFINITY {
            return None;
        }
        let beyond = |t: f64| way * self.way(i, t) - limit;
        let mut from = 0.0;
        for to in self.turns(i, end).into_iter().chain([end]) {
            if beyond(to) > 0.0 {
                return Some(falls(|t| -beyond(t), from, to));
            }
            from = to;
        }
        None
    }

    /// The first moment up to `end` at which `f0 + f1 t + c a` is no longer positive, a the acceleration along.
    pub(super) fn first_fall(&self, [f0, f1]: [f64; 2], c: f64, end: f64) -> Option<f64> {
        let at = |t: f64| f0 + f1 * t + c * self.acceleration(0, t);
        // Largest change per second.
        let last = self.begin + end;
        let mut steepest = 0.0;
        for k in (2..TERMS).rev() {
            steepest = steepest * last + (k * (k - 1)) as f64 * self.velocity[0][k].abs();
        }
        positive_until(&at, f1.abs() + c.abs() * steepest, [0.0, end], CUTS)
    }
}

/// The first moment between two at which a function of no more than this slope falls to zero.
fn positive_until(at: &impl Fn(f64) -> f64, steepest: f64, [from, to]: [f64; 2], cuts: u32) -> Option<f64> {
    let [a, b] = [at(from), at(to)];
    if a <= 0.0 {
        return Some(from);
    }
    if a + b > steepest * (to - from) {
        return None;
    }
    let middle = 0.5 * (from + to);
    if cuts == 0 || middle <= from || middle >= to {
        return (b <= 0.0).then_some(to);
    }
    positive_until(at, steepest, [from, middle], cuts - 1)
        .or_else(|| positive_until(at, steepest, [middle, to], cuts - 1))
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
