//! The contact problem of a step, put together from what both faces do.
//!
//! With the crack's answers `W` of both parts and the weights `B` of the nodes at each contact
//!
//! ```text
//! G = B W B^T,      b = B u_f
//! ```
//!
//! as [`super::coulomb`] needs them.

use super::contact::{relative, spread, Contacts, Pair};
use super::coulomb::{Problem, Report, Solver};
use super::dam::Dam;
use super::sides::{Faces, Sides};
use super::status::Status;

/// The contact problem of a step, in terms of the faces.
pub(super) struct Crack {
    pub contacts: Contacts,
    pub problem: Problem,
    pub solver: Solver,
    /// Normal velocity before the step, and whether the contact was closed.
    pub approach: Vec<f64>,
    pub closed: Vec<bool>,
    /// State of damping that `problem.g` belongs to.
    pub assembled: Option<usize>,
}

impl Crack {
    pub(super) fn new(dam: &Dam) -> Self {
        let lower = dam.bodies.lower.as_ref().map_or(0, |body| body.nodes);
        let contacts = Contacts::new(dam.contactors, dam.bodies.upper.nodes, lower);
        let m = contacts.len();
        Crack {
            problem: Problem {
                g: vec![0.0; 4 * m * m],
                b: vec![0.0; 2 * m],
                h: vec![0.0; m],
                mu_stick: vec![dam.friction[0]; m],
                mu_slip: dam.friction[1],
            },
            solver: Solver::new(m),
            approach: vec![0.0; m],
            closed: vec![true; m],
            contacts,
            assembled: None,
        }
    }

    /// Find where the nodes of both faces meet; where pairs are others, or the state of damping is, put `G` together
    /// from the crack's `answers`. `softness` is added to the answer to itself, and gets the largest of them to go by.
    /// Returns whether it has been put together anew.
    #[inline(always)]
    pub(super) fn meet<'w>(
        &mut self,
        position: Faces,
        damping: usize,
        answers: impl Fn() -> Sides<Answer<'w>>,
        softness: impl Fn(f64) -> f64,
    ) -> bool {
        let status = &self.solver.status;
        self.contacts
            .update(position.upper, position.lower, |k| status[k] == Status::Stick);
        if self.assembled != Some(damping) {
            self.contacts.moved.fill(true);
        }
        let other = self.contacts.any_moved();
        if other {
            self.assemble(answers(), softness);
            self.assembled = Some(damping);
        }
        other
    }

    /// Write how each contact answers to an impulse at any other, where one of both has moved.
    #[inline(always)]
    pub(super) fn assemble(&mut self, answers: Sides<Answer>, softness: impl Fn(f64) -> f64) {
        let size = self.problem.b.len();
        let moved = &self.contacts.moved;
        let mut largest = 0.0_f64;
        for (i, one) in self.contacts.pairs.iter().enumerate() {
            for (j, other) in self.contacts.pairs[..=i].iter().enumerate() {
                if !(moved[i] || moved[j]) {
                    continue;
                }
                let mut block = [[0.0; 2]; 2];
                if let (Some(one), Some(other)) = (one, other) {
                    couple(&mut block, &one.upper, &other.upper, answers.upper);
                    if let Some(lower) = answers.lower {
                        couple(&mut block, &one.lower, &other.lower, lower);
                    }
                }
                for (a, row) in block.iter().enumerate() {
                    for (b, value) in row.iter().enumerate() {
                        self.problem.g[(2 * i + a) * size + 2 * j + b] = *value;
                        self.problem.g[(2 * j + b) * size + 2 * i + a] = *value;
                    }
                }
                if i == j {
                    largest = largest.max(block[0][0]).max(block[1][1]);
                }
            }
        }
        let soft = softness(largest);
        if soft > 0.0 {
            for k in (0..size).filter(|k| moved[k / 2]) {
                self.problem.g[k * (size + 1)] += soft;
            }
        }
        self.solver.forget(moved);
    }
}

/// What a contact does in a step without impulses: motion along and across, the room it has, and how fast it opens.
pub(super) struct WithoutContact {
    pub b: [f64; 2],
    pub h: f64,
    pub approach: f64,
}

/// How the crack nodes of a body answer to impulses on them, row by row.
#[derive(Clone, Copy)]
pub(super) struct Answer<'a> {
    pub w: &'a [f64],
    pub nodes: usize,
}

/// Add what the nodes of one contact feel of those of another, in one part.
#[inline(always)]
fn couple(block: &mut [[f64; 2]; 2], one: &[(usize, f64); 2], other: &[(usize, f64); 2], answer: Answer) {
    let Answer { w, nodes } = answer;
    let columns = 2 * nodes;
    for &(i, a) in one {
        for &(j, b) in other {
            let weight = a * b;
            if weight != 0.0 {
                for (r, row) in block.iter_mut().enumerate() {
                    for (c, value) in row.iter_mut().enumerate() {
                        *value += weight * w[(r * nodes + i) * columns + c * nodes + j];
                    }
                }
            }
        }
    }
}

impl Crack {
    /// Write the contact problem of the step; `without` says what becomes of a contact without further impulses, from its
    /// pair, its gap and the impulse it has had.
    #[inline(always)]
    pub(super) fn set_up(
        &mut self,
        friction: [f64; 2],
        without: impl Fn(&Pair, f64, &[f64]) -> WithoutContact,
    ) {
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let status = self.solver.status[k];
            self.closed[k] = status.closed();
            let Some(pair) = pair else {
                self.solver.status[k] = Status::Absent;
                self.problem.b[2 * k] = 0.0;
                self.problem.b[2 * k + 1] = 0.0;
                self.approach[k] = 0.0;
                continue;
            };
            if status == Status::Absent {
                self.solver.status[k] = Status::Open;
            }
            let found = without(pair, self.contacts.gaps[k], &self.solver.p[2 * k..2 * k + 2]);
            self.problem.b[2 * k..2 * k + 2].copy_from_slice(&found.b);
            self.problem.h[k] = found.h;
            self.approach[k] = found.approach;
            self.problem.mu_stick[k] = friction[usize::from(status.slips())];
        }
    }

    /// Take the forces of a dam at rest for the solution of a step.
    pub(super) fn hold(&mut self, forces: &[f64], dt: f64) -> Report {
        for (p, force) in self.solver.p.iter_mut().zip(forces) {
            *p = dt * force;
        }
        self.solver.u.fill(0.0);
        Report {
            iterations: 1,
            ..Report::default()
        }
    }

    /// Put the impulses on both faces and return their sums along and across the crack.
    #[inline(always)]
    pub(super) fn impulses(&self, upper: &mut [f64], lower: &mut [f64]) -> [f64; 2] {
        upper.fill(0.0);
        lower.fill(0.0);
        let mut sum = [0.0; 2];
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let Some(pair) = pair else { continue };
            for (direction, sum) in sum.iter_mut().enumerate() {
                let p = self.solver.p[2 * k + direction];
                if p != 0.0 {
                    spread(pair, direction, p, upper, lower);
                    *sum += p;
                }
            }
        }
        sum
    }

    /// Work of the impulses on given velocities, along and across the crack.
    #[inline(always)]
    pub(super) fn work(&self, velocity: Faces) -> [f64; 2] {
        let mut work = [0.0; 2];
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let Some(pair) = pair else { continue };
            for (direction, work) in work.iter_mut().enumerate() {
                let p = self.solver.p[2 * k + direction];
                if p != 0.0 {
                    *work += p * relative(pair, velocity.upper, velocity.lower, direction);
                }
            }
        }
        work
    }
}
