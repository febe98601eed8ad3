//! What acts in the crack beside contact: water whose pressure follows the opening, and anchors.
//!
//! Both act on the nodes of the two faces and are known when a step begins. They are taken where the nodes would be
//! `theta dt` later with the velocity they have: then an anchor by itself is as stable, up to
//! `dt^2 stiffness / mass = 4 / (4 theta - 1)`, as the scheme is with the stiffness of the concrete, and loses energy at
//! the same small rate. The static pressure and the prestress are among the static loads of the parts; here are the
//! differences from them.

use super::observe::{height, Faces};

/// What the pressure does where the crack opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// It vanishes, in proportion to the gap, until this is `opening`.
    ZeroWhileOpen,
    /// It becomes the reservoir's, in proportion to the gap, until this is `opening`.
    FullWhileOpen,
    /// It falls as a given volume of water fills a wider crack: `opening / (opening + gap)`.
    FollowsOpening,
}

impl Law {
    pub const NAMES: [&'static str; 3] = ["zero while open", "full while open", "follows opening"];
    const ALL: [Law; 3] = [Law::ZeroWhileOpen, Law::FullWhileOpen, Law::FollowsOpening];

    pub fn named(name: &str) -> Option<Law> {
        let place = Self::NAMES.iter().position(|known| *known == name)?;
        Some(Self::ALL[place])
    }
}

/// Water in the crack; forces of each node across the crack, of the upper and of the lower face.
pub struct Water {
    pub law: Law,
    pub opening: f64,
    /// At the static pressure.
    pub still: [Vec<f64>; 2],
    /// At the reservoir's.
    pub full: [Vec<f64>; 2],
}

impl Water {
    /// Change of the force of a node, where it has a gap.
    #[inline(always)]
    fn change(&self, face: usize, node: usize, gap: f64) -> f64 {
        let gap = gap.max(0.0);
        let part = (gap / self.opening).min(1.0);
        let still = self.still[face][node];
        match self.law {
            Law::ZeroWhileOpen => -part * still,
            Law::FullWhileOpen => part * (self.full[face][node] - still),
            Law::FollowsOpening => -still * gap / (self.opening + gap),
        }
    }
}

/// A point of a face: nodes with their weights.
pub type Point = [(usize, f64); 3];

/// An anchor between two points that face each other before the earthquake.
pub struct Anchor {
    /// On the upper and on the lower face; the latter is not used on a rigid plane.
    pub points: [Point; 2],
    /// Its axis, along the crack and across it.
    pub axis: [f64; 2],
    pub prestress: f64,
    pub axial: f64,
    pub shear: f64,
}

impl Anchor {
    fn tension(&self, elongation: f64) -> f64 {
        (self.prestress + self.axial * elongation).max(0.0)
    }

    fn elongation(&self, moved: [f64; 2]) -> f64 {
        self.axis[0] * moved[0] + self.axis[1] * moved[1]
    }

    /// Energy stored beyond the work of the prestress.
    fn energy(&self, moved: [f64; 2]) -> f64 {
        let e = self.elongation(moved);
        let dowel = 0.5 * self.shear * moved[0] * moved[0];
        if self.prestress + self.axial * e > 0.0 {
            return dowel + 0.5 * self.axial * e * e;
        }
        // Slack: from where its tension vanished only the prestress is missing.
        let slack = if self.axial > 0.0 {
            0.5 * self.prestress * self.prestress / self.axial
        } else {
            0.0
        };
        dowel - slack - self.prestress * e
    }
}

/// All that acts in a crack beside contact.
#[derive(Default)]
pub struct Inside {
    pub water: Option<Water>,
    pub anchors: Vec<Anchor>,
}

impl Inside {
    pub fn is_empty(&self) -> bool {
        self.water.is_none() && self.anchors.is_empty()
    }
}

/// The same under way.
pub struct Acting<'a> {
    inside: &'a Inside,
    /// How far apart the points of each anchor were at the start.
    apart: Vec<[f64; 2]>,
    /// Impulses of water and of anchors in this step, on the upper and on the lower face.
    water: [Vec<f64>; 2],
    anchors: [Vec<f64>; 2],
    /// Where the nodes would be.
    ahead: [Vec<f64>; 2],
    /// Energy in the anchors.
    pub stored: f64,
    /// Largest tension of each anchor.
    pub peaks: Vec<f64>,
}

