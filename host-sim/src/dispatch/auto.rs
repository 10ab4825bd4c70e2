//! The choice of `auto` for a scene, and the errors to expect of a method.

use stillbeam::motion::{Commanded, Moves, Pulse, Shaper};
use stillbeam::select::{self, Assessment, Choice, NoChoice, Rung, Tolerance};
use stillbeam_erased::{AnyStepper, Kind, Precision, Spec};

use crate::error::Error;
use crate::flight::Flight;
use crate::progress;
use crate::scene_file::SceneFile;
use crate::solver::Solver;

/// Chooses the cheapest stepper that is good enough for the motion that the scene commands, behind
/// its shaper if it has one. If none is, returns the one that comes nearest. Shows its progress
/// after a second.
///
/// # Errors
/// An error is returned if the scene's moves are refused, whatever the method.
pub fn choose(scene: &SceneFile, solver: &Solver) -> Result<Result<Choice, NoChoice>, Error> {
    choose_with(scene, solver, &|_| ())
}

/// [`choose`] with `progress` called with the fraction that is done.
pub fn choose_with(
    scene: &SceneFile,
    solver: &Solver,
    progress: &dyn Fn(f64),
) -> Result<Result<Choice, NoChoice>, Error> {
    let tolerance = Tolerance { tip: solver.tolerance, torque: solver.torque_tolerance };
    let late = progress::late("choosing a method");
    along(scene, solver.tick, |motion| {
        Ok(select::choose(&scene.arm, solver.tick, motion, &tolerance, &mut |part| {
            late.set(part);
            progress(part);
        }))
    })
}

/// Estimates the errors of a method that is named by hand, along the motion that the scene
/// commands.
pub fn assess(scene: &SceneFile, solver: &Solver) -> Result<Assessment, Error> {
    assess_stepper(scene, &*super::stepper(scene, solver)?)
}

/// Estimates the errors of a rung of `auto`'s ladder along the motion that the scene commands.
/// `bend` is the tip angle that it is set up for, rad.
pub fn assess_rung(
    scene: &SceneFile,
    solver: &Solver,
    rung: Rung,
    bend: f64,
) -> Result<Assessment, Error> {
    let kind = Kind::Rung { rung, bend };
    let spec = Spec { kind, tick: solver.tick, precision: Precision::F32 };
    assess_stepper(scene, &*super::set_up(scene, solver, &spec)?)
}

fn assess_stepper(scene: &SceneFile, stepper: &dyn AnyStepper) -> Result<Assessment, Error> {
    let late = progress::late("judging the method");
    along(scene, stepper.period(), |motion| {
        Ok(stepper.assess(&scene.arm, motion, &mut |part| late.set(part))?)
    })
}

/// Hands over the motion that a scene commands: its moves, or the motion behind a shaper or through
/// waypoints.
fn along<R>(
    scene: &SceneFile,
    tick: f64,
    with: impl FnOnce(&dyn Commanded) -> Result<R, Error>,
) -> Result<R, Error> {
    // The limits are refused first.
    let trajectory = scene.trajectory(tick)?;
    match (&scene.shaper, scene.queue()) {
        (None, Some(moves)) => with(&Moves::new(scene.from, &moves, tick)?),
        (Some(shaper), _) => with(&Flight::new(&trajectory, shaper, scene.from)),
        (None, None) => {
            // The shaper of a motion that stays as it is.
            let none = Shaper::custom(&[Pulse { amplitude: 1.0, delay: 0.0 }])?;
            with(&Flight::new(&trajectory, &none, scene.from))
        }
    }
}
