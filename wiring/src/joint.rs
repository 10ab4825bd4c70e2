//! One axis at work: what a request changes at once, and where the drive says that the shaft is.

use embedded_can::Frame;
use stillbeam::axis::{Axis, Cause, Mode};
use stillbeam::drive::odrive::Node;
use stillbeam::motor::Drivetrain;
use stillbeam::{Angle, Error, Stepper, UniformScene};
use stillbeam_protocol::{Command, Refusal};

use crate::Configuration;

/// Least and greatest angle that a request may give the hub, rad.
pub const HOME_RANGE: (f64, f64) = (-1e6, 1e6);

/// An axis with its arm, its gear and its encoder.
pub struct Joint<S: Stepper<Scalar = f32>, const QUEUE: usize> {
    /// Arm as it is now.
    pub scene: UniformScene,
    /// Generator and policy.
    pub axis: Axis<S, QUEUE>,
    /// Mapping from link to motor.
    pub train: Drivetrain<f32>,
    /// Angle of the shaft as the drive reports it, once it has.
    pub measured: Option<Angle<f32>>,
    node: Node,
}

impl<S: Stepper<Scalar = f32>, const QUEUE: usize> Joint<S, QUEUE> {
    /// Builds the axis, disabled at hub angle 0. `stepper` is that of the configuration's scene.
    ///
    /// # Errors
    /// The policy, the gear, the motor or the node id is outside of its range.
    pub fn new(configuration: &Configuration, stepper: S) -> Result<Self, Error> {
        let Configuration { scene, policy, joint, direction, zero, node } = *configuration;
        let origin = Angle { turns: 0, part: 0.0 };
        // The axis last: what is large then need not wait on the stack for what may be refused.
        let (train, node) = (Drivetrain::new(&joint, direction, zero)?, Node::new(node)?);
        Ok(Self { scene, axis: Axis::new(stepper, origin, policy)?, train, measured: None, node })
    }

    /// Returns the drive's node.
    pub fn node(&self) -> Node {
        self.node
    }

    /// Takes the shaft's angle from a frame of the bus, if it is a report of this axis' encoder. A
    /// report that no angle can hold leaves the axis without a measurement.
    pub fn hear_drive(&mut self, frame: &impl Frame) {
        if let Some(estimates) = self.node.estimates(frame) {
            self.measured = estimates.angle();
        }
    }

    /// Carries out a command that needs no plan. Those that do ([`crate::Work`]), and those that
    /// only ask, change nothing.
    ///
    /// # Errors
    /// The axis is in another mode, its drive has not reported an angle, or the angle of
    /// [`Command::Home`] is not in [`HOME_RANGE`].
    pub fn carry_out(&mut self, command: &Command) -> Result<(), Refusal<'static>> {
        match *command {
            Command::Enable => {
                let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
                self.axis.enable(self.train.mapping().to_link(shaft))?;
            }
            Command::Disable => self.axis.disable(),
            Command::Stop => self.axis.stop(Cause::Requested),
            Command::Home(angle) => self.home(angle)?,
            _ => {}
        }
        Ok(())
    }

    /// Calls the angle where a disabled axis stands `angle`, rad.
    fn home(&mut self, angle: f64) -> Result<(), Refusal<'static>> {
        let (min, max) = HOME_RANGE;
        if !(min..=max).contains(&angle) {
            let (parameter, unit) = ("home.angle", "rad");
            return Err(Error::OutOfRange { parameter, value: angle, min, max, unit }.into());
        }
        let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
        match self.axis.mode() {
            Mode::Disabled => self.train.home(shaft, Angle::from_radians(angle).cast()),
            mode => return Err(Refusal::Mode(mode)),
        }
        Ok(())
    }

    /// Puts another arm in the place of the old one. `stepper` is that of `scene`.
    ///
    /// # Errors
    /// The hub turns, or moves wait.
    pub fn replace(&mut self, scene: UniformScene, stepper: S) -> Result<(), Refusal<'static>> {
        self.axis.replace(stepper)?;
        self.scene = scene;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axes::{CONFIGURATIONS, Joint, stepper};

    fn joint() -> Joint {
        let configuration = &CONFIGURATIONS[0];
        let stepper = stepper(&configuration.scene).expect("the delivered arm");
        Joint::new(configuration, stepper).expect("the delivered axis")
    }

    #[test]
    fn an_axis_is_enabled_where_its_drive_has_reported_that_it_stands() {
        let mut joint = joint();
        assert_eq!(joint.carry_out(&Command::Enable), Err(Refusal::NotMeasured));
        // A gear of 6 that turns the other way: a quarter of a turn at the shaft is -1/24 at the
        // hub.
        joint.measured = Some(Angle { turns: 0, part: 0.125 + 0.25 });
        assert_eq!(joint.carry_out(&Command::Enable), Ok(()));
        let angle = joint.axis.generator().hub().angle.in_turns();
        assert!((angle + 1.0 / 24.0).abs() < 1e-6, "{angle}");
    }

    #[test]
    fn only_a_disabled_axis_is_homed_and_only_within_its_range() {
        let mut joint = joint();
        joint.measured = Some(Angle { turns: 3, part: 0.1 });
        for angle in [f64::NAN, f64::INFINITY, 1.1 * HOME_RANGE.1, 1.1 * HOME_RANGE.0] {
            let refused = joint.carry_out(&Command::Home(angle));
            assert!(matches!(refused, Err(Refusal::Range { parameter: "home.angle", .. })));
        }
        assert_eq!(joint.carry_out(&Command::Home(0.5)), Ok(()));
        assert_eq!(joint.carry_out(&Command::Enable), Ok(()));
        let angle = joint.axis.generator().hub().angle.in_turns();
        assert!((angle - 0.5 / core::f64::consts::TAU).abs() < 1e-6, "{angle}");
        assert_eq!(joint.carry_out(&Command::Home(0.0)), Err(Refusal::Mode(Mode::Enabled)));
    }
}
