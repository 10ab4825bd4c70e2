//! Maps the numbers that a user types to the model types of the core. No other place lists them.

use std::marker::PhantomData;

use stillbeam::model::{Model, Modes, Rod};
use stillbeam::prepared::Prepare;
use stillbeam::select::{Auto, Choice};
use stillbeam::stepper::{Elastica, Modal, Newmark, Rigid, Stepper};
use stillbeam::{Scalar as Real, Scene, stepper};

use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::solver::{Mass, Method, Quality, Scalar, Solver, no_such_mesh};

mod ladder;

use ladder::on_carrier;
pub use ladder::{assess, assess_rung, choose, choose_with, ladder_stepper};

/// Action on a model whose type is known only here.
pub trait Visitor {
    /// Result of the action.
    type Output;

    /// Receives the model.
    fn visit<const N: usize, const W: usize>(
        self,
        model: Model<N, W>,
    ) -> Result<Self::Output, Error>;
}

/// Builds the model of `elements` (1, 2, 4 or 8) and hands it to the visitor.
pub fn with_model<V: Visitor>(
    scene: &Scene,
    elements: usize,
    mass: Mass,
    visitor: V,
) -> Result<V::Output, Error> {
    // Lumped rotations are condensed, but for the tip's if the payload gives it an inertia.
    let tip_turns = scene.payload.inertia > 0.0;
    match (mass, elements) {
        (Mass::Consistent, 1) => visitor.visit(Model::<2, 2>::consistent(scene)?),
        (Mass::Consistent, 2) => visitor.visit(Model::<4, 4>::consistent(scene)?),
        (Mass::Consistent, 4) => visitor.visit(Model::<8, 4>::consistent(scene)?),
        (Mass::Consistent, 8) => visitor.visit(Model::<16, 4>::consistent(scene)?),
        (Mass::Lumped, 1) if tip_turns => visitor.visit(Model::<2, 2>::lumped::<2>(scene)?),
        (Mass::Lumped, 1) => visitor.visit(Model::<1, 1>::lumped::<2>(scene)?),
        (Mass::Lumped, 2) if tip_turns => visitor.visit(Model::<3, 3>::lumped::<4>(scene)?),
        (Mass::Lumped, 2) => visitor.visit(Model::<2, 2>::lumped::<4>(scene)?),
        (Mass::Lumped, 4) if tip_turns => visitor.visit(Model::<5, 5>::lumped::<8>(scene)?),
        (Mass::Lumped, 4) => visitor.visit(Model::<4, 4>::lumped::<8>(scene)?),
        (Mass::Lumped, 8) if tip_turns => visitor.visit(Model::<9, 9>::lumped::<16>(scene)?),
        (Mass::Lumped, 8) => visitor.visit(Model::<8, 8>::lumped::<16>(scene)?),
        (_, n) => Err(no_such_mesh(n)),
    }
}

/// Returns the first natural period of the clamped arm, hub at rest, no gravity, s.
pub fn first_period(scene: &Scene, elements: usize, mass: Mass) -> Result<f64, Error> {
    struct FirstPeriod;
    impl Visitor for FirstPeriod {
        type Output = f64;
        fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Result<f64, Error> {
            Ok(Modes::of(&model).first_period())
        }
    }
    with_model(scene, elements, mass, FirstPeriod)
}

/// Action on a stepper whose type is known only here.
pub trait StepperVisitor {
    /// Result of the action.
    type Output;

    /// Receives the stepper.
    fn visit<S: Stepper + Prepare + Clone>(self, stepper: S) -> Result<Self::Output, Error>;
}

/// Builds the stepper that `solver` asks for, model included, and hands it to the visitor. A new
/// method is one more arm here. `auto` chooses first, see [`choose`].
pub fn with_stepper<V: StepperVisitor>(
    scene: &SceneFile,
    solver: &Solver,
    visitor: V,
) -> Result<V::Output, Error> {
    let choice = match solver.method {
        Method::Auto => Some(choose(scene, solver)?.map_err(|none| none.error)?),
        _ => None,
    };
    with_chosen(scene, solver, choice.as_ref(), visitor)
}

/// [`with_stepper`] with the choice that `auto` has already made, if that is the method.
pub fn with_chosen<V: StepperVisitor>(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    visitor: V,
) -> Result<V::Output, Error> {
    match solver.scalar {
        Scalar::F32 => with_stepper_in::<f32, V>(scene, solver, choice, visitor),
        Scalar::F64 => with_stepper_in::<f64, V>(scene, solver, choice, visitor),
    }
}

