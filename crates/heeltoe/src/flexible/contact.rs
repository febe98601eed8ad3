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
//! to segment; one that sticks keeps the material point it stands on.

use super::sides::Faces;

/// Weights of crack nodes in the motion of the upper face against the lower one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pair {
    /// Two nodes of the upper face with their weights.
    pub upper: [(usize, f64); 2],
    /// Two nodes of the lower face with their weights, which are negative; not used on a rigid plane.
    pub lower: [(usize, f64); 2],
}

/// A node that is watched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contactor {
    pub node: usize,
    /// Whether it belongs to the upper face.
    pub of_upper: bool,
    /// Whether it counts at the very end of the other face. Where the ends of both faces are watched and meet, one of
    /// them must not, or the same constraint would be there twice.
    closed: bool,
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
    rigid_plane: bool,
}

impl Contacts {
    /// Choose the contactors, by the five kinds of Zhu (2004), section 6.3: 1 all nodes of the upper face, 2 of the
    /// lower, 3 all of the upper and the ends of the lower, 4 the reverse, 5 all of both. On a rigid plane, without
    /// `lower` nodes, those of the upper face are watched.
    pub(super) fn new(kind: u8, upper: usize, lower: usize) -> Self {
        let all = |count: usize, of_upper: bool, closed: bool| {
            (0..count).map(move |node| Contactor {
                node,
                of_upper,
                closed,
                segment: 0,
            })
        };
        let ends = |count: usize, of_upper: bool| {
            all(count, of_upper, false).filter(move |c| c.node == 0 || c.node + 1 == count)
        };
        let contactors: Vec<_> = match (lower, kind) {
            (0, _) | (_, 1) => all(upper, true, true).collect(),
            (_, 2) => all(lower, false, true).collect(),
            (_, 4) => all(lower, false, true).chain(ends(upper, true)).collect(),
            (_, 5) => all(upper, true, true).chain(all(lower, false, true)).collect(),
            _ => all(upper, true, true).chain(ends(lower, false)).collect(),
        };
        Contacts {
            pairs: vec![None; contactors.len()],
            gaps: vec![f64::INFINITY; contactors.len()],
            moved: vec![true; contactors.len()],
            contactors,
            rigid_plane: lower == 0,
        }
    }

    /// Number of contactors, whether they meet anything or not.
    pub(super) fn len(&self) -> usize {
        self.contactors.len()
    }

    /// Find every contactor's place on the other face. Positions are all along the crack, then all across it;
    /// `sticks` says which nodes keep their place.
    #[inline(always)]
    pub(super) fn update(&mut self, upper: &[f64], lower: &[f64], sticks: impl Fn(usize) -> bool) {
        if self.rigid_plane {
            let first = self.pairs[0].is_none();
            self.moved.fill(first);
            if first {
                let pair = |c: &Contactor| Pair {
                    upper: [(c.node, 1.0), (c.node, 0.0)],
                    lower: [(0, 0.0); 2],
                };
                self.pairs = self.contactors.iter().map(|c| Some(pair(c))).collect();
            }
            self.gaps.copy_from_slice(&upper[upper.len() / 2..]);
            return;
        }
        for (k, c) in self.contactors.iter_mut().enumerate() {
            let (own, other) = if c.of_upper {
                (upper, lower)
            } else {
                (lower, upper)
            };
            self.moved[k] = false;
            if !(sticks(k) && self.pairs[k].is_some()) {
                let pair = c.place(own, other);
                self.moved[k] = pair != self.pairs[k];
                self.pairs[k] = pair;
            }
            self.gaps[k] = match &self.pairs[k] {
                Some(pair) => pair.relative(Faces { upper, lower }, 1),
                None => f64::INFINITY,
            };
        }
    }

    /// Motion of the upper face against the lower one at all contacts, along the crack, then across it; none where
    /// nothing is met.
    #[inline(always)]
    pub(super) fn relative(&self, faces: Faces, motion: &mut [f64]) {
        if self.rigid_plane {
            motion.copy_from_slice(faces.upper);
            return;
        }
        let (along, across) = motion.split_at_mut(self.len());
        for ((pair, along), across) in self.pairs.iter().zip(along).zip(across) {
            (*along, *across) = match pair {
                Some(pair) => (pair.relative(faces, 0), pair.relative(faces, 1)),
                None => (0.0, 0.0),
            };
        }
    }

    /// Put the forces that the contacts exert on both faces, up on the upper one and down on the lower one.
    #[inline(always)]
    pub(super) fn spread(&self, forces: &[f64], upper: &mut [f64], lower: &mut [f64]) {
        if self.rigid_plane {
            upper.copy_from_slice(forces);
            return;
        }
        upper.fill(0.0);
        lower.fill(0.0);
        let (along, across) = forces.split_at(self.len());
        for (pair, force) in self.pairs.iter().zip(along.iter().zip(across)) {
            if let Some(pair) = pair {
                pair.spread(0, *force.0, upper, lower);
                pair.spread(1, *force.1, upper, lower);
            }
        }
    }
}

impl Contactor {
    /// Find the segment below or above the node, from where it was last.
    fn place(&mut self, own: &[f64], other: &[f64]) -> Option<Pair> {
        let t = own[self.node];
        let along = &other[..other.len() / 2];
        let (first, last) = (along[0], along[along.len() - 1]);
        let inside = if self.closed {
            first <= t && t <= last
        } else {
            first < t && t < last
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
        Some(if self.of_upper {
            Pair {
                upper: [(self.node, 1.0), (self.node, 0.0)],
                lower: [(j, s - 1.0), (j + 1, -s)],
            }
        } else {
            Pair {
                upper: [(j, 1.0 - s), (j + 1, s)],
                lower: [(self.node, -1.0), (self.node, 0.0)],
            }
        })
    }
}

impl Pair {
    /// Motion of the upper face against the lower one: `direction` 0 along the crack, 1 across it.
    #[inline(always)]
    fn relative(&self, faces: Faces, direction: usize) -> f64 {
        let of = |motion: &[f64], nodes: &[(usize, f64); 2]| {
            let half = &motion[direction * (motion.len() / 2)..];
            nodes[0].1 * half[nodes[0].0] + nodes[1].1 * half[nodes[1].0]
        };
        of(faces.upper, &self.upper) + of(faces.lower, &self.lower)
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
