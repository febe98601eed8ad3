//! What a run returns: its outcome, its summary, its events, the histories asked for.

use super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::ledger::Ledger;
use super::mode::Mode;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    Done,
    /// The static loads alone move the block.
    Unstable,
    /// No mode of motion is admissible (Painlevé), or no outcome of an impact.
    Paradox,
    EventLimit,
    /// Events follow each other without time passing.
    Cycling,
    /// The block lies on its side.
    Overturned,
}

impl Outcome {
    pub const NAMES: [&'static str; 6] = [
        "ok",
        "unstable",
        "paradox",
        "event limit",
        "cycling",
        "overturned",
    ];
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    SlipStarts,
    SlipStops,
    HeelLifts,
    ToeLifts,
    HeelStrikes,
    ToeStrikes,
    BothStrike,
    Jams,
    ModeChanges,
}

impl EventKind {
    pub const NAMES: [&'static str; 9] = [
        "slip starts",
        "slip stops",
        "heel lifts",
        "toe lifts",
        "heel strikes",
        "toe strikes",
        "both strike",
        "jams",
        "mode changes",
    ];
}

/// One event: state after it and, for an impact, what it did.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    pub time: f64,
    pub kind: EventKind,
    pub before: Mode,
    pub after: Mode,
    pub position: Vector,
    pub velocity: Vector,
    /// Velocity right before (equal to `velocity` where nothing strikes).
    pub approach: Vector,
    pub impulse: Vector,
    pub energy_lost: f64,
}

/// Moments at which the state is wanted, and what is kept of it.
pub struct Histories<'a> {
    pub times: &'a [f64],
    pub rows: Vec<[f64; 12]>,
    pub modes: Vec<u8>,
}

#[derive(Clone, Debug)]
pub struct Summary {
    pub outcome: Outcome,
    pub end_time: f64,
    pub mode: Mode,
    pub position: Vector,
    pub velocity: Vector,
    pub slip_range: [f64; 2],
    /// Most negative (downstream, about the toe) and most positive (upstream, about the heel) rotation.
    pub rotation_range: [f64; 2],
    pub largest_gap: [f64; 2],
    /// Slip gathered in rest, slide, rock, slide-rock, drift (the first and third stay zero).
    pub slip_by_mode: [f64; 5],
    pub time_by_mode: [f64; 5],
    pub impacts: u64,
    pub events: u64,
    pub largest_impact_velocity: f64,
    pub energy_limited: u64,
    pub jams: u64,
    pub slip_stops: u64,
    pub ledger: Ledger,
    pub kinetic_energy: f64,
}

impl Summary {
    pub(in crate::rigid) fn at_start(block: &Block, time: f64, position: Vector, velocity: Vector) -> Self {
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

    pub(in crate::rigid) fn widen(&mut self, at: &Vector, block: &Block) {
        let turn = block.rotation(at);
        self.slip_range = [self.slip_range[0].min(at[SLIP]), self.slip_range[1].max(at[SLIP])];
        self.rotation_range = [self.rotation_range[0].min(turn), self.rotation_range[1].max(turn)];
        self.largest_gap = [
            self.largest_gap[0].max(at[HEEL]),
            self.largest_gap[1].max(at[TOE]),
        ];
    }
}
