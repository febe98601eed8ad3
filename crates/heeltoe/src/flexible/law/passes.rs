//! Finding what a law bears in a step together with the forces that it depends on.
//!
//! A pass solves the contact problem with a straight line for what each contact bears,
//!
//! ```text
//! |p_t| <= m p_n + c,      m p_n + c = h S(p_n / h, d) at the p_n and d of the pass before
//! ```
//!
//! and is the last where the lines meet the law where the contacts are. The slope `m` is that of the law, or one near it:
//! another one costs new factors of the problem, a slope that is a little off no more than another pass.
//!
//! A problem with `c > 0` need not have a solution: friction of a contact that hardly anything presses may push it off the
//! other face, where it would not be without. Then the lines go through the origin, but for the bond, and the bond of the
//! contact that breaks its conditions most breaks.

use super::super::coulomb::{Problem, Report, Solver};
use super::super::scheme::TimeStep;
use super::super::simd::largest;
use super::super::status::Status;
use super::sideways::Sideways;
use super::worked::Worked;
use super::Laws;

/// A slope that changes and is off by less than this is kept.
const NEAR: f64 = 0.02;
/// What a line may miss the law by, as a share of the largest impulse: no more than the contact problem itself may.
const MISSED: f64 = 1e-11;
/// A solution that breaks the conditions of contact by more is none.
const NONE: f64 = 1e-9;
/// Passes after which half of each change must do, and what is found where contact has no solution; and after which it
/// must do anyhow. Its miss is in the residual.
const HALVED: u32 = 12;
const MOST: u32 = 40;

impl Laws {
    /// Write into a problem what contacts bear as a step begins, with the states that they have.
    pub(in super::super) fn set_up(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        before: &[f64],
        sideways: Sideways,
        dt: f64,
    ) {
        problem.added.resize(solver.status.len(), [0.0; 2]);
        (self.passes, self.careful) = (0, false);
        for worked in &mut self.contacts {
            let k = worked.contact;
            worked.speed = Sideways::size(before[k], sideways.before.get(k).copied());
            worked.look(&self.of_cracks, 0.0);
            let slope = worked.bears.coefficient[1];
            worked.steady = worked.slope == slope;
            worked.slope = slope;
        }
        self.draw(problem, solver, dt);
    }

    /// Whether a solution meets the law, which then books it; if not, draw lines that are nearer to it.
    pub(in super::super) fn met(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        before: &[f64],
        sideways: Sideways,
        step: TimeStep,
        report: &mut Report,
    ) -> bool {
        self.passes += 1;
        let missed = self.missed(problem, solver, before, sideways, step);
        let none = report.residual > NONE;
        let mut most = MOST;
        if none {
            self.careful = true;
            if !self.break_worst(problem, solver) {
                most = HALVED;
            }
        }
        if (none || missed > MISSED) && self.passes < most {
            self.draw(problem, solver, step.dt);
            return false;
        }
        report.residual = report.residual.max(missed);
        if none {
            // A bond has broken since.
            for worked in &mut self.contacts {
                worked.look(&self.of_cracks, worked.moved);
            }
        }
        self.book(&solver.status);
        true
    }

    /// Look at what contacts bear where they are now, and return by how much the lines of the problem miss it, over the
    /// largest impulse.
    fn missed(
        &mut self,
        problem: &Problem,
        solver: &Solver,
        before: &[f64],
        sideways: Sideways,
        step: TimeStep,
    ) -> f64 {
        let m = solver.status.len();
        let largest = largest(&solver.p);
        let mut missed = 0.0_f64;
        for worked in &mut self.contacts {
            let k = worked.contact;
            let status = solver.status[k];
            let p_n = solver.p[m + k];
            worked.pressed = p_n / step.dt;
            worked.moved = worked.way(status, (solver.u[k], before[k]), sideways, step);
            worked.look(&self.of_cracks, worked.moved);
            let bears = |slides: usize| step.dt * worked.borne(slides);
            missed = missed.max(match status {
                Status::Absent | Status::Open => 0.0,
                // The line of a contact that sticks need not meet the law, if it sticks by both.
                Status::Stick => {
                    let along_and_across = Sideways::size(solver.p[k], sideways.p.get(k).copied());
                    along_and_across - bears(usize::from(worked.slipped))
                }
                _ => (problem.mu_slip[k] * p_n + problem.added[k][1] - bears(1)).abs(),
            });
        }
        if largest > 0.0 {
            missed / largest
        } else {
            0.0
        }
    }

    /// Break the bond of the contact that breaks its conditions most; false where there is none to break.
    fn break_worst(&mut self, problem: &Problem, solver: &Solver) -> bool {
        let violation = |worked: &Worked| solver.violation(problem, worked.contact);
        let bonded = self.contacts.iter_mut().filter(|worked| {
            worked.bond[0] > 0.0 && solver.status[worked.contact] != Status::Absent && violation(worked) > 0.0
        });
        let Some(worked) = bonded.max_by(|a, b| violation(a).total_cmp(&violation(b))) else {
            return false;
        };
        worked.worn.bonded = false;
        (0..2).for_each(|k| worked.bears.constant[k] -= worked.bond[k]);
        worked.bond = [0.0; 2];
        true
    }

    /// Draw the lines through what contacts bear where they are.
    fn draw(&mut self, problem: &mut Problem, solver: &mut Solver, dt: f64) {
        let far = if self.passes > HALVED { 0.5 } else { 1.0 };
        self.turned.fill(false);
        let mut any = false;
        for worked in &self.contacts {
            let k = worked.contact;
            let slides = usize::from(worked.slipped);
            let through = |slides: usize, slope: f64| dt * (worked.borne(slides) - slope * worked.pressed);
            let steep = worked.slopes(self.careful);
            problem.mu_stick[k] = steep[slides];
            problem.added[k][0] = through(slides, steep[slides]);
            let off = (steep[1] - problem.mu_slip[k]).abs();
            if self.careful || off > if worked.steady { 0.0 } else { NEAR } {
                problem.mu_slip[k] = steep[1];
                problem.added[k][1] = through(1, steep[1]);
                (self.turned[k], any) = (true, true);
            } else {
                let added = &mut problem.added[k][1];
                *added += far * (through(1, problem.mu_slip[k]) - *added);
            }
        }
        if any {
            solver.forget(&self.turned);
        }
    }
}

impl Worked {
    /// Slopes of the lines at rest and sliding: those of the law or, to be careful, those to the origin but for the bond.
    fn slopes(&self, careful: bool) -> [f64; 2] {
        if !careful || self.pressed <= 0.0 {
            return self.bears.coefficient;
        }
        [0, 1].map(|k| (self.borne(k) - self.bond[k]) / self.pressed)
    }
}
