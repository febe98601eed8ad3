//! The contact problem of a step, of all cracks at once, put together from what all parts do.
//!
//! With the cracks' answers `W` of all parts and the weights `B` of the nodes at each contact
//!
//! ```text
//! G = B W B^T,      b = B u_f
//! ```
//!
//! as [`super::coulomb`] needs them; with dashpots (see [`super::dampers`]) less what they hold back, `G -= V N V^T` with
//! `V = B W_cd`. Contacts answer to each other through a part that both stand on: those of a crack through the parts
//! above and below it, those of two cracks through the part between them.

use super::compliance::Compliance;
use std::ops::Range;

use super::bond::Bonds;
use super::contact::{Contacts, Pair};
use super::coulomb::{Problem, Report, Solver, MANY};
use super::dam::Dam;
use super::dampers::Holding;
use super::faces::Faces;
use super::kinks::Turn;
use super::law::sideways::Sideways;
use super::law::spots::{spots, Spot};
use super::law::Laws;
use super::place::Place;
use super::scheme::TimeStep;
use super::status::Status;

/// The contact problem of a step, in terms of all parts.
pub(super) struct Crack {
    pub contacts: Contacts,
    pub problem: Problem,
    pub solver: Solver,
    pub blocks: Blocks,
    /// Velocities before the step, and whether the contact was closed.
    pub before: Vec<f64>,
    pub closed: Vec<bool>,
    /// What contacts of cracks with a law have been through.
    pub laws: Option<Laws>,
    /// The bonds of joints.
    pub bonds: Option<Bonds>,
    /// Coefficients of friction of each contact that sticks, and that slips.
    friction: Vec<[f64; 2]>,
    /// State of damping that the answers belong to.
    damping: Option<usize>,
    /// Whether they may be others than those that the bonds know.
    pub moved: bool,
}

impl Crack {
    /// `dampers` is the number of dashpots that hold the crack back; `shaken` says that bonds have their dynamic strength.
    pub(super) fn new(dam: &Dam, dampers: usize, shaken: bool) -> Self {
        let contacts = Contacts::new(dam.contactors, &Place::all(&dam.cracks), &dam.cracks);
        let m = contacts.len();
        let friction: Vec<[f64; 2]> = contacts
            .of_cracks()
            .zip(&dam.cracks)
            .flat_map(|(range, line)| range.map(|_| line.friction))
            .collect();
        let laws = Laws::new(dam, &contacts);
        let own = |spot: &Spot| (spot.length, spot.double.is_none());
        let shares: Vec<Vec<_>> = spots(dam, &contacts)
            .iter()
            .map(|spots| spots.iter().map(own).collect())
            .collect();
        let bonds = Bonds::new(&dam.cracks, &shares, shaken);
        Crack {
            problem: Problem {
                g: vec![0.0; 4 * m * m],
                b: vec![0.0; 2 * m],
                h: vec![0.0; m],
                mu_stick: friction.iter().map(|mu| mu[0]).collect(),
                mu_slip: friction.iter().map(|mu| mu[1]).collect(),
                scale: vec![0.0; 2 * m],
                added: Vec::new(),
                lean: Vec::new(),
            },
            solver: if m >= MANY && laws.is_none() && (bonds.is_none() || shaken) {
                Solver::with_inverse(m)
            } else {
                Solver::new(m)
            },
            blocks: Blocks::new(m, dampers),
            before: vec![0.0; 2 * m],
            closed: vec![true; m],
            laws,
            bonds,
            contacts,
            damping: None,
            moved: true,
            friction,
        }
    }

    /// Find where the nodes of both faces meet, and note whose answers are others: where pairs are, or the state of
    /// damping is.
    pub(super) fn meet<'f, 'w>(
        &mut self,
        position: impl Fn(usize) -> Faces<'f>,
        damping: usize,
        answers: impl Fn(usize) -> Option<Compliance<'w>>,
    ) {
        let status = &self.solver.status;
        self.contacts.update(position, |k| status[k] == Status::Stick);
        if self.damping != Some(damping) {
            self.contacts.moved.fill(true);
            self.damping = Some(damping);
        }
        if self.contacts.moved.contains(&true) {
            self.moved = true;
            self.blocks.note(&self.contacts.moved);
            self.solver.forget(&self.contacts.moved);
            self.blocks
                .measure(&mut self.problem.scale, &self.contacts, &answers);
        }
    }

