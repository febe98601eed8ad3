//! The two blocks and their loads in contact coordinates.
//!
//! Each crack is given as a block of its own: of the lower one all that is above it, of the upper one what is above that.
//! The motion `q_1` of the lower block carries the upper one along; `q_2` is what the upper one moves relative to it. What
//! the lower block's motion is at the upper one's reference point is `P q_1`, and
//!
//! `M_l = M_1 - P^T M_2 P`, `f_l = f_1 - P^T f_2`
//!
//! are mass and loads of the lower block alone. So a bonded crack leaves the block of the other exactly, water in a crack
//! presses on both its faces, and each face carries the virtual water before it, none of which couples the two.

use super::super::block::{inverse, Affine, Block, BlockNumbers, Vector, HEEL, SLIP, TOE};
use super::solve::{Six, Square};
use crate::table::numbers;
use crate::Error;

numbers! {
    /// Where the upper block's reference point is, seen from that of all above the lower crack, along and across that.
    Place {
        /// Along the lower crack.
        along,
        /// Across it.
        across,
        /// Angle from the lower crack to the upper one, counter-clockwise (rad).
        turned,
    }
}

/// Two blocks in contact coordinates.
#[derive(Clone, Debug)]
pub struct Stack {
    /// All that is above the lower crack as one block, and what is above the upper one.
    pub(super) blocks: [Block; 2],
    /// `A`.
    pub(super) compliance: Square,
    /// `b`.
    pub(super) free: [Affine; 6],
    /// Mass of the lower block alone and of the upper one.
    mass: [[Vector; 3]; 2],
    /// `P`.
    carried: [Vector; 3],
    /// From contact coordinates to the motion of the reference point.
    motion: [[Vector; 3]; 2],
}

impl Stack {
    /// Work out what the walk needs.
    ///
    /// # Errors
    /// The lower block is left with no positive mass: the blocks are not those of one dam.
    pub fn new(lower: &BlockNumbers, upper: &BlockNumbers, place: &Place) -> Result<Self, Error> {
        let (sine, cosine) = place.turned.sin_cos();
        let carried = [
            [cosine, sine, sine * place.along - cosine * place.across],
            [-sine, cosine, cosine * place.along + sine * place.across],
            [0.0, 0.0, 1.0],
        ];
        let (whole, above) = (mass_of(lower), mass_of(upper));
        let own = minus(&whole, &through(&carried, &times(&above, &carried)));
        let diagonal = [own[0][0], own[1][1], own[2][2]];
        let beside = [own[0][1], own[0][2], own[1][2]];
        let definite =
            diagonal[0] > 0.0 && diagonal[0] * diagonal[1] > beside[0] * beside[0] && determinant(&own) > 0.0;
        if !definite {
            return Err(Error::Blocks("the lower block is left with no positive mass"));
        }
        let inverses = [inverse(diagonal, beside), {
            let beside = [above[0][1], above[0][2], above[1][2]];
            inverse([above[0][0], above[1][1], above[2][2]], beside)
        }];
        let rows = [rows_of(lower), rows_of(upper)];
        let carrying = times(&rows[1], &carried);
        let left = [minus3(&rows[0]), carrying];
        let mut compliance = [[0.0; 6]; 6];
        // The lower block moves both cracks, the upper one its own.
        for (i, row) in compliance.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = form(&left[i / 3][i % 3], &inverses[0], &left[j / 3][j % 3]);
                if i > 2 && j > 2 {
                    *value += form(&rows[1][i - 3], &inverses[1], &rows[1][j - 3]);
                }
            }
        }
        let free = free([lower, upper], &carried, &left, &inverses);
        Ok(Stack {
            blocks: [Block::new(lower), Block::new(upper)],
            compliance,
            free,
            mass: [own, mass_of(upper)],
            carried,
            motion: [motion_of(lower), motion_of(upper)],
        })
    }

    /// The same where the ground accelerates by up to this.
    pub(super) fn under(&self, peaks: [f64; 2]) -> Self {
        let blocks = self.blocks.each_ref();
        Stack {
            blocks: blocks.map(|block| block.under(block.inertia_force(peaks))),
            ..self.clone()
        }
    }

    /// Force that does work on a contact coordinate.
    pub(super) fn load(&self, i: usize) -> &Affine {
        &self.blocks[i / 3].generalised_force[i % 3]
    }

    /// Kinetic energy relative to the ground.
    pub(super) fn kinetic_energy(&self, velocity: &Six) -> f64 {
        let [lower, relative] = [0, 1].map(|crack| {
            let own = part(velocity, crack);
            [0, 1, 2].map(|i| dot(&self.motion[crack][i], &own))
        });
        let upper = [0, 1, 2].map(|i| relative[i] + dot(&self.carried[i], &lower));
        0.5 * (form(&lower, &self.mass[0], &lower) + form(&upper, &self.mass[1], &upper))
    }

    /// Rotations of the two blocks, or their rates.
    pub(super) fn rotations(&self, w: &Six) -> [f64; 2] {
        let [lower, relative] = [0, 1].map(|crack| self.blocks[crack].rotation(&part(w, crack)));
        [lower, lower + relative]
    }
}

