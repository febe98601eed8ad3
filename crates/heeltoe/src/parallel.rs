//! Many runs side by side. Every run depends on its own input alone, so the results are the same bits for any number
//! of threads, any chunking and any order; without the feature `rayon` one goes after the other.

#[cfg(feature = "rayon")]
use std::sync::atomic::{AtomicU32, Ordering};

/// The process that has started rayon's own threads.
#[cfg(feature = "rayon")]
static STARTED_BY: AtomicU32 = AtomicU32::new(0);

/// Whether rayon's own threads are those of another process: a fork has none of its parent's threads, and would wait
/// for them for ever. A pool that was made in this process has its threads.
#[cfg(feature = "rayon")]
fn forked() -> bool {
    let here = std::process::id();
    let before = STARTED_BY.compare_exchange(0, here, Ordering::Relaxed, Ordering::Relaxed);
    rayon::current_thread_index().is_none() && before.is_err_and(|first| first != here)
}

/// `run(0)`, `run(1)`, ... `run(count - 1)`, on the threads of the current rayon pool, at least `chunk` at a time on each.
#[cfg(feature = "rayon")]
pub fn each<T: Send>(count: usize, chunk: usize, run: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    if forked() {
        return (0..count).map(run).collect();
    }
    (0..count).into_par_iter().with_min_len(chunk).map(run).collect()
}

/// `run(0)`, `run(1)`, ... `run(count - 1)`, one after the other whatever `chunk` is.
#[cfg(not(feature = "rayon"))]
pub fn each<T: Send>(count: usize, _chunk: usize, run: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).map(run).collect()
}
