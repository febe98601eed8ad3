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

use super::body::dot;
use super::contact::Contacts;
use super::moving::{Moving, TimeStep};
use super::sides::Sides;

/// The dashpots of a run.
#[derive(Default)]
pub(super) struct Dampers {
    count: usize,
    theta: f64,
    /// `N` and `W_dd` for both states of damping, row by row.
    gain: [Vec<f64>; 2],
    own: [Vec<f64>; 2],
    /// Rates before the step; after it but for the dashpots and contact; impulses.
    rate: Vec<f64>,
    free: Vec<f64>,
    pull: Vec<f64>,
    room: Vec<f64>,
    further: Vec<f64>,
    /// Energy they have taken.
    pub taken: f64,
}

impl Dampers {
    pub(super) fn new(bodies: &Sides<Moving>, step: TimeStep) -> Self {
        let count = bodies.upper.body.dampers;
        let own = [0, 1].map(|state: usize| {
            let mut sum = vec![0.0; count * count];
            bodies
                .iter()
                .for_each(|body| add(&mut sum, &body.operator.damper_own[state]));
            sum
        });
        let weight = step.dt * step.theta;
        let signs = &bodies.upper.body.damper_signs;
        let gain = [0, 1].map(|state: usize| inverse_gain(&own[state], signs, weight));
        let zeros = vec![0.0; count];
        Dampers {
            count,
            theta: step.theta,
            gain,
            own,
            rate: zeros.clone(),
            free: zeros.clone(),
            pull: zeros.clone(),
            room: zeros.clone(),
            further: zeros,
            taken: 0.0,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Change the velocities of the crack without contact by what the dashpots do of themselves; `push` of the bodies,
    /// what acts in the crack beside contact, is known by now.
    #[inline(always)]
    pub(super) fn begin(&mut self, bodies: &mut Sides<Moving>, damping: usize, pushed: bool) {
        self.free.fill(0.0);
        for body in bodies.iter() {
            add(&mut self.free, &body.strain);
            if pushed {
                body.at_dampers(damping, &body.push, &mut self.free);
            }
        }
        let late = (1.0 - self.theta) / self.theta;
        for ((sum, free), rate) in self.room.iter_mut().zip(&self.free).zip(&self.rate) {
            *sum = free + late * rate;
        }
        for (pull, row) in self
            .pull
            .iter_mut()
            .zip(self.gain[damping].chunks_exact(self.count))
        {
            *pull = -dot(row, &self.room);
        }
        for body in bodies.iter_mut() {
            body.pull_crack(damping, &self.pull);
        }
    }

    /// Count in the impulses of contact, which the parts have, and hand the impulses of the dashpots to the parts.
    #[inline(always)]
    pub(super) fn finish(&mut self, bodies: &mut Sides<Moving>, damping: usize) {
        self.room.fill(0.0);
        for body in bodies.iter() {
            body.at_dampers(damping, &body.impulse, &mut self.room);
        }
        for (more, row) in self
            .further
            .iter_mut()
            .zip(self.gain[damping].chunks_exact(self.count))
        {
            *more = -dot(row, &self.room);
        }
        for body in bodies.iter_mut() {
            body.pull_crack(damping, &self.further);
        }
        add(&mut self.pull, &self.further);
        for (k, row) in self.own[damping].chunks_exact(self.count).enumerate() {
            let new = self.free[k] + self.room[k] + dot(row, &self.pull);
            self.taken -= self.pull[k] * (self.theta * new + (1.0 - self.theta) * self.rate[k]);
            self.rate[k] = new;
        }
        for body in bodies.iter_mut() {
            body.pull.copy_from_slice(&self.pull);
        }
    }

    /// Take from the answer of the contacts what the dashpots hold back, `G -= V N V^T` with `V = B W_cd`: where a contact
    /// has moved, as the rest is done.
    #[inline(always)]
    pub(super) fn soften(&self, g: &mut [f64], contacts: &Contacts, bodies: &Sides<Moving>, damping: usize) {
        let (k, size) = (self.count, 2 * contacts.len());
        let mut v = vec![0.0; size * k];
        for (contact, pair) in contacts.pairs.iter().enumerate() {
            let Some(pair) = pair else { continue };
            for direction in 0..2 {
                let row = &mut v[(2 * contact + direction) * k..][..k];
                bodies.upper.felt_by_dampers(damping, &pair.upper, direction, row);
                if let Some(lower) = &bodies.lower {
                    lower.felt_by_dampers(damping, &pair.lower, direction, row);
                }
            }
        }
        let mut n_v = vec![0.0; size * k];
        for (out, row) in n_v.chunks_exact_mut(k).zip(v.chunks_exact(k)) {
            for (value, gain) in out.iter_mut().zip(self.gain[damping].chunks_exact(k)) {
                *value = dot(gain, row);
            }
        }
        for (i, line) in v.chunks_exact(k).enumerate() {
            for (j, other) in n_v.chunks_exact(k).enumerate() {
                if contacts.moved[i / 2] || contacts.moved[j / 2] {
                    g[i * size + j] -= line.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
    }
}

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
