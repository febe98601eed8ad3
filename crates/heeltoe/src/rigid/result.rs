//! What a run returns: its outcome, its summary, its events, the moments asked for.

use super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::ledger::Ledger;
use super::mode::Mode;
use crate::friction::Worn;
use crate::inside::Borne;
use crate::table::{columns, named};

named! {
    /// How a run ended.
    Outcome {
        /// At the end of the record.
        Done = "ok",
        /// The static loads alone move the block.
        Unstable = "unstable",
        /// No mode of motion is admissible (Painlevé), or no outcome of an impact.
        Paradox = "paradox",
        /// After too many events.
        EventLimit = "event limit",
        /// Events follow each other without time passing.
        Cycling = "cycling",
        /// The block lies on its side.
        Overturned = "overturned",
        /// A corner lifts while the ground shakes across the valley and friction or uplift goes by a law.
        LiftsAcross = "lifts across",
    }
}

named! {
    /// What happens at an event.
    EventKind {
        /// A base that stuck slips.
        SlipStarts = "slip starts",
        /// The slip velocity has come to zero.
        SlipStops = "slip stops",
        /// The heel leaves the crack.
        HeelLifts = "heel lifts",
        /// The toe leaves the crack.
        ToeLifts = "toe lifts",
        /// The heel comes down.
        HeelStrikes = "heel strikes",
        /// The toe comes down.
        ToeStrikes = "toe strikes",
        /// Both come down at once.
        BothStrike = "both strike",
        /// A tangential impact ends a Painlevé paradox.
        Jams = "jams",
        /// The block slides over a peak of a rough crack, or passes a valley or a peak in the air.
        AsperityPassed = "asperity passed",
        /// The block comes to rest against a neighbour, across the valley.
        SideStrikes = "side strikes",
        /// None of these, but the mode is another.
        ModeChanges = "mode changes",
    }
}

/// One event: state after it and, for an impact, what it did.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// When (s).
    pub time: f64,
    /// What.
    pub kind: EventKind,
    /// Mode before it.
    pub before: Mode,
    /// Mode after it.
    pub after: Mode,
    /// Slip and gaps (m).
    pub position: Vector,
    /// Their velocities after it (m/s).
    pub velocity: Vector,
    /// Velocities right before (equal to `velocity` where nothing strikes).
    pub approach: Vector,
    /// Impulses of friction and of the normal forces at heel and toe.
    pub impulse: Vector,
    /// Kinetic energy lost.
    pub energy_lost: f64,
}

columns!(Event, e => {
    "time": e.time,
    "kind": e.kind as u8 as f64,
    "mode_before": e.before.index() as f64,
    "mode_after": e.after.index() as f64,
    "slip": e.position[SLIP],
    "gap_heel": e.position[HEEL],
    "gap_toe": e.position[TOE],
    "slip_velocity": e.velocity[SLIP],
    "gap_velocity_heel": e.velocity[HEEL],
    "gap_velocity_toe": e.velocity[TOE],
    "approach_slip_velocity": e.approach[SLIP],
    "approach_velocity_heel": e.approach[HEEL],
    "approach_velocity_toe": e.approach[TOE],
    "friction_impulse": e.impulse[SLIP],
    "heel_impulse": e.impulse[HEEL],
    "toe_impulse": e.impulse[TOE],
    "energy_lost": e.energy_lost,
});

/// The block at a moment that was asked for.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// Mode of motion.
    pub mode: Mode,
    /// Slip and gaps (m).
    pub position: Vector,
    /// Their velocities (m/s).
    pub velocity: Vector,
    /// Their accelerations (m/s2).
    pub acceleration: Vector,
    /// Friction and normal forces at heel and toe (N/m).
    pub reaction: Vector,
}

columns!(Moment, m => {
    "slip": m.position[SLIP],
    "gap_heel": m.position[HEEL],
    "gap_toe": m.position[TOE],
    "slip_velocity": m.velocity[SLIP],
    "gap_velocity_heel": m.velocity[HEEL],
    "gap_velocity_toe": m.velocity[TOE],
    "slip_acceleration": m.acceleration[SLIP],
    "gap_acceleration_heel": m.acceleration[HEEL],
    "gap_acceleration_toe": m.acceleration[TOE],
    "friction_force": m.reaction[SLIP],
    "normal_force_heel": m.reaction[HEEL],
    "normal_force_toe": m.reaction[TOE],
});

