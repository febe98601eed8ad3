//! The flexible model, bound to Python.

use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use heeltoe::flexible::body::{Body, Modes, LANES};
use heeltoe::flexible::dam::{Dam, Options};
use heeltoe::flexible::idce::{self, Idce};
use heeltoe::flexible::inside::{Anchor, Inside, Law, Water};
use heeltoe::flexible::result::{Frames, Summary};
use heeltoe::flexible::step;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;

/// One part as Python gives it, in the order of `Modes`.
#[derive(FromPyObject)]
pub struct Part<'py> {
    omega_squared: Numbers<'py>,
    damping_sticking: Numbers<'py>,
    damping_free: Numbers<'py>,
    load: Numbers<'py>,
    participation_horizontal: Numbers<'py>,
    participation_vertical: Numbers<'py>,
    start: Numbers<'py>,
    shapes: PyReadonlyArray2<'py, f64>,
    position: Numbers<'py>,
}

impl Part<'_> {
    fn body(&self) -> PyResult<Body> {
        let modes = Modes {
            omega_squared: self.omega_squared.as_slice()?,
            damping: [self.damping_sticking.as_slice()?, self.damping_free.as_slice()?],
            load: self.load.as_slice()?,
            participation: [
                self.participation_horizontal.as_slice()?,
                self.participation_vertical.as_slice()?,
            ],
            start: self.start.as_slice()?,
            shapes: self.shapes.as_slice()?,
            position: self.position.as_slice()?,
        };
        let count = modes.omega_squared.len();
        let others = [
            modes.damping[0],
            modes.damping[1],
            modes.load,
            modes.participation[0],
            modes.participation[1],
            modes.start,
        ];
        let columns = modes.position.len();
        if count == 0 || columns < 4 || !columns.is_multiple_of(2) {
            return Err(PyValueError::new_err(
                "a part needs modes and two crack nodes or more",
            ));
        }
        if others.iter().any(|v| v.len() != count) || modes.shapes.len() != count * columns {
            return Err(PyValueError::new_err(
                "the arrays of a part must agree in the number of modes and of crack nodes",
            ));
        }
        Ok(Body::new(&modes))
    }
}

/// Water in the crack as Python gives it, in the order of `Water`.
#[derive(FromPyObject)]
pub struct CrackWater<'py> {
    law: String,
    opening: f64,
    still: Vec<Numbers<'py>>,
    full: Vec<Numbers<'py>>,
}

impl CrackWater<'_> {
    /// Take the forces of the nodes of each face; a face that is not there has none.
    fn water(&self, counts: [usize; 2]) -> PyResult<Water> {
        let law = Law::named(&self.law).ok_or_else(|| PyValueError::new_err("no such law of the water"))?;
        let forces = |given: &[Numbers]| -> PyResult<[Vec<f64>; 2]> {
            let mut found = [Vec::new(), Vec::new()];
            for (face, numbers) in found.iter_mut().zip(given) {
                face.extend_from_slice(numbers.as_slice()?);
            }
            if [found[0].len(), found[1].len()] != counts {
                return Err(PyValueError::new_err(
                    "the water needs a force for each crack node",
                ));
            }
            Ok(found)
        };
        Ok(Water {
            law,
            opening: self.opening,
            still: forces(&self.still)?,
            full: forces(&self.full)?,
        })
    }
}

/// An anchor as Python gives it, in the order of `Anchor`.
#[derive(FromPyObject)]
pub struct CrackAnchor {
    points: Vec<[(usize, f64); 3]>,
    axis: [f64; 2],
    prestress: f64,
    axial_stiffness: f64,
    shear_stiffness: f64,
}

impl CrackAnchor {
    fn anchor(&self, counts: [usize; 2]) -> PyResult<Anchor> {
        let mut points = [[(0, 0.0); 3]; 2];
        points
            .iter_mut()
            .zip(&self.points)
            .for_each(|(mine, given)| *mine = *given);
        let outside = points
            .iter()
            .zip(counts)
            .any(|(point, count)| point.iter().any(|(node, _)| *node >= count.max(1)));
        if outside {
            return Err(PyValueError::new_err("an anchor needs nodes that are there"));
        }
        Ok(Anchor {
            points,
            axis: self.axis,
            prestress: self.prestress,
            axial: self.axial_stiffness,
            shear: self.shear_stiffness,
        })
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen)]
pub struct CrackedDam {
    dam: Dam,
}

type Run<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u8>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

impl CrackedDam {
    /// Refuse what the penalty method does not know.
    fn check(&self, penalty: Option<[f64; 3]>) -> PyResult<()> {
        if penalty.is_some() && !self.dam.inside.is_empty() {
            return Err(PyValueError::new_err(
                "the penalty method knows contact alone in the crack",
            ));
        }
        Ok(())
    }

