//! The power series of a slide on its way: `M u' = F - T e`, `e = u / |u|`, F and T linear in time.
//!
//! Order by order, with `s = |u|`: `s^2 = u . u`, `e s = u`, `(k + 1) M u_(k+1) = F_k - (T e)_k`.

use super::flight::{value, Flight, Terms, TERMS};

/// Order of the series.
pub(super) const ORDER: usize = 14;
/// Error of a velocity in one step (m/s).
pub(super) const ERROR: f64 = 1e-14;
/// Part of the speed, in its first direction, that a step keeps: the friction of a block that all but turns back
/// changes its sign in a moment of which the terms of the series say nothing.
const KEPT: f64 = 0.1;
/// Factor on a step that fails its bound.
const SHORTER: f64 = 0.6;

/// Forces per mass across the valley: on a piece, each as its value and its change per second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Forces {
    /// Mass along the stream over that across the valley.
    pub mass: f64,
    /// Without friction, along and across (m/s2).
    pub push: [[f64; 2]; 2],
    /// Largest friction of a block that slides (m/s2).
    pub rub: [f64; 2],
    /// Bound of a block at rest (m/s2).
    pub hold: [f64; 2],
}

impl Forces {
    /// The same from `t` seconds later on.
    pub(super) fn after(&self, t: f64) -> Self {
        let later = |[value, slope]: [f64; 2]| [value + slope * t, slope];
        Forces {
            push: self.push.map(later),
            rub: later(self.rub),
            hold: later(self.hold),
            ..*self
        }
    }
}

/// How a block goes on that moves with the velocity `u`, for `left` seconds at most.
pub(super) fn go_on(forces: &Forces, u: [f64; 2], left: f64) -> Flight {
    let mass = [forces.mass, 1.0];
    let mut velocity = [[0.0; TERMS]; 2];
    let mut direction = [[0.0; ORDER]; 2];
    let mut speed = [0.0; TERMS];
    let first = u[0].hypot(u[1]);
    for i in 0..2 {
        velocity[i][0] = u[i];
        direction[i][0] = u[i] / first;
    }
    speed[0] = first;
    let [rub, rub_slope] = forces.rub;
    for k in 0..=ORDER {
        if k > 0 {
            let mut square = 0.0;
            for j in 0..=k {
                square += velocity[0][j] * velocity[0][k - j] + velocity[1][j] * velocity[1][k - j];
            }
            for j in 1..k {
                square -= speed[j] * speed[k - j];
            }
            speed[k] = square / (2.0 * first);
        }
        if k == ORDER {
            break;
        }
        for i in 0..2 {
            if k > 0 {
                let mut e = velocity[i][k];
                for j in 1..=k {
                    e -= speed[j] * direction[i][k - j];
                }
                direction[i][k] = e / first;
            }
            let mut force = -rub * direction[i][k];
            if k > 0 {
                force -= rub_slope * direction[i][k - 1];
            }
            if k < 2 {
                force += forces.push[i][k];
            }
            velocity[i][k + 1] = force / (mass[i] * (k + 1) as f64);
        }
    }
    let mut length = reach(&velocity, &speed, ORDER, left);
    let kept = |t: f64| u[0] * value(&velocity[0], t) + u[1] * value(&velocity[1], t);
    while kept(length) < KEPT * first * first {
        length *= SHORTER;
    }
    Flight {
        begin: 0.0,
        length,
        velocity,
        speed,
    }
}

/// How far the last two terms of the series allow to go, `left` at most.
pub(super) fn reach(velocity: &[Terms; 2], speed: &Terms, last: usize, left: f64) -> f64 {
    let mut length = left;
    for k in [last - 1, last] {
        let term = velocity[0][k].abs().max(velocity[1][k].abs()).max(speed[k].abs());
        if term > 0.0 {
            length = length.min((ERROR / term).powf(1.0 / k as f64));
        }
    }
    length
}
