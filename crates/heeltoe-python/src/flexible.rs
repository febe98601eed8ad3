//! The flexible model, bound to Python.

use heeltoe::flexible::{
    many, simulate, Dam, Extreme, FaceAnchor, Give, Inside, Line, Modes, Penalty, Point, RisingWater, Scheme,
    Shaking, Sides, Span, Stressed, Stresses, Summary, Wanted, Worked,
};
use heeltoe::inside::Law;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::law::FrictionLaw;
use crate::tables::{named, pool, rows, shaped, wrong, Numbers};
use crate::watch::{watched, Ending};

/// A body in its modes as Python gives it, by the names of `Modes`.
#[derive(FromPyObject)]
pub struct ReducedBody<'py> {
    omega_squared: Numbers<'py>,
    damping_sticking: Numbers<'py>,
    damping_free: Numbers<'py>,
    load: Numbers<'py>,
    participation_horizontal: Numbers<'py>,
    participation_vertical: Numbers<'py>,
    start: Numbers<'py>,
    shapes: PyReadonlyArray2<'py, f64>,
    position: Numbers<'py>,
    dampers: PyReadonlyArray2<'py, f64>,
    damper_signs: Numbers<'py>,
}

impl ReducedBody<'_> {
    fn body(&self) -> PyResult<heeltoe::flexible::ReducedBody> {
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
            dampers: self.dampers.as_slice()?,
            damper_signs: self.damper_signs.as_slice()?,
        };
        heeltoe::flexible::ReducedBody::new(&modes).map_err(wrong)
    }
}

/// Water in the crack as Python gives it.
#[derive(FromPyObject)]
pub struct FollowingWater<'py> {
    law: String,
    opening: f64,
    still: Vec<Numbers<'py>>,
    full: Vec<Numbers<'py>>,
}

impl FollowingWater<'_> {
    fn water(&self) -> PyResult<heeltoe::flexible::FollowingWater> {
        Ok(heeltoe::flexible::FollowingWater {
            law: named(&self.law, Law::named, &Law::NAMES)?,
            opening: self.opening,
            still: faces(&self.still)?,
            full: faces(&self.full)?,
        })
    }
}

/// Water whose pressure changes with time as Python gives it.
#[derive(FromPyObject)]
pub struct Rising<'py> {
    span: [f64; 2],
    change: Vec<Numbers<'py>>,
}

impl Rising<'_> {
    fn water(&self) -> PyResult<RisingWater> {
        Ok(RisingWater {
            span: self.span,
            change: faces(&self.change)?,
        })
    }
}

/// Numbers of the nodes of each face; a face that is not there has none.
fn faces(given: &[Numbers]) -> PyResult<[Vec<f64>; 2]> {
    let mut found = [Vec::new(), Vec::new()];
    for (face, numbers) in found.iter_mut().zip(given) {
        face.extend_from_slice(numbers.as_slice()?);
    }
    Ok(found)
}

/// An anchor as Python gives it.
#[derive(FromPyObject)]
pub struct CrackAnchor {
    points: Vec<Point>,
    axis: [f64; 2],
    prestress: f64,
    axial_stiffness: f64,
    shear_stiffness: f64,
}

impl CrackAnchor {
    fn anchor(&self) -> FaceAnchor {
        let point = |face: usize| self.points.get(face).copied().unwrap_or_default();
        FaceAnchor {
            place: [point(0), point(1)],
            axis: self.axis,
            prestress: self.prestress,
            axial_stiffness: self.axial_stiffness,
            shear_stiffness: self.shear_stiffness,
        }
    }
}

/// A crack as Python gives it.
#[derive(FromPyObject)]
pub struct CrackLine<'py> {
    upper: (usize, usize),
    lower: (usize, usize),
    friction: [f64; 2],
    law: Option<Bound<'py, FrictionLaw>>,
    give: (f64, f64),
    angles: [Vec<f64>; 2],
}

