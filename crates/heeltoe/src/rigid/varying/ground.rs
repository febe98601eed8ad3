//! The ground's motion: horizontal, vertical, and turning.

use super::block::Ground;

/// Ground motion, linear between samples; a repeated time is a jump.
pub struct TurningGround<'a> {
    pub time: &'a [f64],
    pub horizontal: &'a [f64],
    pub vertical: Option<&'a [f64]>,
    pub rotation: Option<&'a [f64]>,
}

impl TurningGround<'_> {
    pub(super) fn at(&self, k: usize) -> Ground {
        let or_none = |series: Option<&[f64]>| series.map_or(0.0, |s| s[k]);
        [self.horizontal[k], or_none(self.vertical), or_none(self.rotation)]
    }
}

/// Ground acceleration from here to the end of the piece.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    pub(super) ground: Ground,
    pub(super) rate: Ground,
    pub(super) left: f64,
}

impl Stretch {
    pub(super) fn after(&self, since: f64) -> Ground {
        [0, 1, 2].map(|i| self.ground[i] + self.rate[i] * since)
    }
}
