//! The block and its loads in contact coordinates.
//!
//! With q = (y, z, theta) the block obeys `M q'' = f + t T + n_h N_h + n_t N_t`, where
//! `t = (1, 0, H)`, `n_h = (0, 1, -B_h)`, `n_t = (0, 1, B_t)`. The kernel walks in the contact coordinates
//! `w = G q = (slip, heel gap, toe gap)`, in which a closed gap is exactly zero and stays so:
//!
//! `w'' = b + A (T, N_h, N_t)`, `A = G M^-1 G^T`, `b = G M^-1 f`.
//!
//! The load f is affine in the ground accelerations: `f = f_0 + f_h a_h + f_v a_v`.

use crate::friction::Strength;
use crate::table::numbers;

/// Index of the slip, the heel gap and the toe gap in every vector of contact coordinates, and of the friction and
/// the two normal forces in every vector of reactions.
pub(crate) const SLIP: usize = 0;
pub(crate) const HEEL: usize = 1;
pub(crate) const TOE: usize = 2;

/// Slip, heel gap and toe gap, or friction and the normal forces at heel and toe.
pub type Vector = [f64; 3];

/// A quantity that is affine in the horizontal and vertical ground acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Affine {
    pub constant: f64,
    pub horizontal: f64,
    pub vertical: f64,
}

impl Affine {
    /// Three of them, from what does not depend on the ground, and what goes with either acceleration.
    fn of([constant, horizontal, vertical]: [Vector; 3]) -> [Affine; 3] {
        [SLIP, HEEL, TOE].map(|i| Affine {
            constant: constant[i],
            horizontal: horizontal[i],
            vertical: vertical[i],
        })
    }

    /// So many times this.
    pub fn times(&self, factor: f64) -> Self {
        Affine {
            constant: factor * self.constant,
            horizontal: factor * self.horizontal,
            vertical: factor * self.vertical,
        }
    }

    /// This, less something that does not depend on the ground.
    pub fn less(&self, constant: f64) -> Self {
        Affine {
            constant: self.constant - constant,
            ..*self
        }
    }

    /// Value under the ground acceleration (`horizontal`, `vertical`).
    #[inline]
    pub fn at(&self, ground: [f64; 2]) -> f64 {
        self.constant + self.horizontal * ground[0] + self.vertical * ground[1]
    }

    /// As [`Self::at`]; on a LEVEL ground the vertical one is zero.
    #[inline(always)]
    pub fn on<const LEVEL: bool>(&self, ground: [f64; 2]) -> f64 {
        if LEVEL {
            self.constant + self.horizontal * ground[0]
        } else {
            self.at(ground)
        }
    }

    /// As [`Self::slope`]; on a LEVEL ground the vertical acceleration does not change.
    #[inline(always)]
    pub fn rate<const LEVEL: bool>(&self, rate: [f64; 2]) -> f64 {
        if LEVEL {
            self.horizontal * rate[0]
        } else {
            self.slope(rate)
        }
    }

    /// The smallest value where each ground acceleration may be anywhere between two.
    #[inline]
    pub fn least(&self, [horizontal, vertical]: [[f64; 2]; 2]) -> f64 {
        let lesser = |per: f64, [a, b]: [f64; 2]| (per * a).min(per * b);
        self.constant + lesser(self.horizontal, horizontal) + lesser(self.vertical, vertical)
    }

    /// No value is larger, without its sign, where neither ground acceleration exceeds its peak.
    #[inline]
    pub fn largest(&self, [horizontal, vertical]: [f64; 2]) -> f64 {
        self.constant.abs() + self.horizontal.abs() * horizontal + self.vertical.abs() * vertical
    }

    /// Change per unit of time where the ground acceleration changes at `rate`.
    #[inline]
    pub fn slope(&self, rate: [f64; 2]) -> f64 {
        self.horizontal * rate[0] + self.vertical * rate[1]
    }
}

numbers! {
    /// The numbers that describe a block, SI, per metre of dam.
    ///
    /// Loads are generalised forces: downstream, upward, and the moment about the reference point, counter-clockwise. The
    /// static ones do not depend on the ground; the others are per unit of horizontal and of vertical ground acceleration.
    BlockNumbers {
        /// Mass that moves along the crack, with that of the water.
        mass_horizontal,
        /// Mass that moves across the crack.
        mass_vertical,
        /// Moment of inertia about the reference point.
        inertia,
        /// Height of the reference point over the crack.
        height,
        /// Distance of the heel upstream of the reference point.
        heel_distance,
        /// Distance of the toe downstream of the reference point.
        toe_distance,
        /// Static load.
        static_horizontal,
        /// Static load.
        static_vertical,
        /// Static load.
        static_moment,
        /// Load per horizontal acceleration.
        per_horizontal_horizontal,
        /// Load per horizontal acceleration.
        per_horizontal_vertical,
        /// Load per horizontal acceleration.
        per_horizontal_moment,
        /// Load per vertical acceleration.
        per_vertical_horizontal,
        /// Load per vertical acceleration.
        per_vertical_vertical,
        /// Load per vertical acceleration.
        per_vertical_moment,
        /// Coefficient of friction of a base that sticks.
        friction_static,
        /// Coefficient of friction of a base that slips.
        friction_kinetic,
        /// Newton's restitution of an impact.
        restitution,
        /// What couples the motions of the reference point: the water that moves horizontally with a block on an inclined
        /// crack moves it both along and across. Zero on a level one, as are the next two.
        coupling_horizontal_vertical,
        /// Coupling of the motion along the crack with the rotation.
        coupling_horizontal_rotation,
        /// Coupling of the motion across the crack with the rotation.
        coupling_vertical_rotation,
        /// Part of the velocities of the corners that an impact takes beyond its law, where both corners touch.
        rocking_loss,
    }
}

