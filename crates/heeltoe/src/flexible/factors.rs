//! The linear problem that is left of a contact problem once every contact has its state.
//!
//! Unknown are both impulses of a contact that sticks and the normal one of a contact that slips, whose friction goes with
//! it; in the rows of the unknowns
//!
//! ```text
//! G p = -b,      b_n + h for b across the crack,      p_t = -sign(u_t) mu p_n where it slips.
//! ```
//!
//! The matrix is factored, `P G = L U`, column by column, with row pivoting.

use super::body::fma;
use super::coulomb::Problem;
use super::status::Status;

/// The factors of a set of states; they are kept as long as the set is and what `G` has for it.
#[derive(Default)]
pub(super) struct Factors {
    /// The set they belong to.
    of: Vec<Status>,
    /// Contact and component of each unknown.
    unknowns: Vec<(usize, bool)>,
    lu: Vec<f64>,
    pivots: Vec<usize>,
    x: Vec<f64>,
    fresh: bool,
}

impl Factors {
    /// Forget them where they contain a contact whose part of `G` is another one.
    #[inline(always)]
    pub(super) fn forget(&mut self, moved: &[bool]) {
        let mut pairs = self.of.iter().zip(moved);
        if pairs.any(|(status, moved)| *moved && status.closed()) {
            self.fresh = false;
        }
    }

    /// Solve for the impulses `p` under these states; false where the matrix is singular.
    #[inline(always)]
    pub(super) fn solve<const FUSED: bool>(
        &mut self,
        problem: &Problem,
        status: &[Status],
        p: &mut [f64],
    ) -> bool {
        let known = self.fresh && self.of == status;
        if !known && !self.factor::<FUSED>(problem, status) {
            return false;
        }
        self.x.clear();
        for &(contact, along) in &self.unknowns {
            self.x.push(if along {
                -problem.b[2 * contact]
            } else {
                -problem.b[2 * contact + 1] - problem.h[contact]
            });
        }
        self.substitute::<FUSED>();
        p.fill(0.0);
        for (&(contact, along), &value) in self.unknowns.iter().zip(&self.x) {
            if along {
                p[2 * contact] = value;
            } else {
                p[2 * contact + 1] = value;
                let sign = status[contact].sign();
                if sign != 0.0 {
                    p[2 * contact] = -sign * problem.mu_slip * value;
                }
            }
        }
        true
    }

    /// Turn the right-hand side in `x` into the solution.
    #[inline(always)]
    fn substitute<const FUSED: bool>(&mut self) {
        let n = self.unknowns.len();
        for (k, &pivot) in self.pivots.iter().enumerate() {
            self.x.swap(k, pivot);
        }
        // The factors are stored column by column: all of the work is adding multiples of columns.
        for k in 0..n {
            let factor = -self.x[k];
            let (_, below) = self.x.split_at_mut(k + 1);
            for (value, l) in below.iter_mut().zip(&self.lu[k * n + k + 1..(k + 1) * n]) {
                *value = fma::<FUSED>(factor, *l, *value);
            }
        }
        for k in (0..n).rev() {
            let value = self.x[k] * self.lu[k * n + k];
            self.x[k] = value;
            let (above, _) = self.x.split_at_mut(k);
            for (other, l) in above.iter_mut().zip(&self.lu[k * n..k * n + k]) {
                *other = fma::<FUSED>(-value, *l, *other);
            }
        }
    }

    /// Set up and factor the matrix of these states; false where it is singular.
    #[inline(always)]
    fn factor<const FUSED: bool>(&mut self, problem: &Problem, status: &[Status]) -> bool {
        self.set_up::<FUSED>(problem, status);
        self.pivots.clear();
        self.fresh = self.eliminate::<FUSED>();
        if self.fresh {
            self.of.clear();
            self.of.extend_from_slice(status);
        }
        self.fresh
    }

    /// Write the matrix, column by column.
    #[inline(always)]
    fn set_up<const FUSED: bool>(&mut self, problem: &Problem, status: &[Status]) {
        self.unknowns.clear();
        for (contact, status) in status.iter().enumerate() {
            match status {
                Status::Absent | Status::Open => {}
                Status::Stick => self.unknowns.extend([(contact, true), (contact, false)]),
                _ => self.unknowns.push((contact, false)),
            }
        }
        let size = problem.b.len();
        self.lu.clear();
        for &(contact, along) in &self.unknowns {
            let column = &problem.g[(2 * contact + usize::from(!along)) * size..][..size];
            let sign = status[contact].sign();
            let rows = self.unknowns.iter().map(|&(i, a)| 2 * i + usize::from(!a));
            if sign == 0.0 || along {
                self.lu.extend(rows.map(|row| column[row]));
            } else {
                let friction = &problem.g[2 * contact * size..][..size];
                let mu = -sign * problem.mu_slip;
                self.lu
                    .extend(rows.map(|row| fma::<FUSED>(mu, friction[row], column[row])));
            }
        }
    }

    /// Gauss's elimination in place; false where a pivot vanishes.
    #[inline(always)]
    fn eliminate<const FUSED: bool>(&mut self) -> bool {
        let n = self.unknowns.len();
        for k in 0..n {
            let column = &self.lu[k * n + k..(k + 1) * n];
            let mut pivot = 0;
            for (row, value) in column.iter().enumerate() {
                if value.abs() > column[pivot].abs() {
                    pivot = row;
                }
            }
            let largest = column[pivot];
            if largest == 0.0 || !largest.is_finite() {
                return false;
            }
            self.pivots.push(k + pivot);
            if pivot != 0 {
                for column in self.lu.chunks_exact_mut(n) {
                    column.swap(k, k + pivot);
                }
            }
            // The pivot is kept as its inverse: solving needs no division.
            let inverse = 1.0 / largest;
            let (left, right) = self.lu.split_at_mut((k + 1) * n);
            let multipliers = &mut left[k * n + k..];
            multipliers[0] = inverse;
            for value in &mut multipliers[1..] {
                *value *= inverse;
            }
            for column in right.chunks_exact_mut(n) {
                let factor = -column[k];
                if factor != 0.0 {
                    for (value, l) in column[k + 1..].iter_mut().zip(&multipliers[1..]) {
                        *value = fma::<FUSED>(factor, *l, *value);
                    }
                }
            }
        }
        true
    }
}
