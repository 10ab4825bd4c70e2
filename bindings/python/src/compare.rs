//! The differences of two runs.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam_sim::compare as tables;

use crate::error::refused;
use crate::rows::Rows;
use crate::scene::Scene;

/// Compares run `a` with the more accurate run `b`, as the command line's `compare` does.
#[pyfunction]
pub fn compare<'py>(
    py: Python<'py>,
    a: &Rows,
    b: &Rows,
    scene: &Scene,
) -> PyResult<Bound<'py, PyDict>> {
    let file = scene.commanded()?;
    let found = py.detach(|| tables::compare(&a.list, &b.list, file)).map_err(refused)?;
    let result = PyDict::new(py);
    result.set_item("common", found.common)?;
    result.set_item("tip_max", found.tip_max)?;
    result.set_item("tip_rms", found.tip_rms)?;
    result.set_item("tip_max_at", found.tip_max_at)?;
    result.set_item("torque", found.torque)?;
    Ok(result)
}
