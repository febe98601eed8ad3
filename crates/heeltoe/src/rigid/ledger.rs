//! The energy ledger: `E(t) - E(0) = input - friction - impact`, every term integrated exactly on every piece.
//!
//! Input is the work of all applied loads and of the ground's inertia force on the motion relative to the ground;
//! on a piece force is linear and velocity quadratic in time, so the work is a polynomial in the piece's length.

/// Multiplied by, as divisions take a good part of what a piece takes.
const THIRD: f64 = 1.0 / 3.0;

/// Work, and how much goes to and fro in it: the parts of a constant force and of its change by themselves. Their sum
/// may vanish where neither does, and is no scale to judge rounding by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Work {
    pub net: f64,
    pub size: f64,
}

/// `(f0 + f1 t)(v0 + a0 t + a1 t^2 / 2)` integrated from 0 to `end`.
#[inline]
pub(super) fn work(force: [f64; 2], v0: f64, a: [f64; 2], end: f64) -> Work {
    let (path, moment) = path_and_moment(v0, a, end);
    let (steady, changing) = (force[0] * path, force[1] * moment);
    Work {
        net: steady + changing,
        size: steady.abs() + changing.abs(),
    }
}

/// `v0 + a0 t + a1 t^2 / 2`, and t times that, integrated from 0 to `end`.
#[inline(always)]
pub(super) fn path_and_moment(v0: f64, a: [f64; 2], end: f64) -> (f64, f64) {
    let t = end;
    let path = t * (v0 + t * (a[0] / 2.0 + t * a[1] / 6.0));
    let moment = t * t * (v0 / 2.0 + t * (a[0] * THIRD + t * a[1] / 8.0));
    (path, moment)
}

/// Energies since the start; losses are positive.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ledger {
    /// Kinetic energy at the start.
    pub start: f64,
    /// Work of all loads, and of the ground's inertia force, on the motion relative to the ground.
    pub input: f64,
    /// Lost to friction.
    pub friction: f64,
    /// Lost in impacts.
    pub impact: f64,
    /// Sum of the sizes of all entries, to judge the residual by.
    pub turnover: f64,
}

impl Ledger {
    pub(super) fn apply(&mut self, work: Work) {
        self.input += work.net;
        self.turnover += work.size;
    }

    pub(super) fn rub(&mut self, work: Work) {
        self.friction -= work.net;
        self.turnover += work.size;
    }

    pub(super) fn strike(&mut self, lost: f64) {
        self.impact += lost;
        self.turnover += lost.abs();
    }

    /// What the books do not explain, relative to the turnover; zero if nothing ever moved.
    pub fn residual(&self, end: f64) -> f64 {
        let turnover = self.turnover.max(self.start);
        if turnover == 0.0 {
            return 0.0;
        }
        (end - self.start - self.input + self.friction + self.impact).abs() / turnover
    }
}

#[cfg(test)]
mod tests {
    use super::work;

    #[test]
    fn work_on_a_piece_is_the_integral() {
        let (f, v0, a, end) = ([2.0, -3.0], 0.7, [1.1, 4.0], 0.9);
        let n = 200_000;
        let step = end / f64::from(n);
        let sum: f64 = (0..n)
            .map(|k| {
                let t = (f64::from(k) + 0.5) * step;
                (f[0] + f[1] * t) * (v0 + a[0] * t + a[1] * t * t / 2.0) * step
            })
            .sum();
        assert!((work(f, v0, a, end).net - sum).abs() < 1e-9);
    }
}
