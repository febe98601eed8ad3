//! Damping that couples the modes of all parts: a few dashpots between them.
//!
//! Each dashpot is a row `d` over the modes with the force `-d (d v*)` on them, `v* = theta v' + (1 - theta) v`. Only a
//! few are needed, so the step stays diagonal but for a small system: with `e* = d v*` and the impulses `z` of the
//! dashpots
//!
//! ```text
//! e* = e*_f + theta (W_dd z + W_dc p),      z = -dt S e*
//! z  = -N (e*_f / theta + W_dc p),          N = dt theta (S + dt theta W_dd)^-1
//! ```
//!
//! (Woodbury's identity), where `W` are the answers without dashpots and `S` their signs: -1 where one gives back what
//! others take too much, as of the mass of the water; together they only take. The crack then answers with
//! `W_cc - W_cd N W_dc`.
//!
//! The water of a reservoir is tied to the bodies by rows of the same kind, which follow those of the dashpots: its
//! matrix stands where `S` does, and it adds what it remembers to `e*_f / theta`, see [`super::reservoir`].
//!
//! The answers of the parts have these rows behind the crack nodes; behind their velocities without contact stands
//! `e*_f / theta`.

use super::contact::Pair;
use super::dam::Dam;
use super::ledger::Ledger;
use super::modal_stepper::{Drive, ModalStepper};
use super::panels::Panels;
use super::reservoir::{Reservoir, Water};
use super::scheme::TimeStep;
use super::simd::{in_groups, Group, Lanes, LANES};
use super::symmetric::{add_product, Symmetric};

/// The dashpots of a run, and the water that is tied to the bodies as they are.
pub(super) struct Dampers<'a> {
    /// Number of dashpots, and of all rows.
    dashpots: usize,
    count: usize,
    dt: f64,
    /// 1 for a dashpot that takes energy, -1 for one that gives back.
    signs: &'a [f64],
    water: Option<Water<'a>>,
    /// `N` for both states of damping, row by row.
    gain: [Vec<f64>; 2],
    /// With water, whose rows are many: what they are to the bodies.
    wide: Option<[Wide; 2]>,
    /// Impulses, and those of them that answer to contact.
    pull: Vec<f64>,
    further: Vec<f64>,
    /// Room for what the rows feel, for the impulses on the crack nodes, and for sums over both.
    room: Vec<f64>,
    impulses: Vec<Group>,
    rows_room: Vec<Group>,
    nodes_room: Vec<Group>,
    /// Energy the dashpots have taken.
    taken: f64,
}

/// What many rows are to the parts, for one state of damping.
struct Wide {
    /// `N`.
    gain: Panels,
    /// `N W_dc`: a row for each crack node of all parts.
    felt: Panels,
    nodes: HeldNodes,
}

/// `W_cc - W_cd N W_dc`: how the crack nodes of all parts, from the crest down, answer under what the rows hold back, row
/// by row.
pub(super) struct HeldNodes {
    matrix: Vec<Group>,
    tiles: Symmetric,
    /// The first component of each part, and its number of nodes.
    parts: Vec<(usize, usize)>,
    /// Groups in a row.
    stride: usize,
}

impl Wide {
    fn new(bodies: &[ModalStepper], gain: &[f64], state: usize) -> Self {
        let count = gain.len().isqrt();
        let (nodes, gained) = HeldNodes::new(bodies, gain, state);
        let wide = count.div_ceil(LANES);
        Wide {
            gain: Panels::new(&in_groups(gain, count), wide, wide),
            felt: Panels::new(&in_groups(&gained, count), wide, wide),
            nodes,
        }
    }
}

impl HeldNodes {
    /// With `N W_dc`, a row for each crack node of all parts.
    fn new(bodies: &[ModalStepper], gain: &[f64], state: usize) -> (Self, Vec<f64>) {
        let size = bodies.iter().map(|body| body.body.columns()).sum::<usize>();
        let count = gain.len().isqrt();
        let mut parts = Vec::new();
        // What each link feels of each node, and the answers without links.
        let mut felt = vec![vec![0.0; size]; count];
        let mut matrix = vec![0.0; size * size];
        let mut first = 0;
        for body in bodies.iter() {
            let own = body.body.columns();
            parts.push((first, body.body.nodes));
            let rows = body.answers(state).w.chunks_exact(body.body.stride());
            for (r, row) in rows.enumerate() {
                let to = if r < own {
                    &mut matrix[(first + r) * size..][..size]
                } else {
                    &mut felt[r - own][..]
                };
                to[first..][..own].copy_from_slice(&row.as_flattened()[..own]);
            }
            first += own;
        }
        let mut gained = vec![0.0; size * count];
        for (k, gains) in gain.chunks_exact(count.max(1)).enumerate() {
            let mut held = vec![0.0; size];
            for (gain, row) in gains.iter().zip(&felt) {
                held.iter_mut().zip(row).for_each(|(sum, x)| *sum += gain * x);
            }
            for (c, x) in held.iter().enumerate() {
                gained[c * count + k] = *x;
            }
            for (row, x) in matrix.chunks_exact_mut(size).zip(&felt[k]) {
                row.iter_mut().zip(&held).for_each(|(sum, held)| *sum -= x * held);
            }
        }
        let nodes = HeldNodes {
            tiles: Symmetric::new(&matrix, size),
            matrix: in_groups(&matrix, size),
            parts,
            stride: size.div_ceil(LANES),
        };
        (nodes, gained)
    }

