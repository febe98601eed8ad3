//! The block at any rotation, under loads that change as it moves.
//!
//! Coordinates are the displacement (X, Z) along and across the crack of one corner c, heel or toe, and the rotation
//! theta. A point of the block at rho from that corner moves with `(X', Z') + theta' J`, `J = R'(theta) rho`; with p the
//! J of the centroid, k = -R rho the acceleration per theta'^2, and e the horizontal:
//!
//! `M = m [1 0 p1; 0 1 p2; p1 p2 p.p] + J_c + m_w r r^T`, `r = (e1, e2, e.J_w)`,
//! `M q'' = Q - theta'^2 (m (k, p.k) + m_w r (e.k_w)) + G^T (T, N_h, N_t)`.
//!
//! The rows of G are the gradients of slip, heel gap and toe gap; the slip is that of the corner c. As in
//! [`super::super::block`] this becomes `w'' = b + A (T, N_h, N_t)`, now with A and b of the moment.
//!
//! With small rotations J, G and M are those of theta = 0. P-Delta adds to them the moment of the weight that changes with
//! the rotation, `-theta rho . W`.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::mode::Corner;
use super::loads::{Anchor, Water};
use super::step::State;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotation {
    Small,
    PDelta,
    Finite,
}

impl Rotation {
    pub const ALL: [Rotation; 3] = [Rotation::Small, Rotation::PDelta, Rotation::Finite];
    pub const NAMES: [&'static str; 3] = ["small", "p-delta", "finite"];
}

/// Loads that stay as they are: along, across, moment about the heel (counter-clockwise), and the sum of force times
/// distance from the heel, which says how the moment changes as the points of the block turn.
pub type Dead = [f64; 4];

/// Names of the numbers that describe the block beyond those of the exact kernel, in the order the bindings take them
/// (SI, per metre of dam; along and across the crack, from the heel).
pub const VARYING_FIELDS: [&str; VARYING_COUNT] = [
    "mass",
    "inertia",
    "centroid_along",
    "centroid_across",
    "water_mass",
    "water_along",
    "water_across",
    "horizontal_along",
    "horizontal_across",
    "gravity",
    "width",
    "dead_along",
    "dead_across",
    "dead_moment",
    "dead_virial",
    "per_vertical_along",
    "per_vertical_across",
    "per_vertical_moment",
    "per_vertical_virial",
    "opening",
    "full_pressure",
];

pub const VARYING_COUNT: usize = 21;

/// Ground acceleration: horizontal, upward, rotation (counter-clockwise about the middle of the crack).
pub type Ground = [f64; 3];

#[derive(Clone, Debug)]
pub struct TurningBlock {
    pub rotation: Rotation,
    pub mass: f64,
    pub inertia: f64,
    pub centroid: [f64; 2],
    pub water_mass: f64,
    pub water_place: [f64; 2],
    /// The horizontal, downstream, along and across the crack.
    pub horizontal: [f64; 2],
    pub gravity: f64,
    pub width: f64,
    pub dead: Dead,
    /// Per unit of upward ground acceleration, the weight left out.
    pub per_vertical: Dead,
    pub water: Water,
    pub anchors: Vec<Anchor>,
}

/// The block at one moment: masses, loads, and what is needed to solve for the reactions.
pub struct Instant {
    pub inverse_mass: [Vector; 3],
    pub mass: [Vector; 3],
    pub gradient: [Vector; 3],
    /// Applied loads with the ground's inertia force, without the velocity terms.
    pub load: Vector,
    pub compliance: [Vector; 3],
    pub free_acceleration: Vector,
    /// Velocity terms of the equations of motion, on the side of the loads.
    centrifugal: Vector,
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn times(m: &[Vector; 3], v: &Vector) -> Vector {
    [dot(&m[0], v), dot(&m[1], v), dot(&m[2], v)]
}

impl TurningBlock {
    /// Build from the numbers named by [`VARYING_FIELDS`].
    pub fn new(p: &[f64; VARYING_COUNT], rotation: Rotation, water: Water, anchors: Vec<Anchor>) -> Self {
        TurningBlock {
            rotation,
            mass: p[0],
            inertia: p[1],
            centroid: [p[2], p[3]],
            water_mass: p[4],
            water_place: [p[5], p[6]],
            horizontal: [p[7], p[8]],
            gravity: p[9],
            width: p[10],
            dead: [p[11], p[12], p[13], p[14]],
            per_vertical: [p[15], p[16], p[17], p[18]],
            water: Water {
                opening: p[19],
                full: p[20],
                ..water
            },
            anchors,
        }
    }

    /// Distance of the corner from the heel.
    pub fn place(&self, corner: Corner) -> f64 {
        match corner {
            Corner::Heel => 0.0,
            Corner::Toe => self.width,
        }
    }