/// What the blocks do without any force at the cracks, `left` being how the lower one moves each of their coordinates.
fn free(
    of: [&BlockNumbers; 2],
    carried: &[Vector; 3],
    left: &[[Vector; 3]; 2],
    inverses: &[[Vector; 3]; 2],
) -> [Affine; 6] {
    let [loads, above] = of.map(BlockNumbers::loads);
    let rows = rows_of(of[1]);
    let mut free = [Affine::default(); 6];
    for (i, value) in free.iter_mut().enumerate() {
        let part = |k: usize| {
            let passed = transposed(carried, &above[k]);
            let alone = [0, 1, 2].map(|c| passed[c] - loads[k][c]);
            let of_lower = form(&left[i / 3][i % 3], &inverses[0], &alone);
            if i > 2 {
                of_lower + form(&rows[i - 3], &inverses[1], &above[k])
            } else {
                of_lower
            }
        };
        *value = Affine {
            constant: part(0),
            horizontal: part(1),
            vertical: part(2),
        };
    }
    free
}

/// The coordinates of one crack.
pub(super) fn part(of: &Six, crack: usize) -> Vector {
    [SLIP, HEEL, TOE].map(|i| of[3 * crack + i])
}

fn rows_of(p: &BlockNumbers) -> [Vector; 3] {
    [
        [1.0, 0.0, p.height],
        [0.0, 1.0, -p.heel_distance],
        [0.0, 1.0, p.toe_distance],
    ]
}

/// The inverse of [`rows_of`].
fn motion_of(p: &BlockNumbers) -> [Vector; 3] {
    let width = p.heel_distance + p.toe_distance;
    let turning = [0.0, -1.0 / width, 1.0 / width];
    [
        [1.0, p.height / width, -p.height / width],
        [0.0, p.toe_distance / width, p.heel_distance / width],
        turning,
    ]
}

fn mass_of(p: &BlockNumbers) -> [Vector; 3] {
    let [d, e, f] = [
        p.coupling_horizontal_vertical,
        p.coupling_horizontal_rotation,
        p.coupling_vertical_rotation,
    ];
    [
        [p.mass_horizontal, d, e],
        [d, p.mass_vertical, f],
        [e, f, p.inertia],
    ]
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn form(a: &Vector, m: &[Vector; 3], b: &Vector) -> f64 {
    (0..3).map(|i| a[i] * dot(&m[i], b)).sum()
}

fn transposed(m: &[Vector; 3], v: &Vector) -> Vector {
    [0, 1, 2].map(|j| (0..3).map(|i| m[i][j] * v[i]).sum())
}

fn times(a: &[Vector; 3], b: &[Vector; 3]) -> [Vector; 3] {
    a.map(|row| transposed(b, &row))
}

/// `a^T b`.
fn through(a: &[Vector; 3], b: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|i| transposed(b, &[a[0][i], a[1][i], a[2][i]]))
}

fn minus(a: &[Vector; 3], b: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[i][j] - b[i][j]))
}

fn minus3(a: &[Vector; 3]) -> [Vector; 3] {
    a.map(|row| row.map(|value| -value))
}

fn determinant(m: &[Vector; 3]) -> f64 {
    let minor = |j: usize, k: usize| m[1][j] * m[2][k] - m[1][k] * m[2][j];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}
