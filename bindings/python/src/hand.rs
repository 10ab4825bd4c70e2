//! A generator of whatever stepper, to be ticked by hand.

use stillbeam::model::{EightElements, FourElements, OneElement, TwoElements};
use stillbeam::motion::{Limits, MoveSummary};
use stillbeam::stepper::{Newmark, Stepper};
use stillbeam::{Angle, AxisKind, Error as CoreError, Generator, Move, Scalar as Real, Setpoint};
use stillbeam_sim::dispatch::ladder_stepper;
use stillbeam_sim::error::Error;
use stillbeam_sim::run::{QUEUE, row};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Mass, Method, Scalar, Solver};
use stillbeam_sim::table::Row;

/// Actions on a generator by hand.
pub trait Hand: Send + Sync {
    /// Puts a move behind the others.
    fn push(&mut self, motion: &Move) -> Result<MoveSummary, CoreError>;
    /// Goes to another target from where the hub is; returns the ticks until it is there.
    fn retarget(&mut self, angle: f64, rate: f64, duration: f64) -> Result<u32, CoreError>;
    /// Makes the tick of time `t` s. Returns its setpoint as a run has it, with the payload's
    /// centre if that is `offset` m beyond the tip.
    fn tick(&mut self, t: f64, axis: AxisKind, offset: f64) -> Row;
    /// True if no move is under way or waiting.
    fn is_holding(&self) -> bool;
    /// True if hub and arm rest.
    fn is_asleep(&self) -> bool;
}

impl<S> Hand for Generator<S, QUEUE>
where
    S: Stepper + Send + Sync,
    S::State: Send + Sync,
    S::Scalar: Send + Sync,
{
    fn push(&mut self, motion: &Move) -> Result<MoveSummary, CoreError> {
        Self::push(self, motion)
    }

    fn retarget(&mut self, angle: f64, rate: f64, duration: f64) -> Result<u32, CoreError> {
        let angle = Angle::from_radians(angle).cast();
        Self::retarget(self, angle, S::Scalar::from_f64(rate), duration)
    }

    fn tick(&mut self, t: f64, axis: AxisKind, offset: f64) -> Row {
        let setpoint = Self::tick(self);
        let payload = (offset != 0.0).then(|| {
            let tip_angle = self.stepper().tip_angle(self.state());
            let tip = setpoint.payload_centre(S::Scalar::from_f64(offset), tip_angle);
            Setpoint { tip, ..setpoint }.global_tip_on(axis).map(Real::to_f64)
        });
        row(t, axis, &setpoint, payload)
    }

    fn is_holding(&self) -> bool {
        Self::is_holding(self)
    }

    fn is_asleep(&self) -> bool {
        Self::is_asleep(self)
    }
}

/// Builds the generator of a scene's arm, at rest at `angle` rad.
pub fn generator(
    scene: &SceneFile,
    solver: &Solver,
    angle: f64,
    acceleration: Option<f64>,
) -> Result<Box<dyn Hand>, Error> {
    let limits = Limits { torque: None, moment: None, ..scene.limits };
    match (solver.method, solver.scalar) {
        (Method::Newmark, Scalar::F32) => newmark(scene, solver, angle, limits),
        (Method::Newmark, Scalar::F64) => Err(Error::new(
            "solver.scalar = \"f64\": must be f32 with newmark in a generator; run has both",
        )),
        (_, Scalar::F32) => {
            boxed(ladder_stepper::<f32>(scene, solver, acceleration)?, angle, limits)
        }
        (_, Scalar::F64) => {
            boxed(ladder_stepper::<f64>(scene, solver, acceleration)?, angle, limits)
        }
    }
}

fn newmark(
    scene: &SceneFile,
    solver: &Solver,
    angle: f64,
    limits: Limits,
) -> Result<Box<dyn Hand>, Error> {
    let (arm, tick) = (&scene.arm, solver.tick);
    if solver.mass == Mass::Lumped {
        return Err(Error::new(
            "solver.mass = \"lumped\": must be consistent in a generator; run has both",
        ));
    }
    /// The stepper of one number of elements.
    macro_rules! boxed {
        ($model:expr, $n:literal, $w:literal) => {{
            let stepper = Newmark::<f32, $n, $w>::new(&$model, tick)?;
            boxed(if solver.spin { stepper } else { stepper.without_spin() }, angle, limits)
        }};
    }
    match solver.elements {
        1 => boxed!(OneElement::consistent(arm)?, 2, 2),
        2 => boxed!(TwoElements::consistent(arm)?, 4, 4),
        4 => boxed!(FourElements::consistent(arm)?, 8, 4),
        _ => boxed!(EightElements::consistent(arm)?, 16, 4),
    }
}

fn boxed<S>(stepper: S, angle: f64, limits: Limits) -> Result<Box<dyn Hand>, Error>
where
    S: Stepper + Send + Sync + 'static,
    S::State: Send + Sync,
    S::Scalar: Send + Sync,
{
    let mut generator = Generator::<S, QUEUE>::new(stepper, angle)?;
    generator.limit(limits)?;
    Ok(Box::new(generator))
}