    /// Sine and cosine that the geometry goes by.
    fn turned(&self, theta: f64) -> [f64; 2] {
        match self.rotation {
            Rotation::Finite => [theta.sin(), theta.cos()],
            _ => [0.0, 1.0],
        }
    }

    /// How far a point of the base, `ahead` of the corner, is lifted above it by the rotation.
    pub fn lift(&self, ahead: f64, theta: f64) -> f64 {
        match self.rotation {
            Rotation::Finite => ahead * theta.sin(),
            _ => ahead * theta,
        }
    }

    /// Velocity of that lift, with the rotation and its rate.
    pub fn lift_velocity(&self, ahead: f64, theta: f64, rate: f64) -> f64 {
        ahead * self.turned(theta)[1] * rate
    }

    /// Gaps at heel and toe.
    pub fn gaps(&self, corner: Corner, state: &State) -> [f64; 2] {
        match corner {
            Corner::Heel => [state[1], state[1] + self.lift(self.width, state[2])],
            Corner::Toe => [state[1] + self.lift(-self.width, state[2]), state[1]],
        }
    }

    /// Velocities of slip, heel gap and toe gap.
    pub fn contact_velocity(&self, corner: Corner, state: &State) -> Vector {
        match corner {
            Corner::Heel => [
                state[3],
                state[4],
                state[4] + self.lift_velocity(self.width, state[2], state[5]),
            ],
            Corner::Toe => [
                state[3],
                state[4] + self.lift_velocity(-self.width, state[2], state[5]),
                state[4],
            ],
        }
    }

    /// The same state seen from the other corner.
    pub fn other_corner(&self, corner: Corner, state: &State) -> State {
        let ahead = match corner {
            Corner::Heel => self.width,
            Corner::Toe => -self.width,
        };
        let [sine, cosine] = self.turned(state[2]);
        let mut other = *state;
        other[0] += ahead * (cosine - 1.0);
        other[1] += self.lift(ahead, state[2]);
        other[3] -= ahead * sine * state[5];
        other[4] += ahead * cosine * state[5];
        other
    }

    /// Masses, loads and reactions' equations at a state.
    pub fn at(&self, corner: Corner, state: &State, ground: &Ground) -> Instant {
        let from = self.place(corner);
        let [sine, cosine] = self.turned(state[2]);
        let finite = self.rotation == Rotation::Finite;
        let rate = state[5];
        let lever = |b: f64, d: f64| [-b * sine - d * cosine, b * cosine - d * sine];
        let (b, d) = (self.centroid[0] - from, self.centroid[1]);
        let p = lever(b, d);
        let (wb, wd) = (self.water_place[0] - from, self.water_place[1]);
        let q = lever(wb, wd);
        let e = self.horizontal;
        let r = [e[0], e[1], e[0] * q[0] + e[1] * q[1]];
        let (m, mw) = (self.mass, self.water_mass);
        let mut mass = [
            [m, 0.0, m * p[0]],
            [0.0, m, m * p[1]],
            [m * p[0], m * p[1], m * (p[0] * p[0] + p[1] * p[1]) + self.inertia],
        ];
        for i in 0..3 {
            for k in 0..3 {
                mass[i][k] += mw * r[i] * r[k];
            }
        }
        let mut centrifugal = [0.0; 3];
        if finite {
            // R rho is J turned back by a right angle.
            let k = [-p[1], p[0]];
            let kw = e[0] * -q[1] + e[1] * q[0];
            let square = rate * rate;
            for i in 0..3 {
                let own = [k[0], k[1], p[0] * k[0] + p[1] * k[1]][i];
                centrifugal[i] = -square * (m * own + mw * r[i] * kw);
            }
        }
        let load = self.load(corner, state, ground, [sine, cosine], &p, &r);
        let ahead = match corner {
            Corner::Heel => self.width,
            Corner::Toe => -self.width,
        };
        let other = [0.0, 1.0, ahead * cosine];
        let own = [0.0, 1.0, 0.0];
        let gradient = match corner {
            Corner::Heel => [[1.0, 0.0, 0.0], own, other],
            Corner::Toe => [[1.0, 0.0, 0.0], other, own],
        };
        let inverse_mass = inverse(&mass);
        let driven = [0, 1, 2].map(|i| load[i] + centrifugal[i]);
        let free = times(&inverse_mass, &driven);
        let mut compliance = [[0.0; 3]; 3];
        for i in 0..3 {
            let moved = times(&inverse_mass, &gradient[i]);
            for k in 0..3 {
                compliance[i][k] = dot(&moved, &gradient[k]);
            }
        }
        let mut free_acceleration = gradient.map(|row| dot(&row, &free));
        if finite {
            let far = if corner == Corner::Heel { TOE } else { HEEL };
            free_acceleration[far] -= ahead * sine * rate * rate;
        }
        Instant {
            inverse_mass,
            mass,
            gradient,
            load,
            compliance,
            free_acceleration,
            centrifugal,
        }
    }

