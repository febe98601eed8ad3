//! Cracks whose friction goes by a law: what each contact has been through, and what it bears.
//!
//! A contact with the share `a` of its crack's length, which the force `N` presses, bears
//!
//! ```text
//! S = a tau(N / a, d, v)
//! ```
//!
//! with `tau` of [`crate::friction::Law`], the path `d` that this very contact has slipped and its speed `v`. `N` and `d`
//! are those of the step itself, `d` in the middle of its way: they are found by passes, see [`passes`]. The speed is
//! that with which the step begins. So what friction takes in a step is the work under its curve, and but for the speed
//! the law adds no error of the step's first order to that of the scheme.
//!
//! A contact that opens, or has left the other face, has broken its bond. One that is watched in place of the end of the
//! other face, and was not there before, has been through what that end has.

mod passes;
mod spots;

use self::spots::spots;
use super::contact::Contacts;
use super::dam::Dam;
use super::moving::TimeStep;
use super::status::Status;
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
    contact: usize,
    /// The contact of the other face's end that it takes the place of.
    double: Option<usize>,
    /// Force (N) that presses it.
    pressed: f64,
    /// Speed of its slip as the step begins, and whether it slipped in the step before.
    speed: f64,
    slipped: bool,
    /// What it bears at rest and sliding in this step (N), and what of it the bond does.
    bears: Strength,
    bond: [f64; 2],
    /// Slope of what it bears sliding as the step begins, and whether it was that in the step before.
    slope: f64,
    steady: bool,
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

/// All of them, with the laws of their cracks.
#[derive(Clone, Debug, Default)]
pub(super) struct Laws {
    of_cracks: Vec<Option<Law>>,
    pub contacts: Vec<Worked>,
    /// Of each crack: work that broke its bond (J), what it bore in the last step (N).
    pub sums: Vec<[f64; 2]>,
    /// Passes of the step so far.
    passes: u32,
    /// Whether they go carefully by now.
    careful: bool,
}

impl Laws {
    /// None where no crack has a law.
    pub(super) fn new(dam: &Dam, all: &Contacts) -> Option<Self> {
        if dam.cracks.iter().all(|line| line.law.is_none()) {
            return None;
        }
        let mut contacts = Vec::new();
        let mut first = 0;
        for (crack, (line, spots)) in dam.cracks.iter().zip(spots(dam, all)).enumerate() {
            if line.law.is_some() {
                contacts.extend(spots.iter().enumerate().map(|(k, spot)| {
                    let worn = Worn {
                        path: 0.0,
                        bonded: spot.double.is_none(),
                    };
                    Worked {
                        crack,
                        length: spot.length,
                        worn,
                        before: worn,
                        pressed_before: 0.0,
                        contact: first + k,
                        double: spot.double.map(|place| first + place),
                        pressed: 0.0,
                        speed: 0.0,
                        slipped: false,
                        bears: Strength::default(),
                        bond: [0.0; 2],
                        slope: 0.0,
                        steady: false,
                    }
                }));
            }
            first += spots.len();
        }
        Some(Laws {
            of_cracks: dam.cracks.iter().map(|line| line.law.clone()).collect(),
            contacts,
            sums: vec![[0.0; 2]; dam.cracks.len()],
            passes: 0,
            careful: false,
        })
    }

    /// Begin where the contacts of a dam at rest are, with the forces that press them.
    pub(super) fn begin_at(&mut self, still: &[Worked], forces: &[f64]) {
        let m = forces.len() / 2;
        for (worked, still) in self.contacts.iter_mut().zip(still) {
            let pressed = forces[m + worked.contact];
            (worked.worn, worked.before) = (still.worn, still.worn);
            (worked.pressed, worked.pressed_before) = (pressed, pressed);
        }
        for worked in &mut self.contacts {
            worked.look(&self.of_cracks, 0.0);
        }
        self.add_up();
    }

    /// Book a step: what the contacts have slipped, and which of them have opened.
    pub(super) fn book(&mut self, status: &[Status], u: &[f64], before: &[f64], step: TimeStep) {
        for worked in &mut self.contacts {
            let k = worked.contact;
            let moved = worked.way(status[k], u[k], before[k], step);
            worked.look(&self.of_cracks, moved);
            self.sums[worked.crack][0] += worked.bond[1] * moved;
            worked.worn.path += moved;
            worked.worn.bonded &= status[k].closed();
            worked.slipped = status[k].slips();
        }
        for k in 0..self.contacts.len() {
            let Worked { contact, double, .. } = self.contacts[k];
            if let (Some(double), Status::Absent) = (double, status[contact]) {
                let other = self.contacts.iter().find(|other| other.contact == double);
                let there = other.map_or(0.0, |other| other.worn.path);
                // What it has been through itself, before it left the other face, stays.
                self.contacts[k].worn.path = self.contacts[k].worn.path.max(there);
            }
        }
        self.add_up();
    }

    /// Add up what each crack bears now.
    fn add_up(&mut self) {
        self.sums.iter_mut().for_each(|sums| sums[1] = 0.0);
        for worked in self.contacts.iter().filter(|worked| worked.pressed > 0.0) {
            self.sums[worked.crack][1] += worked.borne(usize::from(worked.slipped));
        }
    }

    /// Mean path that a crack has slipped since the start (m).
    pub(super) fn path(&self, crack: usize) -> f64 {
        let own = || {
            self.contacts
                .iter()
                .filter(|w| w.crack == crack && w.double.is_none())
        };
        let length: f64 = own().map(|w| w.length).sum();
        own()
            .map(|w| w.length * (w.worn.path - w.before.path))
            .sum::<f64>()
            / length.max(f64::MIN_POSITIVE)
    }
}

impl Worked {
    /// Way that it slips in a step; one that goes on sticking has none, whatever rounding says.
    fn way(&self, status: Status, u: f64, before: f64, step: TimeStep) -> f64 {
        if status.slips() || (self.slipped && status.closed()) {
            step.dt * (step.theta * u + (1.0 - step.theta) * before).abs()
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
    fn look(&mut self, laws: &[Option<Law>], moved: f64) {
        if let Some(law) = &laws[self.crack] {
            let worn = self.midway(moved);
            self.bears = law.strength(self.length, self.pressed, self.speed, worn);
            self.bond = law.bond(worn).map(|bond| self.length * bond);
        }
    }

    /// What it bears under the force that presses it, at rest (0) or sliding (1).
    fn borne(&self, slides: usize) -> f64 {
        self.bears.coefficient[slides] * self.pressed + self.bears.constant[slides]
    }
}
