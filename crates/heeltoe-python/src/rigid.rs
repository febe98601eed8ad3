//! The rigid model, bound to Python.

use heeltoe::asperity::{Asperities, AsperityNumbers};
use heeltoe::friction::Worn as BeenThrough;
use heeltoe::inside::{Anchor, Law};
use heeltoe::rigid::plane::{self, Across, CrossShaking};
use heeltoe::rigid::varying::{self, Rotation, Surface, TurningBlock, TurningShaking, VaryingNumbers};
use heeltoe::rigid::{
    exact, many, Block, BlockNumbers, Crest, Options, Outcome, Run, Shaking, Summary, Wanted,
};
use numpy::{IntoPyArray, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::law::FrictionLaw;
use crate::results::BlockRun;
use crate::tables::{flags, named, pool, row, rows, slice, wrong, Flags, Numbers};
use crate::watch::{prompt, watched};

/// Runs of no more events, samples and moments that are wanted take a few milliseconds: no one interrupts them.
const EVENTS_AT_ONCE: u64 = 2000;
const MOMENTS_AT_ONCE: usize = 50_000;
/// So many runs of many are made, side by side, before their numbers are put into columns.
const TOGETHER: usize = 4096;

/// How far a run has come (s).
fn reached(run: &Run) -> Option<[f64; 2]> {
    let [slip, ..] = run.summary.position;
    Some([run.summary.end_time, slip])
}

fn block(numbers: &Numbers) -> PyResult<Block> {
    Ok(Block::new(&BlockNumbers::from_row(&row(numbers, "a block")?)))
}

/// One run of a motion of so many samples with its events, and with what is seen of it at some moments (s), some of them
/// whole: beside Python, where it has many events.
fn walked(
    py: Python<'_>,
    samples: usize,
    (times, whole): (&Numbers, &Option<Flags>),
    options: Options,
    walk: impl Fn(Options, Wanted<'_>) -> Run + Sync,
) -> PyResult<Run> {
    let times = times.as_slice()?;
    let wanted = Wanted {
        times,
        whole: flags(whole, times.len())?,
        events: true,
        ..Wanted::default()
    };
    if samples + times.len() <= MOMENTS_AT_ONCE {
        let few = Options {
            event_limit: options.event_limit.min(EVENTS_AT_ONCE),
            ..options
        };
        let run = prompt(py, || walk(few, wanted))?;
        if run.summary.outcome != Outcome::EventLimit || few.event_limit == options.event_limit {
            return Ok(run);
        }
    }
    watched(py, None, reached, |stop| walk(options, Wanted { stop, ..wanted }))
}

/// Run one block; see `_kernel.pyi`.
#[pyfunction]
#[pyo3(signature = (block, time, horizontal, vertical, output_times, start, settle, event_limit, jam, whole=None))]
#[allow(clippy::too_many_arguments)]
pub fn run_rigid<'py>(
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
    whole: Option<Flags<'py>>,
) -> PyResult<BlockRun> {
    let block = self::block(&block)?;
    let shaking = Shaking::new(time.as_slice()?, horizontal.as_slice()?, slice(&vertical)?).map_err(wrong)?;
    let options = Options {
        settle,
        event_limit,
        jam,
    };
    let walk =
        |options: Options, wanted: Wanted<'_>| exact::simulate(&block, &shaking, start, options, wanted);
    let run = walked(py, time.len()?, (&output_times, &whole), options, walk)?;
    BlockRun::of(py, run, true)
}

/// Run one block whose ground shakes across the valley, too; see `_kernel.pyi`.
#[pyfunction]
#[pyo3(signature = (block, across, time, horizontal, vertical, cross, output_times, start, settle, event_limit, jam, whole=None))]
#[allow(clippy::too_many_arguments)]
pub fn run_rigid_plane<'py>(
    py: Python<'py>,
    block: Numbers<'py>,
    across: [f64; 5],
    time: Numbers<'py>,
    horizontal: Numbers<'py>,
    vertical: Option<Numbers<'py>>,
    cross: Numbers<'py>,
    output_times: Numbers<'py>,
    start: Option<[[f64; 3]; 2]>,
    settle: f64,
    event_limit: u64,
    jam: bool,
    whole: Option<Flags<'py>>,
) -> PyResult<BlockRun> {
    let block = self::block(&block)?;
    let level = Shaking::new(time.as_slice()?, horizontal.as_slice()?, slice(&vertical)?).map_err(wrong)?;
    let shaking = CrossShaking {
        level: &level,
        cross: cross.as_slice()?,
    };
    let across = self::across(across);
    across.check(&block, &shaking).map_err(wrong)?;
    let options = Options {
        settle,
        event_limit,
        jam,
    };
    let walk = |options: Options, wanted: Wanted<'_>| {
        plane::simulate(&block, &across, &shaking, start, options, wanted)
    };
    let run = walked(py, time.len()?, (&output_times, &whole), options, walk)?;
    BlockRun::of(py, run, true)
}

