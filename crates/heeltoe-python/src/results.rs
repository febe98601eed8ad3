//! What runs return, as classes with a field for each number; see `_kernel.pyi`.

use heeltoe::flexible::{self as elastic, Frames};
use heeltoe::inside::Borne;
use heeltoe::rigid::stack::StackRun as TwoBlocks;
use heeltoe::rigid::{Crossing as Crossed, Event, EventKind, Mode, Moment, Outcome, Run, Summary};
use numpy::ndarray::Array2;
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::tables::{kept, shaped, table, wrong};

type Column = Py<PyArray1<f64>>;
type Table = Py<PyArray2<f64>>;

/// Whether fields have the names of a kernel's columns, in their order.
const fn same(fields: &[&str], columns: &[&str]) -> bool {
    let mut k = 0;
    while k < fields.len() {
        let (field, column) = (fields[k].as_bytes(), columns[k].as_bytes());
        if field.len() != column.len() {
            return false;
        }
        let mut i = 0;
        while i < field.len() {
            if field[i] != column[i] {
                return false;
            }
            i += 1;
        }
        k += 1;
    }
    fields.len() == columns.len()
}

/// A class of the numbers that a kernel has in a row.
macro_rules! numbers {
    ($name:ident of $row:ty { $($field:ident)+ }) => {
        #[pyclass(frozen, get_all, eq, module = "heeltoe.kernel._kernel")]
        #[derive(Clone, PartialEq)]
        pub struct $name {
            $($field: f64,)+
        }

        impl $name {
            pub fn of([$($field),+]: [f64; <$row>::FIELDS.len()]) -> Self {
                const { assert!(same(&[$(stringify!($field)),+], &<$row>::FIELDS)) };
                $name { $($field),+ }
            }
        }

        #[pymethods]
        impl $name {
            /// See `_kernel.pyi`.
            fn by_name<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
                let named = PyDict::new(py);
                $(named.set_item(stringify!($field), self.$field)?;)+
                Ok(named)
            }
        }
    };
}

/// A class of the columns of a kernel's table.
macro_rules! columns {
    ($name:ident of $row:ty { $($field:ident)+ }) => {
        #[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
        pub struct $name {
            $($field: Column,)+
        }

        impl $name {
            pub fn of(
                py: Python<'_>,
                rows: impl ExactSizeIterator<Item = [f64; <$row>::FIELDS.len()]>,
            ) -> PyResult<Self> {
                const { assert!(same(&[$(stringify!($field)),+], &<$row>::FIELDS)) };
                let [$($field),+] = columns_of(py, rows)?;
                Ok($name { $($field),+ })
            }
        }

        #[pymethods]
        impl $name {
            /// See `_kernel.pyi`.
            fn by_name<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
                let named = PyDict::new(py);
                $(named.set_item(stringify!($field), &self.$field)?;)+
                Ok(named)
            }
        }
    };
    ($name:ident of $row:ty { $($field:ident)+ }, joined) => {
        columns!($name of $row { $($field)+ });

        impl $name {
            fn then(&self, py: Python<'_>, later: &Self) -> PyResult<Self> {
                Ok($name { $($field: joined(py, &self.$field, &later.$field)?),+ })
            }
        }
    };
}

fn array<T: Element>(py: Python<'_>, values: Vec<T>) -> Py<PyArray1<T>> {
    values.into_pyarray(py).unbind()
}

/// The columns of rows, one behind the other in one array: many small ones cost more to lay out than to fill.
fn columns_of<const N: usize>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> PyResult<[Column; N]> {
    let count = rows.len();
    let mut values = vec![0.0; N * count];
    for (place, row) in rows.enumerate() {
        for (k, value) in row.into_iter().enumerate() {
            values[k * count + place] = value;
        }
    }
    let table = shaped(py, values, N)?;
    let column = |k: usize| Ok(table.get_item(k)?.cast_into::<PyArray1<f64>>()?.unbind());
    let columns: Vec<Column> = (0..N).map(column).collect::<PyResult<_>>()?;
    Ok(columns.try_into().expect("a column for each name"))
}

/// One array behind the other.
fn joined<T: Element + Copy>(
    py: Python<'_>,
    first: &Py<PyArray1<T>>,
    later: &Py<PyArray1<T>>,
) -> PyResult<Py<PyArray1<T>>> {
    let (first, later) = (first.bind(py).readonly(), later.bind(py).readonly());
    Ok(array(py, [first.as_slice()?, later.as_slice()?].concat()))
}

