//! The method that `auto` takes for a scene's moves, and why.

use serde::Serialize;
use stillbeam::select::{Assessment, Choice, Rung};

use crate::dispatch;
use crate::error::Error;
use crate::number::short_percent;
use crate::scene_file::SceneFile;
use crate::solver::{Method, Solver};

/// A choice of `auto` and its reason.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodReport {
    /// The method with its options, e.g. `elastica, 2 modes, fast`.
    pub name: String,
    /// Largest error of the tip to expect, fraction of L.
    pub tip_error: f64,
    /// Largest error of the torque to expect, fraction of its peak.
    pub torque_error: f64,
    /// The reason, in a sentence.
    pub why: String,
}

/// A choice of `auto` with its report.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    /// The choice.
    pub choice: Choice,
    /// True if it keeps both tolerances; else it comes nearest.
    pub keeps: bool,
    /// The choice in words.
    pub report: MethodReport,
}

/// Chooses as `auto` does and gives the reason: the errors of the next cheaper method.
pub fn advise(scene: &SceneFile) -> Result<MethodReport, Error> {
    advise_with(scene, &|_| ()).map(|advice| advice.report)
}

/// [`advise`] with the choice itself. `progress` is called with the fraction that is done.
pub fn advise_with(scene: &SceneFile, progress: &dyn Fn(f64)) -> Result<Advice, Error> {
    let solver = Solver { method: Method::Auto, ..scene.solver.resolve()? };
    let [tip, torque] =
        [solver.tolerance, solver.torque_tolerance].map(|part| short_percent(part, 4));
    let limits = format!("{tip} of L and {torque} of the torque\u{2019}s peak");
    let (choice, keeps, why) = match dispatch::choose_with(scene, &solver, progress)? {
        Ok(choice) => (choice, true, kept(scene, &solver, &choice, &limits)),
        Err(none) => {
            let Some(nearest) = none.nearest else { return Err(none.error.into()) };
            (nearest, false, format!("none keeps {limits}, this one comes nearest"))
        }
    };
    Ok(Advice { report: report(&choice, why), choice, keeps })
}

fn report(choice: &Choice, why: String) -> MethodReport {
    MethodReport {
        name: choice.rung.to_string(),
        tip_error: choice.expected.tip,
        torque_error: choice.expected.torque,
        why,
    }
}

/// Returns the reason for a choice that keeps the tolerances.
fn kept(scene: &SceneFile, solver: &Solver, choice: &Choice, limits: &str) -> String {
    let ladder = Rung::ladder(&scene.arm);
    let place = ladder.iter().position(|rung| *rung == choice.rung).unwrap_or(0);
    let Some(cheaper) = place.checked_sub(1).map(|below| ladder[below]) else {
        return format!("the cheapest of all keeps {limits}");
    };
    let other = match dispatch::assess_rung(scene, solver, cheaper, choice.bend) {
        Ok(Assessment { tip, torque, .. }) if tip.is_finite() => format!(
            "{cheaper} would err by {} and {}",
            short_percent(tip, 2),
            short_percent(torque, 2)
        ),
        _ => format!("{cheaper} cannot follow"),
    };
    format!("the cheapest that keeps {limits}; {other}")
}
