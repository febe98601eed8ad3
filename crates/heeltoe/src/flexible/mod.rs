//! The flexible model: two elastic parts, and a frictional crack between them.

pub mod body;
pub mod contact;
pub mod coulomb;
pub mod coupling;
pub mod dam;
pub mod frames;
pub mod idce;
pub mod inside;
pub mod ledger;
pub mod observe;
pub mod part;
pub mod result;
pub mod step;
#[cfg(test)]
mod tests;