    /// Find the velocities of the crack nodes with these impulses of contact.
    fn answer<W: Lanes>(&self, bodies: &mut [ModalStepper], impulses: &[Group], room: &mut [Group]) {
        room.fill([0.0; LANES]);
        add_product::<W>(&self.tiles, impulses, room);
        let mut answers: &[f64] = room.as_flattened();
        for body in bodies.iter_mut() {
            let (own, rest) = answers.split_at(body.impulse.len());
            let velocities = body.answer.as_flattened_mut().iter_mut();
            for ((x, free), answer) in velocities.zip(body.free.as_flattened()).zip(own) {
                *x = free + answer;
            }
            answers = rest;
        }
    }

    /// How a contact answers to another where its nodes move across the valley alone.
    pub(super) fn across(&self, one: &Pair, other: &Pair) -> f64 {
        let mut answer = 0.0;
        for (part, nodes) in one.parts() {
            // A rigid plane has no nodes.
            for (node, a) in nodes.iter().filter(|(_, a)| *a != 0.0) {
                let row = &self.matrix[(self.parts[part].0 + node) * self.stride..][..self.stride];
                for (part, nodes) in other.parts() {
                    for (node, b) in nodes.iter().filter(|(_, b)| *b != 0.0) {
                        answer += a * b * row.as_flattened()[self.parts[part].0 + node];
                    }
                }
            }
        }
        answer
    }

    /// How a contact answers to another.
    // In line it would be compiled a dozen times over.
    #[inline(never)]
    pub(super) fn block(&self, one: &Pair, other: &Pair) -> [[f64; 2]; 2] {
        let mut block = [[0.0; 2]; 2];
        for (part, nodes) in one.parts() {
            for &(node, a) in nodes {
                // A rigid plane has no nodes.
                if a == 0.0 {
                    continue;
                }
                for (r, answers) in block.iter_mut().enumerate() {
                    let (first, half) = self.parts[part];
                    let row = &self.matrix[(first + r * half + node) * self.stride..][..self.stride];
                    let row = row.as_flattened();
                    for (part, nodes) in other.parts() {
                        for &(node, b) in nodes {
                            if b == 0.0 {
                                continue;
                            }
                            let (first, half) = self.parts[part];
                            answers[0] += a * b * row[first + node];
                            answers[1] += a * b * row[first + node + half];
                        }
                    }
                }
            }
        }
        block
    }
}

