//! How the crack answers to forces in a step: `u = W p` through both faces, and `G` where contacts are closed.

use super::bodies::Sides;
use super::contact::Contacts;
use super::coulomb::{ContactOperator, Problem};
use super::coupling::Blocks;
use super::dampers::Dampers;
use super::modal_stepper::ModalStepper;
use super::simd::Lanes;

/// How the crack answers in a step, by what its faces do.
pub(super) struct FacesOperator<'s, 'a> {
    pub(super) contacts: &'s Contacts,
    pub(super) blocks: &'s mut Blocks,
    pub(super) bodies: &'s mut Sides<ModalStepper<'a>>,
    pub(super) dampers: &'s mut Dampers<'a>,
    pub(super) damping: usize,
    pub(super) softness: f64,
}

impl ContactOperator for FacesOperator<'_, '_> {
    #[inline(always)]
    fn fill(&mut self, problem: &mut Problem, wanted: impl Fn(usize) -> bool) {
        let answers = self.bodies.map(|body| body.answers(self.damping));
        let gain = self.dampers.holding(self.damping);
        self.blocks.fill(
            &mut problem.g,
            self.contacts,
            answers,
            gain,
            self.softness,
            wanted,
        );
    }

    #[inline(always)]
    fn fill_row(&mut self, problem: &mut Problem, contact: usize, wanted: impl Fn(usize) -> bool) {
        let answers = self.bodies.map(|body| body.answers(self.damping));
        let gain = self.dampers.holding(self.damping);
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

    #[inline(always)]
    fn velocities<W: Lanes>(&mut self, _: &Problem, p: &[f64], u: &mut [f64]) {
        let (upper, lower) = self.bodies.both_mut(|body| &mut body.impulse);
        self.contacts.spread(p, upper, lower);
        self.dampers.answer::<W>(self.bodies, self.damping);
        let faces = self.bodies.faces(|body| body.at_crack(&body.answer));
        self.contacts.relative(faces, u);
        if self.softness > 0.0 {
            u.iter_mut().zip(p).for_each(|(u, p)| *u += self.softness * p);
        }
    }
}
