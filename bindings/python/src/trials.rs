//! A drive and its machine along a scene.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use stillbeam_sim::servo::bench::SAMPLES;
use stillbeam_sim::servo::trials::{Outcome, Report, Trial};

use crate::machine;
use crate::progress::Progress;
use crate::scene::Scene;

/// Lets a drive follow a scene, as the command line's `drive` does.
#[pyfunction]
pub fn drive<'py>(
    py: Python<'py>,
    scene: &Scene,
    on: Option<&Bound<'py, PyAny>>,
    drive: Option<&str>,
    between: Option<&str>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let file = scene.commanded()?;
    let machine = machine::with(machine::of(on)?, drive, between)?;
    let trials = Trial::all(&file.arm);
    let progress = Progress::new(progress);
    let report = progress.work(py, || {
        let steps = progress.steps("runs", trials.len());
        Report::of(file, &machine, &trials, &|| steps.step())
    })?;
    let result = PyDict::new(py);
    result.set_item("tick", report.tick)?;
    result.set_item("drive", machine.drive.name())?;
    result.set_item("conclusion", report.conclusion())?;
    result.set_item("no_still", report.no_still.as_ref().map(ToString::to_string))?;
    let (times, angles): (Vec<f64>, Vec<f64>) = report.commanded.angles(0.0).unzip();
    result.set_item("command_time", PyArray1::from_vec(py, times))?;
    result.set_item("command_angle", PyArray1::from_vec(py, angles))?;
    let outcomes = PyList::empty(py);
    for outcome in &report.outcomes {
        outcomes.append(trial(py, outcome, report.tick)?)?;
    }
    result.set_item("trials", outcomes)?;
    Ok(result)
}

/// Returns one trial's figures and its run.
fn trial<'py>(py: Python<'py>, outcome: &Outcome, tick: f64) -> PyResult<Bound<'py, PyDict>> {
    let Outcome { trial, judged, exact, trace, lag } = outcome;
    let entry = PyDict::new(py);
    entry.set_item("sent", trial.describe())?;
    entry.set_item("still", trial.still)?;
    for (name, value) in [
        ("hub_error", judged.hub),
        ("tip_error", judged.tip),
        ("residual", judged.residual),
        ("residual_if_exact", *exact),
        ("off_after_arrival", judged.off),
        ("peak_torque", judged.torque),
        ("saturated", judged.saturated),
        ("lag", *lag),
        ("sample_interval", tick / f64::from(SAMPLES)),
    ] {
        entry.set_item(name, value)?;
    }
    let of = |value: fn(&stillbeam_sim::plant::Shown) -> f64| -> Vec<f64> {
        trace.shown.iter().map(value).collect()
    };
    for (name, column) in [
        ("time", of(|shown| shown.t)),
        ("hub_angle", of(|shown| shown.angle)),
        ("hub_rate", of(|shown| shown.rate)),
        ("tip_x", of(|shown| shown.tip[0])),
        ("tip_y", of(|shown| shown.tip[1])),
        ("deflection", of(|shown| shown.deflection)),
        ("motor_torque", trace.torque.clone()),
    ] {
        entry.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(entry)
}