/// Motion across the valley: the mass, the gaps to the left and to the right, its place and its velocity.
fn across([mass, left, right, place, velocity]: [f64; 5]) -> Across {
    Across {
        mass,
        gap: [left, right],
        start: [place, velocity],
    }
}

/// Run one block under loads and at rotations that change; see `_kernel.pyi`.
#[pyfunction]
#[pyo3(signature = (block, varying, rotation, law, pressure, anchors, friction, asperities, time, horizontal,
    vertical, turning, output_times, start, worn, rough, settle, event_limit, jam, across=None, cross=None, whole=None))]
#[allow(clippy::too_many_arguments)]
pub fn run_rigid_varying<'py>(
    py: Python<'py>,
    block: Numbers<'py>,
    varying: Numbers<'py>,
    rotation: &str,
    law: &str,
    pressure: PyReadonlyArray2<'py, f64>,
    anchors: PyReadonlyArray2<'py, f64>,
    friction: Option<PyRef<'py, FrictionLaw>>,
    asperities: Option<Numbers<'py>>,
    time: Numbers<'py>,
    horizontal: Numbers<'py>,
    vertical: Option<Numbers<'py>>,
    turning: Option<Numbers<'py>>,
    output_times: Numbers<'py>,
    start: Option<[[f64; 3]; 2]>,
    worn: Option<(f64, bool)>,
    rough: Option<[f64; 2]>,
    settle: f64,
    event_limit: u64,
    jam: bool,
    across: Option<[f64; 5]>,
    cross: Option<Numbers<'py>>,
    whole: Option<Flags<'py>>,
) -> PyResult<BlockRun> {
    let block = self::block(&block)?;
    let anchors = rows(anchors.as_slice()?, "anchors")?.iter().map(anchor).collect();
    let body = TurningBlock::new(
        &VaryingNumbers::from_row(&row(&varying, "a block that varies")?),
        named(rotation, Rotation::named, &Rotation::NAMES)?,
        named(law, Law::named, &Law::NAMES)?,
        rows(pressure.as_slice()?, "pressure")?.to_vec(),
        anchors,
    );
    let level = Shaking::new(time.as_slice()?, horizontal.as_slice()?, slice(&vertical)?).map_err(wrong)?;
    let shaking = TurningShaking::new(level.clone(), slice(&turning)?).map_err(wrong)?;
    let options = Options {
        settle,
        event_limit,
        jam,
    };
    let law = friction.map(|friction| friction.0.clone());
    let asperities = asperities.as_ref().map(self::asperities).transpose()?;
    let surface = law.as_ref().map(|law| Surface {
        law,
        worn: worn.map_or(BeenThrough::FRESH, |(path, bonded)| BeenThrough { path, bonded }),
        asperities: asperities.map(|asperities| (asperities, rough.unwrap_or_default())),
    });
    if let (Some(across), Some(cross)) = (across, slice(&cross)?) {
        let varying = (&body, surface.as_ref());
        Across::check_varying(varying, &shaking).map_err(wrong)?;
        let (across, shaking) = (self::across(across), CrossShaking { level: &level, cross });
        across.check(&block, &shaking).map_err(wrong)?;
        let walk = |options: Options, wanted: Wanted<'_>| {
            plane::simulate_varying(&block, &across, &shaking, varying, start, options, wanted)
        };
        let run = walked(py, time.len()?, (&output_times, &whole), options, walk)?;
        return BlockRun::of(py, run, true);
    }
    let walk = |options: Options, wanted: Wanted<'_>| {
        varying::simulate(&block, &body, surface.as_ref(), &shaking, start, options, wanted)
    };
    let run = walked(py, time.len()?, (&output_times, &whole), options, walk)?;
    BlockRun::of(py, run, false)
}

fn asperities(numbers: &Numbers) -> PyResult<Asperities> {
    let numbers = AsperityNumbers::from_row(&row(numbers, "a rough crack")?);
    Ok(Asperities::new(&numbers))
}

