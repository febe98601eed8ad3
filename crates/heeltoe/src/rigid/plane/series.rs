//! The power series of a slide on its way: `M u' = F - T e`, `e = u / |u|`, F and T linear in time.
//!
//! Order by order, with `s = |u|`: `s' = u' . e`, `e s = u`, `(k + 1) M u_(k+1) = F_k - (T e)_k`.

use super::flight::{value, Flight, Terms, INVERSE};
use super::polynomial::TERMS;
use super::rub::Rubbing;

/// Order of the series.
pub(super) const ORDER: usize = TERMS - 1;
/// Largest last term of a momentum, per mass, in one step (m/s).
const ERROR: f64 = 1e-13;
/// Largest effect of the last term of a velocity that friction takes away at once on where the block goes (m).
const WAY: f64 = 1e-14;
/// Both are as much smaller as a block has not yet gone so fast (m/s) and so far (m), so that its books close, but for
/// the smallest of factors.
const FAST: f64 = 0.1;
const FAR: f64 = 0.01;
const LEAST: f64 = 1e-6;
/// Part of the speed, in its first direction, that a step keeps: the friction of a block that all but turns back
/// changes its sign in a moment of which the terms of the series say nothing.
pub(super) const KEPT: f64 = 0.1;
/// Factor on a step that fails its bound.
pub(super) const SHORTER: f64 = 0.6;

/// Forces per mass across the valley: on a piece, each as its value and its change per second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forces<'a> {
    /// Mass along the stream over that across the valley.
    pub mass: f64,
    /// Without friction, along and across (m/s2).
    pub push: [[f64; 2]; 2],
    /// Largest friction of a block that slides (m/s2); by a law, at its present speed and path.
    pub rub: [f64; 2],
    /// No less than that at any speed and path.
    pub most: [f64; 2],
    /// The law of friction, where it goes by one.
    pub law: Option<Rubbing<'a>>,
    /// Bound of a block at rest (m/s2).
    pub hold: [f64; 2],
}

/// Bounds of the last terms of a step: of what lasts (m/s), of the way of what passes (m).
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub error: f64,
    pub way: f64,
}

impl Bounds {
    /// Those of a block that has gone so fast and so far.
    pub(super) fn new(speed: f64, path: f64) -> Self {
        Bounds {
            error: ERROR * (speed / FAST).clamp(LEAST, 1.0),
            way: WAY * (path / FAR).clamp(LEAST, 1.0),
        }
    }
}

impl Forces<'_> {
    /// The same from `t` seconds later on.
    #[inline]
    pub(super) fn after(&self, t: f64) -> Self {
        let later = |[value, slope]: [f64; 2]| [value + slope * t, slope];
        Forces {
            push: self.push.map(later),
            rub: later(self.rub),
            hold: later(self.hold),
            most: later(self.most),
            law: self.law.map(|law| law.after(t)),
            ..*self
        }
    }

    /// Largest acceleration along and across in the next `t` seconds, without its sign.
    #[inline]
    pub(super) fn fastest(&self, t: f64) -> [f64; 2] {
        let most = |[value, slope]: [f64; 2]| value.abs().max((value + slope * t).abs());
        let rub = most(self.most);
        [(most(self.push[0]) + rub) / self.mass, most(self.push[1]) + rub]
    }

    /// How long a block of this speed goes on at most before friction stops it; none where it may not do so at once, or
    /// not in `left` seconds.
    pub(super) fn stops_within(&self, speed: f64, left: f64) -> Option<f64> {
        if self.law.is_some() {
            return None;
        }
        let [[fx, jx], [fy, jy]] = self.push;
        let [rub, rub_slope] = self.rub;
        // The excess of friction over the force falls no faster than this; sqrt(u . M u) falls by it, over the mass.
        let spare = rub - (fx * fx + fy * fy).sqrt();
        if spare <= 0.0 {
            return None;
        }
        let time = 2.0 * speed * self.mass.max(1.0) / spare;
        let falls = jx.abs() + jy.abs() + rub_slope.abs();
        (time < left && falls * time < 0.5 * spare).then_some(time)
    }
}

