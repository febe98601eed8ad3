//! The contact problem of one step: find the impulses `p` for which
//!
//! ```text
//! u = G p + b
//! 0 <= u_n + h   perpendicular to   p_n >= 0                         (Signorini)
//! u_t = 0 and |p_t| <= mu p_n,  or  p_t = -mu p_n sign(u_t)          (Coulomb)
//! ```
//!
//! at all contacts at once. In two dimensions each contact is open, sticking, or slipping one way; the right set of
//! these states turns the problem into a linear one. The set of the last step is tried first, contacts that break
//! their conditions change state, and the factors of the matrix are kept as long as the set is and what `G` has for it.

use super::body::fma;
use super::factors::Factors;
use super::status::Status;

/// The numbers of one problem; component `2 i` is along the crack at contact `i`, `2 i + 1` across it.
#[derive(Default)]
pub(super) struct Problem {
    /// Symmetric, row by row.
    pub g: Vec<f64>,
    pub b: Vec<f64>,
    /// One for each contact.
    pub h: Vec<f64>,
    /// Coefficient of friction of each contact up to which it sticks, and with which it slips.
    pub mu_stick: Vec<f64>,
    pub mu_slip: f64,
}

/// How a solution was found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Report {
    /// Sets of states tried.
    pub iterations: u32,
    /// Whether the sweeps had to help.
    pub swept: bool,
    /// Largest violation of the conditions, as an impulse, over the impulse that would stop the fastest node, or the
    /// largest impulse if that is more.
    pub residual: f64,
}

/// Sets tried with all wrong contacts changed at once, and then with the worst alone, before sweeping.
const AT_ONCE: u32 = 12;
const ONE_BY_ONE: u32 = 60;
/// What counts as a violation, relative to the largest term: well above rounding, far below what matters.
const SLACK: f64 = 1e-11;

/// State of the contacts and the factors that belong to it.
#[derive(Default)]
pub(super) struct Solver {
    pub status: Vec<Status>,
    /// Solution, ordered like `b`.
    pub p: Vec<f64>,
    /// Velocities of the solution.
    pub u: Vec<f64>,
    factors: Factors,
}

impl Solver {
    pub(super) fn new(contacts: usize) -> Self {
        Solver {
            status: vec![Status::Stick; contacts],
            p: vec![0.0; 2 * contacts],
            u: vec![0.0; 2 * contacts],
            ..Default::default()
        }
    }

    /// Forget the factors where they contain a contact that has moved, because its part of `G` is another one.
    #[inline(always)]
    pub(super) fn forget(&mut self, moved: &[bool]) {
        self.factors.forget(moved);
    }

    /// Solve, starting from the states of the last time; `Absent` ones must have been set by the caller.
    #[inline(always)]
    pub(super) fn solve<const FUSED: bool>(&mut self, problem: &Problem) -> Report {
        let mut report = Report::default();
        while report.iterations < AT_ONCE + ONE_BY_ONE {
            report.iterations += 1;
            if !self.factors.solve::<FUSED>(problem, &self.status, &mut self.p) {
                break;
            }
            self.velocities::<FUSED>(problem);
            if !self.amend(problem, report.iterations > AT_ONCE) {
                report.residual = self.clip(problem);
                return report;
            }
        }
        self.sweep::<FUSED>(problem);
        report.swept = true;
        report.residual = self.clip(problem);
        report
    }

    /// `u = G p + b`.
    #[inline(always)]
    pub(super) fn velocities<const FUSED: bool>(&mut self, problem: &Problem) {
        let size = problem.b.len();
        self.u.copy_from_slice(&problem.b);
        for (&p, column) in self.p.iter().zip(problem.g.chunks_exact(size)) {
            if p != 0.0 {
                for (u, g) in self.u.iter_mut().zip(column) {
                    *u = fma::<FUSED>(p, *g, *u);
                }
            }
        }
    }

    /// Change the state of the contacts that break their conditions, all or the worst; false where none does.
    #[inline(always)]
    fn amend(&mut self, problem: &Problem, worst_only: bool) -> bool {
        let size = problem.b.len();
        let fastest = problem.b.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let largest = self.p.iter().fold(0.0_f64, |a, p| a.max(p.abs()));
        let (slack_u, slack_p) = (SLACK * fastest, SLACK * largest);
        let mut worst = (0.0, usize::MAX, Status::Open);
        let mut changed = false;
        for contact in 0..self.status.len() {
            let (u_t, u_n) = (self.u[2 * contact], self.u[2 * contact + 1] + problem.h[contact]);
            let (p_t, p_n) = (self.p[2 * contact], self.p[2 * contact + 1]);
            let status = self.status[contact];
            let compliance = problem.g[(2 * contact + 1) * (size + 1)];
            let limit = problem.mu_stick[contact] * p_n;
            let (violation, next) = match status {
                Status::Open if u_n < -slack_u => (-u_n, Status::Stick),
                Status::Stick | Status::SlipDownstream | Status::SlipUpstream if p_n < -slack_p => {
                    (-p_n * compliance, Status::Open)
                }
                Status::Stick if p_t.abs() > limit.max(0.0) + slack_p => {
                    let way = if p_t > 0.0 {
                        Status::SlipUpstream
                    } else {
                        Status::SlipDownstream
                    };
                    ((p_t.abs() - limit) * compliance, way)
                }
                Status::SlipDownstream if u_t < -slack_u => (-u_t, Status::Stick),
                Status::SlipUpstream if u_t > slack_u => (u_t, Status::Stick),
                _ => continue,
            };
            changed = true;
            if !worst_only {
                self.status[contact] = next;
            } else if violation > worst.0 {
                worst = (violation, contact, next);
            }
        }
        if worst_only && worst.1 != usize::MAX {
            self.status[worst.1] = worst.2;
        }
        changed
    }

    /// Take rounding off the solution and return its residual.
    #[inline(always)]
    fn clip(&mut self, problem: &Problem) -> f64 {
        let size = problem.b.len();
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for contact in 0..self.status.len() {
            if self.status[contact] == Status::Absent {
                continue;
            }
            let i = 2 * contact;
            self.p[i + 1] = self.p[i + 1].max(0.0);
            let (p_t, p_n) = (self.p[i], self.p[i + 1]);
            largest = largest.max(p_n);
            let (u_t, u_n) = (self.u[i], self.u[i + 1] + problem.h[contact]);
            let (g_t, g_n) = (problem.g[i * (size + 1)], problem.g[(i + 1) * (size + 1)]);
            largest = largest
                .max(problem.b[i].abs() / g_t)
                .max(problem.b[i + 1].abs() / g_n);
            // The natural map: zero exactly where the conditions hold.
            worst = worst.max(p_n.min(u_n / g_n).abs());
            let mu = match self.status[contact] {
                Status::Stick => problem.mu_stick[contact],
                _ => problem.mu_slip,
            };
            worst = worst.max((p_t - (p_t - u_t / g_t).clamp(-mu * p_n, mu * p_n)).abs());
        }
        if largest > 0.0 {
            worst / largest
        } else {
            0.0
        }
    }
}
