//! The flexible model, bound to Python.

use std::sync::Arc;

use heeltoe::flexible::{
    find_rest, many, simulate, BondLaw, CrossShaking, Crossing, Dam, FaceAnchor, Inside, Line, Modes,
    Penalty, Point, RisingWater, RockingThresholds, Scheme, Shaking, Span, Stressed, Stresses, Summary,
    Unrest, UntilRest, Wanted,
};
use heeltoe::inside::Law;
use numpy::{PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::law::FrictionLaw;
use crate::results::{by_column, AtRest, DamRun};
use crate::tables::{named, pool, rows, slice, wrong, Numbers};
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
    wet: PyReadonlyArray2<'py, f64>,
    boundary: PyReadonlyArray2<'py, f64>,
}

impl ReducedBody<'_> {
    /// With the rows that tie it to water, and so many components for each node.
    fn body(&self, wet: &[f64], directions: usize) -> PyResult<heeltoe::flexible::ReducedBody> {
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
            directions,
            dampers: self.dampers.as_slice()?,
            damper_signs: self.damper_signs.as_slice()?,
            wet,
            boundary: self.boundary.as_slice()?,
        };
        heeltoe::flexible::ReducedBody::new(&modes).map_err(wrong)
    }
}

/// Water with sound as Python gives it.
#[derive(FromPyObject)]
pub struct Reservoir<'py> {
    omega_squared: Numbers<'py>,
    damping_floor: PyReadonlyArray2<'py, f64>,
    damping_far: PyReadonlyArray2<'py, f64>,
    ground: PyReadonlyArray2<'py, f64>,
}

impl Reservoir<'_> {
    fn reservoir(&self) -> PyResult<heeltoe::flexible::Reservoir> {
        let shares = rows::<2>(self.ground.as_slice()?, "the ground's motion of the water")?;
        let ground = [0, 1].map(|k| shares.iter().map(|share| share[k]).collect::<Vec<f64>>());
        heeltoe::flexible::Reservoir::new(
            self.omega_squared.as_slice()?,
            [self.damping_floor.as_slice()?, self.damping_far.as_slice()?],
            [&ground[0], &ground[1]],
        )
        .map_err(wrong)
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
    crack: usize,
    span: [f64; 2],
    change: Vec<Numbers<'py>>,
}

impl Rising<'_> {
    fn water(&self) -> PyResult<RisingWater> {
        Ok(RisingWater {
            crack: self.crack,
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
    anchor: usize,
    points: Vec<Point>,
    axis: [f64; 2],
    prestress: f64,
    axial_stiffness: f64,
    shear_stiffness: f64,
    capacity: f64,
}

impl CrackAnchor {
    fn anchor(&self) -> FaceAnchor {
        let point = |face: usize| self.points.get(face).copied().unwrap_or_default();
        FaceAnchor {
            place: Crossing {
                anchor: self.anchor,
                points: [point(0), point(1)],
            },
            axis: self.axis,
            prestress: self.prestress,
            axial_stiffness: self.axial_stiffness,
            shear_stiffness: self.shear_stiffness,
            capacity: self.capacity,
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
    bond: Option<[f64; 6]>,
    give: (f64, f64),
    angles: [Vec<f64>; 2],
    water: Option<FollowingWater<'py>>,
    anchors: Vec<CrackAnchor>,
}

impl CrackLine<'_> {
    fn line(&self) -> PyResult<Line> {
        let span = |(first, count): (usize, usize)| Span { first, count };
        Ok(Line {
            nodes: [span(self.upper), span(self.lower)],
            friction: self.friction,
            law: self.law.as_ref().map(|law| law.get().0.clone()),
            bond: self
                .bond
                .map(|[tensile, cohesion, opening, shear, dynamic, first]| BondLaw {
                    tensile,
                    cohesion,
                    energy: [opening, shear],
                    dynamic,
                    first,
                }),
            give: RockingThresholds {
                rotation: self.give.0,
                gap: self.give.1,
            },
            angles: self.angles.clone(),
            inside: Inside {
                water: self.water.as_ref().map(FollowingWater::water).transpose()?,
                anchors: self.anchors.iter().map(CrackAnchor::anchor).collect(),
            },
        })
    }
}

/// Stresses by the modes of the parts as Python gives them, by the names of `Stressed`.
#[derive(FromPyObject)]
pub struct StressRows<'py> {
    parts: Vec<PyReadonlyArray3<'py, f64>>,
    stride: usize,
}

impl StressRows<'_> {
    /// The stresses of these rows, and after how many steps each time they are wanted.
    fn wanted(rows: &Option<Self>) -> PyResult<Option<(Vec<Stresses<'_>>, usize)>> {
        rows.as_ref()
            .map(|rows| Ok((rows.stresses()?, rows.stride)))
            .transpose()
    }

    fn stresses(&self) -> PyResult<Vec<Stresses<'_>>> {
        if self.stride == 0 {
            return Err(wrong("stresses need a stride"));
        }
        let mut parts = Vec::new();
        for part in &self.parts {
            let rows = rows(part.as_slice()?, "a stress")?;
            parts.push(Stresses::new(rows, part.shape()[1]).map_err(wrong)?);
        }
        Ok(parts)
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen)]
pub struct CrackedDam {
    dam: Arc<Dam>,
    /// The crack that is asked of.
    asked: usize,
    rising: Vec<RisingWater>,
    /// Its parts across the valley, and how far their neighbours are.
    across: Option<(Arc<Vec<heeltoe::flexible::ReducedBody>>, [f64; 2])>,
    /// Why there is no state of rest.
    unrest: Option<Unrest>,
}

