//! Moves that arrive still, planned and judged by the reference rod.

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam::Limits;
use stillbeam::planner::ShortestMove;
use stillbeam_sim::plan::request::ERRORS;
use stillbeam_sim::plan::shortest::INTERVALS;
use stillbeam_sim::plan::{Options, Planned, Request};
use stillbeam_sim::reference::Sample;
use stillbeam_sim::scene_file::SceneFile;

use crate::keys;
use crate::progress::Progress;
use crate::scene::Scene;

/// Returns the request: what the keywords leave out is the scene's.
fn request(file: &SceneFile, keywords: &Bound<'_, PyDict>) -> PyResult<Request> {
    let number = |key: &str| -> PyResult<Option<f64>> {
        let value = keywords.get_item(key)?.filter(|value| !value.is_none());
        value.map(|value| value.extract()).transpose()
    };
    let of = file.limits;
    let limits = Limits {
        rate: number("max_rate")?.or(of.rate),
        acceleration: number("max_acceleration")?.or(of.acceleration),
        deceleration: of.deceleration,
        jerk: number("max_jerk")?.or(of.jerk),
        torque: number("max_torque")?.or(of.torque),
        moment: number("max_moment")?.or(of.moment),
    };
    Ok(Request {
        arm: file.arm,
        from: number("start")?.unwrap_or(file.from),
        to: number("to")?.unwrap_or(f64::NAN),
        duration: number("duration")?,
        limits: limits.validate().map_err(crate::error::core)?,
        robust: number("robust")?,
        options: Options::default(),
        tick: keys::tick(file)?,
    })
}

/// Plans a move that arrives still, as the command line's `plan` does.
#[pyfunction]
pub fn plan<'py>(
    py: Python<'py>,
    scene: &Scene,
    keywords: &Bound<'py, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let request = request(&scene.file, keywords)?;
    let progress = Progress::new(progress);
    let axis = request.arm.mount.axis;
    let planned = progress.work(py, || {
        let steps = progress.steps("reference rod", ERRORS.len());
        request.carry_out(&|| steps.step()).map_err(|error| error.on(axis))
    })?;
    let result = PyDict::new(py);
    result.set_item("start", request.from)?;
    figures(&result, &request, &planned)?;
    arrays(py, &result, &request, &planned)?;
    Ok(result)
}

/// Adds the numbers.
fn figures(result: &Bound<'_, PyDict>, request: &Request, planned: &Planned) -> PyResult<()> {
    let Planned { plan, prediction, judgement, .. } = planned;
    for (name, value) in [
        ("to", request.to),
        ("duration", plan.duration()),
        ("tick", request.tick),
        ("first_period", planned.first_period),
        ("peak_rate", plan.peaks().rate),
        ("peak_acceleration", plan.peaks().acceleration),
        ("peak_jerk", plan.peaks().jerk),
        ("peak_torque", planned.loads.torque.value),
        ("peak_moment", planned.loads.moment.value),
        ("peak_deflection", prediction.deflection),
        ("residual", judgement.residual),
    ] {
        result.set_item(name, value)?;
    }
    result.set_item("ticks", plan.ticks())?;
    result.set_item("simulations", plan.simulations())
}

/// A column's name and its values.
type Column = (&'static str, fn(&Sample) -> f64);

/// Returns the rows of a fastest move: time, angle, rate.
fn rows(request: &Request, plan: &ShortestMove<INTERVALS>) -> Option<Vec<Vec<f64>>> {
    let ShortestMove::Fastest(fastest) = plan else { return None };
    let begin = vec![0.0, request.from, 0.0];
    let rest = fastest.waypoints();
    let rest = rest.map(|row| vec![row.time, row.angle, row.rate.unwrap_or(0.0)]);
    Some([begin].into_iter().chain(rest).collect())
}

/// Adds the sensitivity and the reference rod's run.
fn arrays(
    py: Python<'_>,
    result: &Bound<'_, PyDict>,
    request: &Request,
    planned: &Planned,
) -> PyResult<()> {
    let (errors, residuals): (Vec<f64>, Vec<f64>) = planned.sensitivity.iter().copied().unzip();
    result.set_item("frequency_error", PyArray1::from_vec(py, errors))?;
    result.set_item("residual_at_error", PyArray1::from_vec(py, residuals))?;
    let rows = rows(request, &planned.plan);
    let rows = rows.map(|rows| PyArray2::from_vec2(py, &rows)).transpose()?;
    result.set_item("rows", rows)?;
    let columns: [Column; 7] = [
        ("time", |sample| sample.t),
        ("hub_angle", |sample| sample.angle),
        ("hub_rate", |sample| sample.rate),
        ("hub_acceleration", |sample| sample.acceleration),
        ("tip_x", |sample| sample.tip[0]),
        ("tip_y", |sample| sample.tip[1]),
        ("deflection", |sample| sample.deflection),
    ];
    let samples = &planned.judgement.samples;
    for (name, value) in columns {
        let column: Vec<f64> = samples.iter().map(value).collect();
        result.set_item(name, PyArray1::from_vec(py, column))?;
    }
    let torque: Vec<f64> = samples.iter().map(|sample| sample.torque).collect();
    result.set_item("torque", PyArray1::from_vec(py, torque))
}
