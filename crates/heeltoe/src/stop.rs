//! How somebody else ends a run before its time.

use std::sync::atomic::{AtomicBool, Ordering};

/// A flag that a run looks at in every step; by default there is none. What a stopped run returns is unfinished.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stop<'a>(Option<&'a AtomicBool>);

impl<'a> Stop<'a> {
    /// Stop once this is true.
    pub fn once(flag: &'a AtomicBool) -> Self {
        Stop(Some(flag))
    }

    /// Whether it is time.
    #[inline(always)]
    pub fn asked(self) -> bool {
        self.0.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }
}