/// What a run leaves behind.
#[derive(Clone, Debug)]
pub struct Run {
    /// Its end, peaks and sums.
    pub summary: Summary,
    /// The block at the moments asked for, up to where the run stopped.
    pub moments: Vec<Moment>,
    /// Slip and gaps (m) at these and at those at which no more was asked for.
    pub places: Vec<Vector>,
    /// What happened, if that was asked for.
    pub events: Vec<Event>,
    /// What each anchor has borne (N/m, s); the exact walk knows none.
    pub anchors: Vec<Borne>,
    /// What the crack has been through, where its friction goes by a law.
    pub worn: Option<Wear>,
    /// What the asperities have been through, where the crack is rough.
    pub rough: Option<Roughness>,
    /// Motion of the block across the valley, where the ground shakes that way.
    pub crossing: Option<Crossing>,
}

/// Motion of a block across the valley; positive to the left bank.
#[derive(Clone, Debug, Default)]
pub struct Crossing {
    /// At the moments asked for: place (m), velocity (m/s), friction (N/m).
    pub kept: Vec<[f64; 3]>,
    /// Place at the end (m).
    pub position: f64,
    /// Velocity at the end (m/s).
    pub velocity: f64,
    /// Least and largest place (m).
    pub range: [f64; 2],
    /// Length of the path of the slip, along and across together (m).
    pub path: f64,
    /// Impulse on the neighbours (N s/m).
    pub side_impulse: f64,
    /// How long one of them held the block (s).
    pub time_at_side: f64,
    /// How often it came to one.
    pub side_strikes: u64,
}

columns!(Crossing, c => {
    "slip": c.position,
    "slip_velocity": c.velocity,
    "slip_min": c.range[0],
    "slip_max": c.range[1],
    "path": c.path,
    "side_impulse": c.side_impulse,
    "time_at_side": c.time_at_side,
    "side_strikes": c.side_strikes as f64,
});

/// What the asperities of a rough crack have been through.
#[derive(Clone, Debug)]
pub struct Roughness {
    /// At the moments asked for: dilation (m), angle (rad), plastic work per area (J/m2).
    pub kept: Vec<[f64; 3]>,
    /// At the end.
    pub end: [f64; 3],
    /// Largest dilation with a corner in contact (m).
    pub highest: f64,
}

/// What a crack whose friction goes by a law has been through.
#[derive(Clone, Debug)]
pub struct Wear {
    /// At the moments asked for: path (m), and 1 while the bond is whole.
    pub kept: Vec<[f64; 2]>,
    /// At the end.
    pub end: Worn,
    /// Sum of the errors estimated of all steps of the integration, and of what those in the velocity come to (m).
    pub error: f64,
    /// Time that they took: what else there is of the run is exact (s).
    pub integrated: f64,
}

/// End, peaks and sums of a run; SI, per metre of dam.
#[derive(Clone, Debug)]
pub struct Summary {
    /// How it ended.
    pub outcome: Outcome,
    /// When (s).
    pub end_time: f64,
    /// Mode of motion at the end.
    pub mode: Mode,
    /// Slip and gaps at the end (m).
    pub position: Vector,
    /// Their velocities (m/s).
    pub velocity: Vector,
    /// Least and largest slip (m).
    pub slip_range: [f64; 2],
    /// Most negative (downstream, about the toe) and most positive (upstream, about the heel) rotation.
    pub rotation_range: [f64; 2],
    /// Largest gap at the heel and at the toe (m).
    pub largest_gap: [f64; 2],
    /// Slip gathered in rest, slide, rock, slide-rock, drift (the first and third stay zero).
    pub slip_by_mode: [f64; 5],
    /// Time spent in each of them (s).
    pub time_by_mode: [f64; 5],
    /// Number of impacts.
    pub impacts: u64,
    /// Number of all events.
    pub events: u64,
    /// Largest velocity with which a corner struck (m/s).
    pub largest_impact_velocity: f64,
    /// Impacts whose restitution had to be lowered for energy not to grow.
    pub energy_limited: u64,
    /// Tangential impacts out of a Painlevé paradox.
    pub jams: u64,
    /// How often a slip stopped.
    pub slip_stops: u64,
    /// Where the energy went.
    pub ledger: Ledger,
    /// Kinetic energy at the end, relative to the ground.
    pub kinetic_energy: f64,
}

