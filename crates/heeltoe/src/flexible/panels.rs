//! A matrix for products with one vector after the other: a few groups of its columns at a time, each such panel read
//! from front to back, as memory gives it fastest. What is zero at its head and foot is left out.

use std::ops::Range;

use super::simd::{combine, Group, Lanes};

/// Groups of a panel: what is summed up stays in registers.
const PANEL: usize = 5;

/// A matrix in panels.
pub(super) struct Panels {
    numbers: Vec<Group>,
    /// Rows of each panel.
    rows: Vec<Range<usize>>,
}

impl Panels {
    /// The first `groups` of rows of `stride` groups.
    pub(super) fn new(rows: &[Group], stride: usize, groups: usize) -> Self {
        let (mut numbers, mut spans) = (Vec::new(), Vec::new());
        for first in (0..groups).step_by(PANEL) {
            let columns = first..groups.min(first + PANEL);
            let panel = || rows.chunks_exact(stride).map(|row| &row[columns.clone()]);
            let filled = |row: &[Group]| row.as_flattened().iter().any(|x| *x != 0.0);
            let count = rows.len() / stride;
            // In pairs, as they are summed up.
            let head = panel().position(filled).unwrap_or(count) / 2 * 2;
            let foot = count - panel().rev().position(filled).unwrap_or(count) / 2 * 2;
            let span = head..foot.max(head);
            panel()
                .take(span.end)
                .skip(span.start)
                .for_each(|row| numbers.extend_from_slice(row));
            spans.push(span);
        }
        Panels { numbers, rows: spans }
    }

    /// Add `sum_k x_k rows_k`.
    pub(super) fn combine<W: Lanes>(&self, x: &[f64], sum: &mut [Group]) {
        let mut rest = &self.numbers[..];
        for (rows, sum) in self.rows.iter().zip(sum.chunks_mut(PANEL)) {
            let (panel, others) = rest.split_at(rows.len() * sum.len());
            combine::<W>(panel, &x[rows.clone()], sum);
            rest = others;
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
    #[test]
    fn what_is_zero_at_head_and_foot_is_not_kept() {
        let (rows, stride) = (11, 12);
        let x: Vec<f64> = (0..rows).map(|k| (k as f64).cos()).collect();
        // Nothing, all, and ends that are even and odd.
        for filled in [0..0, 0..rows, 3..8, 4..7, 10..11] {
            let number = |k: usize| (k as f64 + 1.0).sin();
            let row = |k: usize| -> Vec<Group> {
                let has = filled.contains(&k);
                let group =
                    |n| std::array::from_fn(|l| if has { number(k * 96 + n * LANES + l) } else { 0.0 });
                (0..stride).map(group).collect()
            };
            let matrix: Vec<Group> = (0..rows).flat_map(row).collect();
            let panels = Panels::new(&matrix, stride, stride);
            assert!(panels.numbers.len() <= stride * (filled.len() + 2));
            let (mut sum, mut expected) = (vec![[1.0; LANES]; stride], vec![[1.0; LANES]; stride]);
            panels.combine::<Plain>(&x, &mut sum);
            combine::<Plain>(&matrix, &x, &mut expected);
            assert_eq!(sum, expected);
        }
    }
}
