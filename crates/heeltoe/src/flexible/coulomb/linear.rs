//! What solves the linear problem of a set of states, by factors or by an inverse, and corrects what that misses:
//!
//! ```text
//! p += M (-u - h),      u = G p + b,      until u + h is small where it must vanish.
//! ```

use super::super::simd::{largest, Lanes};
use super::problem::{ContactOperator, Problem};

/// What old factors may leave, relative to the fastest node: less than what counts as a violation.
const RIGHT: f64 = 1e-12;
/// Factors that leave more than this share of what they are to correct are too old.
const OLD: f64 = 0.02;

/// The linear problem of a set of states.
pub(super) trait Linear {
    /// What the velocities `u` are amiss at most; to be corrected next.
    fn amiss(&mut self, u: &[f64], h: &[f64]) -> f64;

    /// Add to the impulses `p` what corrects that.
    fn add<W: Lanes>(&mut self, problem: &Problem, p: &mut [f64]);
}

/// Write what the velocities of the unknowns are amiss into `x`, and return the most of it.
pub(super) fn missing(unknowns: &[usize], u: &[f64], h: &[f64], x: &mut Vec<f64>) -> f64 {
    let m = h.len();
    x.clear();
    x.extend(
        unknowns
            .iter()
            .map(|&k| if k < m { -u[k] } else { -u[k] - h[k - m] }),
    );
    largest(x)
}

/// Correct what a solution misses; false where that is more than `rounded`, relative to the fastest node, and corrections
/// do no better.
pub(super) fn settle<W: Lanes>(
    linear: &mut impl Linear,
    problem: &Problem,
    crack: &mut impl ContactOperator,
    p: &mut [f64],
    u: &mut [f64],
    rounded: f64,
) -> bool {
    let fastest = largest(&problem.b);
    let mut before = fastest;
    loop {
        let now = linear.amiss(u, &problem.h);
        if now <= RIGHT * fastest {
            return true;
        }
        if now.is_nan() || now > OLD * before {
            return now <= rounded * fastest;
        }
        before = now;
        linear.add::<W>(problem, p);
        crack.velocities::<W>(problem, p, u);
    }
}
