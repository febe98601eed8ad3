//! What a run of the flexible model leaves behind.

use super::envelope::Extreme;
use super::frames::Frames;
use super::law::worked::Worked;
use super::summary::Summary;

/// What a run leaves behind.
#[derive(Clone, Debug)]
pub struct Run {
    /// Its end, peaks and sums, for each crack from the crest down.
    pub cracks: Vec<Summary>,
    /// States at equal distances in time, if they were asked for.
    pub frames: Frames,
    /// What the contacts of cracks with a law have been through.
    pub worked: Vec<Worked>,
    /// Extremes of the stresses at each place of all parts, from the crest down; none unless they were asked for.
    pub extremes: Vec<Vec<Extreme>>,
    /// Those of the pressures of water with sound; none unless they were asked for.
    pub pressures: Vec<Extreme>,
    /// Where the point of the part at the crest that was wanted is at the start and after each step (m), from anywhere.
    pub crest: Vec<f64>,
    /// The same across the valley (m).
    pub crest_cross: Vec<f64>,
}

impl Run {
    /// That of the first crack.
    pub fn summary(&self) -> &Summary {
        &self.cracks[0]
    }
}
