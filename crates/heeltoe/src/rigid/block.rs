//! The block and its loads in contact coordinates.
//!
//! With q = (y, z, theta) the block obeys `M q'' = f + t T + n_h N_h + n_t N_t`, where
//! `t = (1, 0, H)`, `n_h = (0, 1, -B_h)`, `n_t = (0, 1, B_t)`. The kernel walks in the contact coordinates
//! `w = G q = (slip, heel gap, toe gap)`, in which a closed gap is exactly zero and stays so:
//!
//! `w'' = b + A (T, N_h, N_t)`, `A = G M^-1 G^T`, `b = G M^-1 f`.
//!
//! The load f is affine in the ground accelerations: `f = f_0 + f_h a_h + f_v a_v`.

/// Index of the slip, the heel gap and the toe gap in every vector of contact coordinates, and of the friction and
/// the two normal forces in every vector of reactions.
pub const SLIP: usize = 0;
pub const HEEL: usize = 1;
pub const TOE: usize = 2;

pub type Vector = [f64; 3];

/// A quantity that is affine in the horizontal and vertical ground acceleration.
#[derive(Clone, Copy, Debug, Default)]
pub struct Affine {
    pub constant: f64,
    pub horizontal: f64,
    pub vertical: f64,
}

impl Affine {
    /// Value under the ground acceleration (`horizontal`, `vertical`).
    #[inline]
    pub fn at(&self, ground: [f64; 2]) -> f64 {
        self.constant + self.horizontal * ground[0] + self.vertical * ground[1]
    }

    /// Change per unit of time where the ground acceleration changes at `rate`.
    #[inline]
    pub fn slope(&self, rate: [f64; 2]) -> f64 {
        self.horizontal * rate[0] + self.vertical * rate[1]
    }
}

/// Names of the numbers that describe a block, in the order the bindings take them (SI, per metre of dam).
///
/// The nine load numbers are the generalised forces (downstream, upward, counter-clockwise moment about the reference
/// point) that do not depend on the ground, and those per unit of horizontal and of vertical ground acceleration.
///
/// The last three are what couples the motions of the reference point: the water that moves horizontally with a block on
/// an inclined crack moves it both along and across. They are zero on a level one.
pub const BLOCK_FIELDS: [&str; FIELD_COUNT] = [
    "mass_horizontal",
    "mass_vertical",
    "inertia",
    "height",
    "heel_distance",
    "toe_distance",
    "static_horizontal",
    "static_vertical",
    "static_moment",
    "per_horizontal_horizontal",
    "per_horizontal_vertical",
    "per_horizontal_moment",
    "per_vertical_horizontal",
    "per_vertical_vertical",
    "per_vertical_moment",
    "friction_static",
    "friction_kinetic",
    "restitution",
    "coupling_horizontal_vertical",
    "coupling_horizontal_rotation",
    "coupling_vertical_rotation",
];
pub const FIELD_COUNT: usize = 21;

#[derive(Clone, Debug)]
pub struct Block {
    mass_horizontal: f64,
    mass_vertical: f64,
    inertia: f64,
    coupling: Vector,
    height: f64,
    heel_distance: f64,
    pub width: f64,
    inverse_width: f64,
    /// `A = G M^-1 G^T`.
    pub compliance: [Vector; 3],
    /// `b = G M^-1 f`.
    pub free_acceleration: [Affine; 3],
    /// `G^-T f`: the forces that do work on the contact coordinates.
    pub generalised_force: [Affine; 3],
    pub friction_static: f64,
    pub friction_kinetic: f64,
    pub restitution: f64,
    /// A force of the size of the loads: ties are told from rounding relative to it.
    pub force_scale: f64,
}

