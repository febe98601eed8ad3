//! Cracks whose friction goes by a law: what each contact has been through, and what it bears.
//!
//! A contact with the share `a` of its crack's length, which the force `N` presses, bears
//!
//! ```text
//! S = a tau(N / a, d, v)
//! ```
//!
//! with `tau` of [`crate::friction::Law`], the path `d` that this very contact has slipped and its speed `v`, both of the
//! vector in the plane of the crack where the ground moves across the valley, too. `N` and `d`
//! are those of the step itself, `d` in the middle of its way: they are found by passes, see [`passes`]. The speed is
//! that with which the step begins. So what friction takes in a step is the work under its curve, and but for the speed
//! the law adds no error of the step's first order to that of the scheme.
//!
//! A contact that opens, or has left the other face, has broken its bond. One that is watched in place of the end of the
//! other face, and was not there before, has been through what that end has.

mod passes;
pub(super) mod sideways;
pub(super) mod spots;
pub(super) mod worked;

use self::spots::spots;
use self::worked::Worked;
use super::contact::Contacts;
use super::dam::Dam;
use super::status::Status;
use crate::friction::{Law, Strength, Worn};

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
    /// Contacts of which the line sliding has turned.
    turned: Vec<bool>,
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
                        moved: 0.0,
                        bears: Strength::default(),
                        bond: [0.0; 2],
                        settled: false,
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
            turned: vec![false; first],
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
            worked.settled = false;
            worked.look(&self.of_cracks, 0.0);
        }
        self.add_up();
    }

    /// Book a step: what the contacts have slipped, and which of them have opened.
    fn book(&mut self, status: &[Status]) {
        for worked in &mut self.contacts {
            let k = worked.contact;
            self.sums[worked.crack][0] += worked.bond[1] * worked.moved;
            worked.worn.path += worked.moved;
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
