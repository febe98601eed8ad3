//! The dam as its cracks see it: a linear system between any two steps of contact.
//!
//! Elastic bodies in their modes, dashpots between them, rock that takes waves away and the water of a reservoir all
//! answer linearly to impulses `p` in the cracks. With the velocities `u_f` that a step ends with without contact,
//!
//! ```text
//! u = u_f + W p
//! ```
//!
//! and the contact problem asks for no more than `u_f`, `W p`, single entries of `W`, and that all follow once `p` is
//! known. What a dam is made of besides concrete comes in here, behind these few questions.

use super::body::ReducedBody;
use super::compliance::Compliance;
use super::contact::Contacts;
use super::crack_forces::CrackForces;
use super::dampers::{Dampers, HeldNodes, Holding};
use super::dowels::Dowels;
use super::faces::Faces;
use super::ledger::Ledger;
use super::modal_stepper::{advance, move_crack, Drive, ModalStepper};
use super::reservoir::Reservoir;
use super::scheme::TimeStep;
use super::simd::{Group, Lanes};
use super::still::Still;

/// Bodies, dashpots and water in a step.
pub(super) struct LinearDam<'a> {
    bodies: Vec<ModalStepper<'a>>,
    dampers: Dampers<'a>,
    /// What drives this step.
    drive: Drive,
    pub(super) step: TimeStep,
}

impl<'a> LinearDam<'a> {
    /// The dam as it stands before the earthquake; it starts with the damping of cracks that stick.
    pub(super) fn new(
        bodies: &'a [ReducedBody],
        reservoir: Option<&'a Reservoir>,
        still: Option<&'a Still>,
        step: TimeStep,
    ) -> Self {
        let parts = bodies.iter().enumerate();
        let bodies: Vec<_> = parts
            .map(|(part, body)| ModalStepper::new(body, still, part, step))
            .collect();
        LinearDam {
            dampers: Dampers::new(&bodies, reservoir, step),
            drive: Drive {
                ground: [0.0; 2],
                damping: 0,
            },
            bodies,
            step,
        }
    }