impl CrackedDam {
    fn scheme(&self, theta: f64, penalty: Option<[f64; 3]>) -> PyResult<Scheme> {
        let Some([stiffness, gamma, beta]) = penalty else {
            return Ok(Scheme::Exact(theta));
        };
        if self.dam.cracks.iter().any(|line| !line.inside.is_empty()) {
            return Err(wrong("the penalty method knows contact alone in the crack"));
        }
        if self.dam.cracks.len() > 1 {
            return Err(wrong("the penalty method knows one crack"));
        }
        if self
            .dam
            .cracks
            .iter()
            .any(|line| line.law.is_some() || line.bond.is_some())
        {
            return Err(wrong("the penalty method knows constant friction and no bond"));
        }
        let radiates = self.dam.bodies.iter().any(|body| body.radiates());
        if self.dam.reservoir.is_some() || radiates {
            return Err(wrong(
                "the penalty method knows neither water with sound nor rock with waves",
            ));
        }
        if self.dam.bodies[0].dampers() > 0 {
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
    /// The ground, and the water that changes meanwhile, as this scheme may have it.
    fn shaking<'a>(
        &'a self,
        ground: &'a [[f64; 2]],
        across: Option<&'a [f64]>,
        dt: f64,
        scheme: &Scheme,
    ) -> PyResult<Shaking<'a>> {
        if !self.rising.is_empty() && matches!(scheme, Scheme::Penalty(_)) {
            return Err(wrong("water that changes needs exact contact"));
        }
        let across = match (across, &self.across) {
            (None, _) => None,
            (Some(_), None) => return Err(wrong("the dam has no parts across the valley")),
            (Some(_), _) if matches!(scheme, Scheme::Penalty(_)) => {
                return Err(wrong("shaking across the valley needs exact contact"))
            }
            (Some(across), _) if across.len() != ground.len() => {
                return Err(wrong(
                    "the ground needs as many steps across the valley as along it",
                ))
            }
            (Some(ground), Some((bodies, gap))) => Some(CrossShaking {
                bodies,
                gap: *gap,
                ground,
                crest: None,
            }),
        };
        Ok(Shaking {
            across,
            ground,
            dt,
            scale: [1.0; 2],
            rising: &self.rising,
        })
    }
}

#[pymethods]
impl CrackedDam {
    #[new]
    #[pyo3(signature = (parts, cracks, contactors, reservoir=None, *, asked=0))]
    fn new(
        py: Python<'_>,
        parts: Vec<ReducedBody<'_>>,
        cracks: Vec<CrackLine<'_>>,
        contactors: u8,
        reservoir: Option<Reservoir<'_>>,
        asked: usize,
    ) -> PyResult<Self> {
        if asked >= cracks.len() {
            return Err(wrong("the crack asked of is not there"));
        }
        let mut water = reservoir.map(|water| water.reservoir()).transpose()?;
        let rows: Vec<&[f64]> = parts
            .iter()
            .map(|part| part.wet.as_slice())
            .collect::<Result<_, _>>()?;
        let ties = match &mut water {
            Some(water) => water.tie(&rows).map_err(wrong)?,
            None => rows.iter().map(|rows| rows.to_vec()).collect(),
        };
        let bodies = parts.iter().zip(&ties).map(|(part, ties)| part.body(ties, 2));
        let mut dam = Dam {
            bodies: bodies.collect::<PyResult<_>>()?,
            cracks: cracks.iter().map(CrackLine::line).collect::<PyResult<_>>()?,
            contactors,
            reservoir: water,
            still: None,
        };
        dam.check().map_err(wrong)?;
        let found = watched(py, None, |_| None, |stop| find_rest(&dam, stop))?;
        let unrest = found.as_ref().err().copied();
        dam.still = found.ok();
        Ok(CrackedDam {
            dam: Arc::new(dam),
            asked,
            rising: Vec::new(),
            across: None,
            unrest,
        })
    }

    /// See `_kernel.pyi`.
    fn under(&self, rising: Vec<Rising<'_>>) -> PyResult<Self> {
        let rising = rising.iter().map(Rising::water).collect::<PyResult<Vec<_>>>()?;
        let fits = |water: &RisingWater| {
            let line = self.dam.cracks.get(water.crack);
            let counts = [water.change[0].len(), water.change[1].len()];
            line.is_some_and(|line| line.nodes.map(|span| span.count) == counts)
        };
        if !rising.iter().all(fits) {
            return Err(wrong("the water that changes needs a force for each crack node"));
        }
        Ok(CrackedDam {
            dam: Arc::clone(&self.dam),
            asked: self.asked,
            rising,
            across: self.across.clone(),
            unrest: self.unrest,
        })
    }