    /// Take over the states of the contacts from the step before; `problem.b` is zero where nothing is met.
    pub(super) fn set_up(&mut self) {
        let limits = self.friction.iter().zip(&mut self.problem.mu_stick);
        let states = self.solver.status.iter_mut().zip(limits);
        for ((pair, closed), (status, (friction, mu))) in
            self.contacts.pairs.iter().zip(&mut self.closed).zip(states)
        {
            *closed = status.closed();
            match (pair, *status) {
                (None, _) => *status = Status::Absent,
                (_, Status::Absent) => *status = Status::Open,
                _ => {}
            }
            *mu = friction[usize::from(status.slips())];
        }
    }

    /// Let contacts with a law, and bonds, bear in a step what they do as it begins.
    pub(super) fn bear(&mut self, step: TimeStep, sideways: Sideways) {
        if let Some(laws) = &mut self.laws {
            let before = &self.before;
            laws.set_up(&mut self.problem, &mut self.solver, before, sideways, step.dt);
        }
        if let Some(bonds) = &mut self.bonds {
            let gaps = &self.contacts.gaps;
            bonds.set_up(&mut self.problem, &self.solver, gaps, sideways, step);
        }
    }

    /// What to add to the answers to themselves: this share of the largest.
    pub(super) fn softness(&self, share: f64) -> f64 {
        if share == 0.0 {
            return 0.0;
        }
        let known = self.problem.scale.iter().filter(|scale| **scale > 0.0);
        share / known.fold(f64::INFINITY, |a, scale| a.min(*scale))
    }

    /// Put all of `G` together.
    pub(super) fn fill<'w>(&mut self, answers: impl Fn(usize) -> Option<Compliance<'w>>, softness: f64) {
        let (g, contacts) = (&mut self.problem.g, &self.contacts);
        self.blocks
            .fill(g, contacts, &answers, Holding::Gain(&[]), softness, |_| true);
    }

    /// Take the forces of a dam at rest for the solution of a step.
    pub(super) fn hold(&mut self, forces: &[f64], dt: f64) -> Report {
        let m = self.contacts.len();
        // Rounding may have put a node at an end beyond it.
        let meets = |k: usize| self.contacts.pairs[k % m].is_some();
        let impulse = |(k, force): (usize, &f64)| if meets(k) { dt * force } else { 0.0 };
        self.solver.hold(forces.iter().enumerate().map(impulse));
        Report {
            iterations: 1,
            ..Report::default()
        }
    }

    /// Put the impulses on the crack nodes of all parts.
    pub(super) fn impulses<T>(&self, parts: &mut [T], of: impl Fn(&mut T) -> &mut Vec<f64>) {
        self.contacts.spread(&self.solver.p, parts, of);
    }

    /// Whether the bond of a contact holds it under the force found.
    pub(super) fn holds(&self, contact: usize) -> bool {
        let pressed = self.solver.p[self.contacts.len() + contact];
        self.bonds
            .as_ref()
            .is_some_and(|bonds| bonds.holds(contact, pressed))
    }

    /// Sums of the impulses of some contacts along and across their crack.
    pub(super) fn sums(&self, contacts: Range<usize>) -> [f64; 2] {
        let (along, across) = self.solver.p.split_at(self.contacts.len());
        if self.contacts.straight() {
            return [along, across].map(|impulses| impulses[contacts.clone()].iter().sum());
        }
        contacts.fold([0.0; 2], |sum, k| {
            let turn = self.contacts.pairs[k].map_or_else(Turn::default, |pair| pair.turn);
            let (t, n) = turn.back(along[k], across[k]);
            [sum[0] + t, sum[1] + n]
        })
    }
}

/// What is known of `G`.
pub(super) struct Blocks {
    /// Counts the times that something has moved.
    now: u64,
    /// When each contact moved last; when the block of two contacts, and what the dashpots feel of each, was worked out.
    moved: Vec<u64>,
    known: Vec<u64>,
    felt: Vec<u64>,
    /// `V` and `V N`, row by row.
    v: Vec<f64>,
    v_n: Vec<f64>,
    dampers: usize,
}

impl Blocks {
    fn new(contacts: usize, dampers: usize) -> Self {
        Blocks {
            now: 1,
            moved: vec![1; contacts],
            known: vec![0; contacts * contacts],
            felt: vec![0; contacts],
            v: vec![0.0; 2 * contacts * dampers],
            v_n: vec![0.0; 2 * contacts * dampers],
            dampers,
        }
    }

    fn note(&mut self, moved: &[bool]) {
        self.now += 1;
        for (at, moved) in self.moved.iter_mut().zip(moved) {
            if *moved {
                *at = self.now;
            }
        }
    }