fn with_stepper_in<T: Real, V: StepperVisitor>(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    visitor: V,
) -> Result<V::Output, Error> {
    if scene.arm.mount.carrier != 0.0 {
        return visitor.visit(on_carrier::<T>(scene, solver)?);
    }
    if let Some(choice) = choice {
        return visitor.visit(Auto::<T>::chosen(&scene.arm, solver.tick, choice)?);
    }
    match solver.method {
        Method::Rigid => visitor.visit(Rigid::<T>::new(&scene.arm, solver.tick)?),
        Method::Newmark => {
            let newmark = NewmarkOf::<T, V> { solver, visitor, scalar: PhantomData };
            with_model(&scene.arm, solver.elements, solver.mass, newmark)
        }
        Method::Modal => {
            let modal = ModalOf::<T, V> { solver, visitor, scalar: PhantomData };
            with_model(&scene.arm, solver.elements, solver.mass, modal)
        }
        Method::Elastica if solver.modes == 1 => visitor.visit(elastica::<T, 1>(scene, solver)?),
        Method::Elastica if solver.modes == 2 => visitor.visit(elastica::<T, 2>(scene, solver)?),
        Method::Elastica => visitor.visit(elastica::<T, 3>(scene, solver)?),
        Method::Auto => {
            let choice = choose(scene, solver)?.map_err(|none| none.error)?;
            visitor.visit(Auto::<T>::chosen(&scene.arm, solver.tick, &choice)?)
        }
    }
}

struct NewmarkOf<'a, T, V> {
    solver: &'a Solver,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Real, V: StepperVisitor> Visitor for NewmarkOf<'_, T, V> {
    type Output = V::Output;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Result<V::Output, Error> {
        let stepper = Newmark::<T, N, W>::new(&model, self.solver.tick)?;
        self.visitor.visit(if self.solver.spin { stepper } else { stepper.without_spin() })
    }
}

struct ModalOf<'a, T, V> {
    solver: &'a Solver,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Real, V: StepperVisitor> Visitor for ModalOf<'_, T, V> {
    type Output = V::Output;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Result<V::Output, Error> {
        let Self { solver, visitor, .. } = self;
        if solver.modes > N {
            return Err(Error::new(format_args!(
                "solver.modes = {}: must be at most {N} with elements = {} and {} mass",
                solver.modes,
                solver.elements,
                solver.mass.name()
            )));
        }
        match solver.modes {
            1 => visitor.visit(modal::<T, 1, N, W>(&model, solver)?),
            2 => visitor.visit(modal::<T, 2, N, W>(&model, solver)?),
            _ => visitor.visit(modal::<T, 3, N, W>(&model, solver)?),
        }
    }
}

fn modal<T: Real, const K: usize, const N: usize, const W: usize>(
    model: &Model<N, W>,
    solver: &Solver,
) -> Result<Modal<T, K>, Error> {
    let stepper = Modal::new(model, solver.tick)?;
    Ok(if solver.spin { stepper } else { stepper.without_spin() })
}

/// Builds elastica, fitted for the bend to expect from the scene's own accelerations.
fn elastica<T: Real, const K: usize>(
    scene: &SceneFile,
    solver: &Solver,
) -> Result<Elastica<T, K>, Error> {
    let rod = Rod::new(&scene.arm)?;
    let bend = expected_bend(&rod, scene, solver)?;
    Ok(Elastica::new(&rod, solver.tick, quality(solver), bend)?)
}

/// Returns the tip angle to expect from the scene's own accelerations, rad.
///
/// # Errors
/// An angle that elastica cannot be fitted for.
fn expected_bend<const K: usize>(
    rod: &Rod<K>,
    scene: &SceneFile,
    solver: &Solver,
) -> Result<f64, Error> {
    let trajectory = scene.trajectory(solver.tick)?;
    let peaks = trajectory.plans().iter().map(|plan| plan.summary.peaks.acceleration);
    bend_within(rod, peaks.fold(0.0, f64::max))
}

/// Returns the tip angle to expect from an acceleration in rad/s², rad.
///
/// # Errors
/// An angle that elastica cannot be fitted for.
fn bend_within<const K: usize>(rod: &Rod<K>, acceleration: f64) -> Result<f64, Error> {
    let (_, most) = Elastica::<f64, K>::BEND;
    let bend = rod.bend(acceleration);
    if bend > most {
        return Err(Error::new(format_args!(
            "solver.method = elastica: the tip is expected to turn {bend:.2} rad against the hub, \
             must be at most {most} rad; use a longer move or a stiffer link"
        )));
    }
    Ok(bend)
}

fn quality(solver: &Solver) -> stepper::Quality {
    match solver.quality {
        Quality::Fast => stepper::Quality::Fast,
        Quality::Fine => stepper::Quality::Fine,
    }
}