/// How a block goes on that moves with the velocity `u`, for `left` seconds at most. It stops in no more than `stops`
/// seconds where that is given.
pub(super) fn go_on(forces: &Forces, u: [f64; 2], left: f64, stops: Option<f64>, bounds: Bounds) -> Flight {
    let per = [1.0 / forces.mass, 1.0];
    let first = (u[0] * u[0] + u[1] * u[1]).sqrt();
    let inverse = 1.0 / first;
    let mut terms: Terms = [[0.0; 3]; TERMS];
    terms[0] = [u[0], u[1], first];
    let mut direction = [[0.0; 2]; TERMS];
    direction[0] = u.map(|u| u * inverse);
    let d0 = direction[0];
    // k u_k.
    let mut growth = [[0.0; 2]; TERMS];
    let [rub, rub_slope] = forces.rub;
    let mut by_law = forces.law.and_then(|law| law.unfold(first));
    for k in 0..TERMS {
        if k > 0 {
            // Two sums each, which end with what is known last: an addition waits for the one before.
            let mut longer = [[0.0; 2]; 2];
            let mut turned = [[0.0; 2]; 2];
            let mut add = |half: usize, j: usize| {
                let d = direction[k - j];
                for i in 0..2 {
                    longer[half][i] += growth[j][i] * d[i];
                    turned[half][i] += terms[j][2] * d[i];
                }
            };
            for j in 0..k / 2 {
                add(0, k / 2 - j);
            }
            for j in k / 2 + 1..k {
                add(1, j);
            }
            let along = |i: usize| longer[0][i] + longer[1][i] + growth[k][i] * d0[i];
            let speed = (along(0) + along(1)) * INVERSE[k];
            terms[k][2] = speed;
            for i in 0..2 {
                direction[k][i] = (terms[k][i] - speed * d0[i] - turned[0][i] - turned[1][i]) * inverse;
            }
        }
        if let Some(law) = &mut by_law {
            law.next(k, terms[k][2]);
        }
        if k == ORDER {
            break;
        }
        for i in 0..2 {
            let mut force = if let Some(law) = &by_law {
                -law.times(k, d0[i], |j| direction[j][i])
            } else if k > 0 {
                -rub * direction[k][i] - rub_slope * direction[k - 1][i]
            } else {
                -rub * direction[k][i]
            };
            if k < 2 {
                force += forces.push[i][k];
            }
            growth[k + 1][i] = force * per[i];
            terms[k + 1][i] = growth[k + 1][i] * INVERSE[k + 1];
        }
    }
    // Friction turns the velocity back to where the force has it at the rate T / (m s). What a step errs by in M u across
    // that direction lasts no longer; so does all of it where the block is about to stop.
    let Bounds { error, way } = bounds;
    let lasting = stops.map_or(error, |time| error.max((way / time).min(KEPT * first)));
    let passing = (way * rub * inverse / forces.mass.max(1.0))
        .min((first * error).sqrt())
        .max(lasting);
    let [c, s] = d0;
    let whole = forces.mass * c * c + s * s;
    let errors = |term: &[f64; 3]| {
        let lasts = (forces.mass * c * term[0] + s * term[1]).abs() / whole;
        let passes = (c * term[1] - s * term[0]).abs();
        (lasts / lasting).max(passes / passing)
    };
    let mut length = reach(&terms, ORDER, errors, left);
    let mut end = value(&terms, length);
    while u[0] * end[0] + u[1] * end[1] < KEPT * first * first {
        length *= SHORTER;
        end = value(&terms, length);
    }
    Flight {
        begin: 0.0,
        length,
        terms,
        friction: by_law.map(|law| law.terms),
    }
}

/// How far the last two terms of the series allow to go, `left` at most; `errors` says how many times its bound a term is.
pub(super) fn reach(terms: &Terms, last: usize, errors: impl Fn(&[f64; 3]) -> f64, left: f64) -> f64 {
    let shortest = [last - 1, last]
        .into_iter()
        .map(|k| -errors(&terms[k]).ln() * INVERSE[k])
        .fold(f64::INFINITY, f64::min);
    left.min(shortest.exp())
}
