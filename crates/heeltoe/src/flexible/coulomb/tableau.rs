//! How velocities answer to impulses, `r = G p`, where at some components the impulse answers to the velocity instead.
//!
//! With `x` the given and `y` the answering one of `p_k` and `r_k`, `y = T x`, where `T = G` as long as all impulses are
//! given. The given one at `k` and its answer change places by
//!
//! ```text
//! T'_kk = 1 / T_kk,     T'_ik = T_ik / T_kk,     T'_kj = -T_kj / T_kk,     T'_ij = T_ij - T_ik T_kj / T_kk
//! ```
//!
//! (a principal pivot: Cottle, Pang and Stone, The Linear Complementarity Problem, 1992, chapter 2). The pivots of a
//! positive definite `G` are positive in whatever order they come.

use super::super::simd::{add_times, inlined, Group, Lanes, LANES};

/// A pivot against what it began with, below which the other components decide what moves there.
const VANISHES: f64 = 1e-7;

#[derive(Default)]
pub(super) struct Tableau {
    /// Column by column, each filled up to so many groups.
    columns: Vec<Group>,
    stride: usize,
    diagonal: Vec<f64>,
    /// Whether at each component the velocity is given.
    given: Vec<bool>,
    own: Vec<Group>,
}

impl Tableau {
    /// Begin with all impulses given, and `G` column by column in whole groups.
    pub(super) fn begin(&mut self, g: &[Group], size: usize) {
        self.stride = size.div_ceil(LANES);
        self.columns.clear();
        self.columns.extend_from_slice(g);
        self.given.clear();
        self.given.resize(size, false);
        self.diagonal.clear();
        let diagonal = (0..size).map(|k| g[k * self.stride + k / LANES][k % LANES]);
        self.diagonal.extend(diagonal);
        self.own.resize(self.stride, [0.0; LANES]);
    }

    /// Whether the velocity of a component is given.
    #[inline(always)]
    pub(super) fn given(&self, k: usize) -> bool {
        self.given[k]
    }

    /// How a component answers to what is given at another one.
    #[inline(always)]
    pub(super) fn answer(&self, k: usize, to: usize) -> f64 {
        self.columns[to * self.stride + k / LANES][k % LANES]
    }

    /// Let what is given at a component and what answers change places; false where others decide its velocity.
    #[inline(always)]
    pub(super) fn exchange<W: Lanes>(&mut self, k: usize) -> bool {
        let (stride, pivot) = (self.stride, self.answer(k, k));
        if !self.given[k] && (pivot.is_nan() || pivot <= VANISHES * self.diagonal[k]) {
            return false;
        }
        self.given[k] = !self.given[k];
        let inverse = 1.0 / pivot;
        self.own.copy_from_slice(&self.columns[k * stride..][..stride]);
        for (j, column) in self.columns.chunks_exact_mut(stride).enumerate() {
            if j == k {
                column.fill([0.0; LANES]);
                add_times::<W>(inverse, &self.own, column);
                column[k / LANES][k % LANES] = inverse;
            } else {
                let by = -inverse * column[k / LANES][k % LANES];
                if by != 0.0 {
                    add_times::<W>(by, &self.own, column);
                }
                column[k / LANES][k % LANES] = by;
            }
        }
        true
    }

    /// The answers to all that is given.
    #[inline(always)]
    pub(super) fn answers<W: Lanes>(&self, x: &[f64], y: &mut [Group]) {
        y.fill([0.0; LANES]);
        inlined::combine::<W>(&self.columns, self.stride, x, y);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::simd::{in_groups, Plain};
    use super::Tableau;

    /// By hand: `r = G p` with `G = [2 1; 1 3]`; where `r_0` is given, `p_0 = (r_0 - p_1) / 2` and `r_1 = r_0 / 2 + 5/2 p_1`.
    #[test]
    fn given_and_answer_change_places_and_back() {
        let g = [2.0, 1.0, 1.0, 3.0];
        let mut tableau = Tableau::default();
        tableau.begin(&in_groups(&g, 2), 2);
        let answers =
            |tableau: &Tableau| [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(k, to)| tableau.answer(k, to));
        assert!(tableau.exchange::<Plain>(0) && tableau.given(0));
        assert_eq!(answers(&tableau), [0.5, -0.5, 0.5, 2.5]);
        let mut y = [[0.0; 8]];
        tableau.answers::<Plain>(&[3.0, 1.0], &mut y);
        assert_eq!(y[0][..2], [1.0, 4.0]);
        assert!(tableau.exchange::<Plain>(0) && !tableau.given(0));
        assert_eq!(answers(&tableau), g);
    }

    #[test]
    fn others_decide_so_that_it_is_not_given() {
        let mut tableau = Tableau::default();
        tableau.begin(&in_groups(&[2.0, -2.0, -2.0, 2.0], 2), 2);
        assert!(tableau.exchange::<Plain>(1));
        assert!(!tableau.exchange::<Plain>(0) && !tableau.given(0));
        assert!(tableau.exchange::<Plain>(1));
        assert!(tableau.exchange::<Plain>(0));
    }
}