    /// Where the nodes around a crack are.
    #[inline(always)]
    pub(super) fn position(&self, crack: usize) -> Faces<'_> {
        Faces::around(crack, &self.bodies, |body| &body.position)
    }

    /// Their velocities.
    #[inline(always)]
    pub(super) fn velocity(&self, crack: usize) -> Faces<'_> {
        Faces::around(crack, &self.bodies, |body| &body.velocity)
    }

    /// Their velocities at the end of the step without contact, once what else acts in the cracks is known.
    #[inline(always)]
    pub(super) fn free(&self, crack: usize) -> Faces<'_> {
        Faces::around(crack, &self.bodies, |body| body.at_crack(&body.free))
    }

    /// Their velocities with the impulses of contact, as [`Self::answer`] finds them.
    #[inline(always)]
    pub(super) fn answered(&self, crack: usize) -> Faces<'_> {
        Faces::around(crack, &self.bodies, |body| body.at_crack(&body.answer))
    }

    /// The impulses on them.
    #[inline(always)]
    pub(super) fn impulse(&self, crack: usize) -> Faces<'_> {
        Faces::around(crack, &self.bodies, |body| &body.impulse)
    }

    /// Put the impulses of contact on them.
    #[inline(always)]
    pub(super) fn spread(&mut self, contacts: &Contacts, impulses: &[f64]) {
        contacts.spread(impulses, &mut self.bodies, |body| &mut body.impulse);
    }

    /// The same of impulses across the valley.
    pub(super) fn spread_across(&mut self, contacts: &Contacts, impulses: &[f64]) {
        contacts.spread_across(impulses, &mut self.bodies, |body| &mut body.impulse);
    }

    /// How the crack nodes answer in a state of damping, dashpots included.
    pub(super) fn held(&self, damping: usize) -> HeldNodes {
        self.dampers.held(&self.bodies, damping)
    }

    /// The state of damping of this step.
    #[inline(always)]
    pub(super) fn damping(&self) -> usize {
        self.drive.damping
    }

    /// Entries of `W` of a part without dashpots and water; none of a rigid plane.
    #[inline(always)]
    pub(super) fn answers(&self, part: usize) -> Option<Compliance<'_>> {
        let body = self.bodies.get(part)?;
        Some(body.answers(self.drive.damping))
    }

    /// What dashpots and water hold back of it.
    #[inline(always)]
    pub(super) fn holding(&self) -> Holding<'_> {
        self.dampers.holding(self.drive.damping)
    }

    /// Whether nothing moves or drives it.
    #[inline(always)]
    pub(super) fn rests(&self) -> bool {
        self.bodies.iter().all(ModalStepper::rests) && self.dampers.rests(self.drive.ground)
    }

    /// Let the modes finish the present step, where there is one, and begin another driven so.
    pub(super) fn advance<W: Lanes>(&mut self, under_way: bool, next: Drive) {
        let now = under_way.then_some(self.drive);
        self.drive = next;
        for body in self.bodies.iter_mut() {
            advance::<W>(body, now, next, self.step);
        }
    }

    /// Let what is in the cracks beside contact push the nodes of their faces.
    pub(super) fn push(&mut self, acting: &mut CrackForces) {
        acting.find(
            |crack| self.position(crack),
            |crack| self.velocity(crack),
            self.step,
        );
        acting.spread(&mut self.bodies, |body| &mut body.push);
    }

    /// The same of anchors across the valley.
    pub(super) fn push_across(&mut self, dowels: &mut Dowels) {
        dowels.find(
            |crack| self.position(crack),
            |crack| self.velocity(crack),
            self.step,
        );
        dowels.spread(&mut self.bodies, |body| &mut body.push);
    }

    /// Find the velocities without contact: with what acts beside it, where anything does, less the forces that the start
    /// has in the cracks, where it has been found, and with dashpots and water.
    pub(super) fn find_free<W: Lanes>(&mut self, acting: bool, still: bool) {
        let damping = self.drive.damping;
        for body in self.bodies.iter_mut() {
            if still {
                body.let_go(self.step.dt, !acting);
            }
            if acting || still {
                body.push_crack::<W>(damping, !acting);
            }
        }
        if !self.dampers.is_empty() {
            self.dampers.begin::<W>(&mut self.bodies, self.drive);
        }
    }

    /// Find the velocities with the impulses of contact.
    pub(super) fn answer<W: Lanes>(&mut self) {
        self.dampers.answer::<W>(&mut self.bodies, self.drive.damping);
    }

    /// Move the crack nodes, whose impulses are final.
    pub(super) fn finish<W: Lanes>(&mut self) {
        if !self.dampers.is_empty() {
            self.dampers.finish::<W>(&mut self.bodies, self.drive);
        }
        for body in self.bodies.iter_mut() {
            move_crack::<W>(body, self.step);
        }
    }

    /// Hand the bodies all impulses of the step: those of contact, less what the start has in it, and the others.
    pub(super) fn join(&mut self, quiet: bool, pushed: bool) {
        for body in self.bodies.iter_mut() {
            if quiet {
                body.impulse.fill(0.0);
            } else if pushed {
                body.join_push();
            }
        }
    }

    /// Amplitudes of all modes.
    #[inline(always)]
    pub(super) fn amplitudes(&self) -> Vec<Vec<Group>> {
        self.bodies.iter().map(ModalStepper::amplitudes).collect()
    }

    /// Modes of the part at the crest since the start.
    #[inline(always)]
    pub(super) fn moved(&self) -> &[Group] {
        &self.bodies[0].q
    }

    /// Velocities of the water's modes.
    pub(super) fn water(&self) -> &[f64] {
        self.dampers.water()
    }

    /// The same in groups; None without water.
    pub(super) fn water_groups(&self) -> Option<&Vec<Group>> {
        self.dampers.water_groups()
    }

    /// Energy of the bodies.
    pub(super) fn energy(&self) -> f64 {
        let of = |body: &ModalStepper| body.body.energy(&body.amplitudes(), &body.v);
        self.bodies.iter().map(of).sum()
    }

    /// Add the works of bodies, dashpots and water to a ledger, and what they hold.
    pub(super) fn book(&self, ledger: &mut Ledger) {
        for body in self.bodies.iter() {
            body.sums.book(ledger);
        }
        ledger.stored = self.energy() + ledger.springs;
        self.dampers.book(ledger);
    }
}
