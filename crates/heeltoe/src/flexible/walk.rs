//! What every scheme does around its steps: the crack, what is read off it, frames, and whether the dam is still there.
//!
//! A scheme finds where the crack would go without contact, `x_f`, solves the contact problem, and lets its bodies follow;
//! then the step is booked here, with what happened between the motion before it and the one after.

use super::body::Group;
use super::coupling::Crack;
use super::dam::{Dam, Wanted};
use super::envelope::Envelope;
use super::frames::{Frames, Since, Snapshot};
use super::ledger::Ledger;
use super::observe::{mean_along, Motion};
use super::result::{Outcome, Run, Summary};
use super::sides::{Faces, Sides};
use super::stance::Stance;
use super::wide::Wide;

/// A slip or opening of so many widths of the crack is off any scale.
const REACH: f64 = 100.0;

/// The crack under way, and all that is noted of it.
pub(super) struct Walk<'a> {
    pub dam: &'a Dam,
    pub crack: Crack,
    pub summary: Summary,
    dt: f64,
    wanted: Wanted<'a>,
    /// Mean position along the crack of the upper face less that of the lower one at the start.
    zero: f64,
    motion: Motion,
    stance: Stance,
    reach: f64,
    since: Since,
    frames: Frames,
    envelope: Option<Envelope<'a>>,
}

impl<'a> Walk<'a> {
    /// `start` is where the nodes of both faces are.
    pub(super) fn new(dam: &'a Dam, dt: f64, wanted: Wanted<'a>, start: Faces) -> Self {
        let zero = mean_along(start.upper) - mean_along(start.lower);
        let upper = &dam.bodies.upper;
        let crack = Crack::new(dam, upper.dampers);
        Walk {
            dam,
            stance: Stance::new(dam.give, &crack.contacts, start),
            crack,
            summary: Summary::default(),
            dt,
            wanted,
            zero,
            motion: Motion::of(start, zero),
            reach: REACH * (upper.position[upper.nodes - 1] - upper.position[0]),
            since: Since::new(upper),
            frames: Frames::default(),
            envelope: wanted.stresses.map(Envelope::new),
        }
    }

    /// Whether frames are wanted.
    #[inline(always)]
    pub(super) fn observed(&self) -> bool {
        self.wanted.stride > 0
    }

    /// Whether one is due after this step.
    #[inline(always)]
    pub(super) fn due(&self, step: usize) -> bool {
        self.observed() && (step + 1).is_multiple_of(self.wanted.stride)
    }

    /// Book a step that has brought the nodes here, with the mean normal force of contact in it.
    #[inline(always)]
    pub(super) fn book(&mut self, step: usize, position: Faces, normal_force: f64) {
        let after = Motion::of(position, self.zero);
        let slip = after.slip - self.motion.slip;
        let state = self
            .stance
            .state(position, &self.crack.contacts, &self.crack.solver.status);
        let summary = &mut self.summary;
        summary.end_time = (step + 1) as f64 * self.dt;
        summary.time_by_state[state as usize] += self.dt;
        summary.slip_by_state[state.slips_as()] += slip;
        summary.slip = after.slip;
        summary.slip_velocity = slip / self.dt;
        summary.slip_max = summary.slip_max.max(after.slip);
        summary.slip_min = summary.slip_min.min(after.slip);
        summary.rotation_max = summary.rotation_max.max(after.rotation);
        summary.rotation_min = summary.rotation_min.min(after.rotation);
        summary.opening_heel = summary.opening_heel.max(after.opening_heel);
        summary.opening_toe = summary.opening_toe.max(after.opening_toe);
        summary.peak_normal_force = summary.peak_normal_force.max(normal_force);
        summary.final_state = state;
        self.motion = after;
        self.strikes();
    }

    /// Count the nodes that have come down in this step, and how fast they came.
    #[inline(always)]
    fn strikes(&mut self) {
        let (crack, summary) = (&self.crack, &mut self.summary);
        let approach = &crack.before[crack.contacts.len()..];
        for (k, status) in crack.solver.status.iter().enumerate() {
            let speed = -approach[k];
            if status.closed() && !crack.closed[k] && speed > 0.0 {
                summary.impacts += 1;
                summary.impact_velocity = summary.impact_velocity.max(speed);
            }
            summary.penetration = summary.penetration.max(-crack.contacts.gaps[k]);
        }
    }

    /// Add the impulses of a step, on the nodes of the upper face and in all, to those since the last frame.
    #[inline(always)]
    pub(super) fn gather(&mut self, nodes: &[f64], sum: [f64; 2]) {
        self.since.add(nodes, sum, self.dt);
    }

    /// Keep a frame.
    pub(super) fn keep(&mut self, position: Faces, modes: &Sides<&[Group]>, ledger: &Ledger) {
        self.frames.keep(&Snapshot {
            faces: position,
            status: &self.crack.solver.status,
            motion: &self.motion,
            since: &self.since,
            summary: &self.summary,
            ledger,
        });
        if self.wanted.modes {
            self.frames.keep_modes(&self.dam.bodies, modes);
        }
        self.since.clear();
    }

    /// Whether the stresses after this step are wanted.
    #[inline(always)]
    pub(super) fn stressed(&self, step: usize) -> bool {
        self.envelope.as_ref().is_some_and(|envelope| envelope.due(step))
    }

    /// Take the stresses of a state into account, where they are wanted.
    #[inline(always)]
    pub(super) fn stress<W: Wide>(&mut self, modes: &Sides<&[Group]>) {
        if let Some(envelope) = &mut self.envelope {
            envelope.add::<W>(self.summary.end_time, modes);
        }
    }

    /// Whether the upper part is off any scale, which the outcome says, or somebody has stopped the run.
    #[inline(always)]
    pub(super) fn lost(&mut self) -> bool {
        let (slip, opening) = (self.motion.slip, self.motion.opening_heel);
        let here = slip.abs() < self.reach && opening.abs() < self.reach;
        if !here {
            self.summary.outcome = if slip.is_finite() {
                Outcome::Lost
            } else {
                Outcome::BlownUp
            };
        }
        !here || self.wanted.stop.asked()
    }

    /// Hand over what there is to tell.
    pub(super) fn end(self, ledger: Ledger, tensions: Vec<f64>) -> Run {
        let summary = Summary {
            ledger,
            tensions,
            ..self.summary
        };
        Run {
            summary,
            frames: self.frames,
            extremes: self.envelope.map(Envelope::end),
        }
    }
}