/// Rows, and later ones below them.
fn below(py: Python<'_>, first: &Table, later: &Table) -> PyResult<Table> {
    let (first, later) = (first.bind(py), later.bind(py));
    let values = [first.readonly().as_slice()?, later.readonly().as_slice()?].concat();
    let shape = (first.shape()[0] + later.shape()[0], first.shape()[1]);
    let both = Array2::from_shape_vec(shape, values).map_err(wrong)?;
    Ok(both.into_pyarray(py).unbind())
}

/// Columns of rows by their names.
pub fn by_column<'py, const N: usize>(
    py: Python<'py>,
    names: [&str; N],
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> PyResult<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    for (name, column) in names.into_iter().zip(columns_of(py, rows)?) {
        named.set_item(name, column)?;
    }
    Ok(named)
}

numbers!(BlockSummary of Summary {
    outcome end_time final_mode slip gap_heel gap_toe slip_velocity gap_velocity_heel gap_velocity_toe slip_min slip_max
    rotation_min rotation_max largest_gap_heel largest_gap_toe slip_sliding slip_slide_rocking slip_drifting time_rest
    time_sliding time_rocking time_slide_rocking time_drifting impacts events largest_impact_velocity
    energy_limited_impacts jams slip_stops energy_input energy_friction energy_impact energy_kinetic energy_residual
});

columns!(BlockHistories of Moment {
    slip gap_heel gap_toe slip_velocity gap_velocity_heel gap_velocity_toe slip_acceleration gap_acceleration_heel
    gap_acceleration_toe friction_force normal_force_heel normal_force_toe
}, joined);

columns!(BlockEvents of Event {
    time kind mode_before mode_after slip gap_heel gap_toe slip_velocity gap_velocity_heel gap_velocity_toe
    approach_slip_velocity approach_velocity_heel approach_velocity_toe friction_impulse heel_impulse toe_impulse
    energy_lost
}, joined);

numbers!(DamSummary of elastic::Summary {
    outcome end_time slip slip_max slip_min slip_velocity rotation_max rotation_min opening_upstream opening_downstream penetration
    slip_sliding slip_slide_rocking slip_drifting time_rest time_sliding time_rocking time_slide_rocking time_drifting
    impacts largest_impact_velocity peak_normal_force energy_start energy_stored energy_penalty energy_input
    energy_damping energy_numerical energy_impact energy_friction energy_gained energy_turnover energy_residual steps
    iterations most_iterations sweeps contact_residual final_state crack_friction crack_impact slip_path bond_energy
    energy_fracture energy_boundary energy_floor energy_far_end crack_fracture first_cracking first_cracking_place cracked_through cracked_from_heel
    cracked_from_toe cracked_length softening_length cross_slip cross_slip_max cross_slip_min cross_slip_path side_contacts
    time_at_side side_impulse
});

columns!(DamFrames of Frames {
    time slip slip_velocity rotation gap_heel gap_toe normal_force friction_force touching state stored_energy
    input_energy damping_energy impact_energy friction_energy numerical_energy slip_path friction_strength
    fracture_energy boundary_energy floor_energy far_end_energy cracked_upstream cracked_downstream cracked_length softening_length
    slip_cross friction_cross
});

columns!(StressExtremes of elastic::Extreme { tension tension_time xx zz xz compression compression_time });

columns!(WornContacts of elastic::Worked {
    crack length double path bonded path_before bonded_before normal_force_before
});