fn anchor(
    &[place, along, across, prestress, axial_stiffness, shear_stiffness, capacity]: &[f64; 7],
) -> Anchor<f64> {
    Anchor {
        place,
        axis: [along, across],
        prestress,
        axial_stiffness,
        shear_stiffness,
        capacity,
    }
}

/// Run many blocks on all cores; see `_kernel.pyi`.
#[pyfunction]
#[pyo3(signature = (blocks, motions, motion_of, scales, settle, event_limit, jam, threads, crest=None))]
#[allow(clippy::too_many_arguments)]
pub fn run_rigid_many<'py>(
    py: Python<'py>,
    blocks: PyReadonlyArray2<'py, f64>,
    motions: Vec<(Numbers<'py>, Numbers<'py>, Option<Numbers<'py>>)>,
    motion_of: PyReadonlyArray1<'py, i64>,
    scales: PyReadonlyArray2<'py, f64>,
    settle: f64,
    event_limit: u64,
    jam: bool,
    threads: usize,
    crest: Option<(PyReadonlyArray2<'py, f64>, Vec<Numbers<'py>>, Numbers<'py>)>,
) -> PyResult<Bound<'py, PyDict>> {
    let (blocks, scales) = (blocks.as_slice()?, scales.as_slice()?);
    let (blocks, scales) = (rows(blocks, "blocks")?, rows(scales, "scales")?);
    let which = motion_of.as_slice()?;
    let count = blocks.len();
    if scales.len() != count || which.len() != count {
        return Err(wrong("blocks, motion_of and scales must be as many"));
    }
    let shakings = motions
        .iter()
        .map(|(time, horizontal, vertical)| {
            Shaking::new(time.as_slice()?, horizontal.as_slice()?, slice(vertical)?).map_err(wrong)
        })
        .collect::<PyResult<Vec<_>>>()?;
    if which.iter().any(|&m| m < 0 || m as usize >= shakings.len()) {
        return Err(wrong("motion_of names a motion that is not there"));
    }
    let options = Options {
        settle,
        event_limit,
        jam,
    };
    let moves = crest.as_ref().map(|(moves, ..)| moves.as_slice()).transpose()?;
    let moves = moves.map(|moves| rows::<3>(moves, "crest")).transpose()?;
    let times = crest.iter().flat_map(|(_, times, _)| times);
    let times = times
        .map(|times| times.as_slice())
        .collect::<Result<Vec<_>, _>>()?;
    let weights = crest
        .as_ref()
        .map_or(Ok(&[][..]), |(.., weights)| weights.as_slice())?;
    if moves.is_some_and(|moves| moves.len() != count || times.len() != shakings.len()) {
        return Err(wrong(
            "a crest must be said of each block, its moments of each motion",
        ));
    }
    let case = |k: usize| {
        let motion = which[k] as usize;
        let crest = moves.map(|moves| Crest {
            times: times[motion],
            moves: moves[k],
            weights,
        });
        (
            BlockNumbers::from_row(&blocks[k]),
            shakings[motion].scaled(scales[k]),
            crest,
        )
    };
    let pool = pool(threads)?;
    let mut columns: [Vec<f64>; Summary::FIELDS.len()] = std::array::from_fn(|_| Vec::with_capacity(count));
    let mut peaks: [Vec<f64>; 2] = Default::default();
    // The summaries of all runs would be in memory beside what is made of them.
    for start in (0..count).step_by(TOGETHER) {
        let some = TOGETHER.min(count - start);
        let runs = watched(
            py,
            None,
            |_| None,
            |stop| pool.install(|| many::run(some, options, stop, |k| case(start + k))),
        )?;
        for (summary, crest) in runs {
            for (column, number) in columns.iter_mut().zip(summary.row()) {
                column.push(number);
            }
            if moves.is_some() {
                peaks
                    .iter_mut()
                    .zip(crest)
                    .for_each(|(column, peak)| column.push(peak));
            }
        }
    }
    let table = PyDict::new(py);
    for (name, column) in Summary::FIELDS.into_iter().zip(columns) {
        table.set_item(name, column.into_pyarray(py))?;
    }
    if moves.is_some() {
        for (name, column) in ["crest_displacement", "crest_acceleration"]
            .into_iter()
            .zip(peaks)
        {
            table.set_item(name, column.into_pyarray(py))?;
        }
    }
    Ok(table)
}
