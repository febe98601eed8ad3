//! Where the faces of a crack are among the nodes of the bodies.

use super::crack_line::{Line, Span};
use super::faces::{Face, Faces, Meeting};

/// Where the faces of a crack are among the nodes of both bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub upper: Span,
    pub lower: Span,
    /// Whether the part above it belongs to the lower body.
    pub turned: bool,
}

impl Place {
    /// Those of all cracks, from the crest down.
    pub(super) fn all(cracks: &[Line]) -> Vec<Self> {
        let place = |(k, line): (usize, &Line)| Place {
            upper: line.nodes[0],
            lower: line.nodes[1],
            turned: k % 2 == 1,
        };
        cracks.iter().enumerate().map(place).collect()
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
