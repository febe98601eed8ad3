//! What every scheme does around its steps: the cracks, what is read off them, frames, and whether the dam is still there.
//!
//! A scheme finds where the crack would go without contact, `x_f`, solves the contact problem, and lets its bodies follow;
//! then the step is booked here, with what happened between the motion before it and the one after.

use std::ops::Range;

use super::across::Across;
use super::body::ReducedBody;
use super::bond::Cracked;
use super::contact::Contactor;
use super::coupling::Crack;
use super::crack_line::Line;
use super::dam::{Dam, Shaking, Wanted};
use super::dampers::Dampers;
use super::envelope::Envelope;
use super::faces::{mean_along, Faces, Meeting};
use super::frames::{Frames, Since, Snapshot};
use super::ledger::Ledger;
use super::observe::Motion;
use super::place::Place;
use super::result::Run;
use super::rocking_thresholds::Stance;
use super::simd::{Group, Lanes};
use super::summary::{Outcome, Summary};
use super::track::Track;
use crate::inside::Borne;

/// A slip or opening of so many widths of the crack is off any scale.
const REACH: f64 = 100.0;

/// One crack under way, and all that is noted of it.
pub(super) struct Watch {
    place: Place,
    /// Its contacts.
    contacts: Range<usize>,
    pub summary: Summary,
    /// Mean position along the crack of the upper face less that of the lower one at the start.
    zero: f64,
    motion: Motion,
    stance: Stance,
    reach: f64,
}

impl Watch {
    /// `bonded` is where its nodes are while it is, `faces` where they start.
    fn new(
        place: Place,
        contacts: Range<usize>,
        contactors: &[Contactor],
        line: &Line,
        [bonded, faces]: [Meeting; 2],
    ) -> Self {
        let zero = mean_along(faces.upper) - mean_along(faces.lower);
        let along = bonded.upper.along;
        let width = along[along.len() - 1] - along[0];
        // A bond without strength is broken from the start.
        let cracked = match line.bond {
            Some(_) if !line.bonded() => Cracked {
                lengths: [width, width, width, 0.0],
                ..Cracked::default()
            },
            _ => Cracked::NONE,
        };
        Watch {
            stance: Stance::new(line.give, &contactors[contacts.clone()], faces),
            summary: Summary {
                cracked,
                ..Summary::default()
            },
            zero,
            motion: Motion::of(faces, zero),
            reach: REACH * width,
            contacts,
            place,
        }
    }

    /// Book a step that has brought the nodes here.
    fn book(&mut self, end: f64, dt: f64, around: Faces, crack: &Crack, normal_force: f64) {
        let faces = self.place.of(around);
        let after = Motion::of(faces, self.zero);
        let slip = after.slip - self.motion.slip;
        let own = self.contacts.clone();
        let state = self.stance.state(
            faces,
            &crack.contacts.contactors[own.clone()],
            &crack.contacts.gaps[own.clone()],
            &crack.solver.status[own],
        );
        let summary = &mut self.summary;
        summary.end_time = end;
        summary.time_by_state[state as usize] += dt;
        summary.slip_by_state[state.slips_as()] += slip;
        summary.slip = after.slip;
        summary.slip_velocity = slip / dt;
        summary.slip_max = summary.slip_max.max(after.slip);
        summary.slip_min = summary.slip_min.min(after.slip);
        summary.rotation_max = summary.rotation_max.max(after.rotation);
        summary.rotation_min = summary.rotation_min.min(after.rotation);
        summary.opening_upstream = summary.opening_upstream.max(after.opening_heel);
        summary.opening_downstream = summary.opening_downstream.max(after.opening_toe);
        summary.peak_normal_force = summary.peak_normal_force.max(normal_force);
        summary.final_state = state;
        self.motion = after;
        self.strikes(crack);
    }

    /// Count the nodes that have come down in this step, and how fast they came.
    fn strikes(&mut self, crack: &Crack) {
        let summary = &mut self.summary;
        let approach = &crack.before[crack.contacts.len()..];
        for k in self.contacts.clone() {
            let speed = -approach[k];
            if crack.solver.status[k].closed() && !crack.closed[k] && speed > 0.0 {
                summary.impacts += 1;
                summary.impact_velocity = summary.impact_velocity.max(speed);
            }
            summary.penetration = summary.penetration.max(-crack.contacts.gaps[k]);
        }
    }
}

