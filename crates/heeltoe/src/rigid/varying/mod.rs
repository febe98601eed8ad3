//! The rigid block where no closed form holds: rotations of any size, water and anchors that change with the opening of
//! the crack, a ground that turns.
//!
//! Modes, reactions, impact and the choice of the next mode are those of the exact walk; between events the equations of
//! motion are integrated to a tolerance far below anything that is shown, and events are found on the integrated motion.

mod advance;
pub mod block;
pub mod ground;
mod keep;
pub mod loads;
mod rest;
pub mod step;
pub mod walk;