impl BlockSummary {
    /// This and a later run as one. Of two residuals of the books, relative to the size of their entries, the larger
    /// bounds that of both together.
    fn then(&self, later: &Self) -> Self {
        let least = |a: f64, b: f64| if b < a { b } else { a };
        let largest = |a: f64, b: f64| if b > a { b } else { a };
        BlockSummary {
            slip_min: least(self.slip_min, later.slip_min),
            rotation_min: least(self.rotation_min, later.rotation_min),
            slip_max: largest(self.slip_max, later.slip_max),
            rotation_max: largest(self.rotation_max, later.rotation_max),
            largest_gap_heel: largest(self.largest_gap_heel, later.largest_gap_heel),
            largest_gap_toe: largest(self.largest_gap_toe, later.largest_gap_toe),
            largest_impact_velocity: largest(self.largest_impact_velocity, later.largest_impact_velocity),
            energy_residual: largest(self.energy_residual, later.energy_residual),
            slip_sliding: self.slip_sliding + later.slip_sliding,
            slip_slide_rocking: self.slip_slide_rocking + later.slip_slide_rocking,
            slip_drifting: self.slip_drifting + later.slip_drifting,
            time_rest: self.time_rest + later.time_rest,
            time_sliding: self.time_sliding + later.time_sliding,
            time_rocking: self.time_rocking + later.time_rocking,
            time_slide_rocking: self.time_slide_rocking + later.time_slide_rocking,
            time_drifting: self.time_drifting + later.time_drifting,
            impacts: self.impacts + later.impacts,
            events: self.events + later.events,
            energy_limited_impacts: self.energy_limited_impacts + later.energy_limited_impacts,
            jams: self.jams + later.jams,
            slip_stops: self.slip_stops + later.slip_stops,
            energy_input: self.energy_input + later.energy_input,
            energy_friction: self.energy_friction + later.energy_friction,
            energy_impact: self.energy_impact + later.energy_impact,
            ..later.clone()
        }
    }
}

