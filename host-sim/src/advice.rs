//! Remarks of a run on its method: the choice of `auto`, and a remark on one that is named by hand.

use stillbeam::select::{Assessment, Choice, Tolerance};

use crate::error::Error;
use crate::number::short_percent;
use crate::scene_file::SceneFile;
use crate::solver::{Method, Solver, SolverKeys};
use crate::{axis_units, dispatch};

/// Returns the method that `auto` chooses. If no method keeps default tolerances, takes the one
/// that comes nearest and notes it. Returns an error if a method or tolerances were asked for, or
/// if the tip's error exceeds [`REMARKABLE`]. `keys` are those that were given, by hand or by the
/// scene. `progress` is called with the fraction that is done.
pub fn chosen(
    scene: &SceneFile,
    solver: &Solver,
    keys: &SolverKeys,
    progress: &dyn Fn(f64),
    notes: &mut Vec<String>,
) -> Result<Choice, Error> {
    let none = match dispatch::choose_with(scene, solver, progress)? {
        Ok(choice) => return Ok(choice),
        Err(none) => none,
    };
    let asked =
        keys.method.is_some() || keys.tolerance.is_some() || keys.torque_tolerance.is_some();
    let near = |choice: &Choice| !asked && choice.expected.tip <= REMARKABLE.tip;
    let Some(nearest) = none.nearest.filter(near) else { return Err(none.error.into()) };
    notes.push(format!(
        "no method keeps {} of L and {} of the {}'s peak here; {} comes nearest, with {}",
        short_percent(solver.tolerance, 4),
        short_percent(solver.torque_tolerance, 4),
        axis_units::of(scene.arm.mount.axis).effort,
        nearest.rung,
        errors(scene, &nearest.expected)
    ));
    Ok(nearest)
}

/// Errors above which a method that is named by hand gets a remark.
pub const REMARKABLE: Tolerance = Tolerance { tip: 0.01, torque: 0.05 };

/// Returns a remark if the method is expected to err by more than [`REMARKABLE`]. The remark names
/// a better method if there is one.
pub fn remark(scene: &SceneFile, solver: &Solver) -> Option<String> {
    // A method that cannot be judged here has run all the same.
    let expected = dispatch::assess(scene, solver).ok()?;
    if expected.excess(&REMARKABLE) <= 1.0 {
        return None;
    }
    let (tolerance, torque_tolerance) = (Solver::PAPER.tolerance, Solver::PAPER.torque_tolerance);
    let auto = Solver { method: Method::Auto, tolerance, torque_tolerance, ..*solver };
    let better = match dispatch::choose(scene, &auto) {
        Ok(Ok(choice)) => Some(choice),
        Ok(Err(none)) => none.nearest,
        Err(_) => None,
    };
    let excess = |choice: &Choice| choice.expected.excess(&REMARKABLE);
    let advice = match better.filter(|choice| excess(choice) < expected.excess(&REMARKABLE)) {
        Some(choice) => {
            format!("auto would take {}, with {}", choice.rung, errors(scene, &choice.expected))
        }
        None => "no method does better at this tick; a shorter one may".to_owned(),
    };
    let method = solver.method.name();
    Some(format!("{method} is expected to err by {}; {advice}", errors(scene, &expected)))
}

/// Returns the errors in words, e.g. `0.04 % of L, 0.2 % of the torque's peak`.
pub fn errors(scene: &SceneFile, expected: &Assessment) -> String {
    let effort = axis_units::of(scene.arm.mount.axis).effort;
    let [tip, torque] = [expected.tip, expected.torque].map(|e| short_percent(e, 2));
    format!("{tip} of L, {torque} of the {effort}'s peak")
}
