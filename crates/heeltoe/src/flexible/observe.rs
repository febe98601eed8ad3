//! What is read off the crack in each step: slip, rotation, openings.
//!
//! ```text
//! slip = mean of t above - mean of t below,     rotation = chord above - chord below,     opening = n - n of the lower face
//! ```
//!
//! with t along the crack and n across it; both are zero at the start.

use super::faces::Meeting;
use super::faces::{chord, height, mean_along};
use crate::table::named;

/// The motion of the upper face against the lower one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motion {
    pub slip: f64,
    pub rotation: f64,
    pub opening_heel: f64,
    pub opening_toe: f64,
}

impl Motion {
    /// Measure; `zero` is the mean position along the crack of the upper face less that of the lower at the start.
    #[inline(always)]
    pub(super) fn of(faces: Meeting, zero: f64) -> Self {
        let (upper, lower) = (faces.upper, faces.lower);
        let last = upper.along.len() - 1;
        let ends = [0, last].map(|node| upper.across[node] - height(lower, upper.along[node]));
        let mut rotation = chord(upper);
        if !lower.along.is_empty() {
            rotation -= chord(lower);
        }
        Motion {
            slip: mean_along(upper) - mean_along(lower) - zero,
            rotation,
            opening_heel: ends[0],
            opening_toe: ends[1],
        }
    }
}

named! {
    /// What the part above the crack may be doing; see the module `rocking_thresholds`.
    #[derive(Default)]
    State {
        /// It stands.
        #[default]
        Rest = "rest",
        /// It slides.
        Sliding = "sliding",
        /// It rocks about heel or toe.
        Rocking = "rocking",
        /// It slides while it rocks.
        SlideRocking = "slide-rocking",
        /// It touches nowhere.
        Drifting = "drifting",
    }
}

impl State {
    /// Under which of sliding, slide-rocking and drifting its slip is booked: a crack at rest shifts by what its nodes
    /// creep in turn, and what they shift by elastically comes and goes.
    pub(super) fn slips_as(self) -> usize {
        match self {
            State::Rest | State::Sliding => 0,
            State::Rocking | State::SlideRocking => 1,
            State::Drifting => 2,
        }
    }
}
