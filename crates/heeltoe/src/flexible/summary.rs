//! The peaks and sums of a run, crack by crack.

use super::bond::Cracked;
use super::coulomb::Report;
use super::ledger::Ledger;
use super::observe::State;
use crate::inside::Borne;
use crate::table::{columns, named};

named! {
    /// How a run ended.
    #[derive(Default)]
    Outcome {
        /// At the end of the record.
        #[default]
        Ok = "ok",
        /// The upper part has slid or flown beyond the lower one, or off any scale.
        Lost = "lost",
        /// Numbers beyond what a computer can hold: energy made from nothing.
        BlownUp = "blown up",
    }
}

/// Peaks and sums over all steps, of one crack; how the run ended, its steps and its energies are those of the dam.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// How it ended.
    pub outcome: Outcome,
    /// When (s).
    pub end_time: f64,
    /// Mean motion (m) of the upper face against the lower one, positive downstream.
    pub slip: f64,
    /// Largest slip.
    pub slip_max: f64,
    /// Least slip.
    pub slip_min: f64,
    /// In the last step (m/s).
    pub slip_velocity: f64,
    /// Mean of the paths (m) that its contacts have slipped, to and fro; of a crack with a law.
    pub slip_path: f64,
    /// Work (J) that broke its bond.
    pub bond_energy: f64,
    /// What has become of its bond, where it is a joint.
    pub cracked: Cracked,
    /// Largest rotation of the chord of the upper face against that of the lower one, positive counter-clockwise.
    pub rotation_max: f64,
    /// Least rotation.
    pub rotation_min: f64,
    /// Largest opening at the heel (m).
    pub opening_upstream: f64,
    /// Largest opening at the toe (m).
    pub opening_downstream: f64,
    /// Largest depth (m) to which a watched node has gone into the other face.
    pub penetration: f64,
    /// Slip (m) while all watched nodes touch, while some do, and while none does.
    pub slip_by_state: [f64; 3],
    /// Time in each [`State`] (s).
    pub time_by_state: [f64; 5],
    /// How many nodes have come down.
    pub impacts: u64,
    /// The fastest of them (m/s).
    pub impact_velocity: f64,
    /// Largest sum of the normal forces of contact (N).
    pub peak_normal_force: f64,
    /// Where the energy of the whole dam went.
    pub ledger: Ledger,
    /// What of it was lost in this crack, along it and across it (J).
    pub lost: [f64; 2],
    /// Steps taken.
    pub steps: u64,
    /// Sets of states tried in all steps.
    pub iterations: u64,
    /// Most sets tried in a step.
    pub most_iterations: u32,
    /// Steps in which sweeps had to help.
    pub sweeps: u64,
    /// Largest violation of the conditions of contact, over the largest impulse.
    pub residual: f64,
    /// State of the crack in the last step.
    pub final_state: State,
    /// What each anchor with stiffness has borne (N, s).
    pub anchors: Vec<Borne>,
    /// Motion of the crack across the valley.
    pub cross: CrossSummary,
}

/// Peaks and sums of a crack across the valley, positive to the left bank.
#[derive(Clone, Copy, Debug, Default)]
pub struct CrossSummary {
    /// Mean motion (m) of the upper face against the lower one.
    pub slip: f64,
    /// Largest slip.
    pub slip_max: f64,
    /// Least slip.
    pub slip_min: f64,
    /// Length (m) of the path of the slip, along and across the valley together.
    pub slip_path: f64,
    /// How often the part above comes to rest against a neighbour.
    pub side_contacts: u64,
    /// How long a neighbour pushes a node (s).
    pub time_at_side: f64,
    /// Impulse (N s) that the neighbours have taken.
    pub side_impulse: f64,
    /// Whether one pushes now.
    pub at_side: bool,
}

columns!(Summary, s => {
    "outcome": f64::from(s.outcome as u8),
    "end_time": s.end_time,
    "slip": s.slip,
    "slip_max": s.slip_max,
    "slip_min": s.slip_min,
    "slip_velocity": s.slip_velocity,
    "rotation_max": s.rotation_max,
    "rotation_min": s.rotation_min,
    "opening_upstream": s.opening_upstream,
    "opening_downstream": s.opening_downstream,
    "penetration": s.penetration,
    "slip_sliding": s.slip_by_state[0],
    "slip_slide_rocking": s.slip_by_state[1],
    "slip_drifting": s.slip_by_state[2],
    "time_rest": s.time_by_state[0],
    "time_sliding": s.time_by_state[1],
    "time_rocking": s.time_by_state[2],
    "time_slide_rocking": s.time_by_state[3],
    "time_drifting": s.time_by_state[4],
    "impacts": s.impacts as f64,
    "largest_impact_velocity": s.impact_velocity,
    "peak_normal_force": s.peak_normal_force,
    "energy_start": s.ledger.start,
    "energy_stored": s.ledger.stored,
    "energy_penalty": s.ledger.penalty,
    "energy_input": s.ledger.input,
    "energy_damping": s.ledger.damping,
    "energy_numerical": s.ledger.numerical,
    "energy_impact": s.ledger.impact,
    "energy_friction": s.ledger.friction,
    "energy_gained": s.ledger.gained,
    "energy_turnover": s.ledger.turnover,
    "energy_residual": s.ledger.residual(),
    "steps": s.steps as f64,
    "iterations": s.iterations as f64,
    "most_iterations": f64::from(s.most_iterations),
    "sweeps": s.sweeps as f64,
    "contact_residual": s.residual,
    "final_state": f64::from(s.final_state as u8),
    "crack_friction": s.lost[0],
    "crack_impact": s.lost[1],
    "slip_path": s.slip_path,
    "bond_energy": s.bond_energy,
    "energy_fracture": s.ledger.fracture,
    "energy_boundary": s.ledger.boundary,
    "energy_floor": s.ledger.floor,
    "energy_far_end": s.ledger.far_end,
    "crack_fracture": s.cracked.energy,
    "first_cracking": s.cracked.first[0],
    "first_cracking_place": s.cracked.first[1],
    "cracked_through": s.cracked.through,
    "cracked_from_heel": s.cracked.lengths[0],
    "cracked_from_toe": s.cracked.lengths[1],
    "cracked_length": s.cracked.lengths[2],
    "softening_length": s.cracked.lengths[3],
    "cross_slip": s.cross.slip,
    "cross_slip_max": s.cross.slip_max,
    "cross_slip_min": s.cross.slip_min,
    "cross_slip_path": s.cross.slip_path,
    "side_contacts": s.cross.side_contacts as f64,
    "time_at_side": s.cross.time_at_side,
    "side_impulse": s.cross.side_impulse,
});

impl Summary {
    /// Count how a step's contact problem was solved.
    #[inline(always)]
    pub(super) fn note(&mut self, report: Report) {
        self.steps += 1;
        self.iterations += u64::from(report.iterations);
        self.most_iterations = self.most_iterations.max(report.iterations);
        self.sweeps += u64::from(report.swept);
        self.residual = self.residual.max(report.residual);
    }
}