impl BlockNumbers {
    /// Static loads, and those per horizontal and per vertical acceleration of the ground.
    pub(super) fn loads(&self) -> [Vector; 3] {
        [
            [self.static_horizontal, self.static_vertical, self.static_moment],
            [
                self.per_horizontal_horizontal,
                self.per_horizontal_vertical,
                self.per_horizontal_moment,
            ],
            [
                self.per_vertical_horizontal,
                self.per_vertical_vertical,
                self.per_vertical_moment,
            ],
        ]
    }
}

/// A block in contact coordinates.
#[derive(Clone, Debug)]
pub struct Block {
    mass_horizontal: f64,
    mass_vertical: f64,
    inertia: f64,
    coupling: Vector,
    height: f64,
    heel_distance: f64,
    pub(super) width: f64,
    inverse_width: f64,
    /// `A = G M^-1 G^T`.
    pub(super) compliance: [Vector; 3],
    /// `b = G M^-1 f`.
    pub(super) free_acceleration: [Affine; 3],
    /// Size of the terms of `b` at least, where it is known as their sum alone, in which they may cancel.
    pub(super) free_terms: Vector,
    /// `G^-T f`: the forces that do work on the contact coordinates.
    pub(super) generalised_force: [Affine; 3],
    pub(super) friction_static: f64,
    pub(super) friction_kinetic: f64,
    /// What friction bears without a normal force, at rest and sliding.
    pub(super) cohesion: [f64; 2],
    /// On a slope: what is added to the coefficients of friction downstream, and taken off them upstream.
    lean: [f64; 2],
    /// Slope of what the gaps count from, over the slip.
    slope: f64,
    pub(super) restitution: f64,
    pub(super) rocking_loss: f64,
    /// A force of the size of the loads: ties are told from rounding relative to it.
    pub(super) force_scale: f64,
}

