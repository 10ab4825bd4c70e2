//! Measures the error of a case.

use super::row::Errors;
use stillbeam_sim::compare::{Residual, common, compare};
use stillbeam_sim::error::Error;
use stillbeam_sim::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::SolverKeys;
use stillbeam_sim::table::Row;

/// Tip error, in lengths, at which a run has diverged. A greater error only tells how long it has
/// grown.
const LOST: f64 = 10.0;

/// Runs the core on the scene and compares it with the reference, by the definitions of
/// [`stillbeam_sim::compare`].
pub fn errors(scene: &SceneFile, keys: SolverKeys, reference: &[Row]) -> Result<Errors, Error> {
    let scene = SceneFile { solver: keys, ..scene.clone() };
    let rows = run::run(&scene, &keys.resolve()?)?;
    // A distance that is not a number would compare as small.
    let finite = |row: &Row| {
        [row.tip_x_m, row.tip_y_m, row.deflection_m, row.torque_nm].iter().all(|x| x.is_finite())
    };
    if !rows.iter().all(finite) {
        return Ok(Errors::DIVERGED);
    }
    // The reference holds the times of other ticks too; its residual and its peak torque are taken
    // at the run's own.
    let reference: Vec<Row> = common(&rows, reference).into_iter().map(|(_, row)| *row).collect();
    let comparison = compare(&rows, &reference, &scene)?;
    if comparison.tip_max > LOST {
        return Ok(Errors::DIVERGED);
    }
    let [run, truth] = comparison.residual.map(Residual::value);
    let errors = Errors {
        tip_max: comparison.tip_max,
        tip_rms: comparison.tip_rms,
        residual: run.zip(truth).map(|(run, truth)| (run - truth).abs()),
        torque: comparison.torque,
    };
    Ok(errors.rounded())
}
