//! Finding what bonds bear in a step together with the motion that it depends on.
//!
//! A pass solves the contact problem under what the bonds bore in the pass before, and is the last where they bear that
//! after the motion it finds. Where the ground shakes across the valley, what they bear that way is part of it.

use super::super::across::Across;
use super::super::contact_operator::FacesOperator;
use super::super::coulomb::{ContactOperator, Problem, Report, Solver};
use super::super::law::sideways::Sideways;
use super::super::scheme::TimeStep;
use super::super::simd::{largest, Lanes};
use super::super::status::Status;
use super::{size, Bonds};

/// Miss that the bond of the last pass may have, as a share of the largest impulse.
const MISSED: f64 = 1e-11;
/// Velocity of a node that sticks, as a share of the fastest: rounding.
const ROUNDED: f64 = 1e-11;
/// Passes after which half of each change must do, and after which what is found must do. Its miss is in the residual.
const HALVED: u32 = 20;
const MOST: u32 = 60;

impl Bonds {
    /// Solve the contact problem of a step with the bonds; `moved` says that the crack may answer otherwise than before.
    pub(in super::super) fn solve<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        (crack, mut across): (&mut FacesOperator, Option<&mut Across>),
        before: &[f64],
        step: TimeStep,
        moved: &mut bool,
    ) -> Report {
        let mut report = Report::default();
        self.passes = 0;
        if let Some(across) = across.as_deref_mut() {
            across.part_with_bonds();
            self.own_across.clone_from(&across.rows.b);
        }
        self.own.clone_from(&problem.b);
        // The last solution is that of contact alone again.
        let left = solver.p.iter_mut().zip(&self.pushed);
        left.for_each(|(p, pushed)| *p -= pushed);
        loop {
            if *moved || self.pushed != self.shift {
                self.pushed.clone_from(&self.shift);
                crack.velocities::<W>(problem, &self.pushed, &mut self.push);
                self.push.iter_mut().zip(&self.own).for_each(|(u, b)| *u -= b);
                *moved = false;
            }
            for (b, (own, push)) in problem.b.iter_mut().zip(self.own.iter().zip(&self.push)) {
                *b = own + push;
            }
            if let Some(across) = across.as_deref_mut() {
                let (push, bonds) = (&mut self.push_across, &self.shift_across);
                across.push_by_bonds::<W>(crack.contacts, bonds, &self.own_across, push);
            }
            let mut shifted = Shifted {
                crack: &mut *crack,
                sum: std::mem::take(&mut self.sum),
                shift: &self.pushed,
            };
            report.go_on(match across.as_deref_mut() {
                None => solver.solve::<W>(problem, &mut shifted),
                Some(across) => {
                    let report = shifted.crack.solve_disc::<W>(problem, solver, across);
                    shifted.velocities::<W>(problem, &solver.p, &mut solver.u);
                    report
                }
            });
            self.sum = shifted.sum;
            let sideways = across.as_deref().map_or_else(Sideways::default, Across::sideways);
            let met = self.met(problem, solver, before, sideways, step, &mut report);
            problem.b.copy_from_slice(&self.own);
            if met {
                // Those that the solution was found with, not those of a next pass.
                self.shift.clone_from(&self.pushed);
                break;
            }
        }
        if let Some(across) = across {
            self.shift_across.clone_from(&across.bonds);
            across.join_bonds(&self.own_across);
        }
        let whole = solver.p.iter_mut().zip(&self.pushed);
        whole.for_each(|(p, pushed)| *p += pushed);
        report
    }

    /// Look at a solution; whether it meets the law of the bonds.
    fn met(
        &mut self,
        problem: &mut Problem,
        solver: &Solver,
        before: &[f64],
        sideways: Sideways,
        step: TimeStep,
        report: &mut Report,
    ) -> bool {
        self.passes += 1;
        let m = solver.status.len();
        let way = |u: f64, before: f64| step.dt * (step.theta * u + (1.0 - step.theta) * before);
        let fastest = largest(&problem.b).max(largest(&self.own_across));
        let largest = largest(&solver.p)
            .max(largest(&self.shift))
            .max(largest(sideways.p))
            .max(largest(&self.shift_across));
        for bond in self.iter_mut() {
            let k = bond.contact;
            let [along, apart] = [k, m + k].map(|i| way(solver.u[i], before[i]));
            let of = |numbers: &[f64]| numbers.get(k).copied().unwrap_or(0.0);
            let mut slip = [along, way(of(sideways.u), of(sideways.before))];
            // A node that goes on to stick does not move: its bond bears the same to the last bit.
            if solver.status[k] == Status::Stick && size(slip) <= ROUNDED * fastest * step.dt {
                slip = [0.0; 2];
            }
            let shear = [solver.p[k], of(sideways.p)].map(|impulse| impulse / step.dt);
            bond.follow(solver.status[k], [slip[0], apart, slip[1]], shear);
        }
        let far = if self.passes > HALVED { 0.5 } else { 1.0 };
        let change = self.draw(problem, step.dt, far);
        if change <= MISSED * largest || self.passes >= MOST {
            report.residual = report
                .residual
                .max(if largest > 0.0 { change / largest } else { 0.0 });
            return true;
        }
        false
    }
}

/// The crack under the impulses of the bonds and those that are looked for.
struct Shifted<'s, C> {
    crack: &'s mut C,
    shift: &'s [f64],
    sum: Vec<f64>,
}

impl<C: ContactOperator> ContactOperator for Shifted<'_, C> {
    fn fill(&mut self, problem: &mut Problem, wanted: impl Fn(usize) -> bool) {
        self.crack.fill(problem, wanted);
    }

    fn fill_row(&mut self, problem: &mut Problem, contact: usize, wanted: impl Fn(usize) -> bool) {
        self.crack.fill_row(problem, contact, wanted);
    }

    fn velocities<W: Lanes>(&mut self, problem: &Problem, p: &[f64], u: &mut [f64]) {
        for (sum, (p, own)) in self.sum.iter_mut().zip(p.iter().zip(self.shift)) {
            *sum = p + own;
        }
        let sum = std::mem::take(&mut self.sum);
        self.crack.velocities::<W>(problem, &sum, u);
        self.sum = sum;
    }
}
