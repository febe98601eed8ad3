//! Where the solution of a step goes on from: those of the last steps with the same set of states, by their differences
//!
//! ```text
//! p = p_1 + D p_1 + D^2 p_1 + D^3 p_1,      D p_1 = p_1 - p_2
//! ```
//!
//! as far as these are known, and `G p` by the same. What that misses is corrected, see [`super::linear`].

/// How many differences are kept.
pub(super) const ORDER: usize = 3;

/// A number at the last step, and its differences there but for the last.
pub(super) type Course = [f64; ORDER];

/// The last solutions with the same set.
#[derive(Default)]
pub(super) struct Past {
    /// What the last one is for; empty where there is none to go on from.
    b: Vec<f64>,
    /// The impulses until the one before, and what they change in the velocities.
    p: Vec<Course>,
    change: Vec<Course>,
    /// How many differences are known.
    known: usize,
}

impl Past {
    /// Whether there is a solution to go on from.
    pub(super) fn known(&self) -> bool {
        !self.b.is_empty()
    }

    /// Begin anew with the next solution.
    pub(super) fn forget(&mut self) {
        self.b.clear();
        self.known = 0;
    }

    /// Keep what the last solution is for.
    pub(super) fn keep(&mut self, b: &[f64]) {
        self.b.clear();
        self.b.extend_from_slice(b);
    }

    /// From the impulses and velocities of the last solution to those that the next one, for `b`, begins with.
    pub(super) fn go_on(&mut self, b: &[f64], p: &mut [f64], u: &mut [f64]) {
        u.iter_mut().zip(&self.b).for_each(|(u, b)| *u -= b);
        for (now, past) in [(p, &mut self.p), (&mut *u, &mut self.change)] {
            past.resize(now.len(), [0.0; ORDER]);
            let both = now.iter_mut().zip(past);
            if self.known == ORDER {
                // As nearly always: the same for each, so that it need not be looked at for each.
                both.for_each(|(now, past)| *now = next(*now, past, ORDER));
            } else {
                both.for_each(|(now, past)| *now = next(*now, past, self.known));
            }
        }
        self.known = (self.known + 1).min(ORDER);
        u.iter_mut().zip(b).for_each(|(u, b)| *u += b);
    }
}

/// What comes after a number, of which so many differences are known.
#[inline(always)]
pub(super) fn next(now: f64, past: &mut Course, known: usize) -> f64 {
    let (mut sum, mut difference) = (now, now);
    for (k, past) in past.iter_mut().enumerate() {
        let before = std::mem::replace(past, difference);
        if k == known {
            break;
        }
        difference -= before;
        sum += difference;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{Past, ORDER};

    #[test]
    fn solutions_go_on_as_they_went() {
        let (b, p) = (|t: f64| 1.0 + 2.0 * t, |t: f64| t * t * t - 2.0 * t * t + 5.0);
        let solution = |t: f64| (vec![p(t)], vec![3.0 * p(t) + b(t)]);
        let mut past = Past::default();
        for start in [0, 20] {
            past.forget();
            assert!(!past.known());
            for step in start..start + 8 {
                let t = f64::from(step);
                let (mut impulses, mut velocities) = solution(t);
                past.keep(&[b(t)]);
                assert!(past.known());
                past.go_on(&[b(t + 1.0)], &mut impulses, &mut velocities);
                let [was, is] = [p(t), p(t + 1.0)];
                let known = (step - start) as usize;
                assert_eq!(impulses[0] == was, known == 0);
                assert_eq!(
                    (impulses[0], velocities[0]) == (is, 3.0 * is + b(t + 1.0)),
                    known >= ORDER
                );
            }
        }
    }
}
