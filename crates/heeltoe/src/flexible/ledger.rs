//! Where the energy goes.
//!
//! With `v* = theta v' + (1 - theta) v` the scheme of [`super::step`] keeps, to the last bit of rounding,
//!
//! ```text
//! E' - E = (dt f - gamma dV) v*  -  dt c v*^2  -  (theta - 1/2) (|v' - v|^2 + omega^2 |q' - q|^2)  +  p u*
//!           input                   damping      numerical                                     contact
//! ```
//!
//! in every step, with what leaves through the boundary of the rock and, of the water, through floor and far end. What is left over in the end is the residual: rounding, or a mistake.

use super::simd::{Group, LANES};

/// Energies since the start; losses are positive.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ledger {
    /// Strain and kinetic energy at the start.
    pub start: f64,
    /// Strain and kinetic energy now, with that of the anchors and of the water with sound.
    pub stored: f64,
    /// Energy held by the anchors, now.
    pub springs: f64,
    /// Energy held by the springs of a penalty, now.
    pub penalty: f64,
    /// Work of the static loads, of pressure that changes, and of the ground on the motion relative to it.
    pub input: f64,
    /// Lost to damping in the concrete.
    pub damping: f64,
    /// Taken by the scheme itself.
    pub numerical: f64,
    /// Lost to contact across the crack.
    pub impact: f64,
    /// Lost to contact along it.
    pub friction: f64,
    /// Taken by the bond of joints: what broke it, and what it holds while it softens.
    pub fracture: f64,
    /// Left through the boundary of the rock, or lost in it.
    pub boundary: f64,
    /// Left through the floor of the reservoir.
    pub floor: f64,
    /// Left through its far end.
    pub far_end: f64,
    /// Energy that contact has added in steps of positive work, and bonds beyond what they held; neither ought to add
    /// any.
    pub gained: f64,
    /// All that went in or out, without sign.
    pub turnover: f64,
}

impl Ledger {
    /// Loss that only the scheme itself can explain.
    pub(super) fn unexplained(&self) -> f64 {
        let change = self.stored + self.penalty - self.start;
        let dam = self.input - self.damping - self.impact - self.friction - self.fracture - change;
        dam - (self.boundary + self.floor + self.far_end)
    }

    /// What is not accounted for, over the turnover.
    pub fn residual(&self) -> f64 {
        let scale = self.turnover + self.stored.abs() + self.start.abs();
        if scale > 0.0 {
            (self.unexplained() - self.numerical).abs() / scale
        } else {
            0.0
        }
    }
}

/// Sums of one body, mode group by mode group.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    pub input: Group,
    pub turnover: Group,
    pub damping: Group,
    pub numerical: Group,
    pub boundary: Group,
}

impl Sums {
    /// Add these sums to a ledger.
    pub(super) fn book(&self, ledger: &mut Ledger) {
        for l in 0..LANES {
            ledger.input += self.input[l];
            ledger.turnover += self.turnover[l];
            ledger.damping += self.damping[l];
            ledger.numerical += self.numerical[l];
            ledger.boundary += self.boundary[l];
        }
    }
}
