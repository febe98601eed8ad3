//! The contact problem by sweeps over the contacts (Gauss and Seidel): slow but safe.
//!
//! Each contact is solved with the others held, `u = G_ii p_i + (u - G_ii p_i)_held`, until nothing changes. Of many contacts
//! the states settle long before the impulses do: once they have not changed for a while, the impulses that belong to them
//! are for the solver to find, and to look at.

use super::super::simd::Plain;
use super::super::status::Status;
use super::{ContactOperator, Known, Problem, Solver, Sweeps};

/// Most sweeps.
const SWEEPS: u32 = 5000;

impl Solver {
    /// Sweep until nothing changes or there have been enough, or, which is false, until the states have settled.
    // In line it would be compiled a dozen times over.
    #[inline(never)]
    pub(super) fn sweep(&mut self, problem: &Problem, sweeps: &mut Sweeps) -> bool {
        let (m, size) = (self.status.len(), problem.b.len());
        for contact in 0..m {
            let p_n = self.p[m + contact].max(0.0);
            let limit =
                |along| (problem.mu_stick[contact] * p_n + problem.added(contact, false, along)).max(0.0);
            self.p[m + contact] = if self.status[contact].closed() { p_n } else { 0.0 };
            self.p[contact] = if self.status[contact].closed() {
                self.p[contact].clamp(-limit(-1.0), limit(1.0))
            } else {
                0.0
            };
        }
        while sweeps.count < SWEEPS {
            sweeps.count += 1;
            let mut same = true;
            Known.velocities::<Plain>(problem, &self.p, &mut self.u);
            let (mut change, mut largest) = (0.0_f64, 0.0_f64);
            for contact in 0..m {
                if self.status[contact] == Status::Absent {
                    continue;
                }
                let (i, j) = (contact, m + contact);
                let g = |r: usize, c: usize| problem.g[(i + r * m) * size + i + c * m];
                let (p_t, p_n) = (self.p[i], self.p[j]);
                let free_t = self.u[i] - g(0, 0) * p_t - g(0, 1) * p_n;
                let free_n = self.u[j] + problem.h[contact] - g(1, 0) * p_t - g(1, 1) * p_n;
                let local = Local {
                    g: [[g(0, 0), g(0, 1)], [g(1, 0), g(1, 1)]],
                    free: [free_t, free_n],
                    mu_stick: problem.mu_stick[contact],
                    mu_slip: problem.mu_slip[contact],
                    added: [-1.0, 1.0]
                        .map(|along| [false, true].map(|slips| problem.added(contact, slips, along))),
                };
                let (status, new_t, new_n) = local.solve();
                same &= self.status[contact] == status;
                self.status[contact] = status;
                let (dt, dn) = (new_t - p_t, new_n - p_n);
                change = change.max(dt.abs()).max(dn.abs());
                largest = largest.max(new_n.abs());
                self.p[i] = new_t;
                self.p[j] = new_n;
                for (row, u) in self.u.iter_mut().enumerate() {
                    *u += problem.g[i * size + row] * dt + problem.g[j * size + row] * dn;
                }
            }
            if change <= 1e-13 * largest {
                return true;
            }
            sweeps.same = if same { sweeps.same + 1 } else { 0 };
            if sweeps.same == sweeps.look {
                (sweeps.same, sweeps.look) = (0, 2 * sweeps.look);
                return false;
            }
        }
        true
    }
}

/// The problem of a single contact, the others held.
struct Local {
    g: [[f64; 2]; 2],
    free: [f64; 2],
    mu_stick: f64,
    mu_slip: f64,
    /// For impulses against its direction and along it: what it sticks with, and slips with.
    added: [[f64; 2]; 2],
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
        let added = self.added[usize::from(stick_t > 0.0)][0];
        if stick_n >= 0.0 && stick_t.abs() <= self.mu_stick * stick_n + added {
            return (Status::Stick, stick_t, stick_n);
        }
        for (status, sign) in [(Status::SlipDownstream, 1.0), (Status::SlipUpstream, -1.0)] {
            let mu = -sign * self.mu_slip;
            let added = -sign * self.added[usize::from(sign < 0.0)][1];
            let p_n = -(free_n + nt * added) / (nn + mu * nt);
            let u_t = free_t + (tn + mu * tt) * p_n + tt * added;
            if p_n >= 0.0 && sign * u_t >= 0.0 {
                return (status, mu * p_n + added, p_n);
            }
        }
        // Friction so strong that no state fits alone: let the normal impulse decide, the others will move on.
        (Status::Stick, 0.0, -free_n / nn)
    }
}
