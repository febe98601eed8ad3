//! Frames: what is kept of a run at equal distances in time.

use super::body::{Body, Group};
use super::coulomb::Status;
use super::ledger::Ledger;
use super::observe::{Faces, Motion};
use super::result::{Frames, Summary};

/// Impulses since the last frame.
pub struct Since {
    pub nodes: Vec<f64>,
    pub sum: [f64; 2],
    pub time: f64,
}

impl Since {
    pub fn new(upper: &Body) -> Self {
        Since {
            nodes: vec![0.0; upper.columns()],
            sum: [0.0; 2],
            time: 0.0,
        }
    }

    #[inline(always)]
    pub fn add(&mut self, nodes: &[f64], sum: [f64; 2], dt: f64) {
        for (total, p) in self.nodes.iter_mut().zip(nodes) {
            *total += p;
        }
        self.sum = [self.sum[0] + sum[0], self.sum[1] + sum[1]];
        self.time += dt;
    }

    pub fn clear(&mut self) {
        self.nodes.fill(0.0);
        self.sum = [0.0; 2];
        self.time = 0.0;
    }
}

/// The state at one moment.
pub struct Snapshot<'a> {
    pub faces: Faces<'a>,
    pub modes: [&'a [Group]; 2],
    pub status: &'a [Status],
    pub motion: &'a Motion,
    pub since: &'a Since,
    pub summary: &'a Summary,
    pub ledger: &'a Ledger,
}

/// Add a frame.
pub fn keep(frames: &mut Frames, now: &Snapshot, keep_modes: bool) {
    let Snapshot {
        motion,
        since,
        summary,
        ledger,
        status,
        ..
    } = now;
    let rate = if since.time > 0.0 { 1.0 / since.time } else { 0.0 };
    let present = status.iter().filter(|s| **s != Status::Absent).count();
    let closed = status.iter().filter(|s| s.closed()).count();
    frames.rows.push([
        summary.end_time,
        motion.slip,
        summary.slip_velocity,
        motion.rotation,
        motion.opening_heel,
        motion.opening_toe,
        since.sum[1] * rate,
        since.sum[0] * rate,
        closed as f64 / present.max(1) as f64,
        f64::from(summary.final_state),
        ledger.stored,
        ledger.input,
        ledger.damping,
        ledger.impact,
        ledger.friction,
        ledger.numerical,
    ]);
    frames.upper.extend_from_slice(now.faces.upper);
    frames.lower.extend_from_slice(now.faces.lower);
    frames.force.extend(since.nodes.iter().map(|p| p * rate));
    frames.status.extend(status.iter().map(|s| *s as u8));
    if keep_modes {
        frames.modes_upper.extend_from_slice(now.modes[0].as_flattened());
        frames.modes_lower.extend_from_slice(now.modes[1].as_flattened());
    }
}
