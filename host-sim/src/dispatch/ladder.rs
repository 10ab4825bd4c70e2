//! The rungs of `auto`'s ladder: its choice for a scene, the errors to expect of a method, and every
//! rung as one type.

use stillbeam::model::Rod;
use stillbeam::motion::{Commanded, Moves, Pulse, Shaper};
use stillbeam::select::{Assessment, Auto, Choice, NoChoice, Rung, Tolerance};
use stillbeam::stepper::{OnCarrier, Stepper};
use stillbeam::{Scalar as Real, select};

use super::{StepperVisitor, bend_within, expected_bend, quality, with_stepper};
use crate::error::Error;
use crate::flight::Flight;
use crate::progress;
use crate::scene_file::SceneFile;
use crate::solver::{Mass, Method, Solver};

/// The error of a method that has no stepper for a carrier that turns.
fn not_on_carrier(scene: &SceneFile, solver: &Solver) -> Error {
    Error::new(format_args!(
        "solver.method = \"{}\": must be rigid, elastica, or modal with 8 elements of consistent \
         mass and spin, with carrier.rate = {}",
        solver.method.name(),
        scene.arm.mount.carrier
    ))
}

/// Builds the stepper of an arm on a carrier that turns. One type for all methods, as such scenes
/// are rare.
pub(super) fn on_carrier<T: Real>(
    scene: &SceneFile,
    solver: &Solver,
) -> Result<OnCarrier<Auto<T>>, Error> {
    let rung = rung(solver).ok_or_else(|| not_on_carrier(scene, solver))?;
    let tick = solver.tick;
    let bend = expected_bend(&Rod::<1>::new(&scene.arm)?, scene, solver)?;
    Ok(OnCarrier::new(&scene.arm, |arm| Auto::new(arm, tick, rung, bend))?)
}

/// Returns the rung of `auto`'s ladder that a solver names, or `None` if there is none: for
/// newmark, for modal with another mesh or without spin terms, and for `auto` itself.
fn rung(solver: &Solver) -> Option<Rung> {
    let Solver { method, modes, elements, mass, spin, .. } = *solver;
    match method {
        Method::Rigid => Some(Rung::Rigid),
        Method::Modal if (elements, mass, spin) == (8, Mass::Consistent, true) => {
            Some(Rung::Modal(modes))
        }
        Method::Elastica => Some(Rung::Elastica(modes, quality(solver))),
        _ => None,
    }
}

/// Builds the stepper that `solver` asks for as one type, the same to the bit as its own. `auto`
/// chooses for the scene's moves. Elastica is fitted for hub accelerations up to `acceleration`
/// rad/s², or if that is `None` for those of the scene's moves.
///
/// # Errors
/// A method that is none of [`Auto`], what a set-up refuses, and a carrier that turns.
pub fn ladder_stepper<T: Real>(
    scene: &SceneFile,
    solver: &Solver,
    acceleration: Option<f64>,
) -> Result<Auto<T>, Error> {
    let (arm, tick) = (&scene.arm, solver.tick);
    if arm.mount.carrier != 0.0 {
        return Err(Error::new(format_args!(
            "carrier.rate = {}: must be 0 for a stepper outside of a run",
            arm.mount.carrier
        )));
    }
    if solver.method == Method::Auto {
        let choice = choose(scene, solver)?.map_err(|none| none.error)?;
        return Ok(Auto::chosen(arm, tick, &choice)?);
    }
    let rung = rung(solver).ok_or_else(|| {
        Error::new(format_args!(
            "solver.method = \"{}\": must be rigid, elastica, auto, or modal with 8 elements of \
             consistent mass and spin",
            solver.method.name()
        ))
    })?;
    let bend = match (rung, acceleration) {
        (Rung::Rigid | Rung::Modal(_), _) => 0.0,
        (Rung::Elastica(1, _), given) => bend_of(&Rod::<1>::new(arm)?, scene, solver, given)?,
        (Rung::Elastica(2, _), given) => bend_of(&Rod::<2>::new(arm)?, scene, solver, given)?,
        (Rung::Elastica(..), given) => bend_of(&Rod::<3>::new(arm)?, scene, solver, given)?,
    };
    Ok(Auto::new(arm, tick, rung, bend)?)
}

/// Returns the tip angle for which elastica is fitted, rad: for the given acceleration, rad/s², or
/// for those of the scene's moves.
fn bend_of<const K: usize>(
    rod: &Rod<K>,
    scene: &SceneFile,
    solver: &Solver,
    acceleration: Option<f64>,
) -> Result<f64, Error> {
    match acceleration {
        Some(acceleration) => bend_within(rod, acceleration),
        None => expected_bend(rod, scene, solver),
    }
}

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
    if scene.arm.mount.carrier != 0.0 {
        return Err(not_on_carrier(scene, solver));
    }
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
    with_stepper(scene, solver, Assess { scene })
}

/// Estimates the errors of a rung of `auto`'s ladder along the motion that the scene commands.
/// `bend` is the tip angle that it is set up for, rad.
pub fn assess_rung(
    scene: &SceneFile,
    solver: &Solver,
    rung: Rung,
    bend: f64,
) -> Result<Assessment, Error> {
    let stepper = Auto::<f32>::new(&scene.arm, solver.tick, rung, bend)?;
    Assess { scene }.visit(stepper)
}

struct Assess<'a> {
    scene: &'a SceneFile,
}

impl StepperVisitor for Assess<'_> {
    type Output = Assessment;

    fn visit<S: Stepper + Clone>(self, stepper: S) -> Result<Assessment, Error> {
        let arm = &self.scene.arm;
        let late = progress::late("judging the method");
        along(self.scene, stepper.tick(), |motion| {
            Ok(select::assess(arm, stepper, motion, &mut |part| late.set(part))?)
        })
    }
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
