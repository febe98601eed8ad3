//! Where the solution of a step goes on from: those of the last two with the same set of states, by a straight line,
//!
//! ```text
//! p = 2 p_1 - p_0,      G p = 2 (G p)_1 - (G p)_0
//! ```
//!
//! What that misses is corrected, see [`super::linear`].

/// The last two solutions with the same set.
#[derive(Default)]
pub(super) struct Past {
    /// What the last one is for; empty where there is none to go on from.
    b: Vec<f64>,
    /// The impulses of the one before, and what they change in the velocities; empty where there is none.
    p: Vec<f64>,
    change: Vec<f64>,
}

impl Past {
    /// Whether there is a solution to go on from.
    pub(super) fn known(&self) -> bool {
        !self.b.is_empty()
    }

    /// Begin anew with the next solution.
    pub(super) fn forget(&mut self) {
        for numbers in [&mut self.b, &mut self.p, &mut self.change] {
            numbers.clear();
        }
    }

    /// Keep what the last solution is for.
    pub(super) fn keep(&mut self, b: &[f64]) {
        self.b.clear();
        self.b.extend_from_slice(b);
    }

    /// From the impulses and velocities of the last solution to those that the next one, for `b`, begins with.
    pub(super) fn go_on(&mut self, b: &[f64], p: &mut [f64], u: &mut [f64]) {
        u.iter_mut().zip(&self.b).for_each(|(u, b)| *u -= b);
        if self.p.is_empty() {
            self.p.extend_from_slice(p);
            self.change.extend_from_slice(u);
        } else {
            advance(p, &mut self.p);
            advance(u, &mut self.change);
        }
        u.iter_mut().zip(b).for_each(|(u, b)| *u += b);
    }
}

/// Go on along a straight line; what was now is before.
fn advance(now: &mut [f64], before: &mut [f64]) {
    for (now, before) in now.iter_mut().zip(before) {
        let next = 2.0 * *now - *before;
        *before = std::mem::replace(now, next);
    }
}

#[cfg(test)]
mod tests {
    use super::Past;

    #[test]
    fn a_solution_goes_on_along_a_straight_line() {
        let mut past = Past::default();
        // u = 3 p + b, p = 5 + 2 t.
        let (mut p, mut u) = (vec![5.0], vec![16.0]);
        past.keep(&[1.0]);
        past.go_on(&[2.0], &mut p, &mut u);
        assert_eq!((p[0], u[0]), (5.0, 17.0));
        (p[0], u[0]) = (7.0, 23.0);
        past.keep(&[2.0]);
        past.go_on(&[4.0], &mut p, &mut u);
        assert_eq!((p[0], u[0]), (9.0, 31.0));
        past.forget();
        assert!(!past.known());
    }
}
