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
//! their conditions change state, and the factors of the matrix are kept as long as set and `G` are.

use super::body::fma;

/// State of one contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[repr(u8)]
pub enum Status {
    /// The node is beyond the other face.
    #[default]
    Absent,
    Open,
    Stick,
    /// Slip of the upper face downstream.
    SlipDownstream,
    SlipUpstream,
}

impl Status {
    pub const NAMES: [&'static str; 5] = ["absent", "open", "stick", "slip downstream", "slip upstream"];

    #[inline(always)]
    pub fn closed(self) -> bool {
        !matches!(self, Status::Absent | Status::Open)
    }

    /// Sign of the slip velocity.
    #[inline(always)]
    fn sign(self) -> f64 {
        match self {
            Status::SlipDownstream => 1.0,
            Status::SlipUpstream => -1.0,
            _ => 0.0,
        }
    }
}

/// The numbers of one problem; component `2 i` is along the crack at contact `i`, `2 i + 1` across it.
#[derive(Default)]
pub struct Problem {
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
pub struct Report {
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
const SWEEPS: u32 = 5000;
/// What counts as a violation, relative to the largest term: well above rounding, far below what matters.
const SLACK: f64 = 1e-11;

/// State of the contacts and the factors that belong to it.
#[derive(Default)]
pub struct Solver {
    pub status: Vec<Status>,
    /// Solution, ordered like `b`.
    pub p: Vec<f64>,
    /// Velocities of the solution.
    pub u: Vec<f64>,
    factored: Vec<Status>,
    /// Contact and component of each unknown.
    unknowns: Vec<(usize, bool)>,
    lu: Vec<f64>,
    pivots: Vec<usize>,
    x: Vec<f64>,
    fresh: bool,
}

impl Solver {
    pub fn new(contacts: usize) -> Self {
        Solver {
            status: vec![Status::Stick; contacts],
            p: vec![0.0; 2 * contacts],
            u: vec![0.0; 2 * contacts],
            ..Default::default()
        }
    }

    /// Forget the factors, because `G` is another one.
    pub fn forget(&mut self) {
        self.fresh = false;
    }

