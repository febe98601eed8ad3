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
//! The water of a reservoir is tied to the bodies by rows of the same kind, which follow those of the dashpots: its
//! matrix stands where `S` does, and it adds what it remembers to `e_f`, see [`super::reservoir`].
//!
//! The answers of the parts have these rows behind the crack nodes, and so have their velocities.

use super::bodies::Sides;
use super::ledger::Ledger;
use super::modal_stepper::{Drive, ModalStepper};
use super::reservoir::{Reservoir, Water};
use super::scheme::TimeStep;
use super::simd::Lanes;

/// The dashpots of a run, and the water that is tied to the bodies as they are.
pub(super) struct Dampers<'a> {
    /// Number of dashpots, and of all rows.
    dashpots: usize,
    count: usize,
    theta: f64,
    water: Option<Water<'a>>,
    /// `N` for both states of damping, row by row.
    pub gain: [Vec<f64>; 2],
    /// Rates before the step; impulses, and those of them that answer to contact.
    rate: Vec<f64>,
    pull: Vec<f64>,
    further: Vec<f64>,
    room: Vec<f64>,
    /// Energy the dashpots have taken.
    taken: f64,
}

impl<'a> Dampers<'a> {
    pub(super) fn new(
        bodies: &Sides<ModalStepper>,
        reservoir: Option<&'a Reservoir>,
        step: TimeStep,
    ) -> Self {
        let (dashpots, count) = (bodies.upper.body.dampers, bodies.upper.body.links());
        let weight = step.dt * step.theta;
        let water = reservoir.map(|reservoir| Water::new(reservoir, step));
        let mut own_matrix = vec![0.0; count * count];
        for (k, sign) in bodies.upper.body.damper_signs.iter().enumerate() {
            own_matrix[k * (count + 1)] = *sign;
        }
        if let Some(water) = &water {
            let rows = water.impedance();
            for (k, row) in rows.chunks_exact(count - dashpots).enumerate() {
                own_matrix[(dashpots + k) * count + dashpots..][..row.len()].copy_from_slice(row);
            }
        }
        let gain = [0, 1].map(|state: usize| {
            let mut own = vec![0.0; count * count];
            for body in bodies.iter() {
                let rows = body.damper_rows(state).chunks_exact(body.body.stride());
                for (sum, row) in own.chunks_exact_mut(count.max(1)).zip(rows) {
                    add(sum, &row.as_flattened()[body.body.columns()..]);
                }
            }
            inverse_gain(&own, &own_matrix, weight)
        });
        let zeros = vec![0.0; count];
        Dampers {
            dashpots,
            count,
            water,
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

    /// Whether no water moves, in a step in which the ground's velocity changes so.
    #[inline(always)]
    pub(super) fn rests(&self, change: [f64; 2]) -> bool {
        self.water.as_ref().is_none_or(|water| water.rests(change))
    }

    /// Velocities of the water's modes.
    pub(super) fn water(&self) -> &[f64] {
        self.water.as_ref().map_or(&[], |water| &water.velocity)
    }

    /// Change the velocities without contact by what the dashpots and the water do of themselves; what acts in the crack
    /// beside contact is known by now.
    #[inline(always)]
    pub(super) fn begin<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, drive: Drive) {
        let damping = drive.damping;
        let late = (1.0 - self.theta) / self.theta;
        for (room, rate) in self.room.iter_mut().zip(&self.rate) {
            *room = late * rate;
        }
        for body in bodies.iter() {
            add(&mut self.room, body.rates(&body.free));
        }
        if let Some(water) = &mut self.water {
            water.begin(drive.ground, &mut self.room[self.dashpots..]);
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

    /// Hand the impulses of dashpots and water to the parts, whose velocities are final, and book what they take.
    #[inline(always)]
    pub(super) fn finish(&mut self, bodies: &mut Sides<ModalStepper>, drive: Drive) {
        add(&mut self.pull, &self.further);
        self.room.fill(0.0);
        for body in bodies.iter_mut() {
            add(&mut self.room, body.rates(&body.answer));
            body.pull.copy_from_slice(&self.pull);
        }
        let rates = self.pull.iter().zip(&mut self.rate).zip(&self.room);
        for (k, ((pull, rate), new)) in rates.enumerate() {
            if k < self.dashpots {
                self.taken -= pull * (self.theta * new + (1.0 - self.theta) * *rate);
            }
            *rate = *new;
        }
        if let Some(water) = &mut self.water {
            water.finish(drive.ground, &self.pull[self.dashpots..]);
        }
    }

    /// Add what they have taken to a ledger, and what the water holds.
    pub(super) fn book(&self, ledger: &mut Ledger) {
        ledger.damping += self.taken;
        ledger.turnover += self.taken;
        if let Some(water) = &self.water {
            water.book(ledger);
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

/// `weight (impedance + weight own)^-1` of symmetric matrices, by Gauss and Jordan, which need no pivots here: `own` and
/// what water and dashpots do are positive, and what dashpots give back in a step is far less than 1.
fn inverse_gain(own: &[f64], impedance: &[f64], weight: f64) -> Vec<f64> {
    let count = own.len().isqrt();
    let mut a: Vec<f64> = own
        .iter()
        .zip(impedance)
        .map(|(own, z)| weight * own + z)
        .collect();
    let mut inverse = vec![0.0; count * count];
    for k in 0..count {
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
