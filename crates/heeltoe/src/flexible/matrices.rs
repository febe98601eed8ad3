//! Vibration modes of a body that is given by its mass and its stiffness.
//!
//! With `M = L L^T` the modes of `K phi = omega^2 M phi` are `phi = L^-T y`, with the eigenvectors `y` of the symmetric
//! `L^-1 K L^-T`. Jacobi's rotations find them (Golub and Van Loan, Matrix Computations, 4th edition, 8.5): a body of some
//! hundred freedoms takes seconds; a larger one is reduced by other means, and its modes are given.

use super::body::Modes;
use crate::error::Error;

/// Sweeps of rotations at most; some ten are enough.
const SWEEPS: usize = 60;
/// Numbers that differ by less than this part of the largest are the same.
const SAME: f64 = 1e-9;

/// A body by its matrices over `n` freedoms.
#[derive(Clone, Copy, Debug)]
pub struct Matrices<'a> {
    /// Mass, `n x n`, symmetric and positive definite, row by row (kg).
    pub mass: &'a [f64],
    /// Stiffness, `n x n`, symmetric, row by row (N/m); a body that nothing holds moves without any.
    pub stiffness: &'a [f64],
    /// Static load on each freedom (N).
    pub load: &'a [f64],
    /// How far each freedom moves with the ground, where that moves by one horizontally and vertically.
    pub ground: [&'a [f64]; 2],
    /// Freedoms of the crack nodes: along the crack, then across it.
    pub crack: &'a [usize],
    /// Where the crack nodes are at the start: along the crack, then across it (m).
    pub position: &'a [f64],
    /// Share of critical damping of every mode.
    pub damping: f64,
}

/// The modes of a body, from the lowest up, see [`Modes::from_matrices`].
#[derive(Clone, Debug)]
pub struct MatrixModes {
    omega_squared: Vec<f64>,
    damping: Vec<f64>,
    load: Vec<f64>,
    participation: [Vec<f64>; 2],
    start: Vec<f64>,
    shapes: Vec<f64>,
    position: Vec<f64>,
}

impl MatrixModes {
    /// What [`super::ReducedBody::new`] takes; dashpots, water and a boundary are set there.
    pub fn modes(&self) -> Modes<'_> {
        Modes {
            omega_squared: &self.omega_squared,
            damping: [&self.damping; 2],
            load: &self.load,
            participation: [&self.participation[0], &self.participation[1]],
            start: &self.start,
            shapes: &self.shapes,
            position: &self.position,
            directions: 2,
            dampers: &[],
            damper_signs: &[],
            wet: &[],
            boundary: &[],
        }
    }
}

impl Modes<'_> {
    /// Find the lowest `count` modes of a body, all if it has fewer. They start from zero: the crack takes the load.
    ///
    /// # Errors
    /// [`Error::Body`] where arrays do not agree, numbers are not finite, a matrix is not symmetric, the mass is not
    /// positive, or the stiffness is negative.
    pub fn from_matrices(body: &Matrices, count: usize) -> Result<MatrixModes, Error> {
        let size = body.load.len();
        check(body, size)?;
        let lower = cholesky(body.mass, size)
            .ok_or(Error::Body("the mass of a body must be positive in every motion"))?;
        let (values, vectors) = eigen(reduced(&lower, body.stiffness, size), size);
        let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        if values.iter().any(|value| *value < -SAME * largest) {
            return Err(Error::Body(
                "the stiffness of a body must not be negative in any motion",
            ));
        }
        let mut order: Vec<usize> = (0..size).collect();
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        order.truncate(count);
        // Rounding leaves a little of the zero of a motion without stiffness.
        let clean = |value: f64| if value < SAME * largest { 0.0 } else { value };
        let omega_squared: Vec<f64> = order.iter().map(|k| clean(values[*k])).collect();
        let shapes: Vec<Vec<f64>> = order
            .iter()
            .map(|k| {
                let mut shape: Vec<f64> = (0..size).map(|row| vectors[row * size + k]).collect();
                solve_upper(&lower, &mut shape);
                shape
            })
            .collect();
        let along = |vector: &[f64]| -> Vec<f64> { shapes.iter().map(|shape| dot(shape, vector)).collect() };
        let moved =
            |way: &[f64]| -> Vec<f64> { body.mass.chunks_exact(size).map(|row| dot(row, way)).collect() };
        Ok(MatrixModes {
            damping: omega_squared
                .iter()
                .map(|w| 2.0 * body.damping * w.sqrt())
                .collect(),
            load: along(body.load),
            participation: body.ground.map(|way| along(&moved(way))),
            start: vec![0.0; omega_squared.len()],
            shapes: shapes
                .iter()
                .flat_map(|shape| body.crack.iter().map(|freedom| shape[*freedom]))
                .collect(),
            position: body.position.to_vec(),
            omega_squared,
        })
    }
}

