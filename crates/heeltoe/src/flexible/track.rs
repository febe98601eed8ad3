//! The way of one point of a part, step by step: `x = r.q`, with a number r of each mode.

use super::simd::{apart, Group, Lanes, LANES};

/// The way under way.
pub(super) struct Track {
    /// How far each mode moves the point.
    row: Vec<Group>,
    way: Vec<f64>,
}

impl Track {
    /// `row` has a number for each mode; there is room for these `steps` and the start.
    pub(super) fn new(row: &[f64], steps: usize) -> Self {
        let group = |part: &[f64]| -> Group { std::array::from_fn(|l| part.get(l).copied().unwrap_or(0.0)) };
        Track {
            row: row.chunks(LANES).map(group).collect(),
            way: Vec::with_capacity(steps + 1),
        }
    }

    /// Add where these modes move it.
    pub(super) fn add<W: Lanes>(&mut self, modes: &[Group]) {
        self.way.push(moved::<W>(&self.row, modes));
    }

    #[inline(always)]
    fn sum<W: Lanes>(row: &[Group], modes: &[Group]) -> f64 {
        let mut sum = W::all(0.0);
        for (row, q) in row.iter().zip(modes) {
            sum = W::load(row).fma(W::load(q), sum);
        }
        let mut lanes = [0.0; LANES];
        sum.store(&mut lanes);
        lanes.iter().sum()
    }

    /// Hand over the way, from the start to the end of the last step (m).
    pub(super) fn end(self) -> Vec<f64> {
        self.way
    }
}

apart! {
    /// How far these modes move a point.
    fn moved(row: &[Group], modes: &[Group]) -> f64 = Track::sum;
}