    /// Run one scheme or the other.
    fn simulate(
        &self,
        ground: &[[f64; 2]],
        options: &Options,
        penalty: Option<[f64; 3]>,
        frames: Option<&mut Frames>,
    ) -> Summary {
        match penalty {
            None => step::simulate(&self.dam, ground, options, frames),
            Some([penalty, gamma, beta]) => {
                let idce = Idce { penalty, gamma, beta };
                idce::simulate(&self.dam, ground, options, &idce, frames)
            }
        }
    }
}

#[pymethods]
impl CrackedDam {
    #[new]
    #[pyo3(signature = (upper, lower, friction, contactors, water=None, anchors=Vec::new()))]
    fn new(
        upper: Part,
        lower: Option<Part>,
        friction: [f64; 2],
        contactors: u8,
        water: Option<CrackWater>,
        anchors: Vec<CrackAnchor>,
    ) -> PyResult<Self> {
        let upper = upper.body()?;
        let lower = lower.map(|part| part.body()).transpose()?;
        let counts = [upper.nodes, lower.as_ref().map_or(0, |body| body.nodes)];
        let inside = Inside {
            water: water.map(|water| water.water(counts)).transpose()?,
            anchors: anchors
                .iter()
                .map(|anchor| anchor.anchor(counts))
                .collect::<PyResult<_>>()?,
        };
        Ok(CrackedDam {
            dam: Dam {
                upper,
                lower,
                friction,
                contactors,
                inside,
            },
        })
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, dt, theta, stride, keep_modes, scale, penalty=None))]
    #[allow(clippy::too_many_arguments)]
    fn run<'py>(
        &self,
        py: Python<'py>,
        ground: PyReadonlyArray2<'py, f64>,
        dt: f64,
        theta: f64,
        stride: usize,
        keep_modes: bool,
        scale: [f64; 2],
        penalty: Option<[f64; 3]>,
    ) -> PyResult<Run<'py>> {
        self.check(penalty)?;
        let options = Options {
            dt,
            theta,
            stride,
            keep_modes,
            scale,
        };
        let ground = pairs(ground.as_slice()?)?;
        let mut frames = Frames::default();
        let wanted = (stride > 0).then_some(&mut frames);
        let summary = py.detach(|| self.simulate(ground, &options, penalty, wanted));
        let count = frames.rows.len();
        let table = |values: Vec<f64>| -> PyResult<Bound<'py, PyArray2<f64>>> { shaped(py, values, count) };
        let rows = frames.rows.as_flattened().to_vec();
        Ok((
            Array1::from(summary.row()).into_pyarray(py),
            table(rows)?,
            table(frames.upper)?,
            table(frames.lower)?,
            table(frames.force)?,
            shaped(py, frames.status, count)?,
            table(unpadded(frames.modes_upper, &self.dam.upper))?,
            table(match &self.dam.lower {
                Some(body) => unpadded(frames.modes_lower, body),
                None => Vec::new(),
            })?,
        ))
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, dt, theta, scales, threads, penalty=None))]
    #[allow(clippy::too_many_arguments)]
    fn run_many<'py>(
        &self,
        py: Python<'py>,
        ground: PyReadonlyArray2<'py, f64>,
        dt: f64,
        theta: f64,
        scales: Vec<[f64; 2]>,
        threads: usize,
        penalty: Option<[f64; 3]>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.check(penalty)?;
        let ground = pairs(ground.as_slice()?)?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| PyValueError::new_err(e.to_string()))?;
        let rows: Vec<f64> = py.detach(|| {
            pool.install(|| {
                scales
                    .par_iter()
                    .flat_map_iter(|scale| {
                        let options = Options {
                            dt,
                            theta,
                            stride: 0,
                            keep_modes: false,
                            scale: *scale,
                        };
                        self.simulate(ground, &options, penalty, None).row()
                    })
                    .collect()
            })
        });
        shaped(py, rows, scales.len())
    }
}

/// Pairs of horizontal and vertical acceleration.
fn pairs(values: &[f64]) -> PyResult<&[[f64; 2]]> {
    match values.as_chunks::<2>() {
        (pairs, []) => Ok(pairs),
        _ => Err(PyValueError::new_err("ground must have shape (steps, 2)")),
    }
}

/// Take out the modes that fill up the last group.
fn unpadded(values: Vec<f64>, body: &Body) -> Vec<f64> {
    let (padded, count) = (body.groups() * LANES, body.modes);
    values
        .chunks_exact(padded)
        .flat_map(|row| &row[..count])
        .copied()
        .collect()
}

fn shaped<T: numpy::Element>(
    py: Python<'_>,
    values: Vec<T>,
    rows: usize,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let columns = values.len() / rows.max(1);
    Array2::from_shape_vec((rows, columns), values)
        .map(|array| array.into_pyarray(py))
        .map_err(|e| PyValueError::new_err(e.to_string()))
}
