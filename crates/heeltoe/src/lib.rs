#![doc = include_str!("../README.md")]
#![deny(missing_docs)]

pub mod flexible;
pub mod inside;
mod parallel;
pub mod rigid;
pub mod spectrum;
mod table;
