//! Kernels of heeltoe: what a cracked concrete gravity dam does in an earthquake. They know numbers only: no files, no
//! units.

#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

pub mod asperity;
mod defaults;
pub mod error;
pub mod flexible;
pub mod friction;
pub mod inside;
mod parallel;
pub mod rigid;
pub mod spectrum;
pub mod stop;
mod table;

pub use error::Error;
