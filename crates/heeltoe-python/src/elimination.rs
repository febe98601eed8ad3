//! Factors of large sparse symmetric matrices, as Python calls for them.

use std::sync::Arc;

use heeltoe::flexible::{Factors, Pattern};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::tables::{wrong, Numbers};

type Counts<'py> = PyReadonlyArray1<'py, i32>;

/// See `_kernel.pyi`.
#[pyclass(frozen)]
pub struct SymmetricPattern(Arc<Pattern>);

/// See `_kernel.pyi`.
#[pyclass(frozen)]
pub struct SymmetricFactors {
    pattern: Arc<Pattern>,
    factors: Factors,
}

#[pymethods]
impl SymmetricPattern {
    #[new]
    fn new(starts: Counts, rows: Counts, order: Counts) -> PyResult<Self> {
        // What is negative is too large then, and refused.
        let counts = |array: &Counts| {
            array
                .as_slice()
                .map(|some| some.iter().map(|k| *k as u32).collect::<Vec<_>>())
        };
        let starts: Vec<usize> = counts(&starts)?.iter().map(|k| *k as usize).collect();
        let pattern = Pattern::new(&starts, &counts(&rows)?, &counts(&order)?);
        Ok(Self(Arc::new(
            pattern.ok_or_else(|| wrong("no pattern of a matrix in an order"))?,
        )))
    }

    /// See `_kernel.pyi`.
    fn factors(&self, py: Python<'_>, entries: Numbers) -> PyResult<SymmetricFactors> {
        let values = entries.as_slice()?;
        let factors = match values.as_chunks::<2>() {
            (pairs, []) => py.detach(|| self.0.factors(pairs)),
            _ => None,
        };
        let factors = factors.ok_or_else(|| wrong("not as many entries as the pattern has"))?;
        Ok(SymmetricFactors {
            pattern: self.0.clone(),
            factors,
        })
    }
}

#[pymethods]
impl SymmetricFactors {
    /// See `_kernel.pyi`.
    fn solve<'py>(
        &self,
        py: Python<'py>,
        sides: Numbers<'py>,
        count: usize,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let mut values = sides.as_slice()?.to_vec();
        if values.len() != 2 * count * self.pattern.size() {
            return Err(wrong("not as many right sides as unknowns"));
        }
        py.detach(|| self.pattern.solve(&self.factors, &mut values, count));
        Ok(values.into_pyarray(py))
    }
}