    /// Note by what to measure contacts: how they answer to themselves where they first meet something.
    fn measure<'w>(
        &self,
        scale: &mut [f64],
        contacts: &Contacts,
        answers: &impl Fn(usize) -> Option<Compliance<'w>>,
    ) {
        let m = contacts.len();
        for (k, pair) in contacts.pairs.iter().enumerate() {
            if let (Some(pair), 0.0) = (pair, scale[k]) {
                let block = block(pair, pair, answers, Holding::Gain(&[]));
                (scale[k], scale[m + k]) = (1.0 / block[0][0], 1.0 / block[1][1]);
            }
        }
    }

    /// Write how each of the `wanted` contacts answers to an impulse at any other of them, where it is not known. `gain`
    /// says what dashpots and water hold back, `softness` is added to the answer to itself.
    pub(super) fn fill<'w>(
        &mut self,
        g: &mut [f64],
        contacts: &Contacts,
        answers: &impl Fn(usize) -> Option<Compliance<'w>>,
        gain: Holding,
        softness: f64,
        wanted: impl Fn(usize) -> bool,
    ) {
        for contact in (0..contacts.len()).filter(|contact| wanted(*contact)) {
            let others = (0..=contact).filter(|other| wanted(*other));
            self.fill_row(g, contacts, answers, gain, softness, contact, others);
        }
    }

    /// The same of one contact with `others`.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn fill_row<'w>(
        &mut self,
        g: &mut [f64],
        contacts: &Contacts,
        answers: &impl Fn(usize) -> Option<Compliance<'w>>,
        gain: Holding,
        softness: f64,
        i: usize,
        others: impl Iterator<Item = usize>,
    ) {
        let m = contacts.len();
        let Some(one) = &contacts.pairs[i] else {
            return;
        };
        self.feel(i, one, answers, gain);
        for j in others {
            let Some(other) = &contacts.pairs[j] else {
                continue;
            };
            let known = &mut self.known[i.max(j) * m + i.min(j)];
            if *known >= self.moved[i].max(self.moved[j]) {
                continue;
            }
            *known = self.now;
            self.feel(j, other, answers, gain);
            let block = block(one, other, answers, gain);
            for (a, row) in block.iter().enumerate() {
                for (b, value) in row.iter().enumerate() {
                    let held = self.held_back(a * m + i, b * m + j);
                    let own = if (i, a) == (j, b) { softness } else { 0.0 };
                    let value = value - held + own;
                    g[(a * m + i) * 2 * m + b * m + j] = value;
                    g[(b * m + j) * 2 * m + a * m + i] = value;
                }
            }
        }
    }

    /// Find what the dashpots feel of a contact.
    fn feel<'w>(
        &mut self,
        contact: usize,
        pair: &Pair,
        answers: &impl Fn(usize) -> Option<Compliance<'w>>,
        gain: Holding,
    ) {
        let d = self.dampers;
        let Holding::Gain(gain) = gain else { return };
        if d == 0 || self.felt[contact] >= self.moved[contact] {
            return;
        }
        self.felt[contact] = self.now;
        let m = self.moved.len();
        let felt = |k: usize, direction: usize| {
            let mut felt = 0.0;
            for (part, nodes) in pair.parts() {
                if let Some(answers) = answers(part) {
                    felt += answers.felt(2 * answers.nodes + k, nodes, direction);
                }
            }
            felt
        };
        for k in 0..d {
            let (along, across) = pair.turn.onto(felt(k, 0), felt(k, 1));
            self.v[contact * d + k] = along;
            self.v[(m + contact) * d + k] = across;
        }
        for direction in 0..2 {
            let first = (direction * m + contact) * d;
            for k in 0..d {
                let row = gain[k * d..][..d].iter().zip(&self.v[first..][..d]);
                self.v_n[first + k] = row.map(|(a, b)| a * b).sum();
            }
        }
    }

    /// What dashpots hold back of the answer of two components.
    #[inline(always)]
    fn held_back(&self, i: usize, j: usize) -> f64 {
        let d = self.dampers;
        let (one, other) = (&self.v[i * d..][..d], &self.v_n[j * d..][..d]);
        one.iter().zip(other).map(|(a, b)| a * b).sum()
    }
}

/// How a contact answers to another, but for dashpots that hold it back by their gain.
#[inline(always)]
fn block<'w>(
    one: &Pair,
    other: &Pair,
    answers: &impl Fn(usize) -> Option<Compliance<'w>>,
    gain: Holding,
) -> [[f64; 2]; 2] {
    if let Holding::Nodes(nodes) = gain {
        return one.turn.of_block(other.turn, nodes.block(one, other));
    }
    let mut block = [[0.0; 2]; 2];
    for (part, nodes) in one.parts() {
        for (_, others) in other.parts().iter().filter(|(other, _)| *other == part) {
            if let Some(answers) = answers(part) {
                answers.couple(&mut block, nodes, others);
            }
        }
    }
    one.turn.of_block(other.turn, block)
}