fn check(body: &Matrices, size: usize) -> Result<(), Error> {
    let squares = [body.mass, body.stiffness];
    let agree = size > 0
        && squares.iter().all(|matrix| matrix.len() == size * size)
        && body.ground.iter().all(|way| way.len() == size)
        && body.crack.len() == body.position.len()
        && body.crack.iter().all(|freedom| *freedom < size);
    if !agree {
        return Err(Error::Body(
            "the matrices, loads and crack nodes of a body must agree in its freedoms",
        ));
    }
    let rows = squares
        .into_iter()
        .chain(body.ground)
        .chain([body.load, body.position]);
    if rows.flatten().any(|number| !number.is_finite()) || !(body.damping.is_finite() && body.damping >= 0.0)
    {
        return Err(Error::Body(
            "the numbers of a body must be finite, its damping not negative",
        ));
    }
    let symmetric = |matrix: &&[f64]| {
        let largest = matrix.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        (0..size)
            .all(|r| (0..r).all(|c| (matrix[r * size + c] - matrix[c * size + r]).abs() <= SAME * largest))
    };
    if !squares.iter().all(symmetric) {
        return Err(Error::Body("mass and stiffness of a body must be symmetric"));
    }
    Ok(())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The lower triangle `L` of `L L^T`; none of a matrix that is not positive definite.
fn cholesky(matrix: &[f64], size: usize) -> Option<Vec<f64>> {
    let mut lower = vec![0.0; size * size];
    for r in 0..size {
        for c in 0..=r {
            let rest =
                matrix[r * size + c] - dot(&lower[r * size..r * size + c], &lower[c * size..c * size + c]);
            if r > c {
                lower[r * size + c] = rest / lower[c * size + c];
            } else if rest > 0.0 {
                lower[r * size + r] = rest.sqrt();
            } else {
                return None;
            }
        }
    }
    Some(lower)
}

/// `L^-1 x`, in place.
fn solve_lower(lower: &[f64], x: &mut [f64]) {
    let size = x.len();
    for r in 0..size {
        x[r] = (x[r] - dot(&lower[r * size..r * size + r], &x[..r])) / lower[r * size + r];
    }
}

/// `L^-T x`, in place.
fn solve_upper(lower: &[f64], x: &mut [f64]) {
    let size = x.len();
    for r in (0..size).rev() {
        let rest: f64 = (r + 1..size).map(|k| lower[k * size + r] * x[k]).sum();
        x[r] = (x[r] - rest) / lower[r * size + r];
    }
}

/// `L^-1 K L^-T`.
fn reduced(lower: &[f64], stiffness: &[f64], size: usize) -> Vec<f64> {
    let mut rows = stiffness.to_vec();
    for _ in 0..2 {
        rows.chunks_exact_mut(size)
            .for_each(|row| solve_lower(lower, row));
        rows = (0..size * size)
            .map(|k| rows[k % size * size + k / size])
            .collect();
    }
    rows
}

/// The eigenvalues of a symmetric matrix, and its eigenvectors as columns.
fn eigen(mut a: Vec<f64>, size: usize) -> (Vec<f64>, Vec<f64>) {
    let mut vectors = vec![0.0; size * size];
    (0..size).for_each(|k| vectors[k * size + k] = 1.0);
    for _ in 0..SWEEPS {
        let mut turned = false;
        for p in 0..size {
            for q in p + 1..size {
                let (ends, off) = ([a[p * size + p], a[q * size + q]], a[p * size + q]);
                // Nothing changes by less than the last digit of both ends.
                if off.abs() <= f64::EPSILON * (ends[0] * ends[1]).abs().sqrt()
                    || off.abs() < f64::MIN_POSITIVE
                {
                    continue;
                }
                turned = true;
                rotate(&mut a, &mut vectors, size, [p, q], turn(ends, off));
            }
        }
        if !turned {
            break;
        }
    }
    ((0..size).map(|k| a[k * size + k]).collect(), vectors)
}

/// Cosine and sine of the rotation that clears a number off the diagonal, `off` between `ends`.
fn turn(ends: [f64; 2], off: f64) -> [f64; 2] {
    let slope = (ends[1] - ends[0]) / (2.0 * off);
    let tangent = slope.signum() / (slope.abs() + slope.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    [cosine, tangent * cosine]
}

fn rotate(a: &mut [f64], vectors: &mut [f64], size: usize, [p, q]: [usize; 2], [cosine, sine]: [f64; 2]) {
    let mix = |numbers: &mut [f64], first: usize, second: usize| {
        let (x, y) = (numbers[first], numbers[second]);
        numbers[first] = cosine * x - sine * y;
        numbers[second] = sine * x + cosine * y;
    };
    for k in 0..size {
        mix(a, k * size + p, k * size + q);
        mix(vectors, k * size + p, k * size + q);
    }
    for k in 0..size {
        mix(a, p * size + k, q * size + k);
    }
    a[p * size + q] = 0.0;
    a[q * size + p] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::{Matrices, Modes};
    use crate::error::Error;
    use std::f64::consts::PI;

    /// Masses of one in a row, each tied to the next by a spring of one, the first to the ground if it is `held`.
    fn chain(size: usize, held: bool) -> [Vec<f64>; 2] {
        let number = |r: usize, c: usize| match r.abs_diff(c) {
            0 => f64::from(u8::from(r > 0 || held) + u8::from(r + 1 < size)),
            1 => -1.0,
            _ => 0.0,
        };
        let unit = |r: usize, c: usize| f64::from(u8::from(r == c));
        let all = |f: &dyn Fn(usize, usize) -> f64| (0..size * size).map(|k| f(k / size, k % size)).collect();
        [all(&unit), all(&number)]
    }

    fn modes(mass: &[f64], stiffness: &[f64], count: usize) -> Result<super::MatrixModes, Error> {
        let size = mass.len().isqrt();
        let (ones, zeros) = (vec![1.0; size], vec![0.0; size]);
        let body = Matrices {
            mass,
            stiffness,
            load: &zeros,
            ground: [&ones, &zeros],
            crack: &[0, 0, 0, 0],
            position: &[0.0, 1.0, 0.0, 0.0],
            damping: 0.05,
        };
        Modes::from_matrices(&body, count)
    }

    #[test]
    fn a_chain_has_the_frequencies_of_its_closed_form() {
        let size = 23;
        for held in [true, false] {
            let [mass, stiffness] = chain(size, held);
            let found = modes(&mass, &stiffness, size).unwrap();
            for (k, value) in found.omega_squared.iter().enumerate() {
                let angle = if held {
                    (2 * k + 1) as f64 * PI / (2 * (2 * size + 1)) as f64
                } else {
                    k as f64 * PI / (2 * size) as f64
                };
                assert!((value - 4.0 * angle.sin().powi(2)).abs() < 1e-13, "{k} {value}");
                assert_eq!(found.damping[k], 0.1 * value.sqrt());
            }
            // All modes together have the whole mass.
            let whole: f64 = found.participation[0].iter().map(|share| share * share).sum();
            assert!((whole - size as f64).abs() < 1e-12, "{whole}");
        }
    }

    #[test]
    fn other_masses_and_freedoms_leave_the_frequencies() {
        // By x = T y with any T the modes stay, and their share in the ground if the ground moves y by T^-1.
        let size = 7;
        let [mass, stiffness] = chain(size, true);
        let turned = |r: usize, c: usize| f64::from(u8::from(r == c)) + 0.3 * ((r * 5 + c * 3) as f64).sin();
        let product = |matrix: &[f64]| -> Vec<f64> {
            let number = |k: usize| -> f64 {
                let pairs = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
                pairs
                    .map(|(i, j)| turned(i, k / size) * matrix[i * size + j] * turned(j, k % size))
                    .sum()
            };
            (0..size * size).map(number).collect()
        };
        let [plain, other] = [
            modes(&mass, &stiffness, 4).unwrap(),
            modes(&product(&mass), &product(&stiffness), 4).unwrap(),
        ];
        for (a, b) in plain.omega_squared.iter().zip(&other.omega_squared) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }

    #[test]
    fn a_body_that_cannot_be_is_refused() {
        let [mass, stiffness] = chain(3, true);
        let refused = |mass: &[f64], stiffness: &[f64]| modes(mass, stiffness, 3).unwrap_err().to_string();
        let with = |matrix: &[f64], place: usize, value: f64| {
            let mut other = matrix.to_vec();
            other[place] = value;
            other
        };
        assert!(refused(&mass, &stiffness[..8]).contains("must agree"));
        assert!(refused(&with(&mass, 0, f64::NAN), &stiffness).contains("must be finite"));
        assert!(refused(&mass, &with(&stiffness, 1, 5.0)).contains("must be symmetric"));
        assert!(refused(&with(&mass, 4, 0.0), &stiffness).contains("mass of a body must be positive"));
        assert!(refused(&mass, &with(&stiffness, 4, -9.0)).contains("must not be negative"));
    }
}
