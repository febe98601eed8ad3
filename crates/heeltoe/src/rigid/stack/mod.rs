//! Two rigid blocks, one on the other: a dam that is cracked at two levels.
//!
//! With `w = (slip, heel gap, toe gap)` of the lower crack and the same of the upper one, in which the upper block moves
//! relative to the lower,
//!
//! `w'' = b + A r`, `r = (T, N_h, N_t)` of both cracks.
//!
//! For small rotations and slips that are small against the cracks' widths `A` is constant. Between events all motions
//! are cubic in time, as those of one block are, and modes, their conditions, roots and books are those of [`super`].

mod blocks;
mod choice;
mod impact;
mod keep;
mod many;
mod reaction;
mod solve;
mod walk;

pub use blocks::{Place, Stack};
pub use many::run as many;
pub use walk::{simulate, StackRun};
