//! Many runs of the exact walk, side by side.

use super::block::{Block, FIELD_COUNT, HEEL, SLIP, TOE};
use super::result::Summary;
use super::simulate::{simulate, Motion, Options};
use crate::parallel::each;

/// Names of the numbers an ensemble returns for each run, in order (SI).
pub const SUMMARY_FIELDS: [&str; 34] = [
    "outcome",
    "end_time",
    "final_mode",
    "slip",
    "gap_heel",
    "gap_toe",
    "slip_velocity",
    "gap_velocity_heel",
    "gap_velocity_toe",
    "slip_min",
    "slip_max",
    "rotation_min",
    "rotation_max",
    "largest_gap_heel",
    "largest_gap_toe",
    "slip_sliding",
    "slip_slide_rocking",
    "slip_drifting",
    "time_rest",
    "time_sliding",
    "time_rocking",
    "time_slide_rocking",
    "time_drifting",
    "impacts",
    "events",
    "largest_impact_velocity",
    "energy_limited_impacts",
    "jams",
    "slip_stops",
    "energy_input",
    "energy_friction",
    "energy_impact",
    "energy_kinetic",
    "energy_residual",
];
pub const ROW: usize = SUMMARY_FIELDS.len();
pub type Row = [f64; ROW];

pub fn row(s: &Summary) -> Row {
    let end = s.kinetic_energy;
    [
        s.outcome as u8 as f64,
        s.end_time,
        s.mode.index() as f64,
        s.position[SLIP],
        s.position[HEEL],
        s.position[TOE],
        s.velocity[SLIP],
        s.velocity[HEEL],
        s.velocity[TOE],
        s.slip_range[0],
        s.slip_range[1],
        s.rotation_range[0],
        s.rotation_range[1],
        s.largest_gap[0],
        s.largest_gap[1],
        s.slip_by_mode[1],
        s.slip_by_mode[3],
        s.slip_by_mode[4],
        s.time_by_mode[0],
        s.time_by_mode[1],
        s.time_by_mode[2],
        s.time_by_mode[3],
        s.time_by_mode[4],
        s.impacts as f64,
        s.events as f64,
        s.largest_impact_velocity,
        s.energy_limited as f64,
        s.jams as f64,
        s.slip_stops as f64,
        s.ledger.input,
        s.ledger.friction,
        s.ledger.impact,
        end,
        s.ledger.residual(end),
    ]
}

/// One run of an ensemble: a block, the motion it meets, and the factors on that motion.
pub struct Case<'a> {
    pub block: &'a [f64; FIELD_COUNT],
    pub motion: Motion<'a>,
}

/// Run `count` cases; `case` names the input of each.
pub fn run<'a>(count: usize, options: Options, case: impl Fn(usize) -> Case<'a> + Sync + Send) -> Vec<Row> {
    each(count, 16, |k| {
        let case = case(k);
        let block = Block::new(case.block);
        row(&simulate(&block, &case.motion, None, options, None, None))
    })
}
