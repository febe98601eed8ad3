//! The linear problem that is left of a contact problem once every contact has its state.
//!
//! Unknown are both impulses of a contact that sticks and the normal one of a contact that slips, whose friction goes with
//! it; in the rows of the unknowns
//!
//! ```text
//! G p = -b,      b_n + h for b across the crack,      p_t = -sign(u_t) (mu p_n + c) where it slips.
//! ```
//!
//! The matrix is factored, `P G = L U`, column by column, with row pivoting.

use super::super::simd::{apart, combine, fma, Group, Lanes, LANES};
use super::super::status::Status;
use super::linear::{missing, Linear};
use super::problem::Problem;
use super::triangles;

/// Solutions with the same factors after which their inverse pays: one solution by it takes a quarter of the time, and all
/// of it as long as five. By factors the velocities are right to rounding whatever the matrix is, so what is not
/// corrected goes on by them for longer.
const INVERT_AFTER: u32 = 20;
const CORRECTED_INVERT_AFTER: u32 = 5;
/// An inverse of what is closer to singular than this share of its largest pivot would not solve to rounding.
const INVERTIBLE: f64 = 1e-6;

/// Sets of states whose factors are kept: a crack that slides comes back to the same few again and again.
const KEPT: usize = 24;

/// The factors of the last few sets.
pub(super) struct Kept {
    all: Vec<Factors>,
    /// The one in use.
    now: usize,
    /// Counts the times that another one came into use.
    turns: u64,
}

impl Default for Kept {
    fn default() -> Self {
        Kept {
            all: (0..KEPT).map(|_| Factors::default()).collect(),
            now: 0,
            turns: 0,
        }
    }
}

impl Kept {
    /// Forget those that contain a contact that has moved, because its part of `G` is another one; or, where they are to
    /// last, know that they are old.
    pub(super) fn forget(&mut self, moved: &[bool], last: bool) {
        for factors in &mut self.all {
            if last {
                factors.old = true;
            } else {
                factors.forget(moved);
            }
        }
    }

    /// Whether those turned to last are the factors of a set of states.
    #[inline(always)]
    pub(super) fn last_for(&self, status: &[Status]) -> bool {
        self.all[self.now].belong_to(status)
    }

    /// Turn to the factors of a set of states; false where they are not known.
    pub(super) fn turn_to(&mut self, status: &[Status]) -> bool {
        if self.last_for(status) {
            return true;
        }
        let known = self.all.iter().position(|factors| factors.belong_to(status));
        self.turns += 1;
        self.now = known.unwrap_or_else(|| {
            let free = |k: &usize| self.all[*k].turn * u64::from(self.all[*k].fresh);
            (0..KEPT).min_by_key(free).unwrap_or(0)
        });
        self.all[self.now].turn = self.turns;
        known.is_some()
    }

    /// The factors turned to.
    #[inline(always)]
    pub(super) fn now(&mut self) -> &mut Factors {
        &mut self.all[self.now]
    }
}

/// The factors of a set of states; they hold as long as what `G` has for it.
#[derive(Default)]
pub(super) struct Factors {
    /// The set they belong to.
    of: Vec<Status>,
    /// Component of each unknown.
    unknowns: Vec<usize>,
    /// Contacts that slip. Their friction goes by the problem, whose coefficients a law changes.
    slips: Vec<usize>,
    lu: Vec<f64>,
    pivots: Vec<usize>,
    x: Vec<f64>,
    fresh: bool,
    /// Whether a contact has moved since they were worked out.
    old: bool,
    /// When they came into use last.
    turn: u64,
    /// How often they have been used.
    used: u32,
    /// The inverse, column by column, each filled up to whole groups; empty until it pays.
    inverse: Vec<Group>,
    sum: Vec<Group>,
}

impl Factors {
    /// Forget them where they contain a contact whose part of `G` is another one.
    fn forget(&mut self, moved: &[bool]) {
        let mut pairs = self.of.iter().zip(moved);
        if pairs.any(|(status, moved)| *moved && status.closed()) {
            self.fresh = false;
        }
    }

    /// Whether these are the factors of the set of states.
    #[inline(always)]
    fn belong_to(&self, status: &[Status]) -> bool {
        self.fresh && self.of == status
    }

    /// Whether a contact has moved since they were worked out.
    #[inline(always)]
    pub(super) fn old(&self) -> bool {
        self.old
    }

    /// Solve for the impulses `p`.
    pub(super) fn solve<W: Lanes>(&mut self, problem: &Problem, p: &mut [f64]) {
        self.amiss(&problem.b, &problem.h);
        self.feel(problem);
        p.fill(0.0);
        self.add::<W>(problem, p);
    }

