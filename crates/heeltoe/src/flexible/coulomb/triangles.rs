//! Factors of a small dense matrix, `P A = L U`, column by column, with row pivoting; a pivot is kept as its inverse.

use super::super::simd::{add_times, fma, Group, Lanes, LANES};

/// Gauss's elimination in place of a matrix of `n` columns; false where a pivot vanishes.
#[inline(always)]
pub(super) fn eliminate<W: Lanes>(lu: &mut [f64], n: usize, pivots: &mut Vec<usize>) -> bool {
    pivots.clear();
    for k in 0..n {
        let column = &lu[k * n + k..(k + 1) * n];
        let mut pivot = 0;
        for (row, value) in column.iter().enumerate() {
            if value.abs() > column[pivot].abs() {
                pivot = row;
            }
        }
        let largest = column[pivot];
        if largest == 0.0 || !largest.is_finite() {
            return false;
        }
        pivots.push(k + pivot);
        if pivot != 0 {
            for column in lu.chunks_exact_mut(n) {
                column.swap(k, k + pivot);
            }
        }
        // Solving needs no division.
        let inverse = 1.0 / largest;
        let (left, right) = lu.split_at_mut((k + 1) * n);
        let multipliers = &mut left[k * n + k..];
        multipliers[0] = inverse;
        for value in &mut multipliers[1..] {
            *value *= inverse;
        }
        for column in right.chunks_exact_mut(n) {
            let factor = -column[k];
            if factor != 0.0 {
                for (value, l) in column[k + 1..].iter_mut().zip(&multipliers[1..]) {
                    *value = fma::<W>(factor, *l, *value);
                }
            }
        }
    }
    true
}

/// Turn the right-hand side `x` into the solution. All of the work is adding multiples of columns.
#[inline(always)]
pub(super) fn substitute<W: Lanes>(lu: &[f64], pivots: &[usize], x: &mut [f64]) {
    let n = x.len();
    for (k, &pivot) in pivots.iter().enumerate() {
        x.swap(k, pivot);
    }
    for k in 0..n {
        let factor = -x[k];
        let (_, below) = x.split_at_mut(k + 1);
        for (value, l) in below.iter_mut().zip(&lu[k * n + k + 1..(k + 1) * n]) {
            *value = fma::<W>(factor, *l, *value);
        }
    }
    for k in (0..n).rev() {
        let value = x[k] * lu[k * n + k];
        x[k] = value;
        let (above, _) = x.split_at_mut(k);
        for (other, l) in above.iter_mut().zip(&lu[k * n..k * n + k]) {
            *other = fma::<W>(-value, *l, *other);
        }
    }
}

/// Write the inverse, column by column, each filled up to whole groups.
#[inline(always)]
pub(super) fn inverse<W: Lanes>(lu: &[f64], pivots: &[usize], n: usize, inverse: &mut Vec<Group>) {
    let stride = n.div_ceil(LANES);
    // All columns at once: of each of them the product with the matrix is right to rounding, that of rows would not be.
    let mut rows = vec![[0.0; LANES]; n * stride];
    for k in 0..n {
        rows[k * stride..][..stride].as_flattened_mut()[k] = 1.0;
    }
    for (k, &pivot) in pivots.iter().enumerate().filter(|(k, pivot)| k != *pivot) {
        let (above, below) = rows.split_at_mut(pivot * stride);
        above[k * stride..][..stride].swap_with_slice(&mut below[..stride]);
    }
    for k in 0..n {
        let (own, below) = rows[k * stride..].split_at_mut(stride);
        let multipliers = &lu[k * n + k + 1..(k + 1) * n];
        for (row, l) in below.chunks_exact_mut(stride).zip(multipliers) {
            add_times::<W>(-l, own, row);
        }
    }
    for k in (0..n).rev() {
        let (above, own) = rows.split_at_mut(k * stride);
        let own = &mut own[..stride];
        let pivot = W::all(lu[k * n + k]);
        for x in own.iter_mut() {
            pivot.fma(W::load(x), W::all(0.0)).store(x);
        }
        for (row, u) in above.chunks_exact_mut(stride).zip(&lu[k * n..]) {
            add_times::<W>(-u, own, row);
        }
    }
    inverse.clear();
    inverse.resize(n * stride, [0.0; LANES]);
    let (rows, columns) = (rows.as_flattened(), inverse.as_flattened_mut());
    for k in 0..n {
        for r in 0..n {
            columns[k * stride * LANES + r] = rows[r * stride * LANES + k];
        }
    }
}