columns!(Summary, s => {
    "outcome": s.outcome as u8 as f64,
    "end_time": s.end_time,
    "final_mode": s.mode.index() as f64,
    "slip": s.position[SLIP],
    "gap_heel": s.position[HEEL],
    "gap_toe": s.position[TOE],
    "slip_velocity": s.velocity[SLIP],
    "gap_velocity_heel": s.velocity[HEEL],
    "gap_velocity_toe": s.velocity[TOE],
    "slip_min": s.slip_range[0],
    "slip_max": s.slip_range[1],
    "rotation_min": s.rotation_range[0],
    "rotation_max": s.rotation_range[1],
    "largest_gap_heel": s.largest_gap[0],
    "largest_gap_toe": s.largest_gap[1],
    "slip_sliding": s.slip_by_mode[1],
    "slip_slide_rocking": s.slip_by_mode[3],
    "slip_drifting": s.slip_by_mode[4],
    "time_rest": s.time_by_mode[0],
    "time_sliding": s.time_by_mode[1],
    "time_rocking": s.time_by_mode[2],
    "time_slide_rocking": s.time_by_mode[3],
    "time_drifting": s.time_by_mode[4],
    "impacts": s.impacts as f64,
    "events": s.events as f64,
    "largest_impact_velocity": s.largest_impact_velocity,
    "energy_limited_impacts": s.energy_limited as f64,
    "jams": s.jams as f64,
    "slip_stops": s.slip_stops as f64,
    "energy_input": s.ledger.input,
    "energy_friction": s.ledger.friction,
    "energy_impact": s.ledger.impact,
    "energy_kinetic": s.kinetic_energy,
    "energy_residual": s.ledger.residual(s.kinetic_energy),
});

impl Summary {
    pub(super) fn at_start(block: &Block, time: f64, [position, velocity]: [Vector; 2]) -> Self {
        let turn = block.rotation(&position);
        Summary {
            outcome: Outcome::Done,
            end_time: time,
            mode: Mode::Rest,
            position,
            velocity,
            slip_range: [position[SLIP], position[SLIP]],
            rotation_range: [turn.min(0.0), turn.max(0.0)],
            largest_gap: [position[HEEL], position[TOE]],
            slip_by_mode: [0.0; 5],
            time_by_mode: [0.0; 5],
            impacts: 0,
            events: 0,
            largest_impact_velocity: 0.0,
            energy_limited: 0,
            jams: 0,
            slip_stops: 0,
            ledger: Ledger {
                start: block.kinetic_energy(&velocity),
                ..Ledger::default()
            },
            kinetic_energy: 0.0,
        }
    }

    /// Whether slip, gaps and rotation of a moment lie within the extremes.
    pub(super) fn covers(&self, at: &Vector, turn: f64) -> bool {
        let within = |value: f64, [least, most]: [f64; 2]| least <= value && value <= most;
        within(at[SLIP], self.slip_range)
            && within(turn, self.rotation_range)
            && at[HEEL] <= self.largest_gap[0]
            && at[TOE] <= self.largest_gap[1]
    }

    /// Take slip, gaps and rotation of a moment into the extremes.
    pub(super) fn widen(&mut self, at: &Vector, turn: f64) {
        self.slip_range = [self.slip_range[0].min(at[SLIP]), self.slip_range[1].max(at[SLIP])];
        self.rotation_range = [self.rotation_range[0].min(turn), self.rotation_range[1].max(turn)];
        self.largest_gap = [
            self.largest_gap[0].max(at[HEEL]),
            self.largest_gap[1].max(at[TOE]),
        ];
    }
}