impl CrackLine<'_> {
    fn line(&self) -> Line {
        let span = |(first, count): (usize, usize)| Span { first, count };
        Line {
            nodes: [span(self.upper), span(self.lower)],
            friction: self.friction,
            law: self.law.as_ref().map(|law| law.get().0.clone()),
            give: Give {
                rotation: self.give.0,
                gap: self.give.1,
            },
            angles: self.angles.clone(),
        }
    }
}

/// Slip and number of open contacts of each crack, amplitudes of both bodies, forces on the nodes of both.
type Rest<'py> = (
    Vec<f64>,
    Vec<usize>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
);

type Run<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u8>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<f64>>,
);

/// Stresses by the modes of either part as Python gives them, by the names of `Stressed`.
#[derive(FromPyObject)]
pub struct StressRows<'py> {
    bodies: Vec<PyReadonlyArray3<'py, f64>>,
    stride: usize,
}

impl StressRows<'_> {
    fn stressed(&self) -> PyResult<Stressed<'_>> {
        let mut bodies = Vec::new();
        for each in &self.bodies {
            let rows = rows(each.as_slice()?, "a stress")?;
            bodies.push(Stresses::new(rows, each.shape()[1]).map_err(wrong)?);
        }
        match bodies[..] {
            [upper, ref lower @ ..] if self.stride > 0 && lower.len() < 2 => Ok(Stressed {
                bodies: Sides {
                    upper,
                    lower: lower.first().copied(),
                },
                stride: self.stride,
            }),
            _ => Err(wrong("stresses need one or two parts and a stride")),
        }
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen)]
pub struct CrackedDam {
    dam: Dam,
}

impl CrackedDam {
    fn scheme(&self, theta: f64, penalty: Option<[f64; 3]>) -> PyResult<Scheme> {
        let Some([stiffness, gamma, beta]) = penalty else {
            return Ok(Scheme::Exact(theta));
        };
        if !self.dam.inside.is_empty() {
            return Err(wrong("the penalty method knows contact alone in the crack"));
        }
        if self.dam.cracks.len() > 1 {
            return Err(wrong("the penalty method knows one crack"));
        }
        if self.dam.cracks.iter().any(|line| line.law.is_some()) {
            return Err(wrong("the penalty method knows constant friction"));
        }
        if self.dam.bodies.upper.dampers() > 0 {
            return Err(wrong("the penalty method has no dashpots between the modes"));
        }
        Ok(Scheme::Penalty(Penalty {
            stiffness,
            gamma,
            beta,
        }))
    }
}

impl CrackedDam {
    fn rising(&self, given: &[Rising], scheme: &Scheme) -> PyResult<Vec<RisingWater>> {
        let found = given.iter().map(Rising::water).collect::<PyResult<Vec<_>>>()?;
        let bodies = &self.dam.bodies;
        let counts = [
            bodies.upper.nodes(),
            bodies
                .lower
                .as_ref()
                .map_or(0, heeltoe::flexible::ReducedBody::nodes),
        ];
        let fits = |water: &RisingWater| [water.change[0].len(), water.change[1].len()] == counts;
        if !found.iter().all(fits) {
            return Err(wrong("the water that changes needs a force for each crack node"));
        }
        if !found.is_empty() && (matches!(scheme, Scheme::Penalty(_)) || self.dam.cracks.len() > 1) {
            return Err(wrong("water that changes needs exact contact in one crack"));
        }
        Ok(found)
    }
}

