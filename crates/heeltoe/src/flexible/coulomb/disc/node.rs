//! Sweeps over the contacts, each by itself with the others held (Gauss and Seidel). It has a solution by one number
//! `lambda >= 0`,
//!
//! ```text
//! u_T = -lambda p_T,      |p_T| = mu p_n
//! ```

use super::super::super::simd::Plain;
use super::{length, Disc, Side, State, Way};

/// Steps in the search for a node's lambda, which are more than it takes, and what is left to rounding.
const SECANTS: u32 = 200;
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl Disc {
    /// Sweep so often; true where nothing changes any more.
    // In line it would be compiled a few times over.
    #[inline(never)]
    pub(super) fn sweeps(&mut self, way: &mut Way, most: u32) -> bool {
        let m = self.states.len();
        for contact in 0..m {
            let limit = way.limit(contact, false, way.p[m + contact].max(0.0));
            if !self.states[contact].closed() {
                (way.p[contact], way.p[m + contact], way.rows.p[contact]) = (0.0, 0.0, 0.0);
            }
            way.p[m + contact] = way.p[m + contact].max(0.0);
            let size = length(way.p[contact], way.rows.p[contact]);
            if size > limit {
                way.p[contact] *= limit / size;
                way.rows.p[contact] *= limit / size;
            }
        }
        for _ in 0..most {
            way.velocities::<Plain>();
            let (mut change, mut most) = (0.0_f64, 0.0_f64);
            for contact in 0..m {
                if self.states[contact] == State::Absent {
                    continue;
                }
                let node = Node::of(way, contact);
                let (state, side, p) = node.solve();
                (self.states[contact], way.rows.side[contact]) = (state, side);
                let before = [way.p[contact], way.p[m + contact], way.rows.p[contact]];
                let step = [0, 1, 2].map(|k| p[k] - before[k]);
                change = step.iter().fold(change, |a, x| a.max(x.abs()));
                most = most.max(p[1]);
                (way.p[contact], way.p[m + contact], way.rows.p[contact]) = (p[0], p[1], p[2]);
                way.add(contact, step);
            }
            if change <= 1e-13 * most {
                return true;
            }
        }
        false
    }
}

impl Way<'_> {
    /// Add to the velocities what a change of the impulses of a contact makes.
    fn add(&mut self, contact: usize, [t, n, y]: [f64; 3]) {
        let m = self.rows.p.len();
        let along = &self.problem.g[contact * 2 * m..][..2 * m];
        let normal = &self.problem.g[(m + contact) * 2 * m..][..2 * m];
        for ((u, a), b) in self.u.iter_mut().zip(along).zip(normal) {
            *u += t * a + n * b;
        }
        let across = &self.rows.g[contact * m..][..m];
        self.rows.u.iter_mut().zip(across).for_each(|(u, g)| *u += y * g);
    }
}

/// Where a function that falls from 0 on does not exceed zero any more, to rounding; `about` there. The secant of both ends
/// finds it, the older of which counts half (Illinois; Dowell and Jarratt 1971).
fn falls_to_zero(excess: impl Fn(f64) -> f64, about: f64) -> f64 {
    let (mut low, mut high) = ((0.0, excess(0.0)), (about, excess(about)));
    if low.1 <= 0.0 {
        return 0.0;
    }
    while high.1 > 0.0 && high.0 < f64::MAX / 4.0 {
        (low, high) = (high, (4.0 * high.0, excess(4.0 * high.0)));
    }
    let mut last_above = None;
    for _ in 0..SECANTS {
        if high.1 == 0.0 || high.0 - low.0 <= ROUNDED * high.0 {
            break;
        }
        let secant = high.0 - high.1 * (high.0 - low.0) / (high.1 - low.1);
        let middle = 0.5 * (low.0 + high.0);
        let next = if secant > low.0 && secant < high.0 {
            secant
        } else {
            middle
        };
        let now = (next, excess(next));
        let above = now.1 > 0.0;
        let again = last_above.replace(above) == Some(above);
        if above {
            low = now;
            high.1 *= if again { 0.5 } else { 1.0 };
        } else {
            high = now;
            low.1 *= if again { 0.5 } else { 1.0 };
        }
    }
    high.0
}

/// A contact by itself, the others held.
struct Node {
    /// Answers along and along, along and normal, normal and normal, across and across.
    tt: f64,
    tn: f64,
    nn: f64,
    yy: f64,
    /// Velocities without its impulses.
    free: [f64; 3],
    touches: [bool; 2],
    mu: [f64; 2],
    /// Impulse that it bears beside that.
    added: [f64; 2],
    rho: f64,
}