    /// See `_kernel.pyi`.
    fn crossed(&self, parts: Vec<ReducedBody<'_>>, gap: [f64; 2]) -> PyResult<Self> {
        let bodies = parts.iter().map(|part| part.body(part.wet.as_slice()?, 1));
        let bodies = bodies.collect::<PyResult<Vec<_>>>()?;
        self.dam.check_across(&bodies).map_err(wrong)?;
        Ok(CrackedDam {
            dam: Arc::clone(&self.dam),
            asked: self.asked,
            rising: self.rising.clone(),
            across: Some((Arc::new(bodies), gap)),
            unrest: self.unrest,
        })
    }

    /// See `_kernel.pyi`.
    fn still(&self, py: Python<'_>) -> PyResult<Option<AtRest>> {
        let still = self.dam.still.as_ref();
        still.map(|still| AtRest::of(py, &self.dam, still)).transpose()
    }

    /// See `_kernel.pyi`.
    fn unrest(&self) -> Option<&'static str> {
        self.unrest.map(|why| Unrest::NAMES[why as usize])
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, step, theta, *, stride=0, stresses=None, pressures=None, crest=None, penalty=None, ending=None, until_rest=None, across=None, crest_across=None))]
    #[allow(clippy::too_many_arguments)]
    fn run<'py>(
        &self,
        py: Python<'py>,
        ground: PyReadonlyArray2<'py, f64>,
        step: f64,
        theta: f64,
        stride: usize,
        stresses: Option<StressRows<'py>>,
        pressures: Option<StressRows<'py>>,
        crest: Option<Numbers<'py>>,
        penalty: Option<[f64; 3]>,
        ending: Option<Bound<'py, Ending>>,
        until_rest: Option<(usize, usize, f64, f64)>,
        across: Option<Numbers<'py>>,
        crest_across: Option<Numbers<'py>>,
    ) -> PyResult<DamRun> {
        let scheme = self.scheme(theta, penalty)?;
        let mut shaking = self.shaking(
            rows(ground.as_slice()?, "ground")?,
            slice(&across)?,
            step,
            &scheme,
        )?;
        let (stresses, pressures) = (StressRows::wanted(&stresses)?, StressRows::wanted(&pressures)?);
        if pressures.as_ref().is_some_and(|(water, _)| water.len() != 1) {
            return Err(wrong("the water is one part"));
        }
        let [stresses, pressures] = [&stresses, &pressures].map(|wanted| {
            let (parts, stride) = wanted.as_ref()?;
            Some(Stressed {
                parts,
                stride: *stride,
            })
        });
        let crest = crest.as_ref().map(|row| row.as_slice()).transpose()?;
        if crest.is_some_and(|row| row.len() != self.dam.bodies[0].count()) {
            return Err(wrong(
                "a point of the crest needs a number for each mode of its part",
            ));
        }
        if let Some(across) = &mut shaking.across {
            across.crest = slice(&crest_across)?;
            if across
                .crest
                .is_some_and(|row| row.len() != across.bodies[0].count())
            {
                return Err(wrong(
                    "a point of the crest needs a number for each mode of its part",
                ));
            }
        }
        let until_rest = until_rest.map(|(first, every, seconds, moved)| UntilRest {
            first,
            every: every.max(1),
            seconds,
            moved,
        });
        let reached = |run: &heeltoe::flexible::Run| Some([run.summary().end_time, run.summary().slip]);
        let run = watched(py, ending.as_ref().map(Bound::get), reached, |stop| {
            let wanted = Wanted {
                stride,
                modes: stride > 0,
                stresses,
                pressures,
                crest,
                rest: until_rest,
                stop,
            };
            simulate(&self.dam, &shaking, &scheme, wanted)
        })?;
        DamRun::of(py, run, self.asked)
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (ground, step, theta, scales, *, threads=0, penalty=None, ending=None, across=None))]
    #[allow(clippy::too_many_arguments)]
    fn run_many<'py>(
        &self,
        py: Python<'py>,
        ground: PyReadonlyArray2<'py, f64>,
        step: f64,
        theta: f64,
        scales: PyReadonlyArray2<'py, f64>,
        threads: usize,
        penalty: Option<[f64; 3]>,
        ending: Option<Bound<'py, Ending>>,
        across: Option<Numbers<'py>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let scheme = self.scheme(theta, penalty)?;
        let shaking = self.shaking(
            rows(ground.as_slice()?, "ground")?,
            slice(&across)?,
            step,
            &scheme,
        )?;
        let scales = rows(scales.as_slice()?, "scales")?;
        let pool = pool(threads)?;
        let runs = watched(
            py,
            ending.as_ref().map(Bound::get),
            |_| None,
            |stop| pool.install(|| many::run(&self.dam, &shaking, &scheme, scales, stop)),
        )?;
        let of_crack = |k: usize| by_column(py, Summary::FIELDS, runs.iter().map(|cracks| cracks[k].row()));
        let cracks: Vec<_> = (0..self.dam.cracks.len())
            .map(of_crack)
            .collect::<PyResult<_>>()?;
        PyTuple::new(py, cracks)
    }
}
