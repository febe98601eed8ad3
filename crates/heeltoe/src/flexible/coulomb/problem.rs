//! The numbers of a contact problem, and what its solver asks of the crack.

use super::super::simd::Lanes;

/// The numbers of one problem; the components along the crack of all contacts stand first, then those across it.
#[derive(Default)]
pub(in super::super) struct Problem {
    /// Symmetric, row by row.
    pub g: Vec<f64>,
    pub b: Vec<f64>,
    /// One for each contact.
    pub h: Vec<f64>,
    /// Coefficients of friction of each contact up to which it sticks, and with which it slips.
    pub mu_stick: Vec<f64>,
    pub mu_slip: Vec<f64>,
    /// What each contact bears beside that up to which it sticks, and with which it slips; empty without a law.
    pub added: Vec<[f64; 2]>,
    /// By how much what a contact bears beside friction is less for positive impulses, and more for negative ones;
    /// empty where it bears as much either way.
    pub lean: Vec<f64>,
    /// About what impulse changes the velocity of each component by 1: a scale to measure violations by.
    pub scale: Vec<f64>,
}

impl Problem {
    /// What a contact bears, of impulses `along` of either sign, beside friction in proportion to the normal impulse;
    /// nothing without a law.
    #[inline(always)]
    pub(super) fn added(&self, contact: usize, slips: bool, along: f64) -> f64 {
        let Some(added) = self.added.get(contact) else {
            return 0.0;
        };
        let added = added[usize::from(slips)];
        self.lean
            .get(contact)
            .map_or(added, |lean| added - lean * along.signum())
    }
}

/// What the solver asks of the crack.
pub(in super::super) trait ContactOperator {
    /// See that `G` is right where both contacts are `wanted`.
    fn fill(&mut self, problem: &mut Problem, wanted: impl Fn(usize) -> bool);

    /// See that `G` is right where a contact meets one that is `wanted`.
    fn fill_row(&mut self, problem: &mut Problem, contact: usize, wanted: impl Fn(usize) -> bool);

    /// `u = G p + b`.
    fn velocities<W: Lanes>(&mut self, problem: &Problem, p: &[f64], u: &mut [f64]);
}

/// No one to ask: `G` is right everywhere.
pub(in super::super) struct Known;

impl ContactOperator for Known {
    fn fill(&mut self, _: &mut Problem, _: impl Fn(usize) -> bool) {}

    fn fill_row(&mut self, _: &mut Problem, _: usize, _: impl Fn(usize) -> bool) {}

    fn velocities<W: Lanes>(&mut self, problem: &Problem, p: &[f64], u: &mut [f64]) {
        u.copy_from_slice(&problem.b);
        for (p, column) in p.iter().zip(problem.g.chunks_exact(p.len())) {
            u.iter_mut().zip(column).for_each(|(u, g)| *u += p * g);
        }
    }
}
