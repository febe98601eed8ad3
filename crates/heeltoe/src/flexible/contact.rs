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
    /// Whether all count as moved where one is: nodes that say the same twice share by a softness that goes by the
    /// largest of all answers.
    together: bool,
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
            together: kind == 5 && lower > 0,
        }
    }

    /// Number of contactors, whether they meet anything or not.
    pub(super) fn len(&self) -> usize {
        self.contactors.len()
    }

    /// Whether any pair has changed.
    #[inline(always)]
    pub(super) fn any_moved(&self) -> bool {
        self.moved.contains(&true)
    }

    /// Find every contactor's place on the other face. Positions are all along the crack, then all across it;
    /// `sticks` says which nodes keep their place.
    #[inline(always)]
    pub(super) fn update(&mut self, upper: &[f64], lower: &[f64], sticks: impl Fn(usize) -> bool) {
        if self.rigid_plane {
            let nodes = upper.len() / 2;
            let first = self.pairs[0].is_none();
            self.moved.fill(first);
            for (k, c) in self.contactors.iter().enumerate() {
                self.gaps[k] = upper[nodes + c.node];
                self.pairs[k] = Some(Pair {
                    upper: [(c.node, 1.0), (c.node, 0.0)],
                    lower: [(0, 0.0); 2],
                });
            }
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
                Some(pair) => across(pair, upper, lower),
                None => f64::INFINITY,
            };
        }
        if self.together && self.any_moved() {
            self.moved.fill(true);
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

/// Gap of a pair.
#[inline(always)]
pub(super) fn across(pair: &Pair, upper: &[f64], lower: &[f64]) -> f64 {
    relative(pair, upper, lower, 1)
}

/// Motion of the upper face against the lower one: `direction` 0 along the crack, 1 across it.
#[inline(always)]
pub(super) fn relative(pair: &Pair, upper: &[f64], lower: &[f64], direction: usize) -> f64 {
    let of = |motion: &[f64], nodes: &[(usize, f64); 2]| {
        let offset = direction * (motion.len() / 2);
        nodes
            .iter()
            .map(|&(node, weight)| weight * motion[offset + node])
            .sum::<f64>()
    };
    let above = of(upper, &pair.upper);
    if lower.is_empty() {
        above
    } else {
        above + of(lower, &pair.lower)
    }
}

/// Add the force `value` that a contact exerts, up on the upper face and down on the lower one.
#[inline(always)]
pub(super) fn spread(pair: &Pair, direction: usize, value: f64, upper: &mut [f64], lower: &mut [f64]) {
    let offset = direction * (upper.len() / 2);
    for (node, weight) in pair.upper {
        upper[offset + node] += weight * value;
    }
    if !lower.is_empty() {
        let offset = direction * (lower.len() / 2);
        for (node, weight) in pair.lower {
            lower[offset + node] += weight * value;
        }
    }
}
