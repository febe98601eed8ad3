//! The block at one moment, under loads that change as it moves.
//!
//! Coordinates are the displacement (X, Z) along and across the crack of one corner c, heel or toe, and the rotation
//! theta. A point of the block at rho from that corner moves with `(X', Z') + theta' J`, `J = R'(theta) rho`; with p the
//! J of the centroid, k = -R rho the acceleration per theta'^2, and e the horizontal:
//!
//! `M = m [1 0 p1; 0 1 p2; p1 p2 p.p] + J_c + m_w r r^T`, `r = (e1, e2, e.J_w)`,
//! `M q'' = Q - theta'^2 (m (k, p.k) + m_w r (e.k_w)) + G^T (T, N_h, N_t)`.
//!
//! The rows of G are the gradients of slip, heel gap and toe gap; the slip is that of the corner c. As in
//! [`super::super::Block`] this becomes `w'' = b + A (T, N_h, N_t)`, now with A and b of the moment.
//!
//! With small rotations J, G and M are those of theta = 0. P-Delta adds to them the moment of the weight that changes with
//! the rotation, `-theta rho . W`.

use super::super::block::{inverse, Vector, HEEL, SLIP, TOE};
use super::super::mode::Corner;
use super::block::{Rotation, TurningBlock};
use super::shaking::Ground;
use super::step::{State, SIZE};

/// The block at one moment: masses, loads, and what is needed to solve for the reactions.
#[derive(Clone)]
pub(super) struct Instant {
    inverse_mass: [Vector; 3],
    mass: [Vector; 3],
    gradient: [Vector; 3],
    /// Applied loads with the ground's inertia force, without the velocity terms.
    load: Vector,
    pub compliance: [Vector; 3],
    pub free_acceleration: Vector,
    /// Velocity terms of the equations of motion, on the side of the loads.
    centrifugal: Vector,
    /// Slope from which the gaps count.
    pub slope: f64,
    /// What wear adds to the acceleration off a slope per friction.
    wear: f64,
}

/// A block whose loads and geometry stay as they are: at every moment the same but for the ground.
pub(super) struct Still {
    instant: Instant,
    /// Changes of loads and free accelerations per acceleration of the ground, across and up.
    per_ground: [[Vector; 2]; 2],
}

impl Still {
    pub(super) fn of(block: &TurningBlock, corner: Corner) -> Self {
        let at = |ground: Ground| block.at(corner, &[0.0; SIZE], &ground);
        let instant = at([0.0; 3]);
        let per_ground = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|ground| {
            let there = at(ground);
            let pairs = [
                (there.load, instant.load),
                (there.free_acceleration, instant.free_acceleration),
            ];
            pairs.map(|(there, here)| std::array::from_fn(|i| there[i] - here[i]))
        });
        Still { instant, per_ground }
    }

    pub(super) fn under(&self, ground: &Ground) -> Instant {
        let (_, free_acceleration, load) = self.felt(ground);
        Instant {
            free_acceleration,
            load,
            ..self.instant.clone()
        }
    }

    /// Compliance, free accelerations and loads.
    pub(super) fn felt(&self, ground: &Ground) -> (&[Vector; 3], Vector, Vector) {
        let (mut free, mut load) = (self.instant.free_acceleration, self.instant.load);
        for ([per_load, per_free], ground) in self.per_ground.iter().zip(ground) {
            for i in 0..3 {
                load[i] += per_load[i] * ground;
                free[i] += per_free[i] * ground;
            }
        }
        (&self.instant.compliance, free, load)
    }
}

/// What the gaps of a rough crack count from.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Slope {
    /// Rise over slip.
    pub slope: f64,
    /// Acceleration of the slope, away from the block, per friction that wears it.
    pub wear: f64,
}

/// How the block is turned, seen from a corner: sine and cosine, J of the centroid and of the water, `r`.
struct Turned {
    sine: f64,
    cosine: f64,
    centroid: [f64; 2],
    water: [f64; 2],
    driven: Vector,
}

/// What moves the block, but for contact.
struct Driven {
    turned: Turned,
    mass: [Vector; 3],
    load: Vector,
    centrifugal: Vector,
}

