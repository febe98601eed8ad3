//! What acts in the crack beside contact: water whose pressure follows the opening, and anchors, by the laws of
//! [`crate::inside`].
//!
//! Both act on the nodes of the two faces and are known when a step begins. They are taken where the nodes would be
//! `theta dt` later with the velocity they have:
//!
//! ```text
//! p = dt F(x + theta dt u)
//! ```
//!
//! Then an anchor by itself is as stable, up to `dt^2 stiffness / mass = 4 / (4 theta - 1)`, as the scheme is with the
//! stiffness of the concrete, and loses energy at the same small rate. The static pressure and the prestress are among
//! the static loads of the bodies; here are the differences from them.

use super::faces::{height, Face, Faces};
use super::scheme::TimeStep;
use crate::inside::{Anchor, Law};

/// Water in the crack; forces of each node across the crack, of the upper and of the lower face.
pub struct FollowingWater {
    /// What its pressure does as the crack opens.
    pub law: Law,
    /// Opening over which it does (m).
    pub opening: f64,
    /// Forces at the static pressure (N).
    pub still: [Vec<f64>; 2],
    /// Forces at the reservoir's.
    pub full: [Vec<f64>; 2],
}

impl FollowingWater {
    /// Change of the force of a node, where it has a gap.
    #[inline(always)]
    fn change(&self, face: usize, node: usize, gap: f64) -> f64 {
        let (still, full) = (self.still[face][node], self.full[face][node]);
        self.law.change(still, full, gap, self.opening)
    }
}

/// Water in the crack whose pressure changes with time, whatever the crack does; its forces are those beyond what the
/// bodies and other such water bear.
#[derive(Clone, Debug)]
pub struct RisingWater {
    /// From when to when it changes, evenly (s).
    pub span: [f64; 2],
    /// Change of the forces of each node across the crack, of the upper and of the lower face (N).
    pub change: [Vec<f64>; 2],
}

impl RisingWater {
    /// How much of the change there is at a moment.
    fn share(&self, time: f64) -> f64 {
        let [begin, end] = self.span;
        ((time - begin) / (end - begin)).clamp(0.0, 1.0)
    }
}

/// A point of a face: nodes with their weights.
pub type Point = [(usize, f64); 3];

/// An anchor between two points that face each other before the earthquake: on the upper face and on the lower one, the
/// latter not used on a rigid plane.
pub type FaceAnchor = Anchor<[Point; 2]>;

/// All that acts in a crack beside contact.
#[derive(Default)]
pub struct Inside {
    /// Water whose pressure follows the opening.
    pub water: Option<FollowingWater>,
    /// Anchors that stretch.
    pub anchors: Vec<FaceAnchor>,
}

impl Inside {
    /// Whether nothing does.
    pub fn is_empty(&self) -> bool {
        self.water.is_none() && self.anchors.is_empty()
    }
}

/// The same under way.
pub(super) struct CrackForces<'a> {
    inside: &'a Inside,
    rising: &'a [RisingWater],
    /// Steps so far.
    steps: u32,
    /// Gap of each node at the start, up to which the static pressure holds.
    gaps: [Vec<f64>; 2],
    /// How far apart the points of each anchor were at the start.
    apart: Vec<[f64; 2]>,
    /// Impulses of water and of anchors in this step, on the upper and on the lower face.
    water: [Vec<f64>; 2],
    anchors: [Vec<f64>; 2],
    /// Where the nodes would be.
    ahead: [Vec<f64>; 2],
    /// Energy in the anchors.
    pub stored: f64,
    /// Largest tension and largest force of each anchor.
    pub peaks: Vec<[f64; 2]>,
}

impl<'a> CrackForces<'a> {
    /// None where nothing acts.
    pub(super) fn new(inside: &'a Inside, rising: &'a [RisingWater], start: Faces) -> Option<Self> {
        if inside.is_empty() && rising.is_empty() {
            return None;
        }
        let room = || [vec![0.0; start.upper.len()], vec![0.0; start.lower.len()]];
        Some(CrackForces {
            inside,
            rising,
            steps: 0,
            apart: inside.anchors.iter().map(|a| apart(a, start)).collect(),
            water: room(),
            anchors: room(),
            ahead: room(),
            gaps: [
                gaps(start.upper, start.lower, 1.0),
                gaps(start.lower, start.upper, -1.0),
            ],
            stored: 0.0,
            peaks: inside.anchors.iter().map(|a| [a.prestress; 2]).collect(),
        })
    }