/// The cracks under way, and all that is noted of them.
pub(super) struct Walk<'a> {
    pub dam: &'a Dam,
    /// The contact problem of all cracks.
    pub crack: Crack,
    /// From the crest down.
    pub cracks: Vec<Watch>,
    /// How the steps were solved, and how the run ends.
    pub steps: Summary,
    dt: f64,
    wanted: Wanted<'a>,
    since: Since,
    frames: Frames,
    envelope: Option<Envelope<'a>>,
    pressures: Option<Envelope<'a>>,
    /// The way of a point of the part at the crest.
    pub track: Option<Track>,
}

impl<'a> Walk<'a> {
    /// `start` is where the nodes around each crack are.
    pub(super) fn new<'f>(
        dam: &'a Dam,
        shaking: &Shaking,
        wanted: Wanted<'a>,
        start: impl Fn(usize) -> Faces<'f>,
    ) -> Self {
        let mut crack = Crack::new(dam, Dampers::felt(dam), true);
        let on_rock = dam.bodies[1..].iter().any(ReducedBody::radiates);
        crack.solver.lasting = dam.cracks.len() > 1 || on_rock;
        let contactors = &crack.contacts.contactors;
        let cracks = Place::all(&dam.cracks)
            .into_iter()
            .zip(crack.contacts.of_cracks())
            .zip(&dam.cracks)
            .enumerate();
        let watch = |(k, ((place, contacts), line)): (usize, ((Place, _), _))| {
            let bonded = Faces::around(k, &dam.bodies, |body| &body.position);
            let faces = [bonded, start(k)].map(|faces| place.of(faces));
            Watch::new(place, contacts, contactors, line, faces)
        };
        Walk {
            dam,
            cracks: cracks.map(watch).collect(),
            crack,
            steps: Summary::default(),
            dt: shaking.dt,
            wanted,
            since: Since::new(dam),
            frames: Frames::new(dam),
            envelope: wanted.stresses.map(Envelope::new),
            pressures: wanted.pressures.map(Envelope::new),
            track: wanted.crest.map(|row| Track::new(row, shaking.ground.len())),
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

    /// Whether there have been steps since the last frame: the last frame of a run is its end.
    pub(super) fn pending(&self) -> bool {
        self.since.pending()
    }

    /// Book a step that has brought the nodes here; what the contact problem has found is a force times this `time`.
    pub(super) fn book<'f>(&mut self, step: usize, position: impl Fn(usize) -> Faces<'f>, time: f64) {
        let end = (step + 1) as f64 * self.dt;
        for (k, watch) in self.cracks.iter_mut().enumerate() {
            let [_, normal] = self.crack.sums(watch.contacts.clone());
            watch.book(end, self.dt, position(k), &self.crack, normal / time);
        }
        if let Some(bonds) = &self.crack.bonds {
            let bonded = self.cracks.iter_mut().zip(&bonds.cracked).zip(&self.dam.cracks);
            for ((watch, cracked), _) in bonded.filter(|(_, line)| line.bonded()) {
                watch.summary.cracked = *cracked;
            }
        }
    }

    /// Sum up what cracks with a law have been through.
    fn sum_up(&mut self) {
        if let Some(laws) = &self.crack.laws {
            for (k, watch) in self.cracks.iter_mut().enumerate() {
                (watch.summary.slip_path, watch.summary.bond_energy) = (laws.path(k), laws.sums[k][0]);
            }
        }
    }

    /// Add the impulses of a step, on the nodes around each crack, to those since the last frame; what the contact problem
    /// has found times `factor` are impulses; `cross` has those of the contacts across the valley, if there are any.
    pub(super) fn gather<'f>(&mut self, impulse: impl Fn(usize) -> Faces<'f>, cross: &[f64], factor: f64) {
        let crack = &self.crack;
        for (k, watch) in self.cracks.iter().enumerate() {
            let [along, across] = crack.sums(watch.contacts.clone()).map(|sum| sum * factor);
            let borne = crack.laws.as_ref().map_or(0.0, |laws| laws.sums[k][1] * self.dt);
            let upper = watch.place.of(impulse(k)).upper;
            let cross = cross
                .get(watch.contacts.clone())
                .map_or(0.0, |own| own.iter().sum::<f64>() * factor);
            self.since.add(k, upper, [along, across, borne, cross]);
        }
        self.since.go_on(self.dt);
    }

    /// Book what a step has done across the valley.
    pub(super) fn book_across(&mut self, across: &Across) {
        for (k, watch) in self.cracks.iter_mut().enumerate() {
            let along = watch.summary.slip_velocity * self.dt;
            across.book(k, watch.contacts.clone(), along, &mut watch.summary.cross);
        }
    }

    /// Keep a frame.
    pub(super) fn keep<'f>(
        &mut self,
        position: impl Fn(usize) -> Faces<'f>,
        modes: &[Vec<Group>],
        water: &[f64],
        ledger: &Ledger,
    ) {
        self.sum_up();
        let (since, status) = (&self.since, &self.crack.solver.status);
        let cracks = self.cracks.iter().enumerate().map(|(k, watch)| {
            let now = Snapshot {
                status: &status[watch.contacts.clone()],
                motion: &watch.motion,
                force: since.force(k),
                summary: &watch.summary,
                ledger,
            };
            (now, watch.place.of(position(k)))
        });
        let damage = self.crack.bonds.as_ref().map_or(&[][..], |bonds| &bonds.damage);
        self.frames.keep(cracks, since, status, damage);
        if self.wanted.modes {
            self.frames.keep_modes(&self.dam.bodies, modes);
            self.frames.water.extend_from_slice(water);
        }
        self.since.clear();
    }

    /// Whether the stresses after this step are wanted.
    #[inline(always)]
    pub(super) fn stressed(&self, step: usize) -> bool {
        self.envelope.as_ref().is_some_and(|envelope| envelope.due(step))
    }

    /// Take the stresses of a state into account, where they are wanted.
    pub(super) fn stress<W: Lanes>(&mut self, modes: &[Vec<Group>]) {
        if let Some(envelope) = &mut self.envelope {
            envelope.add::<W>(self.cracks[0].summary.end_time, modes);
        }
    }

    /// Whether the pressures of the water after this step are wanted.
    #[inline(always)]
    pub(super) fn pressed(&self, step: usize) -> bool {
        let wanted = |pressures: &Envelope| pressures.due(step) || self.due(step);
        self.pressures.as_ref().is_some_and(wanted)
    }

    /// Take the pressures of water with these velocities into account, where they are wanted.
    pub(super) fn press<W: Lanes>(&mut self, water: &Vec<Group>) {
        if let Some(pressures) = &mut self.pressures {
            pressures.add::<W>(self.cracks[0].summary.end_time, std::slice::from_ref(water));
        }
    }

    /// Whether the run ends after this step: the dam is at rest, a part above a crack is off any scale, which the outcome
    /// says, or somebody has stopped the run.
    pub(super) fn ends(&mut self, step: usize) -> bool {
        self.lost() || self.rests(step + 1)
    }

    /// Whether the dam is at rest, at a moment at which that is asked.
    fn rests(&self, steps: usize) -> bool {
        self.wanted.rest.is_some_and(|rest| {
            steps >= rest.first
                && (steps - rest.first).is_multiple_of(rest.every)
                && self.frames.rest(self.cracks.len(), rest.seconds, rest.moved)
        })
    }

    fn lost(&mut self) -> bool {
        let mut here = true;
        for Watch { motion, reach, .. } in &self.cracks {
            let openings = [motion.opening_heel, motion.opening_toe];
            if motion.slip.abs() < *reach && openings.iter().all(|opening| opening.abs() < *reach) {
                continue;
            }
            here = false;
            let finite = [motion.slip, openings[0], openings[1]]
                .iter()
                .all(|x| x.is_finite());
            self.steps.outcome = if finite && self.steps.outcome != Outcome::BlownUp {
                Outcome::Lost
            } else {
                Outcome::BlownUp
            };
        }
        !here || self.wanted.stop.asked()
    }

    /// Hand over what there is to tell; `anchors` has what those of a crack bore, `crest_cross` the way of its crest across
    /// the valley.
    pub(super) fn end(
        mut self,
        ledger: Ledger,
        crest_cross: Vec<f64>,
        anchors: impl Fn(usize) -> Vec<Borne>,
    ) -> Run {
        self.sum_up();
        let steps = &self.steps;
        let summary = |(crack, watch): (usize, Watch)| Summary {
            ledger,
            anchors: anchors(crack),
            outcome: steps.outcome,
            steps: steps.steps,
            iterations: steps.iterations,
            most_iterations: steps.most_iterations,
            sweeps: steps.sweeps,
            residual: steps.residual,
            ..watch.summary
        };
        Run {
            cracks: self.cracks.into_iter().enumerate().map(summary).collect(),
            frames: self.frames,
            worked: self.crack.laws.map_or_else(Vec::new, |laws| laws.contacts),
            extremes: self.envelope.map_or_else(Vec::new, Envelope::end),
            pressures: self
                .pressures
                .map_or_else(Vec::new, |water| water.end().swap_remove(0)),
            crest: self.track.map_or_else(Vec::new, Track::end),
            crest_cross,
        }
    }
}
