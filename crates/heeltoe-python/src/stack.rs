//! Two rigid blocks, one on the other, bound to Python.

use heeltoe::rigid::stack::{self, simulate, Place, Stack};
use heeltoe::rigid::{BlockNumbers, Options, Shaking, Wanted};
use pyo3::prelude::*;

use crate::results::StackRun;
use crate::tables::{flags, row, slice, wrong, Flags, Numbers};
use crate::watch::watched;

/// How far a run has come (s).
fn reached(run: &stack::StackRun) -> Option<[f64; 2]> {
    let summary = &run.cracks[0].summary;
    Some([summary.end_time, summary.position[0]])
}

/// Run two blocks; see `_kernel.pyi`.
#[pyfunction]
#[pyo3(signature = (lower, upper, place, time, horizontal, vertical, output_times, settle, event_limit, jam, whole=None))]
#[allow(clippy::too_many_arguments)]
pub fn run_rigid_stack<'py>(
    py: Python<'py>,
    lower: Numbers<'py>,
    upper: Numbers<'py>,
    place: Numbers<'py>,
    time: Numbers<'py>,
    horizontal: Numbers<'py>,
    vertical: Option<Numbers<'py>>,
    output_times: Numbers<'py>,
    settle: f64,
    event_limit: u64,
    jam: bool,
    whole: Option<Flags<'py>>,
) -> PyResult<StackRun> {
    let block = |numbers: &Numbers| Ok::<_, PyErr>(BlockNumbers::from_row(&row(numbers, "a block")?));
    let place = Place::from_row(&row(&place, "a place")?);
    let stack = Stack::new(&block(&lower)?, &block(&upper)?, &place).map_err(wrong)?;
    let shaking = Shaking::new(time.as_slice()?, horizontal.as_slice()?, slice(&vertical)?).map_err(wrong)?;
    let options = Options {
        settle,
        event_limit,
        jam,
    };
    let times = output_times.as_slice()?;
    let whole = flags(&whole, times.len())?;
    let run = watched(py, None, reached, |stop| {
        let wanted = Wanted {
            times,
            whole,
            events: true,
            stop,
        };
        simulate(&stack, &shaking, options, wanted)
    })?;
    StackRun::of(py, run)
}