impl Node {
    fn of(way: &Way, contact: usize) -> Self {
        let (problem, rows, m) = (way.problem, &*way.rows, way.rows.p.len());
        let g = |r: usize, c: usize| problem.g[(contact + r * m) * 2 * m + contact + c * m];
        let (tt, tn, nn, yy) = (g(0, 0), g(0, 1), g(1, 1), rows.g[contact * (m + 1)]);
        let (t, n, y) = (way.p[contact], way.p[m + contact], rows.p[contact]);
        Node {
            tt,
            tn,
            nn,
            yy,
            free: [
                way.u[contact] - tt * t - tn * n,
                way.u[m + contact] + problem.h[contact] - tn * t - nn * n,
                rows.u[contact] - yy * y,
            ],
            touches: rows.touches[contact],
            mu: [problem.mu_stick[contact], problem.mu_slip[contact]],
            added: [false, true].map(|slips| problem.added(contact, slips, 0.0)),
            rho: way.rho(contact),
        }
    }

    /// Return state, neighbour and impulses.
    fn solve(&self) -> (State, Side, [f64; 3]) {
        let ([left, right], across) = (self.touches, self.free[2]);
        let side = match () {
            () if left && across > 0.0 => Side::Left,
            () if right && across < 0.0 => Side::Right,
            () => {
                let (state, p) = self.plane(across);
                return (state, Side::None, p);
            }
        };
        let (state, p) = self.plane(0.0);
        (state, side, [p[0], p[1], -across / self.yy])
    }

    /// The state and the impulses with friction alone, where this moves it across the valley.
    fn plane(&self, across: f64) -> (State, [f64; 3]) {
        let [along, normal, _] = self.free;
        if normal >= 0.0 {
            return (State::Open, [0.0; 3]);
        }
        // With the normal impulse eliminated.
        let own = self.tt - self.tn * self.tn / self.nn;
        let pushed = along - self.tn * normal / self.nn;
        let at = |lambda: f64| {
            let (t, y) = (-pushed / (own + lambda), -across / (self.yy + lambda));
            [t, -(normal + self.tn * t) / self.nn, y]
        };
        let size = |p: [f64; 3]| length(p[0], p[2]);
        let stick = at(0.0);
        if stick[1] >= 0.0 && size(stick) <= self.mu[0] * stick[1] + self.added[0] {
            return (State::Stick, stick);
        }
        let excess = |lambda: f64| {
            let p = at(lambda);
            size(p) - self.mu[1] * p[1] - self.added[1]
        };
        let lambda = falls_to_zero(excess, own.max(self.yy));
        let p = at(lambda);
        let size = size(p);
        if size == 0.0 {
            return (State::Slip([1.0, 0.0], 0.0), p);
        }
        // |z| is that of p and of what it slips by.
        let share = 1.0 / (1.0 + self.rho * lambda);
        (State::Slip([p[0] / size, p[2] / size], share), p)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{problem, CONTACTS};
    use super::super::Rows;
    use super::falls_to_zero;

    /// `1 / (1 + x) - 1 / 4` at 3, and a function with a kink.
    #[test]
    fn a_function_that_falls_is_zero_where_the_closed_form_says() {
        for about in [1e-6, 0.5, 3.0, 1e9] {
            let root = falls_to_zero(|x| 1.0 / (1.0 + x) - 0.25, about);
            assert!((root - 3.0).abs() < 1e-13, "{about}: {root}");
            let root = falls_to_zero(|x| (2.0 - x).max(0.1 * (2.0 - x)), about);
            assert!((root - 2.0).abs() < 1e-13, "{about}: {root}");
        }
        assert_eq!(falls_to_zero(|x| -x, 1.0), 0.0);
    }

    #[test]
    fn a_node_by_itself_has_a_solution_however_strong_its_friction_is() {
        for seed in 0..500 {
            let (problem, mut rows) = problem(41 * seed, 4.0);
            let mut other = Rows::new(CONTACTS);
            std::mem::swap(&mut other, &mut rows);
            let (mut p, mut u) = (vec![0.0; 2 * CONTACTS], problem.b.clone());
            other.u.clone_from(&other.b);
            let way = super::Way {
                problem: &problem,
                rows: &mut other,
                p: &mut p,
                u: &mut u,
            };
            let node = super::Node::of(&way, 0);
            let (_, _, [t, n, y]) = node.solve();
            assert!(
                n >= 0.0 && super::length(t, y) <= 4.0 * n * (1.0 + 1e-9),
                "{seed}"
            );
            let apart = node.free[1] + node.tn * t + node.nn * n;
            assert!(apart > -1e-9 && (n * apart).abs() < 1e-9, "{seed}");
        }
    }
}
