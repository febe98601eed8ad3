//! The block that slides in the plane of its crack: the ground shakes along the stream and across the valley, and
//! friction is one circle.
//!
//! With u the slip velocity along (x, downstream) and across (y, to the left bank), N the whole normal force,
//!
//! `M u' = F - mu_k N u / |u|`, `M = diag(m_x, m_y)`; at rest `|F| <= mu_s N`.
//!
//! No water moves with the block across the valley. Both corners stay in contact; a run in which one would lift ends
//! there ([`Outcome::LiftsAcross`](super::Outcome)). Neighbours stop the block at its sides, plastically, and take what
//! pushes it into them; friction acts along the stream alone then.
//!
//! Between samples F and N are linear in time. `series` has the power series of a motion on its way, `start` those
//! from rest, `straight` the motion of which one component is held, `walk` goes
//! from event to event, and `keep` keeps what there is to keep.

mod flight;
mod keep;
mod series;
mod start;
mod straight;
mod walk;

pub use walk::{simulate, Across, CrossShaking};