impl Block {
    /// Work out what the walk needs of a block. The caller has checked that the numbers are finite, masses and inertia
    /// positive, the base of positive width, friction and restitution in range.
    pub fn new(p: &BlockNumbers) -> Self {
        let (height, heel, toe) = (p.height, p.heel_distance, p.toe_distance);
        let rows = [[1.0, 0.0, height], [0.0, 1.0, -heel], [0.0, 1.0, toe]];
        let coupling = [
            p.coupling_horizontal_vertical,
            p.coupling_horizontal_rotation,
            p.coupling_vertical_rotation,
        ];
        let masses = [p.mass_horizontal, p.mass_vertical, p.inertia];
        let inverse_mass = if coupling == [0.0; 3] {
            let [a, b, c] = masses.map(|mass| 1.0 / mass);
            [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]]
        } else {
            inverse(masses, coupling)
        };
        let moved = |i: usize, c: usize| (0..3).map(|d| rows[i][d] * inverse_mass[d][c]).sum::<f64>();
        let compliance = [0, 1, 2].map(|i| rows.map(|row| (0..3).map(|c| moved(i, c) * row[c]).sum()));
        let width = heel + toe;
        let loads = p.loads();
        let free = loads.map(|f| [0, 1, 2].map(|i| (0..3).map(|c| moved(i, c) * f[c]).sum()));
        // f.q' = f_y s' + f_z z' + (m - H f_y) theta', with z' and theta' from the two gaps.
        let generalised = loads.map(|f| {
            let turning = (f[2] - height * f[0]) / width;
            [f[0], f[1] * toe / width - turning, f[1] * heel / width + turning]
        });
        Block {
            mass_horizontal: p.mass_horizontal,
            mass_vertical: p.mass_vertical,
            inertia: p.inertia,
            coupling,
            height,
            heel_distance: heel,
            width,
            inverse_width: 1.0 / width,
            compliance,
            free_acceleration: Affine::of(free),
            free_terms: [0.0; 3],
            generalised_force: Affine::of(generalised),
            friction_static: p.friction_static,
            friction_kinetic: p.friction_kinetic,
            cohesion: [0.0; 2],
            lean: [0.0; 2],
            slope: 0.0,
            restitution: p.restitution,
            rocking_loss: p.rocking_loss,
            force_scale: p.static_horizontal.abs() + p.static_vertical.abs() + p.static_moment.abs() / width,
        }
    }

    /// The same block where forces may be as large as this: of a block that all but floats, the loads that are left say
    /// little of the rounding in what moves it.
    pub(super) fn under(&self, force: f64) -> Self {
        Block {
            force_scale: self.force_scale.max(force),
            ..self.clone()
        }
    }

    /// The same block with the compliance and the free acceleration of a moment at which they are different.
    pub(super) fn at(&self, compliance: [Vector; 3], free_acceleration: [Affine; 3]) -> Self {
        Block {
            compliance,
            free_acceleration,
            free_terms: [0, 1, 2].map(|i| compliance[i][i] * self.force_scale),
            ..self.clone()
        }
    }

    /// The same block with the friction of a moment.
    pub(super) fn rubbing(&self, strength: &Strength) -> Self {
        let [friction_static, friction_kinetic] = strength.coefficient;
        Block {
            friction_static,
            friction_kinetic,
            cohesion: strength.constant,
            lean: strength.lean,
            ..self.clone()
        }
    }

    /// The same block, its gaps counted from a slope.
    pub(super) fn on_slope(&self, slope: f64) -> Self {
        Block {
            slope,
            ..self.clone()
        }
    }

    /// Coefficient of friction that keeps it from slipping this way, 1 or -1.
    pub(super) fn friction_static_towards(&self, way: f64) -> f64 {
        self.friction_static + way * self.lean[0]
    }

    /// Coefficient of friction as it slips this way.
    pub(super) fn friction_kinetic_towards(&self, way: f64) -> f64 {
        self.friction_kinetic + way * self.lean[1]
    }

    /// What friction bears.
    pub(super) fn strength(&self) -> Strength {
        Strength {
            coefficient: [self.friction_static, self.friction_kinetic],
            constant: self.cohesion,
            lean: self.lean,
        }
    }

    /// Whether friction changes the whole normal force of a block that slides.
    pub(super) fn couples(&self) -> bool {
        self.coupling[0] != 0.0
    }

    /// Inertia of a slip on both corners in the directions of slip, heel gap and toe gap: `M_w (1, 0, 0)`, where nothing
    /// couples the motion along the crack with that across it.
    pub(super) fn masses_of_slip(&self) -> Vector {
        let turning = (self.mass_horizontal * self.height - self.coupling[1]) * self.inverse_width;
        [self.mass_horizontal, turning, -turning]
    }

    /// Mass that moves vertically (concrete alone).
    pub(super) fn mass(&self) -> f64 {
        self.mass_vertical
    }

    /// The ground's inertia force under these accelerations.
    pub(super) fn inertia_force(&self, [horizontal, vertical]: [f64; 2]) -> f64 {
        (self.mass_horizontal * horizontal).max(self.mass_vertical * vertical)
    }

    /// Whether the whole normal force stays as it is while the block slides on a ground whose acceleration changes at
    /// `rate`: neither that nor friction has a part in it.
    pub(super) fn presses_evenly(&self, rate: [f64; 2]) -> bool {
        let [heel, toe] = [HEEL, TOE].map(|gap| self.generalised_force[gap].slope(rate));
        self.coupling[0] == 0.0 && heel + toe == 0.0
    }

    /// A velocity of the size of sqrt(g' B): g' the vertical force per mass, B the width.
    pub(super) fn velocity_scale(&self) -> f64 {
        let g = -self.generalised_force[HEEL].constant - self.generalised_force[TOE].constant;
        (g.abs() / self.mass() * self.width).sqrt()
    }

    /// An acceleration of the size of the loads.
    pub(super) fn acceleration_scale(&self) -> f64 {
        self.force_scale / self.mass_vertical
    }

    /// Rotation (counter-clockwise) that goes with two gaps; with two gap velocities, the rate of rotation.
    pub(super) fn rotation(&self, w: &Vector) -> f64 {
        (w[TOE] - w[HEEL]) * self.inverse_width
    }

    /// Kinetic energy relative to the ground.
    pub(super) fn kinetic_energy(&self, velocity: &Vector) -> f64 {
        let turning = self.rotation(velocity);
        let downstream = velocity[SLIP] - self.height * turning;
        let upward = velocity[HEEL] + self.slope * velocity[SLIP] + self.heel_distance * turning;
        0.5 * (self.mass_horizontal * downstream * downstream
            + self.mass_vertical * upward * upward
            + self.inertia * turning * turning)
            + self.coupling[0] * downstream * upward
            + self.coupling[1] * downstream * turning
            + self.coupling[2] * upward * turning
    }
}

/// Inverse of the symmetric matrix with this diagonal and these terms (1, 2), (1, 3) and (2, 3) beside it.
pub(super) fn inverse([a, b, c]: Vector, [d, e, f]: Vector) -> [Vector; 3] {
    let [x, y, z] = [b * c - f * f, e * f - d * c, d * f - e * b];
    let determinant = a * x + d * y + e * z;
    let cross = d * e - a * f;
    [[x, y, z], [y, a * c - e * e, cross], [z, cross, a * b - d * d]]
        .map(|row| row.map(|cofactor| cofactor / determinant))
}
