//! A crack that is not straight: in which direction each of its segments lies.
//!
//! Nodes are counted by their places along and across the straight line from heel to toe. What a contact does is
//! counted along and across the segment it is on, at the angle `a` to that line:
//!
//! ```text
//! along = cos a t + sin a n,     across = cos a n - sin a t
//! ```
//!
//! The angles are those of the faces as they were made; their deformation changes them by as little as it does those of
//! a straight crack, where it is left out, too. A node on a corner has the mean direction of both sides, the same from
//! either. So a node in a corner that points away from it is held by one condition, and the sides by the nodes beside
//! it; a corner that stands out of its face is watched itself, see [`super::contact`].

use super::crack_line::Line;

/// Direction of a segment: cosine and sine of its angle to the line from heel to toe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    cosine: f64,
    sine: f64,
}

impl Default for Turn {
    fn default() -> Self {
        Turn {
            cosine: 1.0,
            sine: 0.0,
        }
    }
}

impl Turn {
    /// Whether it is that of the line from heel to toe.
    #[inline(always)]
    pub(super) fn straight(self) -> bool {
        self.sine == 0.0
    }

    /// Components along and across the segment of those along and across the line.
    #[inline(always)]
    pub(super) fn onto(self, t: f64, n: f64) -> (f64, f64) {
        if self.straight() {
            return (t, n);
        }
        (self.cosine * t + self.sine * n, self.cosine * n - self.sine * t)
    }

    /// Components along and across the line of those along and across the segment.
    #[inline(always)]
    pub(super) fn back(self, along: f64, across: f64) -> (f64, f64) {
        if self.straight() {
            return (along, across);
        }
        (
            self.cosine * along - self.sine * across,
            self.cosine * across + self.sine * along,
        )
    }

    /// How one contact answers to another, each along and across its segment, from what it is along and across the line.
    #[inline(always)]
    pub(super) fn of_block(self, other: Turn, block: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        if self.straight() && other.straight() {
            return block;
        }
        let [a, b] = block.map(|row| other.onto(row[0], row[1]));
        let (first, second) = (self.onto(a.0, b.0), self.onto(a.1, b.1));
        [[first.0, second.0], [first.1, second.1]]
    }
}

/// Directions of the segments of both faces; none of a straight crack.
#[derive(Clone, Debug, Default)]
pub(super) struct Corners {
    upper: Vec<f64>,
    lower: Vec<f64>,
}

/// As a part of a segment, from the node at its end: what is nearer stands on it.
const AT_NODE: f64 = 1e-6;
/// Segments whose angles differ by no more make no corner.
const LEAST_CORNER: f64 = 1e-6;

impl Corners {
    pub(super) fn of(line: &Line) -> Self {
        let [upper, lower] = line.angles.clone();
        Corners { upper, lower }
    }

    /// Whether the crack is straight.
    pub(super) fn none(&self) -> bool {
        self.upper.is_empty()
    }

    /// Whether a place on a segment is that of one of its nodes.
    pub(super) fn at_node(s: f64) -> bool {
        !(AT_NODE..=1.0 - AT_NODE).contains(&s)
    }

    /// Direction at a place on a segment of the face that a node of the upper face, or of the lower one, meets.
    #[inline(always)]
    pub(super) fn turn(&self, of_upper: bool, segment: usize, s: f64) -> Turn {
        let angles = if of_upper { &self.lower } else { &self.upper };
        if angles.is_empty() {
            return Turn::default();
        }
        let own = angles[segment];
        let other = match (s < AT_NODE, s > 1.0 - AT_NODE) {
            (true, _) if segment > 0 => angles[segment - 1],
            (_, true) if segment + 1 < angles.len() => angles[segment + 1],
            _ => own,
        };
        let (sine, cosine) = (0.5 * (own + other)).sin_cos();
        Turn { cosine, sine }
    }

    /// Nodes of a face at which it stands out towards the other one.
    pub(super) fn standing_out(&self, of_upper: bool) -> impl Iterator<Item = usize> + '_ {
        let (angles, sign) = if of_upper {
            (&self.upper, 1.0)
        } else {
            (&self.lower, -1.0)
        };
        let out = move |pair: &[f64]| sign * (pair[1] - pair[0]) > LEAST_CORNER;
        let found = angles.windows(2).enumerate();
        found.filter(move |(_, pair)| out(pair)).map(|(k, _)| k + 1)
    }
}
