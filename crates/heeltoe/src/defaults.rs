//! Defaults of the options: those of the Python package.

use crate::rigid::Options;

impl Default for Options {
    /// Bounces end below 1e-7 of the block's own speed, a run after a million events, and a Painlevé paradox stops it.
    fn default() -> Self {
        Self {
            settle: 1e-7,
            event_limit: 1_000_000,
            jam: false,
        }
    }
}
