//! States of one contact: of every pair of conditions one holds with equality.
//!
//! ```text
//! open  p_n = p_t = 0     stick  u_n = -h, u_t = 0     slip  u_n = -h, p_t = -+mu p_n
//! ```

use crate::table::named;

named! {
    /// State of one contact.
    #[derive(Default)]
    Status {
        /// The node is beyond the other face.
        #[default]
        Absent = "absent",
        /// The node is off the other face.
        Open = "open",
        /// The node stays where it is on the other face.
        Stick = "stick",
        /// The upper face slips downstream.
        SlipDownstream = "slip downstream",
        /// The upper face slips upstream.
        SlipUpstream = "slip upstream",
    }
}

impl Status {
    #[inline(always)]
    pub(super) fn closed(self) -> bool {
        !matches!(self, Status::Absent | Status::Open)
    }

    #[inline(always)]
    pub(super) fn slips(self) -> bool {
        matches!(self, Status::SlipDownstream | Status::SlipUpstream)
    }

    /// Sign of the slip velocity.
    #[inline(always)]
    pub(super) fn sign(self) -> f64 {
        match self {
            Status::SlipDownstream => 1.0,
            Status::SlipUpstream => -1.0,
            _ => 0.0,
        }
    }
}
