//! Arrays as Python gives and takes them.

use numpy::ndarray::Array2;
use numpy::{Element, IntoPyArray, PyArray2, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::ThreadPool;

pub type Numbers<'py> = PyReadonlyArray1<'py, f64>;
pub type Flags<'py> = PyReadonlyArray1<'py, bool>;

/// A slip of the caller's, who is the Python half: users never see it.
pub fn wrong(what: impl ToString) -> PyErr {
    PyValueError::new_err(what.to_string())
}

/// Rows of equal length, as an array.
pub fn table<const N: usize>(
    py: Python<'_>,
    rows: impl ExactSizeIterator<Item = [f64; N]>,
) -> Bound<'_, PyArray2<f64>> {
    let mut values = Vec::with_capacity(N * rows.len());
    rows.for_each(|row| values.extend_from_slice(&row));
    Array2::from_shape_vec((values.len() / N, N), values)
        .expect("rows of equal length")
        .into_pyarray(py)
}

/// The same of rows that are handed over.
pub fn kept<const N: usize>(py: Python<'_>, rows: Vec<[f64; N]>) -> Bound<'_, PyArray2<f64>> {
    Array2::from_shape_vec((rows.len(), N), rows.into_flattened())
        .expect("rows of equal length")
        .into_pyarray(py)
}

/// So many rows of all these values, as an array.
pub fn shaped<T: Element>(py: Python<'_>, values: Vec<T>, rows: usize) -> PyResult<Bound<'_, PyArray2<T>>> {
    let columns = values.len() / rows.max(1);
    Array2::from_shape_vec((rows, columns), values)
        .map(|array| array.into_pyarray(py))
        .map_err(|e| wrong(e.to_string()))
}

/// The numbers of a row that has a known number of them.
pub fn row<const N: usize>(numbers: &Numbers, what: &str) -> PyResult<[f64; N]> {
    let values = numbers.as_slice()?;
    values
        .try_into()
        .map_err(|_| wrong(format!("{what} has {N} numbers, not {}", values.len())))
}

/// The rows of an array that has a known number of columns.
pub fn rows<'a, const N: usize>(values: &'a [f64], what: &str) -> PyResult<&'a [[f64; N]]> {
    match values.as_chunks::<N>() {
        (rows, []) => Ok(rows),
        _ => Err(wrong(format!("{what} has {N} columns"))),
    }
}

/// Numbers that may not be there.
pub fn slice<'a>(numbers: &'a Option<Numbers>) -> PyResult<Option<&'a [f64]>> {
    Ok(numbers.as_ref().map(|n| n.as_slice()).transpose()?)
}

/// A flag for each of `count` moments, or none at all.
pub fn flags<'a>(flags: &'a Option<Flags>, count: usize) -> PyResult<&'a [bool]> {
    let Some(flags) = flags else { return Ok(&[]) };
    let flags = flags.as_slice()?;
    if flags.len() == count {
        Ok(flags)
    } else {
        Err(wrong(format!(
            "{count} moments need a flag each, not {}",
            flags.len()
        )))
    }
}

/// What has that name.
pub fn named<T>(name: &str, known: fn(&str) -> Option<T>, names: &[&str]) -> PyResult<T> {
    known(name).ok_or_else(|| wrong(format!("{name} is none of {}", names.join(", "))))
}

/// More threads than this, or than there are cores, help no one and take a minute to start.
const MOST_THREADS: usize = 256;

/// So many threads, or as many as there are cores, or as `RAYON_NUM_THREADS` wants.
pub fn pool(threads: usize) -> PyResult<ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let asked = std::env::var("RAYON_NUM_THREADS")
        .ok()
        .and_then(|text| text.trim().parse().ok());
    let count = if threads > 0 {
        threads
    } else {
        asked.filter(|count| *count > 0).unwrap_or(cores)
    };
    let builder = rayon::ThreadPoolBuilder::new().num_threads(count.min(cores.max(MOST_THREADS)));
    builder.build().map_err(|e| wrong(e.to_string()))
}
