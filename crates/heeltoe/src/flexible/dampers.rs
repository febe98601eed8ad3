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
use super::contact::Pair;
use super::dam::Dam;
use super::ledger::Ledger;
use super::modal_stepper::{Drive, ModalStepper};
use super::reservoir::{Reservoir, Water};
use super::scheme::TimeStep;
use super::simd::{Group, Lanes, LANES};

/// The dashpots of a run, and the water that is tied to the bodies as they are.
pub(super) struct Dampers<'a> {
    /// Number of dashpots, and of all rows.
    dashpots: usize,
    count: usize,
    theta: f64,
    water: Option<Water<'a>>,
    /// `N` for both states of damping, row by row.
    gain: [Vec<f64>; 2],
    /// With water, whose rows are many: `N` in groups, and what the rows hold back of the crack.
    wide: Option<[Wide; 2]>,
    /// Rates before the step; impulses, and those of them that answer to contact.
    rate: Vec<f64>,
    pull: Vec<f64>,
    further: Vec<f64>,
    room: Vec<f64>,
    wide_room: Vec<Group>,
    nodes_room: Vec<Group>,
    /// Energy the dashpots have taken.
    taken: f64,
}

/// What many rows are to the bodies, for one state of damping.
struct Wide {
    /// `N`, row by row, each filled up with zeros to whole groups.
    gain: Vec<Group>,
    held: Held,
}

/// `W_cd N W_dc`: what the rows hold back of the answers of the crack nodes of both bodies, those of the upper one first,
/// row by row.
pub(super) struct Held {
    matrix: Vec<Group>,
    columns: [usize; 2],
}

impl Held {
    fn new(bodies: &Sides<ModalStepper>, gain: &[f64], state: usize) -> Self {
        let columns = [
            bodies.upper.body.columns(),
            bodies.lower.as_ref().map_or(0, |body| body.body.columns()),
        ];
        let count = gain.len().isqrt();
        // Rows: what each link feels of each node.
        let mut felt = vec![Vec::new(); count];
        for body in bodies.iter() {
            let rows = body.damper_rows(state).chunks_exact(body.body.stride());
            for (felt, row) in felt.iter_mut().zip(rows) {
                felt.extend_from_slice(&row.as_flattened()[..body.body.columns()]);
            }
        }
        let size = columns[0] + columns[1];
        let stride = size.div_ceil(LANES);
        let mut matrix = vec![[0.0; LANES]; size * stride];
        for (gains, one) in gain.chunks_exact(count).zip(&felt) {
            let mut held = vec![0.0; size];
            for (gain, other) in gains.iter().zip(&felt) {
                held.iter_mut().zip(other).for_each(|(sum, x)| *sum += gain * x);
            }
            for (row, x) in matrix.chunks_exact_mut(stride).zip(one) {
                let row = row.as_flattened_mut().iter_mut();
                row.zip(&held).for_each(|(sum, held)| *sum += x * held);
            }
        }
        Held { matrix, columns }
    }

    /// Take what is held back off the answers of the bodies to their impulses.
    #[inline(always)]
    fn answer(&self, bodies: &mut Sides<ModalStepper>, room: &mut [Group]) {
        let stride = (self.columns[0] + self.columns[1]).div_ceil(LANES);
        room.fill([0.0; LANES]);
        let mut rows = self.matrix.chunks_exact(stride);
        for body in bodies.iter() {
            // In this order, as the rows go on with the next body.
            for (impulse, row) in body.impulse.iter().zip(rows.by_ref()) {
                axpy(*impulse, row, room);
            }
        }
        let mut held: &[f64] = room.as_flattened();
        for body in bodies.iter_mut() {
            let (own, rest) = held.split_at(body.impulse.len());
            let answer = body.answer.as_flattened_mut().iter_mut();
            answer.zip(own).for_each(|(x, held)| *x -= held);
            held = rest;
        }
    }

