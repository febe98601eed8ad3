//! The flexible model: elastic parts of a dam in their vibration modes, and frictional cracks between them.
//!
//! Each mode obeys `w'' + c w' + omega^2 w = f - gamma a(t) + shapes^T p`, with the forces p of contact found in every step,
//! so that nothing passes through the crack and friction is Coulomb's.

mod across;
mod body;
mod bond;
mod boundary;
mod compliance;
mod contact;
mod contact_operator;
mod coulomb;
mod coupling;
mod crack_forces;
mod crack_line;
mod dam;
mod dampers;
mod elimination;
mod envelope;
mod faces;
mod frames;
mod idce;
mod inside;
mod inverse;
mod kinks;
mod law;
mod ledger;
mod linear;
pub mod many;
mod matrices;
mod modal_stepper;
mod newmark;
mod observe;
mod panels;
mod place;
mod reservoir;
mod result;
mod rocking_thresholds;
mod scheme;
mod simd;
mod simulate;
mod start;
mod status;
mod step;
mod still;
mod summary;
mod symmetric;
#[cfg(test)]
mod tests;
mod track;
mod walk;

pub use body::{Modes, ReducedBody};
pub use bond::Cracked;
pub use crack_line::{BondLaw, Line, RockingThresholds, Span};
pub use dam::{CrossShaking, Dam, Shaking, UntilRest, Wanted};
pub use elimination::{Factors, Pattern};
pub use envelope::{Extreme, Stressed, Stresses};
pub use frames::Frames;
pub use inside::{Crossing, FaceAnchor, FollowingWater, Inside, Point, RisingWater};
pub use law::worked::Worked;
pub use ledger::Ledger;
pub use matrices::{Matrices, MatrixModes};
pub use observe::State;
pub use reservoir::Reservoir;
pub use result::Run;
pub use scheme::{Penalty, Scheme};
pub use simulate::simulate;
pub use start::{find_rest, rest};
pub use status::Status;
pub use still::{Still, Unrest};
pub use summary::{Outcome, Summary};
