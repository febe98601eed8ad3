//! A symmetric matrix for products with one vector after the other, of which half is kept: reading it is what a product
//! costs. In tiles of eight by eight numbers
//!
//! ```text
//! y_i += A_ij x_j,      y_j += A_ij^T x_i      (i > j)
//! ```

use super::simd::{apart, Group, Lanes, LANES};

/// A symmetric matrix in tiles, filled up with zeros to whole ones.
pub(super) struct Symmetric {
    /// Of each column of tiles the one on the diagonal, and those below it, column by column.
    tiles: Vec<[Group; LANES]>,
    /// Tiles in a column.
    count: usize,
}

impl Symmetric {
    /// With rows of `size` numbers.
    pub(super) fn new(matrix: &[f64], size: usize) -> Self {
        let count = size.div_ceil(LANES);
        let number = |r: usize, c: usize| {
            if r.max(c) < size {
                matrix[r * size + c]
            } else {
                0.0
            }
        };
        let tile = |i: usize, j: usize| -> [Group; LANES] {
            std::array::from_fn(|c| std::array::from_fn(|r| number(LANES * i + r, LANES * j + c)))
        };
        Symmetric {
            tiles: (0..count)
                .flat_map(|j| (j..count).map(move |i| tile(i, j)))
                .collect(),
            count,
        }
    }

    /// Groups of a vector.
    pub(super) fn groups(&self) -> usize {
        self.count
    }

    /// What [`add_product`] does.
    #[inline(always)]
    fn multiply<W: Lanes>(&self, x: &[Group], y: &mut [Group]) {
        let mut rest = &self.tiles[..];
        for j in 0..self.count {
            let (column, others) = rest.split_at(self.count - j);
            rest = others;
            let shares = x[j];
            // Two sums in turn do not wait for each other.
            let mut own = [W::load(&y[j]), W::all(0.0)];
            for (l, rows) in column[0].iter().enumerate() {
                own[l % 2] = W::all(shares[l]).fma(W::load(rows), own[l % 2]);
            }
            let mut turned = [W::all(0.0); LANES];
            for ((tile, x), y) in column[1..].iter().zip(&x[j + 1..]).zip(&mut y[j + 1..]) {
                let x = W::load(x);
                let mut sums = [W::load(y), W::all(0.0)];
                for l in 0..LANES {
                    let rows = W::load(&tile[l]);
                    sums[l % 2] = W::all(shares[l]).fma(rows, sums[l % 2]);
                    turned[l] = rows.fma(x, turned[l]);
                }
                sums[0].add(sums[1]).store(y);
            }
            let mut lanes = [[0.0; LANES]; LANES];
            for (lanes, turned) in lanes.iter_mut().zip(turned) {
                turned.store(lanes);
            }
            let below = W::load(&W::sums(&lanes));
            own[0].add(own[1]).add(below).store(&mut y[j]);
        }
    }
}

apart! {
    /// Add the product of a matrix with `x`.
    pub(super) fn add_product(matrix: &Symmetric, x: &[Group], y: &mut [Group]) -> () = Symmetric::multiply;
}

#[cfg(test)]
mod tests {
    use super::{add_product, Symmetric};
    use crate::flexible::simd::{in_groups, Plain};

    #[test]
    fn half_of_a_matrix_says_all() {
        for size in [1, 8, 13, 66] {
            let number = |r: usize, c: usize| ((r * c) as f64 + (r + c) as f64).sin();
            let matrix: Vec<f64> = (0..size * size).map(|k| number(k / size, k % size)).collect();
            let x: Vec<f64> = (0..size).map(|k| (k as f64).cos()).collect();
            let kept = Symmetric::new(&matrix, size);
            let mut y = vec![[1.0; 8]; kept.groups()];
            add_product::<Plain>(&kept, &in_groups(&x, size), &mut y);
            for (row, y) in matrix.chunks_exact(size).zip(y.as_flattened()) {
                let expected = 1.0 + row.iter().zip(&x).map(|(a, b)| a * b).sum::<f64>();
                assert!((y - expected).abs() < 1e-13, "{y} {expected}");
            }
        }
    }
}