    /// Find the impulses of the step on both faces, and add them up in `upper` and `lower`.
    pub(super) fn push(
        &mut self,
        position: Faces,
        velocity: Faces,
        step: TimeStep,
        upper: &mut [f64],
        lower: &mut [f64],
    ) {
        let TimeStep { dt, theta } = step;
        let pairs = [(position.upper, velocity.upper), (position.lower, velocity.lower)];
        for (ahead, (x, u)) in self.ahead.iter_mut().zip(pairs) {
            for ((ahead, x), u) in ahead.iter_mut().zip(x).zip(u) {
                *ahead = x + theta * dt * u;
            }
        }
        let [above, below] = &self.ahead;
        if let Some(water) = &self.inside.water {
            for (face, (own, other, sign)) in [(above, below, 1.0), (below, above, -1.0)]
                .into_iter()
                .enumerate()
            {
                let nodes = own.len() / 2;
                for node in 0..nodes {
                    let gap = gap(own, other, sign, node);
                    let change =
                        water.change(face, node, gap) - water.change(face, node, self.gaps[face][node]);
                    self.water[face][nodes + node] = dt * change;
                }
            }
        }
        self.anchors.iter_mut().for_each(|face| face.fill(0.0));
        let faces = Faces {
            upper: above,
            lower: below,
        };
        for (anchor, start) in self.inside.anchors.iter().zip(&self.apart) {
            let moved = since(anchor, faces, start);
            let force = anchor.pull_beyond_prestress(moved);
            for (face, (points, sign)) in anchor.place.iter().zip([-1.0, 1.0]).enumerate() {
                let nodes = self.anchors[face].len() / 2;
                for &(node, weight) in points.iter().take(if nodes > 0 { 3 } else { 0 }) {
                    for (direction, force) in force.iter().enumerate() {
                        self.anchors[face][direction * nodes + node] += sign * weight * dt * force;
                    }
                }
            }
        }
        self.rise(step);
        for (face, sum) in [upper, lower].into_iter().enumerate() {
            for ((sum, w), a) in sum.iter_mut().zip(&self.water[face]).zip(&self.anchors[face]) {
                *sum = w + a;
            }
        }
    }

    /// Add what water that changes with time pushes in this step.
    fn rise(&mut self, TimeStep { dt, theta }: TimeStep) {
        let time = (f64::from(self.steps) + theta) * dt;
        self.steps += 1;
        if self.rising.is_empty() {
            return;
        }
        for (face, impulse) in self.water.iter_mut().enumerate() {
            let across = impulse.len() / 2;
            let across = &mut impulse[across..];
            if self.inside.water.is_none() {
                across.fill(0.0);
            }
            for rising in self.rising {
                let share = dt * rising.share(time);
                for (impulse, change) in across.iter_mut().zip(&rising.change[face]) {
                    *impulse += share * change;
                }
            }
        }
    }

    /// Work of the impulses of water and of anchors on given velocities.
    pub(super) fn work(&self, velocity: Faces) -> [f64; 2] {
        [&self.water, &self.anchors].map(|impulse| {
            let of = |p: &[f64], u: &[f64]| p.iter().zip(u).map(|(p, u)| p * u).sum::<f64>();
            of(&impulse[0], velocity.upper) + of(&impulse[1], velocity.lower)
        })
    }

    /// Note what the anchors bear where the nodes are now, and return by how much their energy has grown.
    pub(super) fn settle(&mut self, position: Faces) -> f64 {
        let before = self.stored;
        self.stored = 0.0;
        for (k, anchor) in self.inside.anchors.iter().enumerate() {
            let moved = since(anchor, position, &self.apart[k]);
            let borne = anchor.borne(moved);
            self.peaks[k] = [0, 1].map(|i| self.peaks[k][i].max(borne[i]));
            self.stored += anchor.energy(moved);
        }
        self.stored - before
    }
}

/// Gap of a node of one face to the other; `sign` is -1 for the lower one.
#[inline(always)]
fn gap(own: &[f64], other: &[f64], sign: f64, node: usize) -> f64 {
    sign * (own[own.len() / 2 + node] - height(Face::whole(other), own[node]))
}

fn gaps(own: &[f64], other: &[f64], sign: f64) -> Vec<f64> {
    (0..own.len() / 2)
        .map(|node| gap(own, other, sign, node))
        .collect()
}

/// How far the points of an anchor are apart, along the crack and across it.
fn apart(anchor: &FaceAnchor, faces: Faces) -> [f64; 2] {
    let of = |face: &[f64], point: &Point, direction: usize| {
        let offset = direction * (face.len() / 2);
        let share = |&(node, weight): &(usize, f64)| weight * face[offset + node];
        if face.is_empty() {
            0.0
        } else {
            point.iter().map(share).sum::<f64>()
        }
    };
    [0, 1].map(|d| of(faces.upper, &anchor.place[0], d) - of(faces.lower, &anchor.place[1], d))
}

fn since(anchor: &FaceAnchor, faces: Faces, start: &[f64; 2]) -> [f64; 2] {
    let now = apart(anchor, faces);
    [now[0] - start[0], now[1] - start[1]]
}
