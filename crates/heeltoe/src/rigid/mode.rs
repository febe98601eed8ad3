//! The five modes of motion and what holds in each.
//!
//! | mode | contact | reactions from |
//! | --- | --- | --- |
//! | rest | both corners, stick | `w'' = 0` in all three |
//! | slide | both, slip of sign S | both gaps `w'' = 0`, `T = -mu_k S (N_h + N_t)` |
//! | rock on heel / toe | one, stick | its gap and the slip `w'' = 0` |
//! | slide-rock on heel / toe | one, slip of sign S | its gap `w'' = 0`, `T = -mu_k S N` |
//! | drift | none | none |

use super::block::{HEEL, TOE};

/// A corner of the block on the crack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// Upstream end of the crack.
    Heel,
    /// Downstream end.
    Toe,
}

impl Corner {
    /// Place of its gap among the contact coordinates.
    pub(super) fn gap(self) -> usize {
        match self {
            Corner::Heel => HEEL,
            Corner::Toe => TOE,
        }
    }

    pub(super) fn other(self) -> Self {
        match self {
            Corner::Heel => Corner::Toe,
            Corner::Toe => Corner::Heel,
        }
    }
}

/// Which way the base slips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    /// With positive velocity.
    Downstream,
    /// With negative velocity.
    Upstream,
}

impl Slip {
    /// Sign of the slip velocity.
    pub(super) fn sign(self) -> f64 {
        match self {
            Slip::Downstream => 1.0,
            Slip::Upstream => -1.0,
        }
    }
}

/// How the block moves between two events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Both corners in contact, and stick.
    Rest,
    /// Both corners in contact, and slip.
    Slide(Slip),
    /// One corner in contact, and sticks.
    Rock(Corner),
    /// One corner in contact, and slips.
    SlideRock(Corner, Slip),
    /// Off the ground.
    Drift,
}

use Corner::{Heel, Toe};
use Slip::{Downstream, Upstream};

impl Mode {
    /// All modes; where two are admissible at once the earlier one is taken. Stick comes before slip, contact
    /// before lift-off.
    pub(super) const ALL: [Mode; 9] = [
        Mode::Rest,
        Mode::Rock(Heel),
        Mode::Rock(Toe),
        Mode::Slide(Downstream),
        Mode::Slide(Upstream),
        Mode::SlideRock(Heel, Downstream),
        Mode::SlideRock(Heel, Upstream),
        Mode::SlideRock(Toe, Downstream),
        Mode::SlideRock(Toe, Upstream),
    ];
    pub(super) const COUNT: usize = Self::NAMES.len();

    /// Number under which the mode leaves the kernel.
    pub fn index(self) -> usize {
        match self {
            Mode::Rest => 0,
            Mode::Rock(Heel) => 1,
            Mode::Rock(Toe) => 2,
            Mode::Slide(Downstream) => 3,
            Mode::Slide(Upstream) => 4,
            Mode::SlideRock(Heel, Downstream) => 5,
            Mode::SlideRock(Heel, Upstream) => 6,
            Mode::SlideRock(Toe, Downstream) => 7,
            Mode::SlideRock(Toe, Upstream) => 8,
            Mode::Drift => 9,
        }
    }

    /// Names of the modes, in the order of [`Mode::index`].
    pub const NAMES: [&'static str; 10] = [
        "rest",
        "rock on heel",
        "rock on toe",
        "slide downstream",
        "slide upstream",
        "slide-rock on heel downstream",
        "slide-rock on heel upstream",
        "slide-rock on toe downstream",
        "slide-rock on toe upstream",
        "drift",
    ];

    /// Which of the five kinds it is: rest, slide, rock, slide-rock, drift.
    #[inline(always)]
    pub(super) fn kind(self) -> usize {
        match self {
            Mode::Rest => 0,
            Mode::Slide(_) => 1,
            Mode::Rock(_) => 2,
            Mode::SlideRock(..) => 3,
            Mode::Drift => 4,
        }
    }

    /// Whether (heel, toe) are held in contact.
    pub(super) fn contacts(self) -> [bool; 2] {
        match self {
            Mode::Rest | Mode::Slide(_) => [true, true],
            Mode::Rock(c) | Mode::SlideRock(c, _) => [c == Heel, c == Toe],
            Mode::Drift => [false, false],
        }
    }

    /// Which of slip, heel gap and toe gap are free to move.
    pub(super) fn free(self) -> [bool; 3] {
        let [heel, toe] = self.contacts();
        [!self.sticks(), !heel, !toe]
    }

    /// Which way the base slips, if it does.
    pub(super) fn slip(self) -> Option<Slip> {
        match self {
            Mode::Slide(s) | Mode::SlideRock(_, s) => Some(s),
            _ => None,
        }
    }

    /// Whether the base, or the corner in contact, does not slip.
    pub(super) fn sticks(self) -> bool {
        matches!(self, Mode::Rest | Mode::Rock(_))
    }
}
