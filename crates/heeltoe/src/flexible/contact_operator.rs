//! How the crack answers to forces in a step: `u = W p` through both faces, and `G` where contacts are closed.

use super::across::Across;
use super::contact::Contacts;
use super::coulomb::{ContactOperator, Problem, Report, Solver};
use super::coupling::Blocks;
use super::linear::LinearDam;
use super::simd::Lanes;
use super::status::Status;

/// How the crack answers in a step, by what its faces do.
pub(super) struct FacesOperator<'s, 'a> {
    pub(super) contacts: &'s Contacts,
    pub(super) blocks: &'s mut Blocks,
    pub(super) linear: &'s mut LinearDam<'a>,
    pub(super) softness: f64,
}

impl FacesOperator<'_, '_> {
    /// Solve the contact problem of a step together with that across the valley; `before` are the velocities before the
    /// step.
    pub(super) fn solve_across<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        across: &mut Across,
        before: &[f64],
    ) -> Report {
        across.leave_out(self.contacts, problem, &solver.status, before);
        let mut report = Report::default();
        loop {
            report.go_on(self.solve_disc::<W>(problem, solver, across));
            self.velocities::<W>(problem, &solver.p, &mut solver.u);
            if !across.take_back(problem, solver) {
                return report;
            }
        }
    }

    /// Find the impulses of both.
    pub(super) fn solve_disc<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        across: &mut Across,
    ) -> Report {
        let moved = across.moved;
        across.mark_left_out(&mut solver.status, false);
        if moved {
            let there = |contact: usize| solver.status[contact] != Status::Absent;
            self.fill(problem, there);
            across.fill(self.contacts, there);
        }
        let (disc, rows) = across.problem();
        let solution = (&mut solver.p[..], &mut solver.u[..]);
        let report = disc.solve::<W>(problem, rows, &mut solver.status, solution, moved);
        across.mark_left_out(&mut solver.status, true);
        across.note();
        across.moved = false;
        report
    }
}

impl ContactOperator for FacesOperator<'_, '_> {
    fn fill(&mut self, problem: &mut Problem, wanted: impl Fn(usize) -> bool) {
        let (linear, gain) = (&*self.linear, self.linear.holding());
        let answers = |part| linear.answers(part);
        self.blocks.fill(
            &mut problem.g,
            self.contacts,
            &answers,
            gain,
            self.softness,
            wanted,
        );
    }

    fn fill_row(&mut self, problem: &mut Problem, contact: usize, wanted: impl Fn(usize) -> bool) {
        let (linear, gain) = (&*self.linear, self.linear.holding());
        let answers = |part| linear.answers(part);
        let others = (0..self.contacts.len()).filter(|other| wanted(*other));
        self.blocks.fill_row(
            &mut problem.g,
            self.contacts,
            &answers,
            gain,
            self.softness,
            contact,
            others,
        );
    }

    fn velocities<W: Lanes>(&mut self, _: &Problem, p: &[f64], u: &mut [f64]) {
        self.linear.spread(self.contacts, p);
        self.linear.answer::<W>();
        self.contacts.relative(|crack| self.linear.answered(crack), u);
        if self.softness > 0.0 {
            u.iter_mut().zip(p).for_each(|(u, p)| *u += self.softness * p);
        }
    }
}
