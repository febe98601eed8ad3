//! Which node of one crack face meets which segment of the other, where, and with what gap.
//!
//! A node at `(t, n)` that lies between the nodes `j` and `j + 1` of the other face, at the fraction
//! `s = (t - t_j) / (t_{j+1} - t_j)`, has the gap
//!
//! ```text
//! g = +-(n - (1 - s) n_j - s n_{j+1})
//! ```
//!
//! with `t` along the crack and `n` across it; plus for a node of the upper face. A sliding node travels from segment
//! to segment; one that sticks keeps the material point it stands on. Of a crack that is not straight each pair has the
//! directions of its segment, see the module `kinks`.

use std::ops::Range;

use super::crack_line::{Line, Span};
use super::faces::{Face, Faces, Meeting};
use super::kinks::{Corners, Turn};
use super::place::Place;

/// Weights of nodes in the motion of the upper face of a crack against the lower one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pair {
    /// The crack, which counts the part above it, too.
    pub crack: usize,
    /// Two nodes of the part above with their weights.
    pub upper: [(usize, f64); 2],
    /// Two nodes of the part below with their weights, which are negative; not used on a rigid plane.
    pub lower: [(usize, f64); 2],
    /// Direction of the segment.
    pub turn: Turn,
}

/// A node that is watched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contactor {
    /// Its place on its face.
    pub node: usize,
    /// Whether this is the upper one of its crack.
    pub of_upper: bool,
    /// Whether it counts at the very end of the other face. Where the ends of both faces are watched and meet, one of
    /// them must not, or the same constraint would be there twice.
    pub closed: bool,
    /// Whether it is a corner that the other face turns around.
    corner: bool,
    /// How far beyond the end of the other face it still is at it (m).
    slack: f64,
    segment: usize,
}

/// The state of all contactors: their pairs and gaps.
pub(super) struct Contacts {
    pub contactors: Vec<Contactor>,
    /// None where the node is beyond the end of the other face.
    pub pairs: Vec<Option<Pair>>,
    pub gaps: Vec<f64>,
    /// Which pairs the last `update` changed.
    pub moved: Vec<bool>,
    /// Faces of each crack, and which of the contactors are its own.
    cracks: Vec<(Place, Range<usize>, Corners)>,
    /// Whether all of them are straight.
    straight: bool,
}

impl Contacts {
    /// Choose the contactors of each crack, by the five kinds of Zhu (2004), section 6.3: 1 all nodes of the upper face, 2
    /// of the lower, 3 all of the upper and the ends of the lower, 4 the reverse, 5 all of both. On a rigid plane, without
    /// lower nodes, those of the upper face are watched.
    pub(super) fn new(kind: u8, places: &[Place], lines: &[Line]) -> Self {
        let mut contactors = Vec::new();
        let mut cracks = Vec::new();
        for (k, place) in places.iter().enumerate() {
            let first = contactors.len();
            let corners = lines.get(k).map_or_else(Corners::default, Corners::of);
            contactors.extend(chosen(kind, place.upper.count, place.lower.count));
            contactors.extend(turned_around(kind, &corners));
            // A node that has slipped past the end by less than breaks its bond still meets that end.
            let slack = lines.get(k).map_or(0.0, Line::lasting_slip);
            contactors[first..]
                .iter_mut()
                .for_each(|contactor: &mut Contactor| contactor.slack = slack);
            cracks.push((*place, first..contactors.len(), corners));
        }
        Contacts {
            pairs: vec![None; contactors.len()],
            gaps: vec![f64::INFINITY; contactors.len()],
            moved: vec![true; contactors.len()],
            contactors,
            straight: cracks
                .iter()
                .all(|(_, _, corners): &(_, _, Corners)| corners.none()),
            cracks,
        }
    }

    /// Whether all cracks are straight.
    #[inline(always)]
    pub(super) fn straight(&self) -> bool {
        self.straight
    }

    /// Which contactors are those of each crack.
    pub(super) fn of_cracks(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.cracks.iter().map(|(_, range, _)| range.clone())
    }

    /// Number of contactors, whether they meet anything or not.
    pub(super) fn len(&self) -> usize {
        self.contactors.len()
    }

