//! Inverses of small matrices that are made once for a run.

/// The inverse of a symmetric positive matrix, row by row.
pub(super) fn inverse(mut a: Vec<f64>, size: usize) -> Vec<f64> {
    // Gauss and Jordan in place: column k becomes that of the inverse. No pivots are needed.
    for k in 0..size {
        let pivot = 1.0 / a[k * size + k];
        let mut own: Vec<f64> = a[k * size..][..size].iter().map(|x| pivot * x).collect();
        own[k] = pivot;
        for (r, row) in a.chunks_exact_mut(size).enumerate() {
            if r == k {
                continue;
            }
            let factor = std::mem::replace(&mut row[k], 0.0);
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
        }
        a[k * size..][..size].copy_from_slice(&own);
    }
    // Rounding has left it not quite symmetric.
    for r in 0..size {
        for c in 0..r {
            let mean = 0.5 * (a[r * size + c] + a[c * size + r]);
            (a[r * size + c], a[c * size + r]) = (mean, mean);
        }
    }
    a
}
