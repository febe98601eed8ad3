//! Friction by a law along a slide in the plane: its path is that of the vector of slip, and its speed the size of its
//! velocity.

use super::flight::Series;
use super::polynomial::TERMS;
use crate::friction::{Law, Strength, Terms, Unfolding, Worn};

/// A law, what the crack has been through, and what presses it together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rubbing<'a> {
    pub law: &'a Law,
    pub worn: Worn,
    /// Width of the crack (m).
    pub width: f64,
    /// Mass per which forces are counted (kg/m).
    pub mass: f64,
    /// Normal force and its change per second (N/m).
    pub normal: [f64; 2],
}

impl Rubbing<'_> {
    /// Strength of the crack at this speed.
    pub(super) fn strength(&self, normal: f64, speed: f64) -> Strength {
        self.law.strength(self.width, normal, speed, self.worn)
    }

    /// No less than what it bears at any speed and after any further path, per mass.
    pub(super) fn most(&self) -> [f64; 2] {
        let most = self.law.most();
        let [value, slope] = self.normal.map(|normal| most * normal / self.mass);
        [value + self.law.cohesion() * self.width / self.mass, slope]
    }

    /// The same from `t` seconds later on, nothing having moved.
    pub(super) fn after(self, t: f64) -> Self {
        let [value, slope] = self.normal;
        Rubbing {
            normal: [value + slope * t, slope],
            ..self
        }
    }

    /// The series of friction of a block that goes on with this speed.
    pub(super) fn unfold(&self, speed: f64) -> Option<Rub> {
        let stress = self.normal.map(|normal| normal / self.width);
        let bond = self.law.bond_over_path(self.worn);
        Some(Rub {
            unfolding: self.law.unfold(self.worn.path, speed, stress, 1.0)?,
            path: [0.0; crate::friction::TERMS],
            rate: [0.0; crate::friction::TERMS],
            mu: [0.0; TERMS],
            normal: self.normal.map(|normal| normal / self.mass),
            bond: bond.map(|stress| stress * self.width / self.mass),
            terms: [0.0; TERMS],
        })
    }
}

/// Friction per mass as a power series in time, whose terms are asked for one after the other.
pub(super) struct Rub {
    unfolding: Unfolding,
    path: Terms,
    rate: Terms,
    mu: Series,
    normal: [f64; 2],
    /// Cohesion, and how it goes by the path.
    bond: [f64; 2],
    pub terms: Series,
}

impl Rub {
    /// Term k, where that of the speed is this one.
    pub(super) fn next(&mut self, k: usize, speed: f64) -> f64 {
        self.rate[k] = speed;
        if k > 0 {
            self.path[k] = self.rate[k - 1] / k as f64;
        }
        self.mu[k] = self.unfolding.term(k, &self.path, &self.rate);
        let [now, change] = self.normal;
        let [bond, per_path] = self.bond;
        let beside = if k == 0 {
            bond
        } else {
            self.mu[k - 1] * change + per_path * self.path[k]
        };
        self.terms[k] = self.mu[k] * now + beside;
        self.terms[k]
    }

    /// Term k of the product with another series, of which the term of order zero counts as `first`.
    pub(super) fn times(&self, k: usize, first: f64, other: impl Fn(usize) -> f64) -> f64 {
        (0..k).map(|j| self.terms[j] * other(k - j)).sum::<f64>() + self.terms[k] * first
    }
}
