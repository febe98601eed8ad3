//! Frames: what is kept of a run at equal distances in time, and at its end. Forces are means since the frame before,
//! `sum of impulses / time`.

use super::body::ReducedBody;
use super::crack_line::Line;
use super::dam::Dam;
use super::faces::{Face, Meeting};
use super::ledger::Ledger;
use super::observe::Motion;
use super::simd::Group;
use super::status::Status;
use super::summary::Summary;
use crate::table::columns;

/// States of the run at equal distances in time, beginning with the start, and at its end.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// One row of [`Frames::FIELDS`] for each crack of each, from the crest down.
    pub rows: Vec<[f64; Self::FIELDS.len()]>,
    /// Positions of the nodes of each crack's upper face, all along the crack, then all across it (m).
    pub upper: Vec<Vec<f64>>,
    /// The same of its lower face.
    pub lower: Vec<Vec<f64>>,
    /// Mean forces on the nodes of its upper face since the frame before (N).
    pub force: Vec<Vec<f64>>,
    /// Status of each contactor, by its place among [`Status::NAMES`].
    pub status: Vec<u8>,
    /// Damage of the bond of each, 1 where it has none; empty without a bonded joint.
    pub damage: Vec<f64>,
    /// Amplitudes of all modes of each part, on request.
    pub modes: Vec<Vec<f64>>,
    /// Velocities of the water's modes, with them.
    pub water: Vec<f64>,
}

impl Frames {
    /// Names of the numbers in a row.
    pub const FIELDS: [&'static str; Snapshot::FIELDS.len()] = Snapshot::FIELDS;

    /// Without any.
    pub(super) fn new(dam: &Dam) -> Self {
        let of_cracks = || vec![Vec::new(); dam.cracks.len()];
        Frames {
            upper: of_cracks(),
            lower: of_cracks(),
            force: of_cracks(),
            modes: vec![Vec::new(); dam.bodies.len()],
            ..Frames::default()
        }
    }

    /// Add a frame: what its cracks do, from the crest down, where their nodes are, and the state of all contacts.
    pub(super) fn keep<'a>(
        &mut self,
        cracks: impl Iterator<Item = (Snapshot<'a>, Meeting<'a>)>,
        since: &Since,
        status: &[Status],
        damage: &[f64],
    ) {
        let write = |to: &mut Vec<f64>, face: Face| {
            to.extend_from_slice(face.along);
            to.extend_from_slice(face.across);
        };
        for (crack, (now, faces)) in cracks.enumerate() {
            self.rows.push(now.row());
            write(&mut self.upper[crack], faces.upper);
            write(&mut self.lower[crack], faces.lower);
        }
        let rate = since.rate();
        for (force, nodes) in self.force.iter_mut().zip(&since.nodes) {
            force.extend(nodes.iter().map(|p| p * rate));
        }
        self.status.extend(status.iter().map(|s| *s as u8));
        self.damage.extend_from_slice(damage);
    }

    /// Whether slip and openings of all `cracks` change by less than `moved` in the last `seconds`, or in the second half
    /// of a shorter run.
    pub(super) fn rest(&self, cracks: usize, seconds: f64, moved: f64) -> bool {
        let column = |name: &str| Self::FIELDS.iter().position(|field| *field == name);
        let at = |name| column(name).expect("a frame has it");
        let (time, watched) = (at("time"), ["slip", "gap_heel", "gap_toe"].map(at));
        let Some(end) = self.rows.last().map(|row| row[time]) else {
            return false;
        };
        let since = (end - seconds).max(end / 2.0);
        (0..cracks).all(|crack| {
            watched.iter().all(|&column| {
                let late = self.rows.iter().skip(crack).step_by(cracks).rev();
                let values = late.take_while(|row| row[time] >= since).map(|row| row[column]);
                let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
                    [low.min(value), high.max(value)]
                });
                high - low < moved
            })
        })
    }

    /// Add the amplitudes of the modes of all parts to a frame.
    pub(super) fn keep_modes(&mut self, bodies: &[ReducedBody], modes: &[Vec<Group>]) {
        for ((frames, body), modes) in self.modes.iter_mut().zip(bodies).zip(modes) {
            frames.extend_from_slice(body.without_filling(modes));
        }
    }
}

