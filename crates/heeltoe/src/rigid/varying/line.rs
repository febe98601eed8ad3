//! A slide on both corners whose forces are straight lines over the path and the ground's acceleration, see
//! [`super::slide`]: `r'' = p + q t + k r`.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::event;
use super::curve::{holds, Curve};
use super::shaking::{Ground, Piece};
use super::step::State;

/// What is well beyond rounding, as a part of the forces at hand, or of a path.
pub(super) const CLEAR: f64 = 1e-9;

/// A force that is `start + per_time t + per_path r`.
#[derive(Clone, Copy)]
pub(super) struct Force {
    pub start: f64,
    pub per_time: f64,
    pub per_path: f64,
}

/// A slide on both corners from a state on.
pub(super) struct Slide {
    /// Sign of the slip velocity.
    pub way: f64,
    /// Path from here.
    pub path: Curve,
    /// Path up to the next corner of the law, from here and since the first slip.
    pub reach: f64,
    pub corner: f64,
    /// How long all this holds, corner or no.
    pub length: f64,
    /// Friction, and the normal forces at heel and toe.
    pub reactions: [Force; 3],
    /// What the loads push along the crack.
    pub load: Force,
}

/// Forces and acceleration along the crack at one moment.
pub(super) type Felt = [f64; 5];

/// What is felt as the block slides one way on both corners, up to the next corner of the law: affine in the ground's
/// acceleration and in the path.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// In a ground at rest, at this path since the first slip.
    pub still: Felt,
    pub path: f64,
    /// What each unit of the ground's acceleration adds, and each of the path.
    pub per_ground: [Felt; 3],
    pub per_path: Felt,
    /// Up to here, since the first slip.
    pub corner: f64,
    /// Whether the bond is whole.
    pub bonded: bool,
    /// The vertical and the turning ground that it is for; none where it is for all.
    pub ground: Option<[f64; 2]>,
}

/// Normal forces at heel and toe, the load along the crack, and the acceleration, beside friction.
pub(super) type Bare = [f64; 4];

/// What is felt in a ground at rest without friction, and what each unit of the ground's acceleration and of friction adds,
/// see [`super::flat`].
#[derive(Clone, Copy)]
pub(super) struct Flat {
    pub still: Bare,
    pub per_ground: [Bare; 3],
    pub per_friction: Bare,
}

impl Line {
    /// The slide from a path on at a speed, on a piece of the record; a slip that starts does so with the acceleration
    /// that it `begins` with. None where friction would grow with the path.
    pub(super) fn slide(
        &self,
        way: f64,
        path: f64,
        speed: f64,
        begins: Option<f64>,
        piece: &Piece,
    ) -> Option<Slide> {
        let force = |i: usize| {
            let by = |ground: &Ground| -> f64 { (0..3).map(|k| self.per_ground[k][i] * ground[k]).sum() };
            Force {
                start: self.still[i] + by(&piece.ground) + self.per_path[i] * (path - self.path),
                per_time: by(&piece.rate),
                per_path: self.per_path[i],
            }
        };
        let pull = force(4);
        let growth = way * pull.per_path;
        if growth < 0.0 || piece.left <= 0.0 {
            return None;
        }
        let (p, q) = (way * begins.unwrap_or(pull.start), way * pull.per_time);
        Some(Slide {
            way,
            path: Curve {
                growth,
                terms: [0.0, speed, p, q + growth * speed],
            },
            reach: self.corner - path,
            corner: self.corner,
            length: piece.left.min(holds(growth)),
            reactions: [SLIP, HEEL, TOE].map(force),
            load: force(3),
        })
    }
}

impl Slide {
    /// Whether it goes on to the end of a piece, whatever the rounding: the path is shorter than to the next corner of the
    /// law, the slip velocity, which grows beyond that of a constant law, does not come near zero, and no normal force does.
    pub(super) fn goes_on(&self, piece: &Piece, clear: f64) -> bool {
        let [_, speed, p, c3] = self.path.terms;
        let slope = c3 - self.path.growth * speed;
        if self.length < piece.left || !event::stays_positive(speed, p, 0.5 * slope, piece.left) {
            return false;
        }
        let path = self.path.at(piece.left);
        path < (1.0 - CLEAR) * self.reach
            && self.reactions[HEEL..].iter().all(|force| {
                let least = force.start.min(force.start + force.per_time * piece.left);
                least + (force.per_path * path).min(0.0) > clear
            })
    }

    /// The state after `since` from `start`, with the works of the loads and of friction.
    pub(super) fn state(&self, start: &State, since: f64) -> State {
        let [path, speed, sum] = self.path.with_derivative_and_integral(since);
        // The integral of t dr is t r less that of r.
        let turned = since * path - sum;
        let work = |force: &Force| {
            self.way * (path * (force.start + 0.5 * force.per_path * path) + force.per_time * turned)
        };
        let mut state = *start;
        state[0] += self.way * path;
        state[3] = self.way * speed;
        state[6] += work(&self.load);
        state[7] += work(&self.reactions[SLIP]);
        state
    }
}