impl Block {
    /// Build from the numbers named by [`BLOCK_FIELDS`]. The caller has checked that they are finite, masses and
    /// inertia positive, the base of positive width, friction and restitution in range.
    pub fn new(p: &[f64; FIELD_COUNT]) -> Self {
        let [m_y, m_z, j, h, b_h, b_t] = [p[0], p[1], p[2], p[3], p[4], p[5]];
        let rows = [[1.0, 0.0, h], [0.0, 1.0, -b_h], [0.0, 1.0, b_t]];
        let coupling = [p[18], p[19], p[20]];
        let inverse_mass = inverse([m_y, m_z, j], coupling);
        let moved = |i: usize, c: usize| (0..3).map(|d| rows[i][d] * inverse_mass[d][c]).sum::<f64>();
        let compliance = [0, 1, 2].map(|i| rows.map(|row| (0..3).map(|c| moved(i, c) * row[c]).sum()));
        let width = b_h + b_t;
        let mut free = [[0.0; 3]; 3];
        let mut generalised = [[0.0; 3]; 3];
        for case in 0..3 {
            let f = [p[6 + 3 * case], p[7 + 3 * case], p[8 + 3 * case]];
            for (i, free) in free.iter_mut().enumerate() {
                free[case] = (0..3).map(|c| moved(i, c) * f[c]).sum();
            }
            // f.q' = f_y s' + f_z z' + (m - H f_y) theta', with z' and theta' from the two gaps.
            let turning = (f[2] - h * f[0]) / width;
            generalised[SLIP][case] = f[0];
            generalised[HEEL][case] = f[1] * b_t / width - turning;
            generalised[TOE][case] = f[1] * b_h / width + turning;
        }
        let affine = |c: &[f64; 3]| Affine {
            constant: c[0],
            horizontal: c[1],
            vertical: c[2],
        };
        Block {
            mass_horizontal: m_y,
            mass_vertical: m_z,
            inertia: j,
            coupling,
            height: h,
            heel_distance: b_h,
            width,
            inverse_width: 1.0 / width,
            compliance,
            free_acceleration: [affine(&free[0]), affine(&free[1]), affine(&free[2])],
            generalised_force: [
                affine(&generalised[0]),
                affine(&generalised[1]),
                affine(&generalised[2]),
            ],
            friction_static: p[15],
            friction_kinetic: p[16],
            restitution: p[17],
            force_scale: p[6].abs() + p[7].abs() + p[8].abs() / width,
        }
    }

    /// The same block with the compliance and the free acceleration of a moment at which they are different.
    pub fn at(&self, compliance: [Vector; 3], free_acceleration: [Affine; 3]) -> Self {
        Block {
            compliance,
            free_acceleration,
            ..self.clone()
        }
    }

    /// Mass that moves vertically (concrete alone).
    pub fn mass(&self) -> f64 {
        self.mass_vertical
    }

    /// An acceleration of the size of the loads.
    pub fn acceleration_scale(&self) -> f64 {
        self.force_scale / self.mass_vertical
    }

    /// Rotation (counter-clockwise) that goes with two gaps; with two gap velocities, the rate of rotation.
    pub fn rotation(&self, w: &Vector) -> f64 {
        (w[TOE] - w[HEEL]) * self.inverse_width
    }

    /// Kinetic energy relative to the ground.
    pub fn kinetic_energy(&self, velocity: &Vector) -> f64 {
        let turning = self.rotation(velocity);
        let downstream = velocity[SLIP] - self.height * turning;
        let upward = velocity[HEEL] + self.heel_distance * turning;
        0.5 * (self.mass_horizontal * downstream * downstream
            + self.mass_vertical * upward * upward
            + self.inertia * turning * turning)
            + self.coupling[0] * downstream * upward
            + self.coupling[1] * downstream * turning
            + self.coupling[2] * upward * turning
    }
}

/// Inverse of the mass matrix with this diagonal and these couplings (1, 2), (1, 3) and (2, 3).
fn inverse(diagonal: Vector, coupling: Vector) -> [Vector; 3] {
    let ([a, b, c], [d, e, f]) = (diagonal, coupling);
    if coupling == [0.0; 3] {
        return [[1.0 / a, 0.0, 0.0], [0.0, 1.0 / b, 0.0], [0.0, 0.0, 1.0 / c]];
    }
    let first = [b * c - f * f, e * f - d * c, d * f - e * b];
    let determinant = a * first[0] + d * first[1] + e * first[2];
    let [x, y, z] = first;
    [
        [x, y, z],
        [y, a * c - e * e, d * e - a * f],
        [z, d * e - a * f, a * b - d * d],
    ]
    .map(|row| row.map(|cofactor| cofactor / determinant))
}