    fn load(
        &self,
        corner: Corner,
        state: &State,
        ground: &Ground,
        [sine, cosine]: [f64; 2],
        p: &[f64; 2],
        r: &Vector,
    ) -> Vector {
        let from = self.place(corner);
        let theta = state[2];
        let [e1, e2] = self.horizontal;
        // Weight and the ground's inertia force act on the centroid; the water is moved sideways only.
        let [horizontal, up, spin] = *ground;
        let down = self.gravity + up;
        let force = [
            -self.mass * (horizontal * e1 - down * e2 + self.mass_arm(spin)[0]),
            -self.mass * (horizontal * e2 + down * e1 + self.mass_arm(spin)[1]),
        ];
        let mut load = [
            force[0],
            force[1],
            force[0] * p[0] + force[1] * p[1] - self.inertia * spin,
        ];
        let middle = [self.water_place[0] - 0.5 * self.width, self.water_place[1]];
        let driven = horizontal + spin * (e2 * middle[0] - e1 * middle[1]);
        for i in 0..3 {
            load[i] -= self.water_mass * r[i] * driven;
        }
        if self.rotation == Rotation::PDelta {
            let (b, d) = (self.centroid[0] - from, self.centroid[1]);
            load[2] -= theta * self.mass * down * (b * e2 - d * e1);
        }
        for (dead, factor) in [(&self.dead, 1.0), (&self.per_vertical, up)] {
            if factor == 0.0 {
                continue;
            }
            let about = dead[2] - from * dead[1];
            let virial = dead[3] - from * dead[0];
            load[0] += factor * dead[0];
            load[1] += factor * dead[1];
            load[2] += factor * (cosine * about - sine * virial);
        }
        let slope = match self.rotation {
            Rotation::Finite => sine,
            _ => theta,
        };
        let heel_gap = state[1] - from * slope;
        let [lifting, about_heel] = self.water.force(heel_gap, slope);
        load[1] += lifting;
        load[2] += cosine * (about_heel - from * lifting);
        for anchor in &self.anchors {
            let ahead = anchor.distance - from;
            let (_, pull) = anchor.pull(self.anchor_moves(corner, state, anchor));
            load[0] += pull[0];
            load[1] += pull[1];
            load[2] += ahead * (cosine * pull[1] - sine * pull[0]);
        }
        load
    }

    /// Acceleration of the place of the centroid in a ground that turns about the middle of the crack.
    fn mass_arm(&self, spin: f64) -> [f64; 2] {
        [
            -spin * self.centroid[1],
            spin * (self.centroid[0] - 0.5 * self.width),
        ]
    }

    /// How far the upper end of an anchor has moved along and across the crack.
    pub fn anchor_moves(&self, corner: Corner, state: &State, anchor: &Anchor) -> [f64; 2] {
        let ahead = anchor.distance - self.place(corner);
        let along = match self.rotation {
            Rotation::Finite => ahead * (state[2].cos() - 1.0),
            _ => 0.0,
        };
        [state[0] + along, state[1] + self.lift(ahead, state[2])]
    }

    /// Kinetic energy relative to the ground.
    pub fn kinetic_energy(&self, instant: &Instant, state: &State) -> f64 {
        let velocity = [state[3], state[4], state[5]];
        0.5 * dot(&velocity, &times(&instant.mass, &velocity))
    }
}

impl Instant {
    /// Acceleration of the coordinates under these reactions.
    pub fn acceleration(&self, reactions: &Vector) -> Vector {
        let total = [0, 1, 2].map(|i| {
            let contact: f64 = (0..3).map(|k| self.gradient[k][i] * reactions[k]).sum();
            self.load[i] + self.centrifugal[i] + contact
        });
        times(&self.inverse_mass, &total)
    }

    /// Work per time of the loads.
    pub fn power(&self, state: &State) -> f64 {
        dot(&self.load, &[state[3], state[4], state[5]])
    }

    /// Accelerations of slip, heel gap and toe gap under these reactions.
    pub fn contact_acceleration(&self, reactions: &Vector) -> Vector {
        [SLIP, HEEL, TOE].map(|i| self.free_acceleration[i] + dot(&self.compliance[i], reactions))
    }
}

/// Inverse of a symmetric matrix.
fn inverse(m: &[Vector; 3]) -> [Vector; 3] {
    let ([a, d, e], [_, b, f], [_, _, c]) = (m[0], m[1], m[2]);
    let first = [b * c - f * f, e * f - d * c, d * f - e * b];
    let determinant = a * first[0] + d * first[1] + e * first[2];
    let cross = d * e - a * f;
    [
        first,
        [first[1], a * c - e * e, cross],
        [first[2], cross, a * b - d * d],
    ]
    .map(|row| row.map(|cofactor| cofactor / determinant))
}