fn inverted(mass: &[Vector; 3]) -> [Vector; 3] {
    let [[a, d, e], [_, b, f], [_, _, c]] = *mass;
    inverse([a, b, c], [d, e, f])
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn times(m: &[Vector; 3], v: &Vector) -> Vector {
    [dot(&m[0], v), dot(&m[1], v), dot(&m[2], v)]
}

impl TurningBlock {
    /// Masses, loads and reactions' equations at a state.
    pub(super) fn at(&self, corner: Corner, state: &State, ground: &Ground) -> Instant {
        let rate = state[5];
        let Driven {
            turned,
            mass,
            load,
            centrifugal,
        } = self.driven(corner, state, ground);
        let ahead = self.ahead(corner);
        let other = [0.0, 1.0, ahead * turned.cosine];
        let own = [0.0, 1.0, 0.0];
        let gradient = match corner {
            Corner::Heel => [[1.0, 0.0, 0.0], own, other],
            Corner::Toe => [[1.0, 0.0, 0.0], other, own],
        };
        let inverse_mass = inverted(&mass);
        let free = times(&inverse_mass, &sum(&load, &centrifugal));
        let mut compliance = [[0.0; 3]; 3];
        for i in 0..3 {
            let moved = times(&inverse_mass, &gradient[i]);
            for k in 0..3 {
                compliance[i][k] = dot(&moved, &gradient[k]);
            }
        }
        let mut free_acceleration = gradient.map(|row| dot(&row, &free));
        if self.rotation == Rotation::Finite {
            free_acceleration[corner.other().gap()] -= ahead * turned.sine * rate * rate;
        }
        Instant {
            inverse_mass,
            mass,
            gradient,
            load,
            compliance,
            free_acceleration,
            centrifugal,
            slope: 0.0,
            wear: 0.0,
        }
    }

    /// Acceleration of a rotation about a corner that stays where it is, and the moment of the loads about it.
    pub(super) fn swing(&self, corner: Corner, state: &State, ground: &Ground) -> [f64; 2] {
        let driven = self.driven(corner, state, ground);
        let moment = driven.load[2];
        [(moment + driven.centrifugal[2]) / driven.mass[2][2], moment]
    }

    /// Acceleration of the coordinates of a block in the air, and its loads.
    pub(super) fn flight(&self, corner: Corner, state: &State, ground: &Ground) -> [Vector; 2] {
        let Driven {
            mass,
            load,
            centrifugal,
            ..
        } = self.driven(corner, state, ground);
        [times(&inverted(&mass), &sum(&load, &centrifugal)), load]
    }

    /// Inlined, so that what is not asked for is not worked out.
    #[inline(always)]
    fn driven(&self, corner: Corner, state: &State, ground: &Ground) -> Driven {
        let turned = self.turned_about(corner, state[2]);
        Driven {
            mass: self.mass_matrix(&turned),
            load: self.load(corner, state, ground, &turned),
            centrifugal: match self.rotation {
                Rotation::Finite => self.centrifugal(&turned, state[5]),
                _ => [0.0; 3],
            },
            turned,
        }
    }

    fn turned_about(&self, corner: Corner, theta: f64) -> Turned {
        let from = self.place(corner);
        let [sine, cosine] = self.turned(theta);
        let lever = |[along, d]: [f64; 2]| {
            [
                -(along - from) * sine - d * cosine,
                (along - from) * cosine - d * sine,
            ]
        };
        let (centroid, water) = (lever(self.centroid), lever(self.water_place));
        let e = self.horizontal;
        Turned {
            sine,
            cosine,
            centroid,
            water,
            driven: [e[0], e[1], e[0] * water[0] + e[1] * water[1]],
        }
    }

    fn mass_matrix(&self, turned: &Turned) -> [Vector; 3] {
        let (m, p, r) = (self.mass, turned.centroid, turned.driven);
        let mut mass = [
            [m, 0.0, m * p[0]],
            [0.0, m, m * p[1]],
            [m * p[0], m * p[1], m * (p[0] * p[0] + p[1] * p[1]) + self.inertia],
        ];
        for i in 0..3 {
            for k in 0..3 {
                mass[i][k] += self.water_mass * r[i] * r[k];
            }
        }
        mass
    }

    fn centrifugal(&self, turned: &Turned, rate: f64) -> Vector {
        let (p, q, r, e) = (turned.centroid, turned.water, turned.driven, self.horizontal);
        // R rho is J turned back by a right angle.
        let k = [-p[1], p[0]];
        let kw = e[0] * -q[1] + e[1] * q[0];
        let square = rate * rate;
        let own = [k[0], k[1], p[0] * k[0] + p[1] * k[1]];
        [0, 1, 2].map(|i| -square * (self.mass * own[i] + self.water_mass * r[i] * kw))
    }

    /// All loads and the ground's inertia force, as they are at this state.
    fn load(&self, corner: Corner, state: &State, ground: &Ground, turned: &Turned) -> Vector {
        let (sine, cosine) = (turned.sine, turned.cosine);
        let from = self.place(corner);
        let mut load = self.inertia_force(from, state[2], ground, turned);
        for (dead, factor) in [(&self.dead, 1.0), (&self.per_vertical, ground[1])] {
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
            _ => state[2],
        };
        let heel_gap = state[1] - from * slope;
        let [lifting, about_heel] = self.water.force(heel_gap, slope);
        load[1] += lifting;
        load[2] += cosine * (about_heel - from * lifting);
        for anchor in &self.anchors {
            let ahead = anchor.place - from;
            let pull = anchor.pull(self.anchor_moves(corner, state, anchor));
            load[0] += pull[0];
            load[1] += pull[1];
            load[2] += ahead * (cosine * pull[1] - sine * pull[0]);
        }
        load
    }

    /// Weight and the ground's inertia force act on the centroid; the water is moved sideways only.
    fn inertia_force(&self, from: f64, theta: f64, ground: &Ground, turned: &Turned) -> Vector {
        let (p, r) = (turned.centroid, turned.driven);
        let [e1, e2] = self.horizontal;
        let [horizontal, up, spin] = *ground;
        let down = self.gravity + up;
        // The place of the centroid in a ground that turns about the middle of the crack accelerates.
        let middle = 0.5 * self.width;
        let swing = [-spin * self.centroid[1], spin * (self.centroid[0] - middle)];
        let force = [
            -self.mass * (horizontal * e1 - down * e2 + swing[0]),
            -self.mass * (horizontal * e2 + down * e1 + swing[1]),
        ];
        let mut load = [
            force[0],
            force[1],
            force[0] * p[0] + force[1] * p[1] - self.inertia * spin,
        ];
        let [along, across] = [self.water_place[0] - middle, self.water_place[1]];
        let driven = horizontal + spin * (e2 * along - e1 * across);
        for i in 0..3 {
            load[i] -= self.water_mass * r[i] * driven;
        }
        if self.rotation == Rotation::PDelta {
            let (b, d) = (self.centroid[0] - from, self.centroid[1]);
            load[2] -= theta * self.mass * down * (b * e2 - d * e1);
        }
        load
    }
}

impl Instant {
    /// Acceleration of the coordinates under these reactions.
    pub(super) fn acceleration(&self, reactions: &Vector) -> Vector {
        let total = [0, 1, 2].map(|i| {
            let contact: f64 = (0..3).map(|k| self.gradient[k][i] * reactions[k]).sum();
            self.load[i] + self.centrifugal[i] + contact
        });
        let mut acceleration = times(&self.inverse_mass, &total);
        if self.wear != 0.0 {
            acceleration[1] += self.wear * reactions[SLIP];
        }
        acceleration
    }

    /// The same with the gaps counted from a slope: `Z = X tan i + Z*`, `M* = L^T M L`, `Q* = L^T Q`, the friction that
    /// does the work of the slip `T* = T + tan i (N_h + N_t)`.
    pub(super) fn on(mut self, Slope { slope: k, wear }: Slope) -> Self {
        if k != 0.0 {
            for j in 0..3 {
                self.mass[0][j] += k * self.mass[1][j];
                self.inverse_mass[1][j] -= k * self.inverse_mass[0][j];
            }
            for i in 0..3 {
                self.mass[i][0] += k * self.mass[i][1];
                self.inverse_mass[i][1] -= k * self.inverse_mass[i][0];
            }
            self.load[0] += k * self.load[1];
            self.centrifugal[0] += k * self.centrifugal[1];
            for gap in [HEEL, TOE] {
                self.free_acceleration[gap] -= k * self.free_acceleration[SLIP];
                for j in 0..3 {
                    self.compliance[gap][j] -= k * self.compliance[SLIP][j];
                }
            }
            for i in 0..3 {
                for gap in [HEEL, TOE] {
                    self.compliance[i][gap] -= k * self.compliance[i][SLIP];
                }
            }
        }
        for gap in [HEEL, TOE] {
            self.compliance[gap][SLIP] += wear;
        }
        (self.slope, self.wear) = (k, wear);
        self
    }

    /// Accelerations of slip, heel gap and toe gap under these reactions.
    pub(super) fn contact_acceleration(&self, reactions: &Vector) -> Vector {
        [SLIP, HEEL, TOE].map(|i| self.free_acceleration[i] + dot(&self.compliance[i], reactions))
    }

    /// What the loads push along the crack.
    pub(super) fn pushed(&self) -> f64 {
        self.load[0]
    }

    /// Work per time of the loads.
    pub(super) fn power(&self, state: &State) -> f64 {
        dot(&self.load, &[state[3], state[4], state[5]])
    }

    /// Kinetic energy relative to the ground.
    pub(super) fn kinetic_energy(&self, state: &State) -> f64 {
        let velocity = [state[3], state[4], state[5]];
        0.5 * dot(&velocity, &times(&self.mass, &velocity))
    }
}
