//! How a body answers to impulses on its crack nodes: `u = W p`.

use super::simd::Group;

/// How the crack nodes of a body answer to impulses on them, and then its dashpots, row by row.
#[derive(Clone, Copy)]
pub(super) struct Compliance<'a> {
    pub w: &'a [Group],
    pub nodes: usize,
    /// Groups in a row.
    pub stride: usize,
}

impl Compliance<'_> {
    /// What a pair's nodes in a face feel, in a direction, in a row of `w`.
    #[inline(always)]
    pub(super) fn felt(&self, row: usize, nodes: &[(usize, f64); 2], direction: usize) -> f64 {
        let row = &self.w[row * self.stride..][..self.stride].as_flattened()[direction * self.nodes..];
        nodes[0].1 * row[nodes[0].0] + nodes[1].1 * row[nodes[1].0]
    }

    /// Add what the nodes of one contact feel of those of another.
    #[inline(always)]
    pub(super) fn couple(
        &self,
        block: &mut [[f64; 2]; 2],
        one: &[(usize, f64); 2],
        other: &[(usize, f64); 2],
    ) {
        for &(node, weight) in one {
            if weight != 0.0 {
                for (r, row) in block.iter_mut().enumerate() {
                    for (c, value) in row.iter_mut().enumerate() {
                        *value += weight * self.felt(r * self.nodes + node, other, c);
                    }
                }
            }
        }
    }
}
