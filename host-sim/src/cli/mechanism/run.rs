//! `run` on a mechanism.

use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::{MechanismKeys, MechanismScene, run};
use stillbeam_sim::solver::SolverKeys;

use super::{Outputs, refuse};

/// Runs the core on a mechanism, and puts out its setpoints.
pub fn run(
    scene: &MechanismScene,
    keys: MechanismKeys,
    outputs: &Outputs<'_>,
) -> Result<ExitCode, Error> {
    let solver = keys.or(scene.solver).resolve()?;
    let rows = run::run(scene, &solver)?;
    outputs.put(scene, &solver.describe(), &rows)?;
    Ok(ExitCode::SUCCESS)
}

/// Returns the typed keys of a mechanism's solver. Refuses those that only an arm of one link has.
pub fn typed(keys: &SolverKeys, coordinates: Option<i64>) -> Result<MechanismKeys, Error> {
    refuse("--method", keys.method.is_some())?;
    refuse("--elements", keys.elements.is_some())?;
    refuse("--mass", keys.mass.is_some())?;
    refuse("--modes", keys.modes.is_some())?;
    refuse("--quality", keys.quality.is_some())?;
    refuse("--tolerance", keys.tolerance.is_some())?;
    refuse("--torque-tolerance", keys.torque_tolerance.is_some())?;
    refuse("--no-spin", keys.spin.is_some())?;
    Ok(MechanismKeys { tick: keys.tick, scalar: keys.scalar, coordinates })
}