    /// Solve, starting from the states of the last time; `Absent` ones must have been set by the caller.
    #[inline(always)]
    pub fn solve<const FUSED: bool>(&mut self, problem: &Problem) -> Report {
        let mut report = Report::default();
        while report.iterations < AT_ONCE + ONE_BY_ONE {
            report.iterations += 1;
            if !self.linear::<FUSED>(problem) {
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

    /// Solve the linear problem of the present set; false where its matrix is singular.
    #[inline(always)]
    fn linear<const FUSED: bool>(&mut self, problem: &Problem) -> bool {
        let known = self.fresh && self.factored == self.status;
        if !known && !self.factor::<FUSED>(problem) {
            return false;
        }
        let n = self.unknowns.len();
        self.x.clear();
        for &(contact, along) in &self.unknowns {
            self.x.push(if along {
                -problem.b[2 * contact]
            } else {
                -problem.b[2 * contact + 1] - problem.h[contact]
            });
        }
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
        self.p.fill(0.0);
        for (&(contact, along), &value) in self.unknowns.iter().zip(&self.x) {
            if along {
                self.p[2 * contact] = value;
            } else {
                self.p[2 * contact + 1] = value;
                let sign = self.status[contact].sign();
                if sign != 0.0 {
                    self.p[2 * contact] = -sign * problem.mu_slip * value;
                }
            }
        }
        true
    }

    /// Set up and factor the matrix of the present set, column by column, with row pivoting.
    #[inline(always)]
    fn factor<const FUSED: bool>(&mut self, problem: &Problem) -> bool {
        self.unknowns.clear();
        for (contact, status) in self.status.iter().enumerate() {
            match status {
                Status::Absent | Status::Open => {}
                Status::Stick => self.unknowns.extend([(contact, true), (contact, false)]),
                _ => self.unknowns.push((contact, false)),
            }
        }
        let size = problem.b.len();
        let n = self.unknowns.len();
        self.lu.clear();
        for &(contact, along) in &self.unknowns {
            let column = &problem.g[(2 * contact + usize::from(!along)) * size..][..size];
            let sign = self.status[contact].sign();
            if sign == 0.0 || along {
                self.lu.extend(
                    self.unknowns
                        .iter()
                        .map(|&(i, a)| column[2 * i + usize::from(!a)]),
                );
            } else {
                let friction = &problem.g[2 * contact * size..][..size];
                let mu = -sign * problem.mu_slip;
                self.lu.extend(self.unknowns.iter().map(|&(i, a)| {
                    let row = 2 * i + usize::from(!a);
                    fma::<FUSED>(mu, friction[row], column[row])
                }));
            }
        }
        self.pivots.clear();
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
                self.fresh = false;
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
        self.factored.clear();
        self.factored.extend_from_slice(&self.status);
        self.fresh = true;
        true
    }

    /// `u = G p + b`.
    #[inline(always)]
    fn velocities<const FUSED: bool>(&mut self, problem: &Problem) {
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

    /// Sweep over the contacts, solving each with the others held, until nothing changes; slow but safe.
    #[inline(always)]
    fn sweep<const FUSED: bool>(&mut self, problem: &Problem) {
        let size = problem.b.len();
        for contact in 0..self.status.len() {
            let p_n = self.p[2 * contact + 1].max(0.0);
            let limit = problem.mu_stick[contact] * p_n;
            self.p[2 * contact + 1] = if self.status[contact].closed() { p_n } else { 0.0 };
            self.p[2 * contact] = if self.status[contact].closed() {
                self.p[2 * contact].clamp(-limit, limit)
            } else {
                0.0
            };
        }
        for _ in 0..SWEEPS {
            self.velocities::<FUSED>(problem);
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            for contact in 0..self.status.len() {
                if self.status[contact] == Status::Absent {
                    continue;
                }
                let i = 2 * contact;
                let g = |r: usize, c: usize| problem.g[(i + r) * size + i + c];
                let (p_t, p_n) = (self.p[i], self.p[i + 1]);
                let free_t = self.u[i] - g(0, 0) * p_t - g(0, 1) * p_n;
                let free_n = self.u[i + 1] + problem.h[contact] - g(1, 0) * p_t - g(1, 1) * p_n;
                let local = Local {
                    g: [[g(0, 0), g(0, 1)], [g(1, 0), g(1, 1)]],
                    free: [free_t, free_n],
                    mu_stick: problem.mu_stick[contact],
                    mu_slip: problem.mu_slip,
                };
                let (status, new_t, new_n) = local.solve();
                self.status[contact] = status;
                let (dt, dn) = (new_t - p_t, new_n - p_n);
                change = change.max(dt.abs()).max(dn.abs());
                largest = largest.max(new_n.abs());
                self.p[i] = new_t;
                self.p[i + 1] = new_n;
                for (row, u) in self.u.iter_mut().enumerate() {
                    *u += problem.g[i * size + row] * dt + problem.g[(i + 1) * size + row] * dn;
                }
            }
            if change <= 1e-13 * largest {
                break;
            }
        }
        self.velocities::<FUSED>(problem);
        self.fresh = false;
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

/// The problem of a single contact, the others held.
struct Local {
    g: [[f64; 2]; 2],
    free: [f64; 2],
    mu_stick: f64,
    mu_slip: f64,
}

impl Local {
    /// Return the state that fits with its impulses.
    fn solve(&self) -> (Status, f64, f64) {
        let [[tt, tn], [nt, nn]] = self.g;
        let [free_t, free_n] = self.free;
        if free_n >= 0.0 {
            return (Status::Open, 0.0, 0.0);
        }
        let det = tt * nn - tn * nt;
        let stick_t = (-free_t * nn + free_n * tn) / det;
        let stick_n = (-free_n * tt + free_t * nt) / det;
        if stick_n >= 0.0 && stick_t.abs() <= self.mu_stick * stick_n {
            return (Status::Stick, stick_t, stick_n);
        }
        for (status, sign) in [(Status::SlipDownstream, 1.0), (Status::SlipUpstream, -1.0)] {
            let mu = -sign * self.mu_slip;
            let p_n = -free_n / (nn + mu * nt);
            let u_t = free_t + (tn + mu * tt) * p_n;
            if p_n >= 0.0 && sign * u_t >= 0.0 {
                return (status, mu * p_n, p_n);
            }
        }
        // Friction so strong that no state fits alone: let the normal impulse decide, the others will move on.
        (Status::Stick, 0.0, -free_n / nn)
    }
}
