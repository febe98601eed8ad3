//! Shake a dam, by whichever scheme is asked for.

use super::dam::{Dam, Shaking, Wanted};
use super::idce;
use super::result::Run;
use super::scheme::Scheme;
use super::step;

/// Shake a dam.
pub fn simulate(dam: &Dam, shaking: &Shaking, scheme: &Scheme, wanted: Wanted) -> Run {
    match scheme {
        Scheme::Exact(theta) => step::simulate(dam, shaking, *theta, wanted),
        Scheme::Penalty(penalty) => idce::simulate(dam, shaking, penalty, wanted),
    }
}
