//! The block under loads that stay as they are and at small rotations: exact, there is no step size.
//!
//! The ground acceleration is linear between samples, so in every mode of motion
//!
//! `w'' = a_0 + a_1 t`, `w' = w'_0 + a_0 t + a_1 t^2 / 2`, `w = w_0 + w'_0 t + a_0 t^2 / 2 + a_1 t^3 / 6`.
//!
//! On each piece of the record (from one sample or event to the next) the next event is the earliest root of: a normal
//! force (linear), what is left of the friction cone (linear), the slip velocity (quadratic), an open gap (cubic). The
//! state is moved there exactly, the event is dealt with, the next mode is chosen, and the walk goes on.

mod advance;
mod glide;
mod keep;
mod pass;
mod stretch;
mod walk;

pub use walk::simulate;
pub(super) use walk::{go_on, simulate_with_path};
