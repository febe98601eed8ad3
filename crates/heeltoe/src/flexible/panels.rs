//! A matrix for products with one vector after the other: a few groups of its columns at a time, each such panel read
//! from front to back, as memory gives it fastest.

use super::simd::{combine, Group, Lanes};

/// Groups of a panel: what is summed up stays in registers.
const PANEL: usize = 5;

/// A matrix in panels.
pub(super) struct Panels {
    numbers: Vec<Group>,
    rows: usize,
}

impl Panels {
    /// The first `groups` of rows of `stride` groups.
    pub(super) fn new(rows: &[Group], stride: usize, groups: usize) -> Self {
        let mut numbers = Vec::with_capacity(rows.len() / stride.max(1) * groups);
        for first in (0..groups).step_by(PANEL) {
            let columns = first..groups.min(first + PANEL);
            for row in rows.chunks_exact(stride) {
                numbers.extend_from_slice(&row[columns.clone()]);
            }
        }
        Panels {
            numbers,
            rows: rows.len() / stride,
        }
    }

    /// Add `sum_k x_k rows_k`.
    pub(super) fn combine<W: Lanes>(&self, x: &[f64], sum: &mut [Group]) {
        let panels = self.numbers.chunks(PANEL * self.rows.max(1));
        for (panel, sum) in panels.zip(sum.chunks_mut(PANEL)) {
            combine::<W>(panel, &x[..self.rows], sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{combine, Panels};
    use crate::flexible::simd::{Group, Plain, LANES};

    #[test]
    fn panels_sum_like_rows() {
        for (stride, groups) in [(1, 1), (7, 7), (12, 11), (20, 17)] {
            let rows: Vec<Group> = (0..9 * stride)
                .map(|k| std::array::from_fn(|l| ((k * LANES + l) as f64).sin()))
                .collect();
            let x: Vec<f64> = (0..9).map(|k| (k as f64).cos()).collect();
            let (mut sum, mut expected) = (vec![[1.0; LANES]; groups], vec![[1.0; LANES]; stride]);
            Panels::new(&rows, stride, groups).combine::<Plain>(&x, &mut sum);
            combine::<Plain>(&rows, &x, &mut expected);
            assert_eq!(sum, expected[..groups]);
        }
    }
}
