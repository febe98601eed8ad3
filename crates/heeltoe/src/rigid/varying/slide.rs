//! A slide by a law that is a straight line over the path: exact, there is no step size.
//!
//! Where friction falls linearly with the path r since the start, or not at all, and the ground's acceleration is linear
//! in time, so is the slip's, `r'' = p + q t + k r`, and every force: [`Curve`]. The next event is the earliest root of the
//! slip velocity, a normal force, and the way that is left up to a corner of the law.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::choice::VIOLATION;
use super::super::mode::Mode;
use super::super::walk::Cause;
use super::advance::Trial;
use super::curve::{holds, Curve};
use super::shaking::Piece;
use super::step::State;
use super::walk::Varying;

/// A force that is `start + per_time t + per_path r`.
#[derive(Clone, Copy)]
struct Force {
    start: f64,
    per_time: f64,
    per_path: f64,
}

/// A slide on both corners from a state on.
pub(super) struct Slide {
    /// Sign of the slip velocity.
    way: f64,
    /// Path from here.
    path: Curve,
    /// Path up to the next corner of the law, from here and since the first slip.
    reach: f64,
    corner: f64,
    /// How long all this holds, corner or no.
    length: f64,
    /// Friction, and the normal forces at heel and toe.
    reactions: [Force; 3],
    /// What the loads push along the crack.
    load: Force,
}

/// Forces and acceleration along the crack at one moment.
type Felt = [f64; 5];

impl Varying<'_> {
    /// The slide from the present state on, if it has a closed form; a slip that starts does so with the acceleration of
    /// `fresh`, freed from rounding.
    pub(super) fn closed_slide(&self, piece: &Piece, fresh: Option<Vector>) -> Option<Slide> {
        let Mode::Slide(slip) = self.walk.mode else {
            return None;
        };
        if self.rough.is_some() {
            return None;
        }
        let rubbing = self.rubbing.as_ref()?;
        let [across, up, spin] = piece.rate;
        let even = spin == 0.0 && self.walk.block.presses_evenly([across, up]);
        if !rubbing.straight(even) || !self.turning.anchors.is_empty() || self.state[2] != 0.0 {
            return None;
        }
        let (way, left) = (slip.sign(), piece.left);
        let corner = rubbing.corner();
        let reach = corner - rubbing.worn.path;
        let mut further = self.state;
        further[0] += way * reach;
        let now = self.felt_sliding(&self.state, piece, 0.0)?;
        let then = self.felt_sliding(&self.state, piece, left)?;
        let there = if reach.is_finite() {
            self.felt_sliding(&further, piece, 0.0)?
        } else {
            now
        };
        let force = |i: usize| Force {
            start: now[i],
            per_time: (then[i] - now[i]) / left,
            per_path: (there[i] - now[i]) / reach,
        };
        let pull = force(4);
        let growth = way * pull.per_path;
        if growth < 0.0 || left <= 0.0 {
            return None;
        }
        let speed = way * self.state[3];
        let begins = fresh.filter(|_| speed == 0.0).map(|all| all[SLIP]);
        let (p, q) = (way * begins.unwrap_or(pull.start), way * pull.per_time);
        Some(Slide {
            way,
            path: Curve {
                growth,
                terms: [0.0, speed, p, q + growth * speed],
            },
            reach,
            corner,
            length: left.min(holds(growth)),
            reactions: [SLIP, HEEL, TOE].map(force),
            load: force(3),
        })
    }

    /// Reactions, the load along the crack and the acceleration, sliding at a state of the present step.
    fn felt_sliding(&self, state: &State, piece: &Piece, since: f64) -> Option<Felt> {
        let instant = self.turning.at(self.corner, state, &piece.after(since));
        let (reactions, _) = self.rubbed(self.walk.mode, state, &instant)?;
        let [friction, heel, toe] = reactions;
        let [acceleration, ..] = instant.acceleration(&reactions);
        Some([friction, heel, toe, instant.pushed(), acceleration])
    }

    /// Slide on to the next event, or as long as that holds; returns the time that took and what ended it.
    pub(super) fn slide_on(&mut self, slide: &Slide, piece: &Piece, time: f64) -> (f64, Option<Cause>) {
        let (at, cause) = self.first_of_slide(slide);
        let turns_corner = cause.is_none() && at < slide.length;
        let mut end = slide.state(&self.state, at);
        if cause == Some(Cause::Stop) {
            end[3] = 0.0;
        }
        let trial = Trial::still(self.state, [0.0; 8], slide.length, piece);
        self.move_on(&trial, &end, at, time);
        if turns_corner {
            self.turn_corner(slide.corner);
        }
        (at, cause)
    }

    /// When the slide ends, and what ends it before its time.
    fn first_of_slide(&self, slide: &Slide) -> (f64, Option<Cause>) {
        let Slide {
            path,
            reach,
            length,
            reactions,
            ..
        } = slide;
        let mut first = (*length, None);
        let mut note = |t: Option<f64>, why: Option<Cause>| {
            if let Some(t) = t.filter(|t| *t < first.0 || *t == first.0 && first.1.is_none()) {
                first = (t, why);
            }
        };
        if reach.is_finite() {
            note(path.affine(*reach, 0.0, -1.0).first_fall(*length, 0.0), None);
        }
        note(path.derivative().first_fall(*length, 0.0), Some(Cause::Stop));
        for Force {
            start,
            per_time,
            per_path,
        } in &reactions[HEEL..]
        {
            let size = self.walk.block.force_scale.max(start.abs());
            let normal = path.affine(*start, *per_time, *per_path);
            note(normal.first_fall(*length, VIOLATION * size), Some(Cause::Normal));
        }
        first
    }
}

impl Slide {
    /// The state after `since` from `start`, with the works of the loads and of friction.
    pub(super) fn state(&self, start: &State, since: f64) -> State {
        let path = self.path.at(since);
        // The integral of t dr is t r less that of r.
        let turned = since * path - self.path.sum(since);
        let work = |force: &Force| {
            self.way * (path * (force.start + 0.5 * force.per_path * path) + force.per_time * turned)
        };
        let mut state = *start;
        state[0] += self.way * path;
        state[3] = self.way * self.path.derivative().at(since);
        state[6] += work(&self.load);
        state[7] += work(&self.reactions[SLIP]);
        state
    }
}
