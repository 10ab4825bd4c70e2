//! `reference` on a mechanism.

use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::MechanismScene;
use stillbeam_sim::progress;
use stillbeam_sim::reference::mechanism;
use stillbeam_sim::truth::{self, Reference};

use super::Outputs;

/// Solves a mechanism, and puts out its rows, `every` s apart.
pub fn reference(
    scene: &MechanismScene,
    solver: Reference,
    every: Option<f64>,
    outputs: &Outputs<'_>,
) -> Result<ExitCode, Error> {
    let tick = scene.solver()?.tick;
    let drives = scene.drives(tick)?;
    let every = every.unwrap_or(tick);
    if !(1e-6..=drives.duration()).contains(&every) {
        return Err(Error::new(format_args!(
            "--every = {every}: must be 0.000001 to {} s, the run's length",
            drives.duration()
        )));
    }
    let bar = progress::percent(&scene.name);
    let times = truth::times_until(drives.duration(), every);
    let rows = mechanism::solve(solver, scene, &drives, &times, &|done| {
        bar.set_position((100.0 * done) as u64);
    });
    bar.finish_and_clear();
    let rows = rows?;
    outputs.put(scene, solver.describe(), &rows)?;
    Ok(ExitCode::SUCCESS)
}
