//! The asperities of a crack as a block finds them: on which flank it is, and what is left of it.

use super::super::result::Roughness;
use crate::asperity::Asperities;

/// Where the block is on its asperities, and what is left of them.
pub(super) struct Rough {
    pub(super) asperities: Asperities,
    /// Area of the crack that the work of friction wears.
    pub(super) area: f64,
    /// Which flank, counted downstream from the valley in which it stood at first.
    pub(super) flank: i64,
    /// Angle of the flank at the start of the present step.
    pub(super) angle: f64,
    /// Plastic work per area.
    pub(super) work: f64,
    /// Height of the flank where the block is, over that of the first valley.
    pub(super) level: f64,
    pub(super) highest: f64,
    pub(super) kept: Vec<[f64; 3]>,
}

impl Rough {
    /// At a slip, with the dilation and the plastic work so far.
    pub(super) fn new(asperities: Asperities, [level, work]: [f64; 2], slip: f64, area: f64) -> Self {
        Rough {
            asperities,
            area,
            flank: asperities.flank(slip),
            angle: asperities.worn(work),
            work,
            level,
            highest: level,
            kept: Vec::new(),
        }
    }

    /// What there is to tell.
    pub(super) fn end(self) -> Roughness {
        Roughness {
            end: [self.level, self.asperities.worn(self.work), self.work],
            kept: self.kept,
            highest: self.highest,
        }
    }

    /// The same block on another flank, as worn as the asperities are.
    pub(super) fn turn_to(&mut self, flank: i64) {
        self.flank = flank;
        self.angle = self.asperities.worn(self.work);
    }
}
