//! A slide on both corners by any law, on one piece of the record: by the same steps as every other motion, but with the
//! little that such a slide needs.
//!
//! A block that lies on both corners has one way to go. Under a friction force F against the slip, its acceleration and
//! both normal forces are affine in the ground's acceleration and in F, and `F = mu N + c` by the law.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::event;
use super::advance::{better, Trial, SHORTEST};
use super::shaking::{Ground, Piece};
use super::step::{middle, step, State};
use super::walk::Varying;
use crate::friction::Strength;

/// Normal forces at heel and toe, the load along the crack, and the acceleration.
type Felt = [f64; 4];

/// What is felt in a ground at rest without friction, and what each unit of the ground's acceleration and of friction adds.
#[derive(Clone, Copy)]
pub(super) struct Flat {
    still: Felt,
    per_ground: [Felt; 3],
    per_friction: Felt,
    way: f64,
}

impl Varying<'_> {
    /// Make one step on a piece, if nothing ends the slide in it, and return how long it is; none where something may. Its
    /// works stay in the state.
    pub(super) fn step_through(
        &mut self,
        flat: &mut Option<Flat>,
        way: f64,
        piece: &Piece,
        clear: f64,
        time: f64,
    ) -> Option<f64> {
        if !self.lies_plainly() || self.rubbing.as_ref()?.corner().is_finite() {
            return None;
        }
        let flat = match flat {
            Some(flat) => flat,
            None => flat.insert(self.flat(way)?),
        };
        let start = self.state;
        let (first, felt) = self.flat_rates(flat, &start, &piece.ground)?;
        let mut length = piece.left.min(self.suggested);
        let taken = loop {
            let mut jams = false;
            let mut rates = |t: f64, y: &State| {
                let there = self.flat_rates(flat, y, &piece.after(t));
                jams |= there.is_none();
                there.map_or([0.0; 8], |(rate, _)| rate)
            };
            let taken = step(&start, &first, length, &self.scale, &mut rates);
            if jams || !taken.error.is_finite() || length <= SHORTEST * self.time_scale {
                return None;
            }
            if taken.error <= 1.0 {
                break taken;
            }
            length *= better(taken.error).clamp(0.1, 0.9);
        };
        let between = middle([&start, &taken.end], [&first, &taken.rate], length);
        let (_, felt_between) = self.flat_rates(flat, &between, &piece.after(0.5 * length))?;
        let (_, felt_at_end) = self.flat_rates(flat, &taken.end, &piece.after(length))?;
        let pressed = [felt, felt_between, felt_at_end]
            .iter()
            .all(|[heel, toe, ..]| *heel > clear && *toe > clear);
        let (v0, v1, a0) = (flat.way * start[3], flat.way * taken.end[3], flat.way * first[3]);
        let bend = (v1 - v0 - a0 * length) / (length * length);
        if !pressed || event::quadratic(v0, a0, bend, length).is_some() {
            return None;
        }
        let trial = Trial {
            error: taken.error,
            integrated: true,
            ..Trial::still(start, first, length, piece)
        };
        self.record(&start, piece, time + length, time);
        self.wear(&taken.end);
        self.gather_error(&trial, false, length);
        self.suggest(length, taken.error);
        self.state = taken.end;
        Some(length)
    }

    /// What is felt as the block slides this way; none where friction makes it infinite.
    fn flat(&self, way: f64) -> Option<Flat> {
        let felt = |ground: &Ground, friction: f64| -> Option<Felt> {
            let instant = self.turning.at(self.corner, &self.state, ground);
            let strength = Strength {
                constant: [friction; 2],
                ..Strength::default()
            };
            let reactions = super::friction::under(&strength, self.walk.mode, &instant)?;
            let [acceleration, ..] = instant.acceleration(&reactions);
            Some([reactions[HEEL], reactions[TOE], instant.pushed(), acceleration])
        };
        let still = felt(&[0.0; 3], 0.0)?;
        let change = |felt: Felt| -> Felt { std::array::from_fn(|i| felt[i] - still[i]) };
        // A force of the size of those at hand, so that rounding is small beside it.
        let force = self.walk.block.force_scale;
        Some(Flat {
            still,
            per_ground: [
                change(felt(&[1.0, 0.0, 0.0], 0.0)?),
                change(felt(&[0.0, 1.0, 0.0], 0.0)?),
                change(felt(&[0.0, 0.0, 1.0], 0.0)?),
            ],
            per_friction: change(felt(&[0.0; 3], force)?).map(|change| change / force),
            way,
        })
    }

    /// [`Varying::rates`] at a state of such a slide, and what is felt there; none where friction makes it infinite.
    fn flat_rates(&self, flat: &Flat, state: &State, ground: &Ground) -> Option<(State, Felt)> {
        let mut felt = flat.still;
        for (per, ground) in flat.per_ground.iter().zip(ground) {
            for (value, per) in felt.iter_mut().zip(per) {
                *value += per * ground;
            }
        }
        let pressing = felt[0] + felt[1];
        let per_friction = flat.per_friction[0] + flat.per_friction[1];
        let friction = self.friction_at(state, pressing, per_friction)?;
        for (value, per) in felt.iter_mut().zip(flat.per_friction) {
            *value += per * friction;
        }
        let [.., load, acceleration] = felt;
        let mut rate = [0.0; 8];
        rate[SLIP] = state[3];
        rate[3] = acceleration;
        rate[6] = load * state[3];
        rate[7] = -flat.way * friction * state[3];
        Some((rate, felt))
    }
}
