//! What acts in a crack beside contact: water whose pressure follows the opening, and anchors, by the laws of
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
//! stiffness of the concrete, and loses energy at the same small rate. An anchor that crosses several cracks has one
//! tension, by its elongation at all of them, and resists slip at each by itself. The static pressure and the prestress
//! are among the static loads of the bodies; here are the differences from them.

use super::crack_line::Line;
use super::faces::{height, Face, Faces, Meeting};
use super::inside::{FaceAnchor, Inside, Point, RisingWater};
use super::place::Place;
use super::scheme::TimeStep;
use crate::inside::Borne;

/// What acts in all cracks, under way.
pub(super) struct CrackForces<'a> {
    /// Of the cracks in which something acts.
    cracks: Vec<Acting<'a>>,
    /// Steps so far, and when the last of them ends.
    steps: u32,
    now: f64,
    /// Elongation of each anchor of the dam at all of its cracks.
    elongation: Vec<f64>,
    /// Energy in the anchors.
    pub stored: f64,
}

/// What acts in one crack under way.
struct Acting<'a> {
    crack: usize,
    place: Place,
    inside: &'a Inside,
    rising: Vec<&'a RisingWater>,
    /// Gap of each node at the start, up to which the static pressure holds.
    gaps: [Vec<f64>; 2],
    /// How far apart the points of each anchor were at the start, and how far they have moved against each other.
    apart: Vec<[f64; 2]>,
    moved: Vec<[f64; 2]>,
    /// Impulses of water and of anchors in this step on the nodes of the upper and of the lower face, all along the crack,
    /// then all across it.
    water: [Vec<f64>; 2],
    anchors: [Vec<f64>; 2],
    /// Where the nodes would be.
    ahead: [Vec<f64>; 2],
    /// What each anchor has borne.
    borne: Vec<Borne>,
}

