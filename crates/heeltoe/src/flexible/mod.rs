//! The flexible model: elastic parts of a dam in their vibration modes, and frictional cracks between them.
//!
//! Each mode obeys `w'' + c w' + omega^2 w = f - gamma a(t) + shapes^T p`, with the forces p of contact found in every step,
//! so that nothing passes through the crack and friction is Coulomb's.

mod acting;
mod answering;
mod body;
mod contact;
mod coulomb;
mod coupling;
mod dam;
mod dampers;
mod envelope;
mod frames;
mod idce;
mod kinks;
mod law;
mod ledger;
pub mod many;
mod moving;
mod newmark;
mod observe;
mod result;
mod sides;
mod stance;
mod start;
mod status;
mod step;
#[cfg(test)]
mod tests;
mod walk;
mod wide;

pub use acting::{FaceAnchor, FollowingWater, Inside, Point, RisingWater};
pub use body::{Modes, ReducedBody};
pub use dam::{Dam, Scheme, Shaking, Wanted};
pub use envelope::{Extreme, Stressed, Stresses};
pub use frames::Frames;
pub use idce::Penalty;
pub use law::Worked;
pub use ledger::Ledger;
pub use observe::State;
pub use result::{Outcome, Run, Summary};
pub use sides::{Line, Sides, Span};
pub use stance::Give;
pub use start::Still;
pub use status::Status;

/// Shake a dam.
pub fn simulate(dam: &Dam, shaking: &Shaking, scheme: &Scheme, wanted: Wanted) -> Run {
    match scheme {
        Scheme::Exact(theta) => step::simulate(dam, shaking, *theta, wanted),
        Scheme::Penalty(penalty) => idce::simulate(dam, shaking, penalty, wanted),
    }
}
