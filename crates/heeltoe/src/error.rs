//! Input that the kernels cannot use.

use std::fmt;

/// Which input is wrong, and why in words.
///
/// ```
/// use heeltoe::{rigid::Shaking, Error};
///
/// let error = Shaking::new(&[0.0], &[0.0], None).err().unwrap();
/// assert!(matches!(error, Error::Motion(_)));
/// assert!(error.to_string().starts_with("a motion needs two samples"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A ground motion.
    Motion(&'static str),
    /// A block, or blocks that stand on each other.
    Blocks(&'static str),
    /// An elastic part: its matrices, its modes or its stresses.
    Body(&'static str),
    /// Parts and cracks that do not make a dam.
    Dam(&'static str),
    /// Water before the dam or in its cracks.
    Water(&'static str),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Motion(why)
            | Error::Blocks(why)
            | Error::Body(why)
            | Error::Dam(why)
            | Error::Water(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for Error {}
