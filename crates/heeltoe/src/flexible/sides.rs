//! What there is twice: for the part above the crack and, unless this is on a rigid plane, for the part below it.
//!
//! The cracks of a dam, from the crest down, and whose nodes their faces are.
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

use super::dam::Dam;
use super::stance::Give;
use crate::friction::Law;

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

/// Numbers of the nodes of both faces of the crack, all along it and then all across it.
#[derive(Clone, Copy)]
pub(super) struct Faces<'a> {
    pub upper: &'a [f64],
    /// Empty on a rigid plane.
    pub lower: &'a [f64],
}

/// Some nodes of a body that follow each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Span {
    /// The first.
    pub first: usize,
    /// How many.
    pub count: usize,
}

/// A crack.
#[derive(Clone, Debug)]
pub struct Line {
    /// Nodes of its upper and of its lower face, among those of the bodies they belong to; no lower ones on a rigid plane.
    pub nodes: [Span; 2],
    /// Coefficients of friction of a node that sticks and of one that slips.
    pub friction: [f64; 2],
    /// A friction law in their place.
    pub law: Option<Law>,
    /// Angles of the segments of its upper and of its lower face to the line from heel to toe (rad); none of a straight
    /// crack.
    pub angles: [Vec<f64>; 2],
    /// What tells rocking and drifting from elastic deformation.
    pub give: Give,
}

impl Line {
    /// The only crack of a dam, between faces of so many nodes.
    pub fn only(nodes: [usize; 2], friction: [f64; 2], give: Give) -> Self {
        Line {
            nodes: nodes.map(|count| Span { first: 0, count }),
            friction,
            law: None,
            angles: [Vec::new(), Vec::new()],
            give,
        }
    }
}

/// Where the faces of a crack are among the nodes of both bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub upper: Span,
    pub lower: Span,
    /// Whether the part above it belongs to the lower body.
    pub turned: bool,
}

impl Place {
    /// Those of all cracks of a dam.
    pub(super) fn all(dam: &Dam) -> Vec<Self> {
        let place = |(k, line): (usize, &Line)| Place {
            upper: line.nodes[0],
            lower: line.nodes[1],
            turned: k % 2 == 1,
        };
        dam.cracks.iter().enumerate().map(place).collect()
    }

    /// Whether what is below it is a rigid plane.
    #[inline(always)]
    pub(super) fn on_plane(&self) -> bool {
        self.lower.count == 0
    }

    /// The only crack of a dam, between faces of so many nodes.
    #[cfg(test)]
    pub(super) fn only(upper: usize, lower: usize) -> Self {
        let [upper, lower] = [upper, lower].map(|count| Span { first: 0, count });
        Place {
            upper,
            lower,
            turned: false,
        }
    }

    /// Numbers of its faces.
    #[inline(always)]
    pub(super) fn of<'a>(&self, faces: Faces<'a>) -> Meeting<'a> {
        let (upper, lower) = if self.turned {
            (faces.lower, faces.upper)
        } else {
            (faces.upper, faces.lower)
        };
        Meeting {
            upper: Face::of(upper, self.upper),
            lower: Face::of(lower, self.lower),
        }
    }
}

/// Numbers of the nodes of one face of a crack.
#[derive(Clone, Copy)]
pub(super) struct Face<'a> {
    pub along: &'a [f64],
    pub across: &'a [f64],
}

impl<'a> Face<'a> {
    #[inline(always)]
    fn of(all: &'a [f64], span: Span) -> Self {
        let (along, across) = all.split_at(all.len() / 2);
        Face {
            along: &along[span.first..][..span.count],
            across: &across[span.first..][..span.count],
        }
    }

    /// The only face of a body.
    #[inline(always)]
    pub(super) fn whole(all: &'a [f64]) -> Self {
        let (along, across) = all.split_at(all.len() / 2);
        Face { along, across }
    }
}

/// Numbers of the nodes of both faces of a crack.
#[derive(Clone, Copy)]
pub(super) struct Meeting<'a> {
    pub upper: Face<'a>,
    /// Empty on a rigid plane.
    pub lower: Face<'a>,
}