impl<'a> CrackForces<'a> {
    /// None where nothing acts; `start` is where the nodes around each crack are.
    pub(super) fn new<'f>(
        lines: &'a [Line],
        rising: &'a [RisingWater],
        start: impl Fn(usize) -> Faces<'f>,
    ) -> Option<Self> {
        let places = Place::all(lines).into_iter().enumerate();
        let acting = |(crack, place): (usize, Place)| {
            let inside = &lines[crack].inside;
            let rising: Vec<_> = rising.iter().filter(|water| water.crack == crack).collect();
            let acts = !inside.is_empty() || !rising.is_empty();
            acts.then(|| Acting::new(crack, place, inside, rising, place.of(start(crack))))
        };
        let cracks: Vec<_> = places.filter_map(acting).collect();
        let anchors = lines.iter().flat_map(|line| &line.inside.anchors);
        let count = anchors.map(|anchor| anchor.place.anchor + 1).max();
        (!cracks.is_empty()).then_some(CrackForces {
            cracks,
            steps: 0,
            now: 0.0,
            elongation: vec![0.0; count.unwrap_or(0)],
            stored: 0.0,
        })
    }

    /// Find the impulses of the step, from where the nodes around each crack are and how fast they move.
    pub(super) fn find<'f>(
        &mut self,
        position: impl Fn(usize) -> Faces<'f>,
        velocity: impl Fn(usize) -> Faces<'f>,
        step: TimeStep,
    ) {
        let time = (f64::from(self.steps) + step.theta) * step.dt;
        self.steps += 1;
        self.now = f64::from(self.steps) * step.dt;
        for acting in &mut self.cracks {
            let [position, velocity] =
                [position(acting.crack), velocity(acting.crack)].map(|faces| acting.place.of(faces));
            acting.go_ahead(position, velocity, step);
            acting.follow(step);
            acting.rise(time, step);
            acting.stretch_ahead();
        }
        self.add_up();
        for acting in &mut self.cracks {
            acting.pull(&self.elongation, step);
        }
    }

    /// Add up how far the anchors are elongated.
    fn add_up(&mut self) {
        self.elongation.fill(0.0);
        for acting in &self.cracks {
            for (anchor, moved) in acting.inside.anchors.iter().zip(&acting.moved) {
                self.elongation[anchor.place.anchor] += anchor.elongation(*moved);
            }
        }
    }

    /// Put them on the crack nodes of all parts; `of` says where a part has them.
    pub(super) fn spread<T>(&self, parts: &mut [T], of: impl Fn(&mut T) -> &mut Vec<f64>) {
        parts.iter_mut().for_each(|part| of(part).fill(0.0));
        for acting in &self.cracks {
            let faces = parts[acting.crack..].iter_mut().zip(acting.place.spans());
            for (face, (part, span)) in faces.enumerate() {
                let sums = of(part);
                let half = sums.len() / 2;
                let (along, across) = sums.split_at_mut(half);
                let (water, anchors) = (&acting.water[face], &acting.anchors[face]);
                for (direction, sums) in [along, across].into_iter().enumerate() {
                    let impulses = water.iter().zip(anchors).skip(direction * span.count);
                    for (sum, (water, anchor)) in sums[span.first..][..span.count].iter_mut().zip(impulses) {
                        *sum += water + anchor;
                    }
                }
            }
        }
    }

    /// Work of the impulses of water and of anchors on given velocities.
    pub(super) fn work<'f>(&self, velocity: impl Fn(usize) -> Faces<'f>) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for acting in &self.cracks {
            let faces = acting.place.of(velocity(acting.crack));
            for (sum, impulse) in sums.iter_mut().zip([&acting.water, &acting.anchors]) {
                let of = |p: &[f64], face: Face| {
                    let u = face.along.iter().chain(face.across);
                    p.iter().zip(u).map(|(p, u)| p * u).sum::<f64>()
                };
                *sum += of(&impulse[0], faces.upper) + of(&impulse[1], faces.lower);
            }
        }
        sums
    }

    /// Note what the anchors bear where the nodes are now, and return by how much their energy has grown; `sideways` is how
    /// far the points of each have moved across the valley, empty where none has.
    pub(super) fn settle<'f>(&mut self, position: impl Fn(usize) -> Faces<'f>, sideways: &[f64]) -> f64 {
        for acting in &mut self.cracks {
            let faces = acting.place.of(position(acting.crack));
            stretch(&mut acting.moved, acting.inside, faces, &acting.apart);
        }
        self.add_up();
        let before = self.stored;
        self.stored = 0.0;
        let mut sideways = sideways.iter();
        // Elongation is stored once, wherever it is.
        let mut stored = vec![false; self.elongation.len()];
        for acting in &mut self.cracks {
            for (k, anchor) in acting.inside.anchors.iter().enumerate() {
                let (moved, which) = (acting.moved[k], anchor.place.anchor);
                let elongation = self.elongation[which];
                let [tension, force] = anchor.borne(moved, elongation);
                let dowel = sideways
                    .next()
                    .map_or(0.0, |moved| anchor.shear_stiffness * moved);
                let borne = [tension, force.hypot(dowel)];
                acting.borne[k].note(anchor, borne, self.now);
                self.stored += anchor.dowel_energy(moved);
                if !std::mem::replace(&mut stored[which], true) {
                    self.stored += anchor.axial_energy(elongation);
                }
            }
        }
        self.stored - before
    }

    /// What each anchor of a crack has borne.
    pub(super) fn borne(&self, crack: usize) -> Vec<Borne> {
        let own = self.cracks.iter().filter(|acting| acting.crack == crack);
        own.flat_map(|acting| acting.borne.iter().copied()).collect()
    }
}

impl<'a> Acting<'a> {
    fn new(
        crack: usize,
        place: Place,
        inside: &'a Inside,
        rising: Vec<&'a RisingWater>,
        start: Meeting,
    ) -> Self {
        let room = || place.spans().map(|span| vec![0.0; 2 * span.count]);
        Acting {
            crack,
            inside,
            rising,
            apart: inside.anchors.iter().map(|anchor| apart(anchor, start)).collect(),
            moved: vec![[0.0; 2]; inside.anchors.len()],
            gaps: [
                gaps(start.upper, start.lower, 1.0),
                gaps(start.lower, start.upper, -1.0),
            ],
            borne: inside.anchors.iter().map(|a| Borne::new(a, 0.0)).collect(),
            water: room(),
            anchors: room(),
            ahead: room(),
            place,
        }
    }

