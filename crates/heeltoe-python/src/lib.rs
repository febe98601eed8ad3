//! Kernels of heeltoe, bound to Python as `heeltoe.kernel._kernel`.

mod elimination;
mod flexible;
mod law;
mod memory;
mod results;
mod rigid;
mod stack;
mod tables;
mod watch;

use heeltoe::asperity::AsperityNumbers;
use heeltoe::flexible::{self as elastic, State, Status};
use heeltoe::friction::{LawNumbers, Shape};
use heeltoe::rigid::stack::Place;
use heeltoe::rigid::varying::VaryingNumbers;
use heeltoe::rigid::{BlockNumbers, EventKind, Mode, Outcome, Shaking, Summary};
use numpy::PyArray2;
use pyo3::prelude::*;

use tables::{table, wrong, Numbers};
use watch::{quiet, watched, InternalError};

#[global_allocator]
static MEMORY: memory::WholeLines = memory::WholeLines;

/// The compiled half of heeltoe.
#[pymodule]
mod _kernel {
    use super::*;

    #[pymodule_export]
    use crate::elimination::{SymmetricFactors, SymmetricPattern};
    #[pymodule_export]
    use crate::flexible::CrackedDam;
    #[pymodule_export]
    use crate::law::FrictionLaw;
    #[pymodule_export]
    use crate::results::{
        AtRest, BlockEvents, BlockHistories, BlockRun, BlockSummary, Crossing, CrossingSummary, DamFrames,
        DamRun, DamSummary, Roughness, StackRun, StressExtremes, Worn, WornContacts,
    };
    #[pymodule_export]
    use crate::rigid::{run_rigid, run_rigid_many, run_rigid_plane, run_rigid_varying};
    #[pymodule_export]
    use crate::stack::run_rigid_stack;
    #[pymodule_export]
    use crate::watch::Ending;
    #[cfg(unix)]
    #[pymodule_export]
    use crate::watch::{end_if_deaf, hear_interruption};

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
        Shaking::new(time, ground, None).map_err(wrong)?;
        if !(0.0..1.0).contains(&damping) || !periods.iter().all(|p| *p >= 0.0 && p.is_finite()) {
            return Err(wrong("damping must be in [0, 1) and periods not negative"));
        }
        let peaks = watched(
            py,
            None,
            |_| None,
            |stop| heeltoe::spectrum::spectrum(time, ground, periods, damping, stop),
        )?;
        Ok(table(
            py,
            peaks.iter().map(|p| [p.displacement, p.total_acceleration]),
        ))
    }

    #[pymodule_init]
    fn init(m: &Bound<'_, PyModule>) -> PyResult<()> {
        quiet();
        m.add("InternalError", m.py().get_type::<InternalError>())?;
        m.add("BLOCK_FIELDS", BlockNumbers::FIELDS.to_vec())?;
        m.add("PLACE_FIELDS", Place::FIELDS.to_vec())?;
        m.add("VARYING_FIELDS", VaryingNumbers::FIELDS.to_vec())?;
        m.add("ASPERITY_FIELDS", AsperityNumbers::FIELDS.to_vec())?;
        m.add("LAW_FIELDS", LawNumbers::FIELDS.to_vec())?;
        m.add("LAWS", Shape::NAMES.to_vec())?;
        m.add("SUMMARY_FIELDS", Summary::FIELDS.to_vec())?;
        m.add("MODES", Mode::NAMES.to_vec())?;
        m.add("EVENT_KINDS", EventKind::NAMES.to_vec())?;
        m.add("OUTCOMES", Outcome::NAMES.to_vec())?;
        m.add("CRACK_OUTCOMES", elastic::Outcome::NAMES.to_vec())?;
        m.add("CRACK_STATES", State::NAMES.to_vec())?;
        m.add("CONTACT_STATUSES", Status::NAMES.to_vec())?;
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
