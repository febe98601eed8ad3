//! The rigid block where no closed form holds: rotations of any size, water and anchors that change with the opening of
//! the crack, a ground that turns.
//!
//! Modes, reactions, impact and the choice of the next mode are those of the exact walk; between events
//!
//! `q'' = M^-1 (Q + G^T (T, N_h, N_t))`
//!
//! is integrated to a tolerance far below anything that is shown, and events are found on the integrated motion; flight and
//! rocking without slip go by power series (`flight`, `unfolding`), the water in the crack with them (`wetting`). Where only
//! friction goes by a law nothing is integrated that has a closed form: rest, rocking and flight (`plain`), a slide whose
//! friction is a straight line over the path (`slide`); any other slide is a power series (`flat`), and once the law has
//! come to a constant the exact walk goes on.

mod advance;
mod block;
mod carried;
mod climb;
mod curve;
mod flanks;
mod flat;
mod flight;
mod friction;
mod instant;
mod keep;
mod line;
mod located;
mod plain;
mod power;
mod rates;
mod ready;
mod rest;
mod rough;
mod rubbing;
mod shaking;
mod slide;
mod step;
mod unfolding;
mod walk;
mod water;
mod wetting;

pub use block::{Rotation, TurningBlock, VaryingNumbers};
pub use shaking::TurningShaking;
pub use walk::{simulate, Surface};