impl<'a> Dampers<'a> {
    pub(super) fn new(bodies: &[ModalStepper<'a>], reservoir: Option<&'a Reservoir>, step: TimeStep) -> Self {
        let (dashpots, count) = (bodies[0].body.dampers, bodies[0].body.rows());
        let weight = step.dt * step.theta;
        let water = reservoir.map(|reservoir| Water::new(reservoir, step));
        let mut own_matrix = vec![0.0; count * count];
        for (k, sign) in bodies[0].body.damper_signs.iter().enumerate() {
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
        let wide = water
            .is_some()
            .then(|| [0, 1].map(|state: usize| Wide::new(bodies, &gain[state], state)));
        let nodes = wide.as_ref().map_or(0, |wide| wide[0].nodes.stride);
        let zeros = vec![0.0; count];
        Dampers {
            wide,
            rows_room: vec![[0.0; LANES]; count.div_ceil(LANES)],
            nodes_room: vec![[0.0; LANES]; nodes],
            dashpots,
            count,
            water,
            dt: step.dt,
            gain,
            signs: &bodies[0].body.damper_signs,
            pull: zeros.clone(),
            further: zeros.clone(),
            room: zeros,
            impulses: vec![[0.0; LANES]; nodes],
            taken: 0.0,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether no water moves, in a step in which the ground's velocity changes so.
    pub(super) fn rests(&self, change: [f64; 2]) -> bool {
        self.water.as_ref().is_none_or(|water| water.rests(change))
    }

    /// Velocities of the water's modes.
    pub(super) fn water(&self) -> &[f64] {
        self.water.as_ref().map_or(&[], Water::velocities)
    }

    /// The same in groups; None without water.
    pub(super) fn water_groups(&self) -> Option<&Vec<Group>> {
        self.water.as_ref().map(Water::groups)
    }

    /// Change the velocities without contact by what the dashpots and the water do of themselves; what acts in the crack
    /// beside contact is known by now.
    pub(super) fn begin<W: Lanes>(&mut self, bodies: &mut [ModalStepper], drive: Drive) {
        let damping = drive.damping;
        self.room.fill(0.0);
        for body in bodies.iter() {
            add(&mut self.room, body.rates(&body.free));
        }
        if let Some(water) = &mut self.water {
            water.begin::<W>(drive.ground, &mut self.room[self.dashpots..]);
        }
        if let Some(wide) = &self.wide {
            self.rows_room.fill([0.0; LANES]);
            wide[damping].gain.combine::<W>(&self.room, &mut self.rows_room);
            negate(self.rows_room.as_flattened(), &mut self.pull);
        } else {
            respond(&self.gain[damping], &self.room, &mut self.pull);
        }
        self.further.fill(0.0);
        for body in bodies.iter_mut() {
            body.pull_free::<W>(damping, &self.pull);
        }
    }

    /// Find the velocities of the crack nodes with the impulses of contact, which the parts have.
    pub(super) fn answer<W: Lanes>(&mut self, bodies: &mut [ModalStepper], damping: usize) {
        if let Some(wide) = &self.wide {
            gather(bodies, &mut self.impulses);
            let nodes = &wide[damping].nodes;
            return nodes.answer::<W>(bodies, &self.impulses, &mut self.nodes_room);
        }
        for body in bodies.iter_mut() {
            body.find_answer::<W>(damping);
        }
        if self.count > 0 {
            self.room.fill(0.0);
            for body in bodies.iter() {
                add(&mut self.room, body.rates(&body.answer));
            }
            respond(&self.gain[damping], &self.room, &mut self.further);
            for body in bodies.iter_mut() {
                body.pull_answer::<W>(damping, &self.further);
            }
        }
        bodies.iter_mut().for_each(ModalStepper::finish_answer);
    }

    /// Hand the impulses of dashpots and water to the parts, whose velocities are final, and book what they take.
    pub(super) fn finish<W: Lanes>(&mut self, bodies: &mut [ModalStepper], drive: Drive) {
        if let Some(wide) = &self.wide {
            self.rows_room.fill([0.0; LANES]);
            gather(bodies, &mut self.impulses);
            let felt = &wide[drive.damping].felt;
            felt.combine::<W>(self.impulses.as_flattened(), &mut self.rows_room);
            negate(self.rows_room.as_flattened(), &mut self.further);
        }
        add(&mut self.pull, &self.further);
        for body in bodies.iter_mut() {
            let links = body.pull.len();
            body.pull.copy_from_slice(&self.pull[..links]);
        }
        for (pull, sign) in self.pull.iter().zip(self.signs) {
            self.taken += sign * pull * pull / self.dt;
        }
        if let Some(water) = &mut self.water {
            water.finish::<W>(drive.ground, &self.pull[self.dashpots..]);
        }
    }

    /// By what the rows hold back a contact: their gain, or how all crack nodes answer under them.
    #[inline(always)]
    pub(super) fn holding(&self, damping: usize) -> Holding<'_> {
        match &self.wide {
            None => Holding::Gain(&self.gain[damping]),
            Some(wide) => Holding::Nodes(&wide[damping].nodes),
        }
    }

    /// How the crack nodes answer with what the dashpots hold back.
    pub(super) fn held(&self, bodies: &[ModalStepper], damping: usize) -> HeldNodes {
        HeldNodes::new(bodies, &self.gain[damping], damping).0
    }

    /// Number of rows that the contact problem has to feel by itself.
    pub(super) fn felt(dam: &Dam) -> usize {
        if dam.reservoir.is_some() {
            0
        } else {
            dam.bodies[0].links()
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
    /// By what they leave of the answers of all crack nodes.
    Nodes(&'s HeldNodes),
}

/// The impulses of dashpots with this gain at these rates.
#[inline(always)]
fn respond(gain: &[f64], rate: &[f64], pull: &mut [f64]) {
    for (pull, row) in pull.iter_mut().zip(gain.chunks_exact(rate.len())) {
        *pull = -row.iter().zip(rate).map(|(a, b)| a * b).sum::<f64>();
    }
}

/// Copy the impulses on the crack nodes of all parts.
#[inline(always)]
fn gather(bodies: &[ModalStepper], impulses: &mut [Group]) {
    let mut rest = impulses.as_flattened_mut();
    for body in bodies.iter() {
        let (own, more) = rest.split_at_mut(body.impulse.len());
        own.copy_from_slice(&body.impulse);
        rest = more;
    }
}

/// Impulses against these sums.
#[inline(always)]
fn negate(sums: &[f64], pull: &mut [f64]) {
    pull.iter_mut().zip(sums).for_each(|(pull, x)| *pull = -x);
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
