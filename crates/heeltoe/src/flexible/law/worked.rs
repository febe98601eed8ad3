//! What one contact of a crack with a friction law has been through, and what it bears now.

use super::super::scheme::TimeStep;
use super::super::status::Status;
use super::sideways::Sideways;
use crate::friction::{Law, Strength, Worn};
use crate::table::columns;

/// A contact of a crack with a law.
#[derive(Clone, Debug)]
pub struct Worked {
    /// Its crack, from the crest down.
    pub crack: usize,
    /// Its share of the length of the crack (m).
    pub length: f64,
    /// What it has been through.
    pub worn: Worn,
    /// The same before the earthquake.
    pub before: Worn,
    /// The force (N) that pressed it then.
    pub pressed_before: f64,
    /// Its place among all contacts.
    pub(super) contact: usize,
    /// The contact of the other face's end that it takes the place of.
    pub(super) double: Option<usize>,
    /// Force (N) that presses it.
    pub(super) pressed: f64,
    /// Speed of its slip as the step begins, and whether it slipped in the step before.
    pub(super) speed: f64,
    pub(super) slipped: bool,
    /// Way that it slips in the step, by what is known of it (m).
    pub(super) moved: f64,
    /// What it bears at rest and sliding in this step (N), and what of it the bond does.
    pub(super) bears: Strength,
    pub(super) bond: [f64; 2],
    /// Whether nothing changes that any more.
    pub(super) settled: bool,
    /// Slope of what it bears sliding as the step begins, and whether it was that in the step before.
    pub(super) slope: f64,
    pub(super) steady: bool,
}

columns!(Worked, w => {
    "crack": w.crack as f64,
    "length": w.length,
    "double": f64::from(w.double.is_some()),
    "path": w.worn.path,
    "bonded": f64::from(w.worn.bonded),
    "path_before": w.before.path,
    "bonded_before": f64::from(w.before.bonded),
    "normal_force_before": w.pressed_before,
});

impl Worked {
    /// Way that it slips in a step; one that goes on sticking has none, whatever rounding says.
    pub(super) fn way(
        &self,
        status: Status,
        (u, before): (f64, f64),
        sideways: Sideways,
        step: TimeStep,
    ) -> f64 {
        if status.slips() || (self.slipped && status.closed()) {
            let mean = |u: f64, before: f64| step.theta * u + (1.0 - step.theta) * before;
            let across = sideways
                .u
                .get(self.contact)
                .zip(sideways.before.get(self.contact));
            step.dt * Sideways::size(mean(u, before), across.map(|(u, before)| mean(*u, *before)))
        } else {
            0.0
        }
    }

    fn midway(&self, moved: f64) -> Worn {
        Worn {
            path: self.worn.path + 0.5 * moved,
            ..self.worn
        }
    }

    /// Find what it bears about the force that presses it, in the middle of this way.
    pub(super) fn look(&mut self, laws: &[Option<Law>], moved: f64) {
        if self.settled {
            return;
        }
        if let Some(law) = &laws[self.crack] {
            let worn = self.midway(moved);
            self.bears = law.strength(self.length, self.pressed, self.speed, worn);
            self.bond = law.bond(worn).map(|bond| self.length * bond);
            self.settled = law.settled(self.worn);
        }
    }

    /// What it bears under the force that presses it, at rest (0) or sliding (1).
    pub(super) fn borne(&self, slides: usize) -> f64 {
        self.bears.coefficient[slides] * self.pressed + self.bears.constant[slides]
    }
}
