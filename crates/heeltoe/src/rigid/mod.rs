//! The rigid model: one block on a crack, three degrees of freedom, exact in time.
//!
//! The ground acceleration is linear between samples, so in every mode of motion the accelerations are linear in
//! time, velocities quadratic and positions cubic. The walk goes from event to event; there is no step size.

pub mod block;
pub mod event;
pub mod impact;
pub mod ledger;
pub mod many;
pub mod mode;
pub mod result;
pub mod simulate;
pub mod varying;