#[pymethods]
impl CrackedDam {
    #[new]
    #[pyo3(signature = (upper, lower, cracks, contactors, water=None, anchors=Vec::new()))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        upper: ReducedBody,
        lower: Option<ReducedBody>,
        cracks: Vec<CrackLine<'_>>,
        contactors: u8,
        water: Option<FollowingWater>,
        anchors: Vec<CrackAnchor>,
    ) -> PyResult<Self> {
        let dam = Dam {
            bodies: Sides {
                upper: upper.body()?,
                lower: lower.map(|body| body.body()).transpose()?,
            },
            cracks: cracks.iter().map(CrackLine::line).collect(),
            contactors,
            inside: Inside {
                water: water.map(|water| water.water()).transpose()?,
                anchors: anchors.iter().map(CrackAnchor::anchor).collect(),
            },
            still: None,
        };
        dam.check().map_err(wrong)?;
        let dam = watched(py, None, |_| None, |stop| dam.rested(stop))?;
        Ok(CrackedDam { dam })
    }

    /// See `_kernel.pyi`.
    fn still<'py>(&self, py: Python<'py>) -> Option<Rest<'py>> {
        let still = self.dam.still.as_ref()?;
        let [above, below] = still.amplitudes(&self.dam);
        Some((
            still.slip.clone(),
            still.open.clone(),
            above.into_pyarray(py),
            below.into_pyarray(py),
            still.force[0].clone().into_pyarray(py),
            still.force[1].clone().into_pyarray(py),
        ))
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, dt, theta, stride, keep_modes, stresses=None, penalty=None, ending=None,
        rising=Vec::new()))]
    #[allow(clippy::too_many_arguments)]
    fn run<'py>(
        &self,
        py: Python<'py>,
        ground: PyReadonlyArray2<'py, f64>,
        dt: f64,
        theta: f64,
        stride: usize,
        keep_modes: bool,
        stresses: Option<StressRows<'py>>,
        penalty: Option<[f64; 3]>,
        ending: Option<Bound<'py, Ending>>,
        rising: Vec<Rising<'py>>,
    ) -> PyResult<Run<'py>> {
        let scheme = self.scheme(theta, penalty)?;
        let rising = self.rising(&rising, &scheme)?;
        let ground = rows(ground.as_slice()?, "ground")?;
        let shaking = Shaking {
            ground,
            dt,
            scale: [1.0; 2],
            rising: &rising,
        };
        let stresses = stresses.as_ref().map(StressRows::stressed).transpose()?;
        let reached = |run: &heeltoe::flexible::Run| Some([run.summary().end_time, run.summary().slip]);
        let run = watched(py, ending.as_ref().map(Bound::get), reached, |stop| {
            let wanted = Wanted {
                stride,
                modes: keep_modes,
                stresses,
                stop,
            };
            simulate(&self.dam, &shaking, &scheme, wanted)
        })?;
        let frames = run.frames;
        let (cracks, rows) = (run.cracks.len(), frames.rows.len());
        let count = rows / cracks;
        let extremes = run.extremes.unwrap_or_default();
        let table = |of: Vec<Extreme>| shaped(py, of.iter().flat_map(Extreme::row).collect(), of.len());
        Ok((
            shaped(py, run.cracks.iter().flat_map(numbers).collect(), cracks)?,
            shaped(py, frames.rows.as_flattened().to_vec(), rows)?,
            shaped(py, frames.upper, count)?,
            shaped(py, frames.lower, count)?,
            shaped(py, frames.force, count)?,
            shaped(py, frames.status, count)?,
            shaped(py, frames.modes_upper, count)?,
            shaped(py, frames.modes_lower, count)?,
            table(extremes.upper)?,
            table(extremes.lower.unwrap_or_default())?,
            crate::tables::table(py, run.worked.iter().map(Worked::row)),
        ))
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, dt, theta, scales, threads, penalty=None, ending=None, rising=Vec::new()))]
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
        ending: Option<Bound<'py, Ending>>,
        rising: Vec<Rising<'py>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let scheme = self.scheme(theta, penalty)?;
        let rising = self.rising(&rising, &scheme)?;
        let shaking = Shaking {
            ground: rows(ground.as_slice()?, "ground")?,
            dt,
            scale: [1.0; 2],
            rising: &rising,
        };
        let pool = pool(threads)?;
        let runs = watched(
            py,
            ending.as_ref().map(Bound::get),
            |_| None,
            |stop| pool.install(|| many::run(&self.dam, &shaking, &scheme, &scales, stop)),
        )?;
        let runs = runs.concat();
        shaped(py, runs.iter().flat_map(numbers).collect(), runs.len())
    }
}

/// The columns of a summary, then the tensions of the anchors.
fn numbers(summary: &Summary) -> Vec<f64> {
    [&summary.row(), &summary.tensions[..]].concat()
}