/// Impulses since the last frame.
pub(super) struct Since {
    /// On the nodes of each crack's upper face.
    nodes: Vec<Vec<f64>>,
    /// For each crack, along and across it, the force that it could bear by its law, and across the valley.
    sums: Vec<[f64; 4]>,
    time: f64,
}

impl Since {
    pub(super) fn new(dam: &Dam) -> Self {
        let room = |line: &Line| vec![0.0; 2 * line.nodes[0].count];
        Since {
            nodes: dam.cracks.iter().map(room).collect(),
            sums: vec![[0.0; 4]; dam.cracks.len()],
            time: 0.0,
        }
    }

    /// Add the impulses on a crack's upper face, and its sums.
    pub(super) fn add(&mut self, crack: usize, upper: Face, sums: [f64; 4]) {
        let impulses = upper.along.iter().chain(upper.across);
        for (total, p) in self.nodes[crack].iter_mut().zip(impulses) {
            *total += p;
        }
        let total = &mut self.sums[crack];
        *total = [0, 1, 2, 3].map(|k| total[k] + sums[k]);
    }

    /// Go on to the end of a step.
    pub(super) fn go_on(&mut self, dt: f64) {
        self.time += dt;
    }

    /// Whether there is anything since.
    pub(super) fn pending(&self) -> bool {
        self.time > 0.0
    }

    /// Mean force along and across a crack, mean of what it could bear by its law, and mean force across the valley.
    pub(super) fn force(&self, crack: usize) -> [f64; 4] {
        self.sums[crack].map(|sum| sum * self.rate())
    }

    /// What makes a mean force of an impulse.
    fn rate(&self) -> f64 {
        if self.time > 0.0 {
            1.0 / self.time
        } else {
            0.0
        }
    }

    pub(super) fn clear(&mut self) {
        self.nodes.iter_mut().for_each(|nodes| nodes.fill(0.0));
        self.sums.fill([0.0; 4]);
        self.time = 0.0;
    }
}

/// The state of a crack at one moment.
pub(super) struct Snapshot<'a> {
    pub status: &'a [Status],
    pub motion: &'a Motion,
    /// Mean force along and across it since the frame before, mean of what it could bear by its law, and mean force
    /// across the valley.
    pub force: [f64; 4],
    pub summary: &'a Summary,
    pub ledger: &'a Ledger,
}

columns!(Snapshot<'_>, now => {
    "time": now.summary.end_time,
    "slip": now.motion.slip,
    "slip_velocity": now.summary.slip_velocity,
    "rotation": now.motion.rotation,
    "gap_heel": now.motion.opening_heel,
    "gap_toe": now.motion.opening_toe,
    "normal_force": now.force[1],
    "friction_force": now.force[0],
    "touching": now.touching(),
    "state": f64::from(now.summary.final_state as u8),
    "stored_energy": now.ledger.stored,
    "input_energy": now.ledger.input,
    "damping_energy": now.ledger.damping,
    "impact_energy": now.ledger.impact,
    "friction_energy": now.ledger.friction,
    "numerical_energy": now.ledger.numerical,
    "slip_path": now.summary.slip_path,
    "friction_strength": now.force[2],
    "fracture_energy": now.summary.cracked.energy,
    "boundary_energy": now.ledger.boundary,
    "floor_energy": now.ledger.floor,
    "far_end_energy": now.ledger.far_end,
    "cracked_upstream": now.summary.cracked.lengths[0],
    "cracked_downstream": now.summary.cracked.lengths[1],
    "cracked_length": now.summary.cracked.lengths[2],
    "softening_length": now.summary.cracked.lengths[3],
    "slip_cross": now.summary.cross.slip,
    "friction_cross": now.force[3],
});

impl Snapshot<'_> {
    /// Share of the nodes over the other face that touch it.
    fn touching(&self) -> f64 {
        let present = self.status.iter().filter(|s| **s != Status::Absent).count();
        let closed = self.status.iter().filter(|s| s.closed()).count();
        closed as f64 / present.max(1) as f64
    }
}
