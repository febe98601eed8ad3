//! How a block moves off one corner or both, and what falls there.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::mode::Mode;
use super::polynomial::{Polynomial, TERMS};
use super::rubbing::ACROSS;

/// Place of the speed of the slip behind the velocities.
pub(super) const SPEED: usize = ACROSS + 1;

/// How such a block moves for `length` seconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lifted {
    pub mode: Mode,
    pub length: f64,
    /// Velocities of slip, heel, toe, across, and the speed with which it rubs.
    pub velocity: [[f64; 5]; TERMS],
    /// Friction along, normal forces at heel and toe, friction across.
    pub force: [[f64; 4]; TERMS],
    /// The rest of the cone of friction where it sticks.
    pub cone: [f64; 3],
    /// Whether its slip stops at the end of the stretch.
    pub stops: bool,
    /// Whether it may turn any way as it slides.
    pub curved: bool,
}

impl Lifted {
    /// One of its velocities, the speed included.
    pub(super) fn rate(&self, i: usize) -> Polynomial {
        Polynomial::new(self.velocity.iter().map(|term| term[i]))
    }

    /// One of its forces.
    pub(super) fn pull(&self, i: usize) -> Polynomial {
        Polynomial::new(self.force.iter().map(|term| term[i]))
    }

    /// Work of friction per second.
    pub(super) fn rubs(&self) -> Polynomial {
        Polynomial::new((0..TERMS).map(|k| {
            let with = |j: usize| {
                let (force, velocity) = (&self.force[j], &self.velocity[k - j]);
                force[SLIP] * velocity[SLIP] + force[ACROSS] * velocity[ACROSS]
            };
            (0..=k).map(with).sum()
        }))
    }

    /// The corner that lies.
    pub(super) fn lies(&self) -> Option<usize> {
        let [heel, toe] = self.mode.contacts();
        [(heel, HEEL), (toe, TOE)]
            .into_iter()
            .find_map(|(lies, gap)| lies.then_some(gap))
    }
}

/// Whether a quantity of this value and change per second is positive or, where it is zero to rounding, does not fall;
/// what is zero to rounding is zero then.
pub(super) fn rises(quantity: &mut [f64; 2], left: f64, least: f64) -> bool {
    let [value, slope] = quantity;
    if value.abs() > least {
        return *value > 0.0;
    }
    *value = value.max(0.0);
    if slope.abs() * left > least {
        return *slope > 0.0;
    }
    *slope = slope.max(0.0);
    true
}
