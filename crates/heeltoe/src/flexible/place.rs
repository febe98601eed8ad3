//! Where the faces of a crack are among the nodes of the parts above and below it.

use super::crack_line::{Line, Span};
use super::faces::{Face, Faces, Meeting};

/// Where the faces of a crack are among the nodes of the part above it and of the part below it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub upper: Span,
    pub lower: Span,
}

impl Place {
    /// Those of all cracks, from the crest down.
    pub(super) fn all(cracks: &[Line]) -> Vec<Self> {
        let place = |line: &Line| Place {
            upper: line.nodes[0],
            lower: line.nodes[1],
        };
        cracks.iter().map(place).collect()
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
        Place { upper, lower }
    }

    /// Both faces.
    pub(super) fn spans(&self) -> [Span; 2] {
        [self.upper, self.lower]
    }

    /// Numbers of its faces.
    #[inline(always)]
    pub(super) fn of<'a>(&self, faces: Faces<'a>) -> Meeting<'a> {
        Meeting {
            upper: Face::of(faces.upper, self.upper),
            lower: Face::of(faces.lower, self.lower),
        }
    }
}
