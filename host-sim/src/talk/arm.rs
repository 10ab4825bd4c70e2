//! An axis with the method that the firmware names.

use stillbeam::axis::{Cause, Mode, Tick};
use stillbeam::drive::ClassicFrame;
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::motor::Drivetrain;
use stillbeam::{Angle, Error as CoreError, Payload, PlanContext, PlannedMove, UniformScene};
use stillbeam_methods::{Method, Visitor, visit_all};
use stillbeam_protocol::{Command, Refusal};
use stillbeam_wiring::{Configuration, Joint, Order, Rows};

use crate::error::Error;

/// Segments of the queue. No firmware has more, so that a move which it accepted is never refused
/// here.
const QUEUE: usize = 64;

/// The firmware's interface of an axis, for any method.
pub(super) trait Arm {
    /// Carries out a command that needs no plan, the shaft being at `shaft` if that is known from
    /// elsewhere than from the drive's frames.
    fn carry_out(
        &mut self,
        command: &Command,
        shaft: Option<Angle<f32>>,
    ) -> Result<(), Refusal<'static>>;
    /// Takes a frame of the drive.
    fn hear_drive(&mut self, frame: &ClassicFrame);
    /// Returns the frame for the drive beside setpoint and switch, once.
    fn take_order(&mut self) -> Option<Order>;
    fn stop(&mut self, cause: Cause);
    fn plan_context(&self) -> Result<PlanContext, CoreError>;
    fn take(&mut self, planned: &PlannedMove<f32>) -> Result<u32, CoreError>;
    /// Sets up the arm with another payload and replaces the old one.
    fn reload(&mut self, payload: Payload, tick: f64) -> Result<(), Error>;
    /// Begins a path at the end of the moves.
    fn begin_path(&mut self, spline: Spline) -> Result<(), CoreError>;
    /// Takes a row of the path.
    fn offer(&mut self, row: Waypoint, last: bool) -> Result<(), Refusal<'static>>;
    fn heard(&mut self);
    /// Makes the next tick, before which `missed` ticks did not take place.
    fn tick(&mut self, missed: u32) -> Tick<f32>;
    fn mode(&self) -> Mode;
    fn cause(&self) -> Option<Cause>;
    fn rests(&self) -> bool;
    fn scene(&self) -> &UniformScene;
    fn train(&self) -> &Drivetrain<f32>;
}

/// Builds a disabled axis with the method of that name. Its hub is at angle 0 when the shaft is at
/// `zero`, to the bit. The configuration's zero in turns need not be exact to the bit.
///
/// # Errors
/// An error is returned if no method has the name, or if the method or the axis refuses the
/// configuration.
pub(super) fn build(
    method: &str,
    configuration: &Configuration,
    zero: Angle<f32>,
    tick: f64,
) -> Result<Box<dyn Arm>, Error> {
    let mut builder = Builder { method, configuration, zero, tick, built: None, names: Vec::new() };
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

/// Builds the method with the name that is wanted.
struct Builder<'a> {
    method: &'a str,
    configuration: &'a Configuration,
    zero: Angle<f32>,
    tick: f64,
    built: Option<Result<Box<dyn Arm>, Error>>,
    names: Vec<&'static str>,
}

impl Visitor for Builder<'_> {
    fn visit<M: Method>(&mut self) {
        self.names.push(M::ID);
        if M::ID == self.method {
            self.built = Some(Of::<M>::boxed(self.configuration, self.zero, self.tick));
        }
    }
}

/// An axis of one method, and the path that comes to it row by row.
struct Of<M: Method>(Joint<M::Stepper, QUEUE>, Rows);

impl<M: Method> Of<M> {
    fn boxed(
        configuration: &Configuration,
        zero: Angle<f32>,
        tick: f64,
    ) -> Result<Box<dyn Arm>, Error> {
        let mut joint = Joint::new(configuration, M::stepper(&configuration.scene, tick)?)?;
        joint.train.home(zero, Angle { turns: 0, part: 0.0 });
        Ok(Box::new(Self(joint, Rows::default())))
    }
}

/// The error of a replica that is not in the firmware's state.
pub(super) fn apart(refused: impl Into<Refusal<'static>>) -> Error {
    let refusal = refused.into();
    Error::new(format_args!("the firmware accepts what the host's axis refuses: {refusal}"))
}

impl<M: Method> Arm for Of<M> {
    fn carry_out(
        &mut self,
        command: &Command,
        shaft: Option<Angle<f32>>,
    ) -> Result<(), Refusal<'static>> {
        if shaft.is_some() {
            self.0.measured = shaft;
        }
        self.0.carry_out(command)
    }

    fn hear_drive(&mut self, frame: &ClassicFrame) {
        self.0.hear_drive(frame);
    }

    fn take_order(&mut self) -> Option<Order> {
        self.0.take_order()
    }

    fn stop(&mut self, cause: Cause) {
        self.0.stop(cause);
    }

    fn plan_context(&self) -> Result<PlanContext, CoreError> {
        self.0.axis.plan_context()
    }

    fn take(&mut self, planned: &PlannedMove<f32>) -> Result<u32, CoreError> {
        self.0.axis.take(planned)
    }

    fn reload(&mut self, payload: Payload, tick: f64) -> Result<(), Error> {
        let scene = UniformScene { payload, ..self.0.scene };
        self.0.replace(scene, M::stepper(&scene, tick)?).map_err(apart)
    }

    fn begin_path(&mut self, spline: Spline) -> Result<(), CoreError> {
        self.1.begin(self.0.axis.path(spline)?);
        Ok(())
    }

    fn offer(&mut self, row: Waypoint, last: bool) -> Result<(), Refusal<'static>> {
        let Self(joint, rows) = self;
        rows.offer(row, last, |path, piece| joint.axis.take_piece(path, piece))
    }

    fn heard(&mut self) {
        self.0.axis.heard();
    }

    fn tick(&mut self, missed: u32) -> Tick<f32> {
        let Self(joint, rows) = self;
        rows.advance(|path, piece| joint.axis.take_piece(path, piece));
        joint.tick(missed)
    }

    fn mode(&self) -> Mode {
        self.0.axis.mode()
    }

    fn cause(&self) -> Option<Cause> {
        self.0.axis.cause()
    }

    fn rests(&self) -> bool {
        self.0.axis.rests()
    }

    fn scene(&self) -> &UniformScene {
        &self.0.scene
    }

    fn train(&self) -> &Drivetrain<f32> {
        &self.0.train
    }
}