    /// Take what is held back of the answer of two contacts off it.
    // In line it would be compiled a dozen times over.
    #[inline(never)]
    pub(super) fn take_off(&self, block: &mut [[f64; 2]; 2], one: &Pair, other: &Pair) {
        let stride = (self.columns[0] + self.columns[1]).div_ceil(LANES);
        let places = |pair: &Pair, direction: usize| {
            let [upper, lower] = [0, 1].map(|side| {
                let first = side * self.columns[0] + direction * self.columns[side] / 2;
                let nodes = if side == 0 { &pair.upper } else { &pair.lower };
                nodes.map(|(node, weight)| (first + node, weight))
            });
            [upper[0], upper[1], lower[0], lower[1]]
        };
        for (r, row) in block.iter_mut().enumerate() {
            for (c, value) in row.iter_mut().enumerate() {
                for (i, a) in places(one, r) {
                    // Of a rigid plane there are no nodes.
                    if a == 0.0 {
                        continue;
                    }
                    let held = self.matrix[i * stride..][..stride].as_flattened();
                    for (j, b) in places(other, c) {
                        if b != 0.0 {
                            *value -= a * b * held[j];
                        }
                    }
                }
            }
        }
    }
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
        let wide = water.is_some().then(|| {
            [0, 1].map(|state| Wide {
                gain: in_groups(&gain[state], count),
                held: Held::new(bodies, &gain[state], state),
            })
        });
        let zeros = vec![0.0; count];
        Dampers {
            wide,
            wide_room: vec![[0.0; LANES]; count.div_ceil(LANES)],
            nodes_room: vec![
                [0.0; LANES];
                bodies
                    .iter()
                    .map(|body| body.body.columns())
                    .sum::<usize>()
                    .div_ceil(LANES)
            ],
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
        self.respond(damping);
        self.pull.copy_from_slice(&self.further);
        self.further.fill(0.0);
        for body in bodies.iter_mut() {
            body.pull_free::<W>(damping, &self.pull);
        }
    }

    /// Change the answers to impulses of contact, which the parts have, by what the dashpots do about them.
    #[inline(always)]
    pub(super) fn follow<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, damping: usize) {
        if let Some(wide) = &self.wide {
            return wide[damping].held.answer(bodies, &mut self.nodes_room);
        }
        self.respond_to_contact::<W>(bodies, damping);
    }

    #[inline(always)]
    fn respond_to_contact<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, damping: usize) {
        self.room.fill(0.0);
        for body in bodies.iter() {
            add(&mut self.room, body.rates(&body.answer));
        }
        self.respond(damping);
        for body in bodies.iter_mut() {
            body.pull_answer::<W>(damping, &self.further);
        }
    }

    /// Hand the impulses of dashpots and water to the parts, whose velocities are final, and book what they take.
    #[inline(always)]
    pub(super) fn finish<W: Lanes>(&mut self, bodies: &mut Sides<ModalStepper>, drive: Drive) {
        if self.wide.is_some() {
            for body in bodies.iter_mut() {
                body.find_answer::<W>(drive.damping);
            }
            self.respond_to_contact::<W>(bodies, drive.damping);
            bodies.iter_mut().for_each(ModalStepper::finish_answer);
        }
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

    /// Find the impulses of all rows at the rates in `room`.
    #[inline(always)]
    fn respond(&mut self, damping: usize) {
        let Some(wide) = &self.wide else {
            respond(&self.gain[damping], &self.room, &mut self.further);
            return;
        };
        self.wide_room.fill([0.0; LANES]);
        let rows = wide[damping].gain.chunks_exact(self.wide_room.len());
        for (row, rate) in rows.zip(&self.room) {
            axpy(*rate, row, &mut self.wide_room);
        }
        let found = self.wide_room.as_flattened();
        self.further
            .iter_mut()
            .zip(found)
            .for_each(|(pull, x)| *pull = -x);
    }

    /// By what the rows hold back a contact: their gain, or what they hold back of all crack nodes.
    #[inline(always)]
    pub(super) fn holding(&self, damping: usize) -> Holding<'_> {
        match &self.wide {
            None => Holding::Gain(&self.gain[damping]),
            Some(wide) => Holding::Nodes(&wide[damping].held),
        }
    }

    /// Number of rows that the contact problem has to feel by itself.
    pub(super) fn felt(dam: &Dam) -> usize {
        if dam.reservoir.is_some() {
            0
        } else {
            dam.bodies.upper.links()
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

/// How rows hold back what a contact does.
#[derive(Clone, Copy)]
pub(super) enum Holding<'s> {
    /// By their gain `N`.
    Gain(&'s [f64]),
    /// By what they hold back of all crack nodes.
    Nodes(&'s Held),
}

/// Add a multiple of a row to a sum.
#[inline(always)]
fn axpy(x: f64, row: &[Group], sum: &mut [Group]) {
    for (sum, row) in sum.iter_mut().zip(row) {
        for l in 0..LANES {
            sum[l] += x * row[l];
        }
    }
}

/// A square matrix in groups, each row filled up with zeros.
fn in_groups(matrix: &[f64], count: usize) -> Vec<Group> {
    let stride = count.div_ceil(LANES);
    let mut groups = vec![[0.0; LANES]; count * stride];
    for (full, row) in groups.chunks_exact_mut(stride).zip(matrix.chunks_exact(count)) {
        full.as_flattened_mut()[..count].copy_from_slice(row);
    }
    groups
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
