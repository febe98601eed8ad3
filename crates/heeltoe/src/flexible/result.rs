//! What a run of the flexible model leaves behind.

use super::coulomb::Report;
use super::ledger::Ledger;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[repr(u8)]
pub enum Outcome {
    #[default]
    Ok,
    /// The upper part has slid or flown beyond the lower one, or off any scale.
    Lost,
    /// Numbers beyond what a computer can hold: energy made from nothing.
    BlownUp,
}

impl Outcome {
    pub const NAMES: [&'static str; 3] = ["ok", "lost", "blown up"];
}

/// Peaks and sums over all steps.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    pub outcome: Outcome,
    pub end_time: f64,
    /// Mean motion of the upper face against the lower one, positive downstream.
    pub slip: f64,
    pub slip_max: f64,
    pub slip_min: f64,
    pub slip_velocity: f64,
    /// Rotation of the chord of the upper face against that of the lower one, positive counter-clockwise.
    pub rotation_max: f64,
    pub rotation_min: f64,
    pub opening_heel: f64,
    pub opening_toe: f64,
    /// Largest depth to which a watched node has gone into the other face.
    pub penetration: f64,
    /// Slip while all watched nodes touch, while some do, and while none does.
    pub slip_by_state: [f64; 3],
    /// Time in each of the states of [`super::observe`].
    pub time_by_state: [f64; 5],
    pub impacts: u64,
    pub impact_velocity: f64,
    pub peak_normal_force: f64,
    pub ledger: Ledger,
    pub steps: u64,
    pub iterations: u64,
    pub most_iterations: u32,
    pub sweeps: u64,
    pub residual: f64,
    /// State of the crack in the last step.
    pub final_state: u8,
    /// Largest tension of each anchor.
    pub tensions: Vec<f64>,
}

impl Summary {
    pub const FIELDS: [&'static str; 39] = [
        "outcome",
        "end_time",
        "slip",
        "slip_max",
        "slip_min",
        "slip_velocity",
        "rotation_max",
        "rotation_min",
        "opening_heel",
        "opening_toe",
        "penetration",
        "slip_sliding",
        "slip_slide_rocking",
        "slip_drifting",
        "time_rest",
        "time_sliding",
        "time_rocking",
        "time_slide_rocking",
        "time_drifting",
        "impacts",
        "largest_impact_velocity",
        "peak_normal_force",
        "energy_start",
        "energy_stored",
        "energy_penalty",
        "energy_input",
        "energy_damping",
        "energy_numerical",
        "energy_impact",
        "energy_friction",
        "energy_gained",
        "energy_turnover",
        "energy_residual",
        "steps",
        "iterations",
        "most_iterations",
        "sweeps",
        "contact_residual",
        "final_state",
    ];

    /// The numbers in the order of `FIELDS`, then the tensions.
    pub fn row(&self) -> Vec<f64> {
        let mut row = self.numbers().to_vec();
        row.extend(&self.tensions);
        row
    }

    fn numbers(&self) -> [f64; 39] {
        let (e, t, s) = (&self.ledger, self.time_by_state, self.slip_by_state);
        [
            f64::from(self.outcome as u8),
            self.end_time,
            self.slip,
            self.slip_max,
            self.slip_min,
            self.slip_velocity,
            self.rotation_max,
            self.rotation_min,
            self.opening_heel,
            self.opening_toe,
            self.penetration,
            s[0],
            s[1],
            s[2],
            t[0],
            t[1],
            t[2],
            t[3],
            t[4],
            self.impacts as f64,
            self.impact_velocity,
            self.peak_normal_force,
            e.start,
            e.stored,
            e.penalty,
            e.input,
            e.damping,
            e.numerical,
            e.impact,
            e.friction,
            e.gained,
            e.turnover,
            e.residual(),
            self.steps as f64,
            self.iterations as f64,
            f64::from(self.most_iterations),
            self.sweeps as f64,
            self.residual,
            f64::from(self.final_state),
        ]
    }

    /// Count how a step's contact problem was solved.
    #[inline(always)]
    pub fn note(&mut self, report: Report) {
        self.steps += 1;
        self.iterations += u64::from(report.iterations);
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.sweeps += u64::from(report.swept);
        self.residual = self.residual.max(report.residual);
    }
}

/// States of the run at equal distances in time, beginning with the start.
#[derive(Default)]
pub struct Frames {
    pub rows: Vec<[f64; 16]>,
    /// Positions of the crack nodes: along the crack, then across it.
    pub upper: Vec<f64>,
    pub lower: Vec<f64>,
    /// Mean forces on the nodes of the upper face since the frame before.
    pub force: Vec<f64>,
    /// Status of each contactor.
    pub status: Vec<u8>,
    /// Amplitudes of all modes, on request.
    pub modes_upper: Vec<f64>,
    pub modes_lower: Vec<f64>,
}

impl Frames {
    pub const FIELDS: [&'static str; 16] = [
        "time",
        "slip",
        "slip_velocity",
        "rotation",
        "opening_heel",
        "opening_toe",
        "normal_force",
        "friction_force",
        "touching",
        "state",
        "energy_stored",
        "energy_input",
        "energy_damping",
        "energy_impact",
        "energy_friction",
        "energy_numerical",
    ];
}
