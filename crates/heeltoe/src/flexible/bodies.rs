//! The two bodies of a dam: above the crack and, unless the crack is on a rigid plane, below it.
//!
//! Parts and cracks follow each other from the crest down, so every crack lies between a part in an odd and one in an even
//! place. Of several cracks the first, third, ... part therefore make up one body, side by side and unconnected, and the
//! others make up the other:
//!
//! ```text
//! bodies.upper = parts 1, 3, ...     bodies.lower = parts 2, 4, ...     crack k between one of either
//! ```
//!
//! and all of the contact problem stays what it is between two bodies.

use super::faces::Faces;

/// Of the part above the crack, and of the part below it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sides<T> {
    /// Of the part above.
    pub upper: T,
    /// Of the part below; none where the crack is on a rigid plane.
    pub lower: Option<T>,
}

impl<T> Sides<T> {
    #[inline(always)]
    pub(super) fn iter(&self) -> impl Iterator<Item = &T> {
        std::iter::once(&self.upper).chain(&self.lower)
    }

    #[inline(always)]
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        std::iter::once(&mut self.upper).chain(&mut self.lower)
    }

    pub(super) fn map<'a, U>(&'a self, mut of: impl FnMut(&'a T) -> U) -> Sides<U> {
        Sides {
            upper: of(&self.upper),
            lower: self.lower.as_ref().map(of),
        }
    }

    /// One quantity of the crack nodes of both, to be written; empty on a rigid plane.
    #[inline(always)]
    pub(super) fn both_mut(&mut self, of: impl Fn(&mut T) -> &mut Vec<f64>) -> (&mut [f64], &mut [f64]) {
        let lower = self
            .lower
            .as_mut()
            .map_or(&mut [][..], |lower| &mut of(lower)[..]);
        (of(&mut self.upper), lower)
    }

    /// One quantity of the crack nodes of both.
    #[inline(always)]
    pub(super) fn faces<'a>(&'a self, of: impl Fn(&'a T) -> &'a [f64]) -> Faces<'a> {
        Faces {
            upper: of(&self.upper),
            lower: self.lower.as_ref().map_or(&[], of),
        }
    }
}
