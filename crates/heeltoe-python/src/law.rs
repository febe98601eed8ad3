//! Friction laws, bound to Python.

use heeltoe::friction::{Law, LawNumbers, Shape, Worn};
use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::tables::{named, row, rows, table, wrong, Numbers};

/// A friction law; see `_kernel.pyi`.
#[pyclass(frozen)]
pub struct FrictionLaw(pub Law);

#[pymethods]
impl FrictionLaw {
    #[new]
    fn new(shape: &str, numbers: Numbers<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let numbers = LawNumbers::from_row(&row(&numbers, "a friction law")?);
        let points = rows(points.as_slice()?, "points")?.to_vec();
        let shape = named(shape, Shape::named, &Shape::NAMES)?;
        Ok(FrictionLaw(Law::new(shape, &numbers, points)))
    }

    /// Shear stresses borne at rest and sliding; see `_kernel.pyi`.
    fn shear_stress<'py>(
        &self,
        py: Python<'py>,
        stress: Numbers<'py>,
        speed: Numbers<'py>,
        path: Numbers<'py>,
        bonded: Numbers<'py>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let all = [&stress, &speed, &path, &bonded];
        let [stress, speed, path, bonded] = all.map(|numbers| numbers.as_slice());
        let (stress, speed, path, bonded) = (stress?, speed?, path?, bonded?);
        let count = stress.len();
        if [speed, path, bonded].iter().any(|numbers| numbers.len() != count) {
            return Err(wrong("stress, speed, path and bonded must be as many"));
        }
        Ok(table(
            py,
            (0..count).map(|k| {
                let worn = Worn {
                    path: path[k],
                    bonded: bonded[k] != 0.0,
                };
                self.0.shear_stress(stress[k], speed[k], worn)
            }),
        ))
    }
}