    /// Find every contactor's place on the other face, from the positions around each crack; `sticks` says which nodes
    /// keep their place.
    pub(super) fn update<'f>(
        &mut self,
        position: impl Fn(usize) -> Faces<'f>,
        sticks: impl Fn(usize) -> bool,
    ) {
        for (crack, (place, range, corners)) in self.cracks.iter().enumerate() {
            let faces = position(crack);
            let meeting = place.of(faces);
            if place.on_plane() {
                // Every node stands opposite to itself for ever.
                let first = self.pairs[range.start].is_none();
                self.moved[range.clone()].fill(first);
                if first {
                    for k in range.clone() {
                        self.pairs[k] = self.contactors[k]
                            .place(meeting, corners)
                            .map(|pair| pair.among(crack, place));
                    }
                }
                self.gaps[range.clone()].copy_from_slice(meeting.upper.across);
                continue;
            }
            for k in range.clone() {
                self.moved[k] = false;
                if !(sticks(k) && self.pairs[k].is_some()) {
                    let pair = self.contactors[k]
                        .place(meeting, corners)
                        .map(|pair| pair.among(crack, place));
                    self.moved[k] = pair != self.pairs[k];
                    self.pairs[k] = pair;
                }
                self.gaps[k] = match &self.pairs[k] {
                    Some(pair) => pair.gap(faces),
                    None => f64::INFINITY,
                };
            }
        }
    }

    /// Motion of the upper face against the lower one at all contacts, along the crack, then across it; none where
    /// nothing is met.
    pub(super) fn relative<'f>(&self, of: impl Fn(usize) -> Faces<'f>, motion: &mut [f64]) {
        let (along, across) = motion.split_at_mut(self.len());
        for (crack, (place, range, _)) in self.cracks.iter().enumerate() {
            let faces = of(crack);
            let (along, across) = (&mut along[range.clone()], &mut across[range.clone()]);
            if place.on_plane() {
                let own = place.of(faces).upper;
                along.copy_from_slice(own.along);
                across.copy_from_slice(own.across);
                continue;
            }
            for ((pair, along), across) in self.pairs[range.clone()].iter().zip(along).zip(across) {
                (*along, *across) = match pair {
                    Some(pair) => pair.turn.onto(pair.relative(faces, 0), pair.relative(faces, 1)),
                    None => (0.0, 0.0),
                };
            }
        }
    }

    /// The same across the valley, of bodies whose nodes move that way alone.
    pub(super) fn relative_across<'f>(&self, of: impl Fn(usize) -> Faces<'f>, motion: &mut [f64]) {
        let sum = |all: &[f64], nodes: &[(usize, f64); 2]| -> f64 {
            let moving = nodes.iter().filter(|(_, weight)| *weight != 0.0);
            moving.map(|(node, weight)| weight * all[*node]).sum()
        };
        for (crack, (place, range, _)) in self.cracks.iter().enumerate() {
            let (faces, motion) = (of(crack), &mut motion[range.clone()]);
            if place.on_plane() {
                let Span { first, count } = place.upper;
                motion.copy_from_slice(&faces.upper[first..][..count]);
                continue;
            }
            for (pair, motion) in self.pairs[range.clone()].iter().zip(motion) {
                *motion = pair.as_ref().map_or(0.0, |pair| {
                    sum(faces.upper, &pair.upper) + sum(faces.lower, &pair.lower)
                });
            }
        }
    }

    /// Put forces across the valley on the crack nodes of such bodies.
    pub(super) fn spread_across<T>(
        &self,
        forces: &[f64],
        parts: &mut [T],
        of: impl Fn(&mut T) -> &mut Vec<f64>,
    ) {
        parts.iter_mut().for_each(|part| of(part).fill(0.0));
        for (crack, (place, range, _)) in self.cracks.iter().enumerate() {
            let forces = &forces[range.clone()];
            if place.on_plane() {
                let Span { first, count } = place.upper;
                of(&mut parts[crack])[first..][..count].copy_from_slice(forces);
                continue;
            }
            for (pair, force) in self.pairs[range.clone()].iter().zip(forces) {
                for (part, nodes) in pair.iter().flat_map(Pair::parts) {
                    for (node, weight) in nodes.iter().filter(|(_, weight)| *weight != 0.0) {
                        of(&mut parts[part])[*node] += weight * force;
                    }
                }
            }
        }
    }

    /// Put the forces that the contacts exert on the crack nodes of all parts, up on the upper face and down on the lower
    /// one; `of` says where a part has them.
    pub(super) fn spread<T>(&self, forces: &[f64], parts: &mut [T], of: impl Fn(&mut T) -> &mut Vec<f64>) {
        parts.iter_mut().for_each(|part| of(part).fill(0.0));
        let (along, across) = forces.split_at(self.len());
        for (crack, (place, range, _)) in self.cracks.iter().enumerate() {
            let (along, across) = (&along[range.clone()], &across[range.clone()]);
            let (above, below) = parts.split_at_mut(crack + 1);
            let upper = of(&mut above[crack]);
            if place.on_plane() {
                let Span { first, count } = place.upper;
                let half = upper.len() / 2;
                upper[first..][..count].copy_from_slice(along);
                upper[half + first..][..count].copy_from_slice(across);
                continue;
            }
            let lower = of(&mut below[0]);
            for (pair, force) in self.pairs[range.clone()].iter().zip(along.iter().zip(across)) {
                if let Some(pair) = pair {
                    let (along, across) = pair.turn.back(*force.0, *force.1);
                    pair.spread(0, along, upper, lower);
                    pair.spread(1, across, upper, lower);
                }
            }
        }
    }
}

