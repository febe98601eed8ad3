//! The rigid model: one block on a crack, three degrees of freedom, from event to event.
//!
//! [`exact`] where the loads stay as they are, [`varying`] where loads or geometry change as the block moves; both share
//! modes, reactions, impact and the choice of what comes next, in contact coordinates `w = (slip, heel gap, toe gap)`:
//!
//! `w'' = b + A (T, N_h, N_t)`.
//!
//! [`stack`] has two such blocks, one on the other; [`plane`] a block that moves across the valley, too.

mod block;
mod choice;
mod course;
mod crest;
mod event;
pub mod exact;
mod impact;
mod ledger;
pub mod many;
mod mode;
pub mod plane;
mod reaction;
mod result;
mod shaking;
pub mod stack;
pub mod varying;
mod walk;

pub use block::{Block, BlockNumbers, Vector};
pub use crest::Crest;
pub use ledger::Ledger;
pub use mode::{Corner, Mode, Slip};
pub use result::{Crossing, Event, EventKind, Moment, Outcome, Roughness, Run, Summary, Wear};
pub use shaking::Shaking;
pub use walk::{Options, Wanted};
