//! An axis with the method that the firmware names.

use stillbeam::axis::{Axis, Cause, Mode, Policy, Tick};
use stillbeam::{Angle, Departure, Error as CoreError, Planned, Scene};
use stillbeam_methods::{Method, Visitor, visit_all};

use crate::error::Error;

/// Segments of the queue: more than any firmware has, so that what it accepted is never refused here.
const QUEUE: usize = 64;

/// An axis of any method: what a replica needs of it.
pub(super) trait Arm {
    fn enable(&mut self, measured: Angle<f32>) -> Result<(), CoreError>;
    fn disable(&mut self);
    fn stop(&mut self, cause: Cause);
    fn departure(&self) -> Result<Departure, CoreError>;
    fn take(&mut self, planned: &Planned<f32>) -> Result<u32, CoreError>;
    /// Sets the stepper of another arm up, and puts it in the place of the old one.
    fn reload(&mut self, scene: &Scene, tick: f64) -> Result<(), Error>;
    fn heard(&mut self);
    fn missed(&mut self, ticks: u32);
    fn tick(&mut self) -> Tick<f32>;
    fn mode(&self) -> Mode;
    fn cause(&self) -> Option<Cause>;
    fn rests(&self) -> bool;
}

/// A disabled axis at angle 0, with the method of that name.
///
/// # Errors
/// No method has the name, or the scene or the policy cannot be.
pub(super) fn build(
    method: &str,
    scene: &Scene,
    tick: f64,
    policy: Policy,
) -> Result<Box<dyn Arm>, Error> {
    let mut builder = Builder { method, scene, tick, policy, built: None, names: Vec::new() };
    visit_all(&mut builder);
    let Builder { built, names, .. } = builder;
    built.unwrap_or_else(|| {
        let names = names.join(", ");
        Err(Error::new(format_args!(
            "method = \"{method}\" in the firmware: must be one of {names}; build host and firmware \
             from the same sources"
        )))
    })
}

/// Builds the method with the name that is looked for.
struct Builder<'a> {
    method: &'a str,
    scene: &'a Scene,
    tick: f64,
    policy: Policy,
    built: Option<Result<Box<dyn Arm>, Error>>,
    names: Vec<&'static str>,
}

impl Visitor for Builder<'_> {
    fn visit<M: Method>(&mut self) {
        self.names.push(M::ID);
        if M::ID == self.method {
            self.built = Some(Of::<M>::boxed(self.scene, self.tick, self.policy));
        }
    }
}

/// An axis of one method.
struct Of<M: Method>(Axis<M::Stepper, QUEUE>);

impl<M: Method> Of<M> {
    fn boxed(scene: &Scene, tick: f64, policy: Policy) -> Result<Box<dyn Arm>, Error> {
        let origin = Angle { turns: 0, part: 0.0 };
        Ok(Box::new(Self(Axis::new(M::stepper(scene, tick)?, origin, policy)?)))
    }
}

/// The error of a replica that is not in the firmware's state.
pub(super) fn apart(refused: CoreError) -> Error {
    Error::new(format_args!("the firmware accepts what the host's axis refuses: {refused:?}"))
}

impl<M: Method> Arm for Of<M> {
    fn enable(&mut self, measured: Angle<f32>) -> Result<(), CoreError> {
        self.0.enable(measured)
    }

    fn disable(&mut self) {
        self.0.disable();
    }

    fn stop(&mut self, cause: Cause) {
        self.0.stop(cause);
    }

    fn departure(&self) -> Result<Departure, CoreError> {
        self.0.departure()
    }

    fn take(&mut self, planned: &Planned<f32>) -> Result<u32, CoreError> {
        self.0.take(planned)
    }

    fn reload(&mut self, scene: &Scene, tick: f64) -> Result<(), Error> {
        self.0.replace(M::stepper(scene, tick)?).map_err(apart)
    }

    fn heard(&mut self) {
        self.0.heard();
    }

    fn missed(&mut self, ticks: u32) {
        self.0.missed(ticks);
    }

    fn tick(&mut self) -> Tick<f32> {
        self.0.tick()
    }

    fn mode(&self) -> Mode {
        self.0.mode()
    }

    fn cause(&self) -> Option<Cause> {
        self.0.cause()
    }

    fn rests(&self) -> bool {
        self.0.rests()
    }
}