impl<'a> Acting<'a> {
    /// None where nothing acts.
    pub fn new(inside: &'a Inside, start: Faces) -> Option<Self> {
        if inside.is_empty() {
            return None;
        }
        let room = || [vec![0.0; start.upper.len()], vec![0.0; start.lower.len()]];
        Some(Acting {
            inside,
            apart: inside.anchors.iter().map(|a| apart(a, start)).collect(),
            water: room(),
            anchors: room(),
            ahead: room(),
            stored: 0.0,
            peaks: inside.anchors.iter().map(|a| a.prestress).collect(),
        })
    }

    /// Find the impulses of the step on both faces, and add them up in `upper` and `lower`.
    pub fn push(
        &mut self,
        position: Faces,
        velocity: Faces,
        dt: f64,
        theta: f64,
        upper: &mut [f64],
        lower: &mut [f64],
    ) {
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
                    let gap = sign * (own[nodes + node] - height(other, own[node]));
                    self.water[face][nodes + node] = dt * water.change(face, node, gap);
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
            let more = anchor.tension(anchor.elongation(moved)) - anchor.prestress;
            let dowel = [anchor.shear * moved[0], 0.0];
            for (face, (points, sign)) in anchor.points.iter().zip([-1.0, 1.0]).enumerate() {
                let nodes = self.anchors[face].len() / 2;
                for &(node, weight) in points.iter().take(if nodes > 0 { 3 } else { 0 }) {
                    for (direction, dowel) in dowel.iter().enumerate() {
                        let force = more * anchor.axis[direction] + dowel;
                        self.anchors[face][direction * nodes + node] += sign * weight * dt * force;
                    }
                }
            }
        }
        for (face, sum) in [upper, lower].into_iter().enumerate() {
            for ((sum, w), a) in sum.iter_mut().zip(&self.water[face]).zip(&self.anchors[face]) {
                *sum = w + a;
            }
        }
    }

    /// Work of the impulses of water and of anchors on given velocities.
    pub fn work(&self, velocity: Faces) -> [f64; 2] {
        [&self.water, &self.anchors].map(|impulse| {
            let of = |p: &[f64], u: &[f64]| p.iter().zip(u).map(|(p, u)| p * u).sum::<f64>();
            of(&impulse[0], velocity.upper) + of(&impulse[1], velocity.lower)
        })
    }

    /// Note the anchors' tensions where the nodes are now, and return by how much their energy has grown.
    pub fn settle(&mut self, position: Faces) -> f64 {
        let before = self.stored;
        self.stored = 0.0;
        for (k, anchor) in self.inside.anchors.iter().enumerate() {
            let moved = since(anchor, position, &self.apart[k]);
            self.peaks[k] = self.peaks[k].max(anchor.tension(anchor.elongation(moved)));
            self.stored += anchor.energy(moved);
        }
        self.stored - before
    }
}

/// How far the points of an anchor are apart, along the crack and across it.
fn apart(anchor: &Anchor, faces: Faces) -> [f64; 2] {
    let of = |face: &[f64], point: &Point, direction: usize| {
        let offset = direction * (face.len() / 2);
        let share = |&(node, weight): &(usize, f64)| weight * face[offset + node];
        if face.is_empty() {
            0.0
        } else {
            point.iter().map(share).sum::<f64>()
        }
    };
    [0, 1].map(|d| of(faces.upper, &anchor.points[0], d) - of(faces.lower, &anchor.points[1], d))
}

fn since(anchor: &Anchor, faces: Faces, start: &[f64; 2]) -> [f64; 2] {
    let now = apart(anchor, faces);
    [now[0] - start[0], now[1] - start[1]]
}
