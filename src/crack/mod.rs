//! The flexible model: two elastic parts, and a frictional crack between them.

pub mod body;
pub mod contact;
pub mod coulomb;
pub mod ledger;
pub mod observe;
pub mod result;
pub mod step;
