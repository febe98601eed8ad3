//! The block that slides in the plane of its crack: the ground shakes along the stream and across the valley, and
//! friction is one circle.
//!
//! With u the slip velocity along (x, downstream) and across (y, to the left bank), N the whole normal force,
//!
//! `M u' = F - mu_k N u / |u|`, `M = diag(m_x, m_y)`; at rest `|F| <= mu_s N`.
//!
//! No water moves with the block across the valley. Neighbours stop the block at its sides, plastically, and take what
//! pushes it into them; friction acts along the stream alone then.
//!
//! Where friction goes by a law (`rub`), its path is that of the vector, and its speed |u|. Off a corner such a block, or one
//! whose uplift goes by the opening, is not followed ([`Outcome::LiftsAcross`](super::Outcome)).
//!
//! Between samples F and N are linear in time while both corners lie: `series` has the power series of a motion on its
//! way, `start` those from rest, `straight` the motion of which one component is held. Off one corner or both `lifted` has
//! the modes and their events, and `aloft` the motion; on a corner that slides the normal force goes with the direction of
//! the slip, and `rubbing` has the series. `walk` and `carry` go from event to event, `keep` keeps what there is to keep,
//! and `polynomial` finds where a series falls through zero. Impacts are those of `impact`.

mod aloft;
mod carry;
mod flight;
mod keep;
mod lifted;
mod polynomial;
mod rub;
mod rubbing;
mod series;
mod start;
mod straight;
mod walk;

pub use walk::{simulate, simulate_varying, Across, CrossShaking};
