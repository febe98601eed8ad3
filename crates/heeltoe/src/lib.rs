//! Kernels of heeltoe: what a cracked concrete gravity dam does in an earthquake. They know numbers only: no files, no
//! units.

pub mod flexible;
pub mod inside;
pub mod parallel;
pub mod rigid;
pub mod spectrum;
mod table;
