//! The choice of `auto`.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam::select::Rung;
use stillbeam_sim::arm;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, SolverKeys};

use crate::keys;
use crate::progress::Progress;
use crate::scene::Scene;

/// Chooses as `auto` does. Returns the solver's keys and what is said of the choice.
#[pyfunction]
pub fn choose<'py>(
    py: Python<'py>,
    scene: &Scene,
    keywords: &Bound<'py, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let keys = SolverKeys { method: Some(Method::Auto), ..keys::of(keywords)? };
    let file = SceneFile { solver: keys.or(scene.file.solver), ..scene.commanded()?.clone() };
    let progress = Progress::new(progress);
    let told = |done| progress.tell("choosing a method", done);
    let advice = progress.work(py, || arm::advise_with(&file, &told))?;
    let result = PyDict::new(py);
    let (method, modes, quality) = match advice.choice.rung {
        Rung::Rigid => ("rigid", None, None),
        Rung::Modal(modes) => ("modal", Some(modes), None),
        Rung::Elastica(modes, quality) => ("elastica", Some(modes), Some(quality.to_string())),
    };
    result.set_item("method", method)?;
    result.set_item("modes", modes)?;
    result.set_item("quality", quality)?;
    result.set_item("name", advice.report.name)?;
    result.set_item("tip_error", advice.report.tip_error)?;
    result.set_item("torque_error", advice.report.torque_error)?;
    result.set_item("within_tolerance", advice.keeps)?;
    result.set_item("why", advice.report.why)?;
    Ok(result)
}
