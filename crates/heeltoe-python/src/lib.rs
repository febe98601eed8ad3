//! Kernels of heeltoe, bound to Python as `heeltoe._kernel`.

mod flexible;

use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use heeltoe::rigid::block::{Block, BLOCK_FIELDS, FIELD_COUNT};
use heeltoe::rigid::many;
use heeltoe::rigid::mode::Mode;
use heeltoe::rigid::result::{Event, EventKind, Histories, Outcome};
use heeltoe::rigid::simulate::{simulate, Motion, Options};
use heeltoe::rigid::varying::block::{Rotation, TurningBlock, VARYING_COUNT, VARYING_FIELDS};
use heeltoe::rigid::varying::ground::TurningGround;
use heeltoe::rigid::varying::loads::{Anchor, Rule, Water};
use heeltoe::rigid::varying::walk;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type RunResult<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<u8>>,
    Bound<'py, PyArray2<f64>>,
);

type VaryingResult<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<u8>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
);

/// Columns of the event table.
const EVENT_FIELDS: [&str; 17] = [
    "time",
    "kind",
    "mode_before",
    "mode_after",
    "slip",
    "gap_heel",
    "gap_toe",
    "slip_velocity",
    "gap_velocity_heel",
    "gap_velocity_toe",
    "approach_slip_velocity",
    "approach_velocity_heel",
    "approach_velocity_toe",
    "impulse_friction",
    "impulse_heel",
    "impulse_toe",
    "energy_lost",
];

/// Columns of the history table.
const HISTORY_FIELDS: [&str; 12] = [
    "slip",
    "gap_heel",
    "gap_toe",
    "slip_velocity",
    "gap_velocity_heel",
    "gap_velocity_toe",
    "slip_acceleration",
    "gap_acceleration_heel",
    "gap_acceleration_toe",
    "friction_force",
    "normal_force_heel",
    "normal_force_toe",
];

fn event_row(e: &Event) -> [f64; 17] {
    let mut row = [0.0; 17];
    row[0] = e.time;
    row[1] = e.kind as u8 as f64;
    row[2] = e.before.index() as f64;
    row[3] = e.after.index() as f64;
    row[4..7].copy_from_slice(&e.position);
    row[7..10].copy_from_slice(&e.velocity);
    row[10..13].copy_from_slice(&e.approach);
    row[13..16].copy_from_slice(&e.impulse);
    row[16] = e.energy_lost;
    row
}

fn table<const N: usize>(rows: &[[f64; N]]) -> Array2<f64> {
    Array2::from_shape_vec((rows.len(), N), rows.as_flattened().to_vec()).expect("rows of equal length")
}

fn motion<'a>(
    time: &'a [f64],
    horizontal: &'a [f64],
    vertical: Option<&'a [f64]>,
    scale: [f64; 2],
) -> PyResult<Motion<'a>> {
    let n = time.len();
    if n < 2 || horizontal.len() != n || vertical.is_some_and(|v| v.len() != n) {
        return Err(PyValueError::new_err(
            "a motion needs two samples or more, and as many accelerations as times",
        ));
    }
    Ok(Motion {
        time,
        horizontal,
        vertical,
        scale,
    })
}

fn parameters(values: &[f64]) -> PyResult<[f64; FIELD_COUNT]> {
    values.try_into().map_err(|_| {
        PyValueError::new_err(format!("a block has {FIELD_COUNT} numbers, not {}", values.len()))
    })
}

/// The choice of that name.
fn named<T: Copy>(name: &str, names: &[&str], choices: &[T]) -> PyResult<T> {
    let place = names.iter().position(|known| *known == name);
    place
        .map(|k| choices[k])
        .ok_or_else(|| PyValueError::new_err(format!("{name} is none of {}", names.join(", "))))
}

fn options(settle: f64, event_limit: u64, jam: bool) -> Options {
    Options {
        settle,
        event_limit,
        jam,
    }
}

/// The compiled half of heeltoe.
#[pymodule]
mod _kernel {
    use super::*;

    #[pymodule_export]
    use crate::flexible::CrackedDam;

