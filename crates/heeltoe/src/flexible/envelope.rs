//! The largest principal stresses of a part over a run, place by place.
//!
//! A stress is linear in the modes, `(xx, zz, xz) = rows q`. States are gathered until there are [`BLOCK`] of them, so that
//! the rows, which are far larger than anything a step reads, are read once for all of these; nothing else is kept. The
//! pressure `p` of water with sound is the stress `(p, p, 0)` by the velocities of its modes.

use super::simd::{apart, Group, Lanes, Plain, LANES};
use crate::error::Error;
use crate::table::columns;

/// Groups of states, and states, that are worked on at once.
const GROUPS: usize = 2;
const BLOCK: usize = GROUPS * LANES;

/// Stresses at the places of a part by its modes.
#[derive(Clone, Copy, Debug)]
pub struct Stresses<'a> {
    rows: &'a [[f64; 3]],
    modes: usize,
}

impl<'a> Stresses<'a> {
    /// `rows` has normal stresses in x and z and the shear stress of one mode after the other, place by place.
    ///
    /// # Errors
    /// Where these are not as many for each place.
    pub fn new(rows: &'a [[f64; 3]], modes: usize) -> Result<Self, Error> {
        if modes == 0 || !rows.len().is_multiple_of(modes) {
            return Err(Error::Body("each place needs a stress for each mode"));
        }
        Ok(Stresses { rows, modes })
    }
}

/// What the stresses of a run are wanted of.
#[derive(Clone, Copy, Debug)]
pub struct Stressed<'a> {
    /// Those of all parts, from the crest down.
    pub parts: &'a [Stresses<'a>],
    /// Steps from one state that is looked at to the next.
    pub stride: usize,
}

/// The extremes of the principal stresses in the plane at one place; tension is positive.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    /// Largest principal stress (Pa), when (s), and the stress in x, z and shear then.
    tension: f64,
    at: f64,
    stress: [f64; 3],
    /// Least principal stress, and when.
    compression: f64,
    compressed_at: f64,
}

columns!(Extreme, of => {
    "tension": of.tension,
    "tension_time": of.at,
    "xx": of.stress[0],
    "zz": of.stress[1],
    "xz": of.stress[2],
    "compression": of.compression,
    "compression_time": of.compressed_at,
});

impl Extreme {
    const NOTHING: Self = Extreme {
        tension: f64::NEG_INFINITY,
        at: 0.0,
        stress: [0.0; 3],
        compression: f64::INFINITY,
        compressed_at: 0.0,
    };

    /// Take the stresses (xx, zz, xz) of some moments into account.
    #[inline(always)]
    fn meet(&mut self, stress: &[[Group; GROUPS]; 3], moments: &[f64]) {
        let [xx, zz, xz] = [0, 1, 2].map(|c| stress[c].as_flattened());
        let (mut major, mut minor) = ([0.0; BLOCK], [0.0; BLOCK]);
        for k in 0..BLOCK {
            let (centre, half) = (0.5 * (xx[k] + zz[k]), 0.5 * (xx[k] - zz[k]));
            let radius = (half * half + xz[k] * xz[k]).sqrt();
            major[k] = centre + radius;
            minor[k] = centre - radius;
        }
        for (k, moment) in moments.iter().enumerate() {
            if major[k] > self.tension {
                self.tension = major[k];
                self.at = *moment;
                self.stress = [xx[k], zz[k], xz[k]];
            }
            if minor[k] < self.compression {
                self.compression = minor[k];
                self.compressed_at = *moment;
            }
        }
    }
}

/// The envelope of all parts under way.
pub(super) struct Envelope<'a> {
    wanted: Stressed<'a>,
    extremes: Vec<Vec<Extreme>>,
    /// States that are not yet looked at: mode by mode the amplitudes at all moments.
    states: Vec<Vec<[Group; GROUPS]>>,
    moments: Vec<f64>,
}

impl<'a> Envelope<'a> {
    pub(super) fn new(wanted: Stressed<'a>) -> Self {
        let places = |of: &Stresses| vec![Extreme::NOTHING; of.rows.len() / of.modes];
        let states = |of: &Stresses| vec![[[0.0; LANES]; GROUPS]; of.modes];
        Envelope {
            extremes: wanted.parts.iter().map(places).collect(),
            states: wanted.parts.iter().map(states).collect(),
            moments: Vec::with_capacity(BLOCK),
            wanted,
        }
    }

    /// Whether the state after this step is one to look at.
    #[inline(always)]
    pub(super) fn due(&self, step: usize) -> bool {
        (step + 1).is_multiple_of(self.wanted.stride)
    }

    /// Take a state into account.
    pub(super) fn add<W: Lanes>(&mut self, moment: f64, modes: &[Vec<Group>]) {
        let place = self.moments.len();
        for (states, modes) in self.states.iter_mut().zip(modes) {
            for (state, amplitude) in states.iter_mut().zip(modes.as_flattened()) {
                state[place / LANES][place % LANES] = *amplitude;
            }
        }
        self.moments.push(moment);
        if self.moments.len() == BLOCK {
            look::<W>(self);
        }
    }

    /// What [`look`] does.
    #[inline(always)]
    fn meet_all<W: Lanes>(&mut self) {
        let parts = self.extremes.iter_mut().zip(self.states.iter());
        for ((extremes, states), of) in parts.zip(self.wanted.parts) {
            for (extreme, rows) in extremes.iter_mut().zip(of.rows.chunks_exact(of.modes)) {
                extreme.meet(&product::<W>(rows, states), &self.moments);
            }
        }
        self.moments.clear();
    }

    /// Hand over the extremes of all places.
    pub(super) fn end(mut self) -> Vec<Vec<Extreme>> {
        if !self.moments.is_empty() {
            look::<Plain>(&mut self);
        }
        self.extremes
    }
}

apart! {
    /// Look at the states gathered.
    fn look(envelope: &mut Envelope<'_>) -> () = Envelope::meet_all;
}

/// The stresses at one place in all states.
#[inline(always)]
fn product<W: Lanes>(rows: &[[f64; 3]], states: &[[Group; GROUPS]]) -> [[Group; GROUPS]; 3] {
    let mut sums = [[W::all(0.0); GROUPS]; 3];
    for (row, state) in rows.iter().zip(states) {
        let state: [W; GROUPS] = [W::load(&state[0]), W::load(&state[1])];
        for c in 0..3 {
            let factor = W::all(row[c]);
            for g in 0..GROUPS {
                sums[c][g] = factor.fma(state[g], sums[c][g]);
            }
        }
    }
    let mut stress = [[[0.0; LANES]; GROUPS]; 3];
    for c in 0..3 {
        for g in 0..GROUPS {
            sums[c][g].store(&mut stress[c][g]);
        }
    }
    stress
}
