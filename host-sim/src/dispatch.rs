//! The stepper that a scene's solver asks for, and what `auto` makes of the scene.

use stillbeam::model::Rod;
use stillbeam::select::Choice;
use stillbeam::stepper::{self, Elastica};
use stillbeam_erased::{self as erased, AnyStepper, Kind, Precision, Refused, Spec};

use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::solver::{Mass, Method, Quality, Scalar, Solver, no_such_mesh};

mod auto;

pub use auto::{assess, assess_rung, choose, choose_with};

/// Sets up the stepper that `solver` asks for. `auto` chooses first, see [`choose`].
///
/// # Errors
/// A method for which there is no stepper, and errors of a set-up.
pub fn stepper(scene: &SceneFile, solver: &Solver) -> Result<Box<dyn AnyStepper>, Error> {
    set_up(scene, solver, &spec(scene, solver, None, None)?)
}

/// [`stepper()`] with the choice that `auto` has already made, if that is the method.
pub fn stepper_chosen(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
) -> Result<Box<dyn AnyStepper>, Error> {
    set_up(scene, solver, &spec(scene, solver, choice, None)?)
}

/// [`stepper()`] with elastica fitted for hub accelerations up to `acceleration` rad/s², or if
/// that is `None` for those of the scene's moves.
pub fn stepper_for(
    scene: &SceneFile,
    solver: &Solver,
    acceleration: Option<f64>,
) -> Result<Box<dyn AnyStepper>, Error> {
    set_up(scene, solver, &spec(scene, solver, None, acceleration)?)
}

/// Returns the first natural period of the clamped arm, hub at rest, no gravity, s.
pub fn first_period(scene: &stillbeam::Scene, elements: usize, mass: Mass) -> Result<f64, Error> {
    erased::first_period(scene, elements, mass.into()).map_err(|refused| match refused {
        Refused::Elements(n) => no_such_mesh(n),
        refused => Error::new(refused),
    })
}

fn set_up(scene: &SceneFile, solver: &Solver, spec: &Spec) -> Result<Box<dyn AnyStepper>, Error> {
    erased::stepper(&scene.arm, spec).map_err(|refused| match refused {
        Refused::Elements(n) => no_such_mesh(n),
        Refused::Modes(most) => Error::new(format_args!(
            "solver.modes = {}: must be at most {most} with elements = {} and {} mass",
            solver.modes,
            solver.elements,
            solver.mass.name()
        )),
        refused => Error::new(refused),
    })
}

/// Returns the stepper's type and numbers.
pub fn spec(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    acceleration: Option<f64>,
) -> Result<Spec, Error> {
    let precision = match solver.scalar {
        Scalar::F32 => Precision::F32,
        Scalar::F64 => Precision::F64,
    };
    let kind = kind(scene, solver, choice, acceleration)?;
    Ok(Spec { kind, tick: solver.tick, precision })
}

fn kind(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    acceleration: Option<f64>,
) -> Result<Kind, Error> {
    let Solver { method, modes, elements, spin, .. } = *solver;
    let mass = solver.mass.into();
    if scene.arm.mount.carrier != 0.0 && !spin {
        return Err(Error::new(format_args!(
            "solver.spin = false: must be true or absent with carrier.rate = {}, which is felt \
             through the spin's terms only",
            scene.arm.mount.carrier
        )));
    }
    Ok(match (method, choice) {
        (Method::Rigid, _) => Kind::Rigid,
        (Method::Newmark, _) => Kind::Newmark { elements, mass, spin },
        (Method::Modal, _) => Kind::Modal { modes, elements, mass, spin },
        (Method::Elastica, _) => {
            let bend = bend(scene, solver, modes, acceleration)?;
            Kind::Elastica { modes, quality: solver.quality.into(), bend }
        }
        (Method::Pointwise, _) => Kind::Pointwise { modes },
        (Method::Auto, Some(choice)) => Kind::Rung { rung: choice.rung, bend: choice.bend },
        (Method::Auto, None) => {
            let choice = choose(scene, solver)?.map_err(|none| none.error)?;
            Kind::Rung { rung: choice.rung, bend: choice.bend }
        }
    })
}

/// Returns the tip angle to expect of a hub's acceleration, rad: `acceleration` rad/s², or if that
/// is `None` the greatest of the scene's moves. Computed with that many modes.
///
/// # Errors
/// An angle that elastica cannot be fitted for.
fn bend(
    scene: &SceneFile,
    solver: &Solver,
    modes: usize,
    acceleration: Option<f64>,
) -> Result<f64, Error> {
    let acceleration = match acceleration {
        Some(acceleration) => acceleration,
        None => {
            let trajectory = scene.trajectory(solver.tick)?;
            let peaks = trajectory.plans().iter().map(|plan| plan.summary.peaks.acceleration);
            peaks.fold(0.0, f64::max)
        }
    };
    let bend = match modes {
        1 => Rod::<1>::new(&scene.arm)?.bend(acceleration),
        2 => Rod::<2>::new(&scene.arm)?.bend(acceleration),
        _ => Rod::<3>::new(&scene.arm)?.bend(acceleration),
    };
    let (_, most) = Elastica::<f64, 1>::BEND;
    if bend > most {
        return Err(Error::new(format_args!(
            "solver.method = elastica: the tip is expected to turn {bend:.2} rad against the hub, \
             must be at most {most} rad; use a longer move or a stiffer link"
        )));
    }
    Ok(bend)
}

impl From<Mass> for erased::Mass {
    fn from(mass: Mass) -> Self {
        match mass {
            Mass::Consistent => Self::Consistent,
            Mass::Lumped => Self::Lumped,
        }
    }
}

impl From<Quality> for stepper::Quality {
    fn from(quality: Quality) -> Self {
        match quality {
            Quality::Fast => Self::Fast,
            Quality::Fine => Self::Fine,
        }
    }
}
