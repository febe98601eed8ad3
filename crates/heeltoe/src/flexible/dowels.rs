//! Anchors across the valley.
//!
//! The line of an anchor lies in the section, so that motion in the section alone elongates it. Across the valley the
//! anchor resists the slip of its crack as a dowel, by the stiffness with which it resists slip along the crack:
//!
//! ```text
//! p = -dt k (w + theta dt w')
//! ```
//!
//! where `w` is how far its points have moved against each other, taken as [`super::crack_forces`] takes all that acts
//! beside contact.

use super::crack_line::Line;
use super::faces::Faces;
use super::inside::Point;
use super::ledger::Ledger;
use super::scheme::TimeStep;

/// The anchors of all cracks across the valley, crack by crack.
pub(super) struct Dowels {
    dowels: Vec<Dowel>,
    /// How far the points of each have moved against each other.
    pub moved: Vec<f64>,
    /// Energy in them.
    stored: f64,
    /// Their work in the step, and by how much their energy has grown in it.
    work: f64,
    grown: f64,
}

/// One of them at one of its cracks.
struct Dowel {
    crack: usize,
    /// Its points on the upper face and on the lower one, in nodes of the parts.
    points: [Point; 2],
    stiffness: f64,
    impulse: f64,
}

impl Dowels {
    /// None where there are no anchors that stretch.
    pub(super) fn new(lines: &[Line]) -> Option<Self> {
        let mut dowels = Vec::new();
        for (crack, line) in lines.iter().enumerate() {
            dowels.extend(line.inside.anchors.iter().map(|anchor| {
                let face = |k: usize| {
                    anchor.place.points[k].map(|(node, weight)| (line.nodes[k].first + node, weight))
                };
                Dowel {
                    crack,
                    points: [face(0), face(1)],
                    stiffness: anchor.shear_stiffness,
                    impulse: 0.0,
                }
            }));
        }
        (!dowels.is_empty()).then(|| Dowels {
            moved: vec![0.0; dowels.len()],
            dowels,
            stored: 0.0,
            work: 0.0,
            grown: 0.0,
        })
    }

    /// Find the impulses of the step, from where the nodes around each crack are and how fast they move.
    pub(super) fn find<'f>(
        &mut self,
        position: impl Fn(usize) -> Faces<'f>,
        velocity: impl Fn(usize) -> Faces<'f>,
        TimeStep { dt, theta }: TimeStep,
    ) {
        for dowel in &mut self.dowels {
            let ahead = dowel.apart(position(dowel.crack)) + theta * dt * dowel.apart(velocity(dowel.crack));
            dowel.impulse = -dt * dowel.stiffness * ahead;
        }
    }

    /// Put them on the crack nodes of all parts; `of` says where a part has them.
    pub(super) fn spread<T>(&self, parts: &mut [T], of: impl Fn(&mut T) -> &mut Vec<f64>) {
        parts.iter_mut().for_each(|part| of(part).fill(0.0));
        for dowel in &self.dowels {
            let faces = parts[dowel.crack..]
                .iter_mut()
                .zip(&dowel.points)
                .zip([1.0, -1.0]);
            for ((part, point), sign) in faces {
                for (node, weight) in point {
                    of(part)[*node] += sign * weight * dowel.impulse;
                }
            }
        }
    }

    /// Work of their impulses on given velocities.
    pub(super) fn work<'f>(&self, velocity: impl Fn(usize) -> Faces<'f>) -> f64 {
        let of = |dowel: &Dowel| dowel.impulse * dowel.apart(velocity(dowel.crack));
        self.dowels.iter().map(of).sum()
    }

    /// Note where the nodes are after a step in which they have done this work.
    pub(super) fn settle<'f>(&mut self, position: impl Fn(usize) -> Faces<'f>, work: f64) {
        let before = self.stored;
        self.stored = 0.0;
        for (dowel, moved) in self.dowels.iter().zip(&mut self.moved) {
            *moved = dowel.apart(position(dowel.crack));
            self.stored += 0.5 * dowel.stiffness * *moved * *moved;
        }
        (self.work, self.grown) = (work, self.stored - before);
    }

    /// Leave them as they are for a step.
    pub(super) fn stay(&mut self) {
        (self.work, self.grown) = (0.0, 0.0);
    }

    /// Book a step.
    pub(super) fn book(&self, ledger: &mut Ledger) {
        // Work that they have not taken up is the scheme's doing.
        ledger.numerical -= self.work + self.grown;
        ledger.springs += self.stored;
        ledger.turnover += self.work.abs();
    }
}

impl Dowel {
    /// By how much its upper point has more of some numbers than its lower one.
    fn apart(&self, faces: Faces) -> f64 {
        let of = |numbers: &[f64], point: &Point| {
            if numbers.is_empty() {
                return 0.0;
            }
            point.iter().map(|(node, weight)| weight * numbers[*node]).sum()
        };
        of(faces.upper, &self.points[0]) - of(faces.lower, &self.points[1])
    }
}