    /// Run one block; see `_kernel.pyi`.
    #[pyfunction]
    #[pyo3(signature = (block, time, horizontal, vertical, output_times, start, settle, event_limit, jam))]
    #[allow(clippy::too_many_arguments)]
    fn run_rigid<'py>(
        py: Python<'py>,
        block: Numbers<'py>,
        time: Numbers<'py>,
        horizontal: Numbers<'py>,
        vertical: Option<Numbers<'py>>,
        output_times: Numbers<'py>,
        start: Option<[[f64; 3]; 2]>,
        settle: f64,
        event_limit: u64,
        jam: bool,
    ) -> PyResult<RunResult<'py>> {
        let block = Block::new(&parameters(block.as_slice()?)?);
        let vertical = vertical.as_ref().map(|v| v.as_slice()).transpose()?;
        let motion = motion(time.as_slice()?, horizontal.as_slice()?, vertical, [1.0, 1.0])?;
        let times = output_times.as_slice()?;
        let (summary, histories, log) = py.detach(|| {
            let mut log = Vec::new();
            let mut histories = Histories {
                times,
                rows: Vec::with_capacity(times.len()),
                modes: Vec::with_capacity(times.len()),
            };
            let wanted = (!times.is_empty()).then_some(&mut histories);
            let options = options(settle, event_limit, jam);
            let summary = simulate(&block, &motion, start, options, Some(&mut log), wanted);
            (summary, histories, log)
        });
        let events: Vec<_> = log.iter().map(event_row).collect();
        Ok((
            Array1::from(many::row(&summary).to_vec()).into_pyarray(py),
            table(&histories.rows).into_pyarray(py),
            Array1::from(histories.modes).into_pyarray(py),
            table(&events).into_pyarray(py),
        ))
    }

    /// Run one block under loads and at rotations that change; see `_kernel.pyi`.
    #[pyfunction]
    #[pyo3(signature = (block, varying, rotation, rule, pressure, anchors, time, horizontal, vertical, turning,
        output_times, start, settle, event_limit, jam))]
    #[allow(clippy::too_many_arguments)]
    fn run_rigid_varying<'py>(
        py: Python<'py>,
        block: Numbers<'py>,
        varying: Numbers<'py>,
        rotation: &str,
        rule: &str,
        pressure: PyReadonlyArray2<'py, f64>,
        anchors: PyReadonlyArray2<'py, f64>,
        time: Numbers<'py>,
        horizontal: Numbers<'py>,
        vertical: Option<Numbers<'py>>,
        turning: Option<Numbers<'py>>,
        output_times: Numbers<'py>,
        start: Option<[[f64; 3]; 2]>,
        settle: f64,
        event_limit: u64,
        jam: bool,
    ) -> PyResult<VaryingResult<'py>> {
        let block = Block::new(&parameters(block.as_slice()?)?);
        let numbers: [f64; VARYING_COUNT] = varying.as_slice()?.try_into().map_err(|_| {
            PyValueError::new_err(format!("a block that varies has {VARYING_COUNT} more numbers"))
        })?;
        let (points, odd) = pressure.as_slice()?.as_chunks::<2>();
        let (bars, rest) = anchors.as_slice()?.as_chunks::<6>();
        if !odd.is_empty() || !rest.is_empty() {
            return Err(PyValueError::new_err("pressure is (k, 2) and anchors (n, 6)"));
        }
        let water = Water {
            rule: named(rule, &Rule::NAMES, &Rule::ALL)?,
            points: points.to_vec(),
            opening: 0.0,
            full: 0.0,
        };
        let bars = bars
            .iter()
            .map(|&[distance, a, b, prestress, axial, shear]| Anchor {
                distance,
                axis: [a, b],
                prestress,
                axial_stiffness: axial,
                shear_stiffness: shear,
            });
        let rotation = named(rotation, &Rotation::NAMES, &Rotation::ALL)?;
        let body = TurningBlock::new(&numbers, rotation, water, bars.collect());
        let (time, horizontal) = (time.as_slice()?, horizontal.as_slice()?);
        let vertical = vertical.as_ref().map(|v| v.as_slice()).transpose()?;
        let turning = turning.as_ref().map(|v| v.as_slice()).transpose()?;
        motion(time, horizontal, vertical, [1.0, 1.0])?;
        motion(time, horizontal, turning, [1.0, 1.0])?;
        let ground = TurningGround {
            time,
            horizontal,
            vertical,
            rotation: turning,
        };
        let times = output_times.as_slice()?;
        let (summary, tension, histories, log) = py.detach(|| {
            let mut log = Vec::new();
            let mut histories = Histories {
                times,
                rows: Vec::with_capacity(times.len()),
                modes: Vec::with_capacity(times.len()),
            };
            let wanted = (!times.is_empty()).then_some(&mut histories);
            let options = options(settle, event_limit, jam);
            let (summary, tension) = walk::simulate(&block, &body, &ground, start, options, &mut log, wanted);
            (summary, tension, histories, log)
        });
        let events: Vec<_> = log.iter().map(event_row).collect();
        Ok((
            Array1::from(many::row(&summary).to_vec()).into_pyarray(py),
            table(&histories.rows).into_pyarray(py),
            Array1::from(histories.modes).into_pyarray(py),
            table(&events).into_pyarray(py),
            Array1::from(tension).into_pyarray(py),
        ))
    }

    /// Run many blocks on all cores; see `_kernel.pyi`.
    #[pyfunction]
    #[pyo3(signature = (blocks, motions, motion_of, scales, settle, event_limit, jam, threads))]
    #[allow(clippy::too_many_arguments)]
    fn run_rigid_many<'py>(
        py: Python<'py>,
        blocks: PyReadonlyArray2<'py, f64>,
        motions: Vec<(Numbers<'py>, Numbers<'py>, Option<Numbers<'py>>)>,
        motion_of: PyReadonlyArray1<'py, i64>,
        scales: PyReadonlyArray2<'py, f64>,
        settle: f64,
        event_limit: u64,
        jam: bool,
        threads: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (parameters, rest) = blocks.as_slice()?.as_chunks::<FIELD_COUNT>();
        let (factors, odd) = scales.as_slice()?.as_chunks::<2>();
        let which = motion_of.as_slice()?;
        let count = parameters.len();
        if !rest.is_empty() || !odd.is_empty() || factors.len() != count || which.len() != count {
            return Err(PyValueError::new_err(
                "blocks (n, 21), motion_of (n,) and scales (n, 2) must agree in n",
            ));
        }
        let mut checked = Vec::with_capacity(motions.len());
        for (time, horizontal, vertical) in &motions {
            let vertical = vertical.as_ref().map(|v| v.as_slice()).transpose()?;
            checked.push(motion(
                time.as_slice()?,
                horizontal.as_slice()?,
                vertical,
                [1.0, 1.0],
            )?);
        }
        if which.iter().any(|&m| m < 0 || m as usize >= checked.len()) {
            return Err(PyValueError::new_err(
                "motion_of names a motion that is not there",
            ));
        }
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| PyValueError::new_err(e.to_string()))?;
        let options = options(settle, event_limit, jam);
        let rows = py.detach(|| {
            pool.install(|| {
                many::run(count, options, |k| many::Case {
                    block: &parameters[k],
                    motion: Motion {
                        scale: factors[k],
                        ..checked[which[k] as usize]
                    },
                })
            })
        });
        Ok(table(&rows).into_pyarray(py))
    }

    /// Response spectrum; see `_kernel.pyi`.
    #[pyfunction]
    fn spectrum<'py>(
        py: Python<'py>,
        time: Numbers<'py>,
        ground: Numbers<'py>,
        periods: Numbers<'py>,
        damping: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (time, ground, periods) = (time.as_slice()?, ground.as_slice()?, periods.as_slice()?);
        motion(time, ground, None, [1.0, 1.0])?;
        if !(0.0..1.0).contains(&damping) || !periods.iter().all(|p| *p >= 0.0 && p.is_finite()) {
            return Err(PyValueError::new_err(
                "damping must be in [0, 1) and periods not negative",
            ));
        }
        let peaks = py.detach(|| heeltoe::spectrum::spectrum(time, ground, periods, damping));
        let rows: Vec<_> = peaks
            .iter()
            .map(|p| [p.displacement, p.total_acceleration])
            .collect();
        Ok(table(&rows).into_pyarray(py))
    }

    #[pymodule_init]
    fn init(m: &Bound<'_, PyModule>) -> PyResult<()> {
        m.add("BLOCK_FIELDS", BLOCK_FIELDS.to_vec())?;
        m.add("VARYING_FIELDS", VARYING_FIELDS.to_vec())?;
        m.add("SUMMARY_FIELDS", many::SUMMARY_FIELDS.to_vec())?;
        m.add("HISTORY_FIELDS", HISTORY_FIELDS.to_vec())?;
        m.add("EVENT_FIELDS", EVENT_FIELDS.to_vec())?;
        m.add("MODES", Mode::NAMES.to_vec())?;
        m.add("EVENT_KINDS", EventKind::NAMES.to_vec())?;
        m.add("OUTCOMES", Outcome::NAMES.to_vec())?;
        m.add(
            "CRACK_SUMMARY_FIELDS",
            heeltoe::flexible::result::Summary::FIELDS.to_vec(),
        )?;
        m.add("FRAME_FIELDS", heeltoe::flexible::result::Frames::FIELDS.to_vec())?;
        m.add(
            "CRACK_OUTCOMES",
            heeltoe::flexible::result::Outcome::NAMES.to_vec(),
        )?;
        m.add("CRACK_STATES", heeltoe::flexible::observe::STATES.to_vec())?;
        m.add(
            "CONTACT_STATUSES",
            heeltoe::flexible::coulomb::Status::NAMES.to_vec(),
        )?;
        m.add("VERSION", env!("CARGO_PKG_VERSION"))?;
        m.add(
            "PROFILE",
            if cfg!(debug_assertions) {
                "debug"
            } else {
                "release"
            },
        )?;
        Ok(())
    }
}