/// Choose the contactors of a crack between faces of so many nodes.
fn chosen(kind: u8, upper: usize, lower: usize) -> Vec<Contactor> {
    let all = |count: usize, of_upper: bool, closed: bool| {
        (0..count).map(move |node| Contactor {
            node,
            of_upper,
            closed,
            corner: false,
            slack: 0.0,
            segment: 0,
        })
    };
    let ends = |count: usize, of_upper: bool| {
        all(count, of_upper, false).filter(move |c| c.node == 0 || c.node + 1 == count)
    };
    match (lower, kind) {
        (0, _) | (_, 1) => all(upper, true, true).collect(),
        (_, 2) => all(lower, false, true).collect(),
        (_, 4) => all(lower, false, true).chain(ends(upper, true)).collect(),
        (_, 5) => all(upper, true, true).chain(all(lower, false, true)).collect(),
        _ => all(upper, true, true).chain(ends(lower, false)).collect(),
    }
}

/// Choose the corners that are watched beside the nodes of the other face: those of the face of which else only the ends
/// are, where the nodes of the other one pass them by.
fn turned_around(kind: u8, corners: &Corners) -> Vec<Contactor> {
    let of_upper = match kind {
        3 => false,
        4 => true,
        _ => return Vec::new(),
    };
    let contactor = |node| Contactor {
        node,
        of_upper,
        closed: false,
        corner: true,
        slack: 0.0,
        segment: 0,
    };
    corners.standing_out(of_upper).map(contactor).collect()
}

impl Contactor {
    /// Find the segment below or above the node, from where it was last; nodes are counted on either face.
    fn place(&mut self, faces: Meeting, corners: &Corners) -> Option<Pair> {
        let (Face { along: own, .. }, Face { along, .. }) = if self.of_upper {
            (faces.upper, faces.lower)
        } else {
            (faces.lower, faces.upper)
        };
        if along.is_empty() {
            // On a rigid plane.
            return Some(Pair {
                upper: [(self.node, 1.0), (self.node, 0.0)],
                ..Pair::default()
            });
        }
        let t = own[self.node];
        let (first, last) = (along[0], along[along.len() - 1]);
        let inside = if self.closed {
            first - self.slack <= t && t <= last + self.slack
        } else {
            first + self.slack < t && t < last - self.slack
        };
        if !inside {
            return None;
        }
        let mut j = self.segment;
        while j > 0 && t < along[j] {
            j -= 1;
        }
        while j + 2 < along.len() && t > along[j + 1] {
            j += 1;
        }
        self.segment = j;
        let s = ((t - along[j]) / (along[j + 1] - along[j])).clamp(0.0, 1.0);
        if self.corner && Corners::at_node(s) {
            return None;
        }
        let turn = corners.turn(self.of_upper, j, s);
        Some(if self.of_upper {
            Pair {
                upper: [(self.node, 1.0), (self.node, 0.0)],
                lower: [(j, s - 1.0), (j + 1, -s)],
                turn,
                ..Pair::default()
            }
        } else {
            Pair {
                upper: [(j, 1.0 - s), (j + 1, s)],
                lower: [(self.node, -1.0), (self.node, 0.0)],
                turn,
                ..Pair::default()
            }
        })
    }
}

impl Pair {
    /// Count the nodes of both faces among those of the parts around this crack.
    #[inline(always)]
    fn among(self, crack: usize, place: &Place) -> Self {
        let from = |span: Span| move |(node, weight): (usize, f64)| (span.first + node, weight);
        Pair {
            crack,
            upper: self.upper.map(from(place.upper)),
            lower: self.lower.map(from(place.lower)),
            turn: self.turn,
        }
    }

    /// Its nodes with their weights, part by part.
    #[inline(always)]
    pub(super) fn parts(&self) -> [(usize, &[(usize, f64); 2]); 2] {
        [(self.crack, &self.upper), (self.crack + 1, &self.lower)]
    }

    /// Motion of the upper face against the lower one: `direction` 0 along the crack, 1 across it.
    #[inline(always)]
    fn relative(&self, faces: Faces, direction: usize) -> f64 {
        let of = |motion: &[f64], nodes: &[(usize, f64); 2]| {
            let half = &motion[direction * (motion.len() / 2)..];
            nodes[0].1 * half[nodes[0].0] + nodes[1].1 * half[nodes[1].0]
        };
        of(faces.upper, &self.upper) + of(faces.lower, &self.lower)
    }

    /// Distance of the upper face from the lower one.
    #[inline(always)]
    fn gap(&self, faces: Faces) -> f64 {
        let across = self.relative(faces, 1);
        if self.turn.straight() {
            return across;
        }
        self.turn.onto(self.relative(faces, 0), across).1
    }

    /// Add the force `value` that a contact exerts.
    #[inline(always)]
    fn spread(&self, direction: usize, value: f64, upper: &mut [f64], lower: &mut [f64]) {
        for (face, nodes) in [(upper, &self.upper), (lower, &self.lower)] {
            let offset = direction * (face.len() / 2);
            for (node, weight) in nodes {
                face[offset + node] += weight * value;
            }
        }
    }
}
