//! Many runs side by side. Every run depends on its own input alone, so the results are the same bits for any number
//! of threads, any chunking and any order; without the feature `rayon` one goes after the other.

/// `run(0)`, `run(1)`, ... `run(count - 1)`, on the threads of the current rayon pool, at least `chunk` at a time on each.
#[cfg(feature = "rayon")]
pub fn each<T: Send>(count: usize, chunk: usize, run: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    (0..count).into_par_iter().with_min_len(chunk).map(run).collect()
}

/// `run(0)`, `run(1)`, ... `run(count - 1)`, one after the other whatever `chunk` is.
#[cfg(not(feature = "rayon"))]
pub fn each<T: Send>(count: usize, _chunk: usize, run: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).map(run).collect()
}
