//! Frames: what is kept of a run at equal distances in time. Forces are means since the frame before,
//! `sum of impulses / time`.

use super::body::{Group, ReducedBody};
use super::ledger::Ledger;
use super::observe::Motion;
use super::result::Summary;
use super::sides::{Faces, Sides};
use super::status::Status;
use crate::table::columns;

/// States of the run at equal distances in time, beginning with the start.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// One row of [`Frames::FIELDS`] for each.
    pub rows: Vec<[f64; Self::FIELDS.len()]>,
    /// Positions of the crack nodes of the upper face, all along the crack, then all across it (m).
    pub upper: Vec<f64>,
    /// The same of the lower face.
    pub lower: Vec<f64>,
    /// Mean forces on the nodes of the upper face since the frame before (N).
    pub force: Vec<f64>,
    /// Status of each contactor, by its place among [`Status::NAMES`].
    pub status: Vec<u8>,
    /// Amplitudes of all modes of the upper body, on request.
    pub modes_upper: Vec<f64>,
    /// Amplitudes of all modes of the lower body, on request.
    pub modes_lower: Vec<f64>,
}

impl Frames {
    /// Names of the numbers in a row.
    pub const FIELDS: [&'static str; Snapshot::FIELDS.len()] = Snapshot::FIELDS;

    /// Add a frame.
    pub(super) fn keep(&mut self, now: &Snapshot) {
        self.rows.push(now.row());
        self.upper.extend_from_slice(now.faces.upper);
        self.lower.extend_from_slice(now.faces.lower);
        let rate = now.since.rate();
        self.force.extend(now.since.nodes.iter().map(|p| p * rate));
        self.status.extend(now.status.iter().map(|s| *s as u8));
    }

    /// Add the amplitudes of the modes of both bodies to a frame.
    pub(super) fn keep_modes(&mut self, bodies: &Sides<ReducedBody>, modes: &Sides<&[Group]>) {
        let kept = |body: &ReducedBody, modes: &[Group]| modes.as_flattened()[..body.modes].to_vec();
        self.modes_upper.extend(kept(&bodies.upper, modes.upper));
        if let (Some(body), Some(modes)) = (&bodies.lower, modes.lower) {
            self.modes_lower.extend(kept(body, modes));
        }
    }
}

/// Impulses since the last frame.
pub(super) struct Since {
    pub nodes: Vec<f64>,
    pub sum: [f64; 2],
    pub time: f64,
}

impl Since {
    pub(super) fn new(upper: &ReducedBody) -> Self {
        Since {
            nodes: vec![0.0; upper.columns()],
            sum: [0.0; 2],
            time: 0.0,
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, nodes: &[f64], sum: [f64; 2], dt: f64) {
        for (total, p) in self.nodes.iter_mut().zip(nodes) {
            *total += p;
        }
        self.sum = [self.sum[0] + sum[0], self.sum[1] + sum[1]];
        self.time += dt;
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
        self.nodes.fill(0.0);
        self.sum = [0.0; 2];
        self.time = 0.0;
    }
}

/// The state at one moment.
pub(super) struct Snapshot<'a> {
    pub faces: Faces<'a>,
    pub status: &'a [Status],
    pub motion: &'a Motion,
    pub since: &'a Since,
    pub summary: &'a Summary,
    pub ledger: &'a Ledger,
}

columns!(Snapshot<'_>, now => {
    "time": now.summary.end_time,
    "slip": now.motion.slip,
    "slip_velocity": now.summary.slip_velocity,
    "rotation": now.motion.rotation,
    "opening_heel": now.motion.opening_heel,
    "opening_toe": now.motion.opening_toe,
    "normal_force": now.since.sum[1] * now.since.rate(),
    "friction_force": now.since.sum[0] * now.since.rate(),
    "touching": now.touching(),
    "state": f64::from(now.summary.final_state as u8),
    "energy_stored": now.ledger.stored,
    "energy_input": now.ledger.input,
    "energy_damping": now.ledger.damping,
    "energy_impact": now.ledger.impact,
    "energy_friction": now.ledger.friction,
    "energy_numerical": now.ledger.numerical,
});

impl Snapshot<'_> {
    /// Share of the nodes over the other face that touch it.
    fn touching(&self) -> f64 {
        let present = self.status.iter().filter(|s| **s != Status::Absent).count();
        let closed = self.status.iter().filter(|s| s.closed()).count();
        closed as f64 / present.max(1) as f64
    }
}
