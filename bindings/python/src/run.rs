//! Whole runs: of the core, and of the reference solvers.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stillbeam_sim::error::Error;
use stillbeam_sim::limits::load;
use stillbeam_sim::progress::late;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_sim::{advice, run as core};

use crate::error::refused;
use crate::keys;
use crate::progress::Progress;
use crate::rows::Rows;
use crate::scene::Scene;

/// Result of a run: its rows, the method in words, and notes.
type Outcome = (Rows, String, Vec<String>);

/// Runs the core on a scene, as the command line's `run` does.
#[pyfunction]
pub fn run(
    py: Python<'_>,
    scene: &Scene,
    keywords: &Bound<'_, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let file = scene.commanded()?;
    let (solver, typed, keys) = keys::resolve(keywords, file)?;
    let progress = Progress::new(progress);
    let (list, words, notes) = progress.work(py, || {
        let mut notes =
            if typed.method.is_none() { file.solver.unread(solver.method) } else { Vec::new() };
        notes.extend(file.roundings(solver.tick)?);
        let limits = progress.limits();
        let (rows, words) =
            rows(file, &solver, &keys, &mut notes, &progress, &|at| limits.tell(at))?;
        Ok((rows, words, notes))
    })?;
    Ok((Rows { list, axis: file.arm.mount.axis, tick: solver.tick }, words, notes))
}

/// Returns the rows of a run and its method in words.
fn rows(
    file: &SceneFile,
    solver: &Solver,
    keys: &SolverKeys,
    notes: &mut Vec<String>,
    progress: &Progress,
    limits: &dyn Fn(load::Progress),
) -> Result<(Vec<Row>, String), Error> {
    let choice = match solver.method {
        Method::Auto => {
            let told = |done| progress.tell("choosing a method", done);
            Some(advice::chosen(file, solver, keys, &told, notes)?)
        }
        _ => None,
    };
    let list = core::run_with(file, solver, choice.as_ref(), limits)?;
    let words = choice.map_or_else(|| solver.describe(), |choice| choice.rung.to_string());
    Ok((list, words))
}

/// Solves a scene with a reference solver, as the command line's `reference` does.
#[pyfunction]
pub fn reference(
    py: Python<'_>,
    scene: &Scene,
    solver: &str,
    every: Option<f64>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Outcome> {
    let file = scene.commanded()?;
    let solver = match solver {
        "rod" => Reference::Rod,
        "fem" => Reference::Fem,
        other => {
            let text = format!("solver = \"{other}\": must be rod or fem");
            return Err(refused(Error::new(text)));
        }
    };
    let tick = file.solver.resolve().map_err(refused)?.tick;
    let progress = Progress::new(progress);
    let (list, notes) = progress.work(py, || {
        let trajectory = file.trajectory(tick)?;
        let every = every.unwrap_or(tick);
        let longest = trajectory.duration();
        if !(1e-6..=longest).contains(&every) {
            let text =
                format!("every = {every}: must be 0.000001 to {longest} s, the run's length");
            return Err(Error::new(text));
        }
        let limits = progress.limits();
        core::admit_loads(file, tick, &|_| true, &|at| limits.tell(at))?;
        let times = truth::times(&trajectory, every);
        let bar = late(&file.name);
        let told = |done| {
            progress.tell("reference", done);
            if !progress.is_called() {
                bar.set(done);
            }
        };
        Ok((truth::solve(solver, file, &trajectory, &times, &told)?, file.roundings(tick)?))
    })?;
    let rows = Rows { list, axis: file.arm.mount.axis, tick };
    Ok((rows, solver.describe().to_owned(), notes))
}