    /// Find where the nodes would be.
    fn go_ahead(&mut self, position: Meeting, velocity: Meeting, TimeStep { dt, theta }: TimeStep) {
        let pairs = [(position.upper, velocity.upper), (position.lower, velocity.lower)];
        for (ahead, (x, u)) in self.ahead.iter_mut().zip(pairs) {
            let moves = x.along.iter().chain(x.across).zip(u.along.iter().chain(u.across));
            for (ahead, (x, u)) in ahead.iter_mut().zip(moves) {
                *ahead = x + theta * dt * u;
            }
        }
    }

    /// Let the water follow the opening.
    fn follow(&mut self, TimeStep { dt, .. }: TimeStep) {
        let Some(water) = &self.inside.water else { return };
        let [above, below] = [0, 1].map(|face| Face::whole(&self.ahead[face]));
        let sides = [(above, below, 1.0), (below, above, -1.0)];
        for (face, (own, other, sign)) in sides.into_iter().enumerate() {
            let nodes = own.along.len();
            for node in 0..nodes {
                let gap = gap(own, other, sign, node);
                let change = water.change(face, node, gap) - water.change(face, node, self.gaps[face][node]);
                self.water[face][nodes + node] = dt * change;
            }
        }
    }

    /// Find how the points of the anchors would have moved.
    fn stretch_ahead(&mut self) {
        let [upper, lower] = [0, 1].map(|face| Face::whole(&self.ahead[face]));
        stretch(
            &mut self.moved,
            self.inside,
            Meeting { upper, lower },
            &self.apart,
        );
    }

    /// Let the anchors pull, by their elongations.
    fn pull(&mut self, elongation: &[f64], TimeStep { dt, .. }: TimeStep) {
        self.anchors.iter_mut().for_each(|face| face.fill(0.0));
        for (anchor, moved) in self.inside.anchors.iter().zip(&self.moved) {
            let force = anchor.pull_beyond_prestress(*moved, elongation[anchor.place.anchor]);
            for (face, (points, sign)) in anchor.place.points.iter().zip([-1.0, 1.0]).enumerate() {
                let nodes = self.anchors[face].len() / 2;
                for &(node, weight) in points.iter().take(if nodes > 0 { 3 } else { 0 }) {
                    for (direction, force) in force.iter().enumerate() {
                        self.anchors[face][direction * nodes + node] += sign * weight * dt * force;
                    }
                }
            }
        }
    }

    /// Add what water that changes with time pushes in this step.
    fn rise(&mut self, time: f64, TimeStep { dt, .. }: TimeStep) {
        if self.rising.is_empty() {
            return;
        }
        for (face, impulse) in self.water.iter_mut().enumerate() {
            let nodes = impulse.len() / 2;
            let across = &mut impulse[nodes..];
            if self.inside.water.is_none() {
                across.fill(0.0);
            }
            for rising in &self.rising {
                let share = dt * rising.share(time);
                for (impulse, change) in across.iter_mut().zip(&rising.change[face]) {
                    *impulse += share * change;
                }
            }
        }
    }
}

/// Gap of a node of one face to the other; `sign` is -1 for the lower one.
#[inline(always)]
fn gap(own: Face, other: Face, sign: f64, node: usize) -> f64 {
    sign * (own.across[node] - height(other, own.along[node]))
}

fn gaps(own: Face, other: Face, sign: f64) -> Vec<f64> {
    let nodes = 0..own.along.len();
    nodes.map(|node| gap(own, other, sign, node)).collect()
}

/// How far the points of an anchor are apart, along the crack and across it.
fn apart(anchor: &FaceAnchor, faces: Meeting) -> [f64; 2] {
    let of = |numbers: &[f64], point: &Point| {
        let share = |&(node, weight): &(usize, f64)| weight * numbers[node];
        if numbers.is_empty() {
            0.0
        } else {
            point.iter().map(share).sum::<f64>()
        }
    };
    let [above, below] = &anchor.place.points;
    [
        of(faces.upper.along, above) - of(faces.lower.along, below),
        of(faces.upper.across, above) - of(faces.lower.across, below),
    ]
}

/// Write how far the points of each anchor have moved against each other.
fn stretch(moved: &mut [[f64; 2]], inside: &Inside, faces: Meeting, start: &[[f64; 2]]) {
    for ((moved, anchor), start) in moved.iter_mut().zip(&inside.anchors).zip(start) {
        let now = apart(anchor, faces);
        *moved = [now[0] - start[0], now[1] - start[1]];
    }
}