    /// Let the unknowns feel what the contacts that slip bear beside friction.
    fn feel(&mut self, problem: &Problem) {
        if problem.added.is_empty() {
            return;
        }
        let size = problem.b.len();
        for &contact in &self.slips {
            let sign = self.of[contact].sign();
            let added = sign * problem.added(contact, true, -sign);
            let felt = &problem.g[contact * size..][..size];
            for (x, &k) in self.x.iter_mut().zip(&self.unknowns) {
                *x += felt[k] * added;
            }
        }
    }

    /// What [`invert`] does.
    #[inline(always)]
    fn find_inverse<W: Lanes>(&mut self) {
        let n = self.unknowns.len();
        let diagonal = || (0..n).map(|k| self.lu[k * (n + 1)].abs());
        let (least, largest) = (
            diagonal().fold(f64::INFINITY, f64::min),
            diagonal().fold(0.0, f64::max),
        );
        if least < INVERTIBLE * largest {
            return;
        }
        let stride = n.div_ceil(LANES);
        self.sum = vec![[0.0; LANES]; stride];
        triangles::inverse::<W>(&self.lu, &self.pivots, n, &mut self.inverse);
    }

    /// What [`substitute`] does.
    #[inline(always)]
    fn solve_triangles<W: Lanes>(&mut self) {
        triangles::substitute::<W>(&self.lu, &self.pivots, &mut self.x);
    }

    /// What [`factor`] does.
    #[inline(always)]
    fn anew<W: Lanes>(&mut self, problem: &Problem, status: &[Status]) -> bool {
        self.set_up::<W>(problem, status);
        self.inverse.clear();
        self.used = 0;
        self.old = false;
        self.fresh = triangles::eliminate::<W>(&mut self.lu, self.unknowns.len(), &mut self.pivots);
        if self.fresh {
            self.of.clear();
            self.of.extend_from_slice(status);
        }
        self.fresh
    }

    /// Write the matrix, column by column.
    #[inline(always)]
    fn set_up<W: Lanes>(&mut self, problem: &Problem, status: &[Status]) {
        let (m, size) = (status.len(), problem.b.len());
        self.unknowns.clear();
        self.slips.clear();
        for (contact, status) in status.iter().enumerate() {
            if *status == Status::Stick {
                self.unknowns.push(contact);
            }
            if status.slips() {
                self.slips.push(contact);
            }
        }
        let closed = status.iter().enumerate().filter(|(_, status)| status.closed());
        self.unknowns.extend(closed.map(|(contact, _)| m + contact));
        self.lu.clear();
        let mut slips = self.slips.iter().peekable();
        for &k in &self.unknowns {
            let column = &problem.g[k * size..][..size];
            let rows = self.unknowns.iter();
            match slips.next_if(|contact| k == m + **contact) {
                None => self.lu.extend(rows.map(|&row| column[row])),
                Some(&contact) => {
                    let mu = -status[contact].sign() * problem.mu_slip[contact];
                    let friction = &problem.g[contact * size..][..size];
                    self.lu
                        .extend(rows.map(|&row| fma::<W>(mu, friction[row], column[row])));
                }
            }
        }
    }
}

apart! {
    /// Set up and factor the matrix of these states; false where it is singular.
    pub(super) fn factor(factors: &mut Factors, problem: &Problem, status: &[Status]) -> bool = Factors::anew;
}

apart! {
    /// Work out the inverse, unless the matrix is next to singular.
    fn invert(factors: &mut Factors) -> () = Factors::find_inverse;
}

apart! {
    /// Turn the right-hand side in `x` into the solution.
    fn substitute(factors: &mut Factors) -> () = Factors::solve_triangles;
}

impl Linear for Factors {
    #[inline(always)]
    fn amiss(&mut self, u: &[f64], h: &[f64]) -> f64 {
        missing(&self.unknowns, u, h, &mut self.x)
    }

    fn add<W: Lanes>(&mut self, problem: &Problem, p: &mut [f64]) {
        self.used += 1;
        if self.used == INVERT_AFTER || self.old && self.used == CORRECTED_INVERT_AFTER {
            invert::<W>(self);
        }
        if self.inverse.is_empty() {
            substitute::<W>(self);
        } else {
            self.sum.fill([0.0; LANES]);
            combine::<W>(&self.inverse, &self.x, &mut self.sum);
            let n = self.x.len();
            self.x.copy_from_slice(&self.sum.as_flattened()[..n]);
        }
        for (&k, &value) in self.unknowns.iter().zip(&self.x) {
            p[k] += value;
        }
        let m = problem.h.len();
        for &contact in &self.slips {
            let sign = self.of[contact].sign();
            p[contact] = -sign * problem.mu_slip[contact] * p[m + contact];
            if !problem.added.is_empty() {
                p[contact] -= sign * problem.added(contact, true, -sign);
            }
        }
    }
}