impl CrossingSummary {
    /// This and a later run as one.
    fn then(&self, later: &Self) -> Self {
        CrossingSummary {
            slip_min: self.slip_min.min(later.slip_min),
            slip_max: self.slip_max.max(later.slip_max),
            path: self.path + later.path,
            side_impulse: self.side_impulse + later.side_impulse,
            time_at_side: self.time_at_side + later.time_at_side,
            side_strikes: self.side_strikes + later.side_strikes,
            ..later.clone()
        }
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct Worn {
    path: Column,
    bonded: Column,
    end: f64,
    bonded_at_end: bool,
    error: f64,
    integrated: f64,
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct Roughness {
    kept: Table,
    end: (f64, f64, f64),
    highest: f64,
}

numbers!(CrossingSummary of Crossed { slip slip_velocity slip_min slip_max path side_impulse time_at_side side_strikes });

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct Crossing {
    kept: Table,
    summary: Py<CrossingSummary>,
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct BlockRun {
    summary: Py<BlockSummary>,
    histories: Py<BlockHistories>,
    mode: Py<PyArray1<u8>>,
    events: Py<BlockEvents>,
    anchors: Option<Table>,
    worn: Option<Py<Worn>>,
    rough: Option<Py<Roughness>>,
    crossing: Option<Py<Crossing>>,
    places: Table,
}

impl BlockRun {
    /// What a walk returns; `exact` where it was, and no anchor could stretch.
    pub fn of(py: Python<'_>, run: Run, exact: bool) -> PyResult<Self> {
        let modes = run.moments.iter().map(|m| m.mode.index() as u8).collect();
        let worn = run.worn.map(|wear| Worn {
            path: array(py, wear.kept.iter().map(|kept| kept[0]).collect()),
            bonded: array(py, wear.kept.iter().map(|kept| kept[1]).collect()),
            end: wear.end.path,
            bonded_at_end: wear.end.bonded,
            error: wear.error,
            integrated: wear.integrated,
        });
        let rough = run.rough.map(|rough| Roughness {
            kept: kept(py, rough.kept).unbind(),
            end: rough.end.into(),
            highest: rough.highest,
        });
        let crossing = match run.crossing {
            Some(crossing) => Some(Crossing {
                summary: Py::new(py, CrossingSummary::of(crossing.row()))?,
                kept: kept(py, crossing.kept).unbind(),
            }),
            None => None,
        };
        Ok(BlockRun {
            summary: Py::new(py, BlockSummary::of(run.summary.row()))?,
            histories: Py::new(py, BlockHistories::of(py, run.moments.iter().map(Moment::row))?)?,
            mode: array(py, modes),
            events: Py::new(py, BlockEvents::of(py, run.events.iter().map(Event::row))?)?,
            anchors: (!exact).then(|| table(py, run.anchors.iter().map(Borne::row)).unbind()),
            worn: worn.map(|worn| Py::new(py, worn)).transpose()?,
            rough: rough.map(|rough| Py::new(py, rough)).transpose()?,
            crossing: crossing.map(|crossing| Py::new(py, crossing)).transpose()?,
            places: kept(py, run.places).unbind(),
        })
    }
}

#[pymethods]
impl BlockRun {
    #[getter]
    fn exact(&self) -> bool {
        self.anchors.is_none()
    }

    #[getter]
    fn outcome(&self) -> &'static str {
        Outcome::NAMES[self.summary.get().outcome as usize]
    }

    #[getter]
    fn final_mode(&self) -> &'static str {
        Mode::NAMES[self.summary.get().final_mode as usize]
    }

    /// See `_kernel.pyi`.
    #[pyo3(signature = (*kinds))]
    fn times_of(&self, py: Python<'_>, kinds: Vec<String>) -> PyResult<Vec<f64>> {
        let events = self.events.get();
        let (time, kind) = (events.time.bind(py).readonly(), events.kind.bind(py).readonly());
        let wanted = |kind: f64| kinds.iter().any(|name| name == EventKind::NAMES[kind as usize]);
        let pairs = time.as_slice()?.iter().zip(kind.as_slice()?);
        Ok(pairs
            .filter(|(_, kind)| wanted(**kind))
            .map(|(time, _)| *time)
            .collect())
    }

    /// See `_kernel.pyi`.
    fn then(&self, py: Python<'_>, later: &Self) -> PyResult<Self> {
        let anchors = match (&self.anchors, &later.anchors) {
            (Some(first), Some(later)) => {
                let (first, later) = (first.bind(py), later.bind(py));
                let (above, below) = (first.readonly(), later.readonly());
                let pairs = above.as_slice()?.iter().zip(below.as_slice()?);
                let columns = Borne::FIELDS.iter().cycle();
                let both = pairs
                    .zip(columns)
                    .map(|((&first, &later), column)| match *column {
                        "last" => later,
                        // The first time; below zero where there is none.
                        "slack" | "yields" if first >= 0.0 => first,
                        _ => first.max(later),
                    });
                Some(shaped(py, both.collect(), first.shape()[0])?.unbind())
            }
            _ => None,
        };
        let worn = match (&self.worn, &later.worn) {
            (Some(first), Some(later)) => {
                let (first, later) = (first.get(), later.get());
                Some(Worn {
                    path: joined(py, &first.path, &later.path)?,
                    bonded: joined(py, &first.bonded, &later.bonded)?,
                    error: first.error + later.error,
                    integrated: first.integrated + later.integrated,
                    ..*later
                })
            }
            _ => None,
        };
        let rough = match (&self.rough, &later.rough) {
            (Some(first), Some(later)) => {
                let (first, later) = (first.get(), later.get());
                Some(Roughness {
                    kept: below(py, &first.kept, &later.kept)?,
                    highest: first.highest.max(later.highest),
                    ..*later
                })
            }
            _ => None,
        };
        let crossing = match (&self.crossing, &later.crossing) {
            (Some(first), Some(later)) => {
                let (first, later) = (first.get(), later.get());
                let crossing = Crossing {
                    kept: below(py, &first.kept, &later.kept)?,
                    summary: Py::new(py, first.summary.get().then(later.summary.get()))?,
                };
                Some(Py::new(py, crossing)?)
            }
            _ => None,
        };
        Ok(BlockRun {
            summary: Py::new(py, self.summary.get().then(later.summary.get()))?,
            histories: Py::new(py, self.histories.get().then(py, later.histories.get())?)?,
            mode: joined(py, &self.mode, &later.mode)?,
            events: Py::new(py, self.events.get().then(py, later.events.get())?)?,
            anchors,
            worn: worn.map(|worn| Py::new(py, worn)).transpose()?,
            rough: rough.map(|rough| Py::new(py, rough)).transpose()?,
            crossing,
            places: below(py, &self.places, &later.places)?,
        })
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct StackRun {
    cracks: (Py<BlockRun>, Py<BlockRun>),
    tilts: Table,
    lost: Table,
}

impl StackRun {
    pub fn of(py: Python<'_>, run: TwoBlocks) -> PyResult<Self> {
        let [below, above] = run.cracks.map(|run| Py::new(py, BlockRun::of(py, run, true)?));
        Ok(StackRun {
            cracks: (below?, above?),
            tilts: table(py, run.tilts.into_iter()).unbind(),
            lost: table(py, run.lost.into_iter()).unbind(),
        })
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct AtRest {
    slips: Py<PyTuple>,
    open_contacts: Py<PyTuple>,
    modes: Py<PyTuple>,
    forces: Py<PyTuple>,
}

/// Arrays of so many rows.
fn tables(py: Python<'_>, values: Vec<Vec<f64>>, rows: usize) -> PyResult<Py<PyTuple>> {
    let tables = values.into_iter().map(|values| shaped(py, values, rows));
    Ok(PyTuple::new(py, tables.collect::<PyResult<Vec<_>>>()?)?.unbind())
}

impl AtRest {
    pub fn of(py: Python<'_>, dam: &elastic::Dam, still: &elastic::Still) -> PyResult<Self> {
        let modes = still
            .amplitudes(&dam.bodies)
            .into_iter()
            .map(|modes| array(py, modes));
        Ok(AtRest {
            slips: PyTuple::new(py, &still.slip)?.unbind(),
            open_contacts: PyTuple::new(py, &still.open)?.unbind(),
            modes: PyTuple::new(py, modes.collect::<Vec<_>>())?.unbind(),
            forces: tables(py, still.forces(&dam.cracks), 2)?,
        })
    }
}

/// See `_kernel.pyi`.
#[pyclass(frozen, get_all, module = "heeltoe.kernel._kernel")]
pub struct DamRun {
    summary: Py<DamSummary>,
    anchors: Py<PyTuple>,
    frames: Py<DamFrames>,
    summaries: Py<PyTuple>,
    all_frames: Py<PyTuple>,
    upper: Py<PyTuple>,
    lower: Py<PyTuple>,
    force: Py<PyTuple>,
    status: Py<PyArray2<u8>>,
    damage: Table,
    modes: Py<PyTuple>,
    water: Table,
    extremes: Py<PyTuple>,
    pressures: Py<StressExtremes>,
    worked: Py<WornContacts>,
    crest: Column,
    crest_cross: Column,
}

impl DamRun {
    /// What a run returns; `asked` is the crack that is asked of.
    pub fn of(py: Python<'_>, run: elastic::Run, asked: usize) -> PyResult<Self> {
        let (frames, cracks) = (run.frames, run.cracks.len());
        let count = frames.rows.len() / cracks;
        let summaries: Vec<_> = run
            .cracks
            .iter()
            .map(|crack| Py::new(py, DamSummary::of(crack.row())))
            .collect::<PyResult<_>>()?;
        let own = |k: usize| frames.rows.iter().skip(k).step_by(cracks).copied();
        let all_frames: Vec<_> = (0..cracks)
            .map(|k| Py::new(py, DamFrames::of(py, own(k))?))
            .collect::<PyResult<_>>()?;
        let extremes: Vec<_> = run
            .extremes
            .iter()
            .map(|places| {
                Py::new(
                    py,
                    StressExtremes::of(py, places.iter().map(elastic::Extreme::row))?,
                )
            })
            .collect::<PyResult<_>>()?;
        let anchors = run
            .cracks
            .iter()
            .map(|crack| table(py, crack.anchors.iter().map(Borne::row)));
        let anchors: Vec<_> = anchors.collect();
        Ok(DamRun {
            summary: summaries[asked].clone_ref(py),
            anchors: PyTuple::new(py, anchors)?.unbind(),
            frames: all_frames[asked].clone_ref(py),
            summaries: PyTuple::new(py, summaries)?.unbind(),
            all_frames: PyTuple::new(py, all_frames)?.unbind(),
            upper: tables(py, frames.upper, count)?,
            lower: tables(py, frames.lower, count)?,
            force: tables(py, frames.force, count)?,
            status: shaped(py, frames.status, count)?.unbind(),
            damage: shaped(py, frames.damage, count)?.unbind(),
            modes: tables(py, frames.modes, count)?,
            water: shaped(py, frames.water, count)?.unbind(),
            extremes: PyTuple::new(py, extremes)?.unbind(),
            pressures: Py::new(
                py,
                StressExtremes::of(py, run.pressures.iter().map(elastic::Extreme::row))?,
            )?,
            crest: array(py, run.crest),
            crest_cross: array(py, run.crest_cross),
            worked: Py::new(
                py,
                WornContacts::of(py, run.worked.iter().map(elastic::Worked::row))?,
            )?,
        })
    }
}

#[pymethods]
impl DamRun {
    #[getter]
    fn outcome(&self) -> &'static str {
        elastic::Outcome::NAMES[self.summary.get().outcome as usize]
    }

    #[getter]
    fn final_state(&self) -> &'static str {
        elastic::State::NAMES[self.summary.get().final_state as usize]
    }
}
