//! Damping that couples the modes of both parts: a few dashpots between them.
//!
//! Each dashpot is a row `d` over the modes with the force `-d (d v*)` on them, `v* = theta v' + (1 - theta) v`. Only a
//! few are needed, so the step stays diagonal but for a small system: with `e = d v` and the impulses `z` of the
//! dashpots
//!
//! ```text
//! e' = e_f + W_dd z + W_dc p,      z = -dt S (theta e' + (1 - theta) e)
//! z  = -N (e_f + (1 - theta) / theta e + W_dc p),      N = dt theta (S + dt theta W_dd)^-1
//! ```
//!
//! (Woodbury's identity), where `W` are the answers without dashpots and `S` their signs: -1 where one gives back what
//! others take too much, as of the mass of the water; together they only take. The crack then answers with
//! `W_cc - W_cd N W_dc`.
//!
//! The answers of the parts have the dashpots behind the crack nodes, and so have their velocities.

use super::bodies::Sides;
use super::modal_stepper::ModalStepper;
use super::scheme::TimeStep;
use super::simd::Lanes;

/// The dashpots of a run.
#[derive(Default)]
pub(super) struct Dampers {
    count: usize,
    theta: f64,
    /// `N` for both states of damping, row by row.
    pub gain: [Vec<f64>; 2],
    /// Rates before the step; impulses, and those of them that answer to contact.
    rate: Vec<f64>,
    pull: Vec<f64>,
    further: Vec<f64>,
    room: Vec<f64>,
    /// Energy they have taken.
    pub taken: f64,
}

impl Dampers {
    pub(super) fn new(bodies: &Sides<ModalStepper>, step: TimeStep) -> Self {
        let count = bodies.upper.body.dampers;
        let weight = step.dt * step.theta;
        let signs = &bodies.upper.body.damper_signs;
        let gain = [0, 1].map(|state: usize| {
            let mut own = vec![0.0; count * count];
            for body in bodies.iter() {
                let rows = body.damper_rows(state).chunks_exact(body.body.stride());
                for (sum, row) in own.chunks_exact_mut(count.max(1)).zip(rows) {
                    add(sum, &row.as_flattened()[body.body.columns()..]);
                }
            }
            inverse_gain(&own, signs, weight)
        });
        let zeros = vec![0.0; count];
        Dampers {
            count,
            theta: step.theta,
            gain,
            rate: zeros.clone(),
            pull: zeros.clone(),
            further: zeros.clone(),
            room: zeros,
            taken: 0.0,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Change the velocities without contact by what the dashpots do of themselves; what acts in the crack beside contact
    /// is known by now.
    #[inline(always)]
    pub(super) fn begin<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, damping: usize) {
        let late = (1.0 - self.theta) / self.theta;
        for (room, rate) in self.room.iter_mut().zip(&self.rate) {
            *room = late * rate;
        }
        for body in bodies.iter() {
            add(&mut self.room, body.rates(&body.free));
        }
        respond(&self.gain[damping], &self.room, &mut self.pull);
        for body in bodies.iter_mut() {
            body.pull_free::<W>(damping, &self.pull);
        }
    }

    /// Change the answers to impulses of contact, which the parts have, by what the dashpots do about them.
    #[inline(always)]
    pub(super) fn follow<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, damping: usize) {
        self.room.fill(0.0);
        for body in bodies.iter() {
            add(&mut self.room, body.rates(&body.answer));
        }
        respond(&self.gain[damping], &self.room, &mut self.further);
        for body in bodies.iter_mut() {
            body.pull_answer::<W>(damping, &self.further);
        }
    }

    /// Hand the impulses of the dashpots to the parts, whose velocities are final, and book what they take.
    #[inline(always)]
    pub(super) fn finish(&mut self, bodies: &mut Sides<ModalStepper>) {
        add(&mut self.pull, &self.further);
        self.room.fill(0.0);
        for body in bodies.iter_mut() {
            add(&mut self.room, body.rates(&body.answer));
            body.pull.copy_from_slice(&self.pull);
        }
        for ((pull, rate), new) in self.pull.iter().zip(&mut self.rate).zip(&self.room) {
            self.taken -= pull * (self.theta * new + (1.0 - self.theta) * *rate);
            *rate = *new;
        }
    }
}

/// The impulses of dashpots with this gain at these rates.
#[inline(always)]
fn respond(gain: &[f64], rate: &[f64], pull: &mut [f64]) {
    for (pull, row) in pull.iter_mut().zip(gain.chunks_exact(rate.len())) {
        *pull = -row.iter().zip(rate).map(|(a, b)| a * b).sum::<f64>();
    }
}

#[inline(always)]
fn add(sum: &mut [f64], more: &[f64]) {
    sum.iter_mut().zip(more).for_each(|(a, b)| *a += b);
}

/// `weight (signs + weight own)^-1` of a symmetric positive `own`, by Gauss and Jordan, which need no pivots here: what
/// dashpots give back in a step is far less than 1.
fn inverse_gain(own: &[f64], signs: &[f64], weight: f64) -> Vec<f64> {
    let count = signs.len();
    let mut a: Vec<f64> = own.iter().map(|value| weight * value).collect();
    let mut inverse = vec![0.0; count * count];
    for k in 0..count {
        a[k * (count + 1)] += signs[k];
        inverse[k * (count + 1)] = weight;
    }
    for k in 0..count {
        let pivot = 1.0 / a[k * (count + 1)];
        for c in 0..count {
            a[k * count + c] *= pivot;
            inverse[k * count + c] *= pivot;
        }
        for r in (0..count).filter(|r| *r != k) {
            let factor = a[r * count + k];
            for c in 0..count {
                a[r * count + c] -= factor * a[k * count + c];
                inverse[r * count + c] -= factor * inverse[k * count + c];
            }
        }
    }
    inverse
}
