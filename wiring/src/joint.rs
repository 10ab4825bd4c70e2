//! One axis at work: what a request changes at once, and where the drive says that the shaft is.

use embedded_can::Frame;
use stillbeam::axis::{Axis, Cause, Mode, Tick, Timing};
use stillbeam::drive::Condition;
use stillbeam::drive::odrive::Node;
use stillbeam::motor::Drivetrain;
use stillbeam::{Angle, Error, Generator, PlannedMove, Setpoint, Stepper, UniformScene};
use stillbeam_protocol::{Command, Refusal};

use crate::admit::admit;
use crate::watch::Watch;
use crate::{Configuration, Order, change};

/// Turns of the shaft from which on homing an axis also moves the drive's own zero to within half a
/// turn. An f32 of 512 turns still tells 8192 and 16,384 counts a turn apart; at 2048 turns it does
/// not ([`stillbeam::drive::Lost`]).
pub const FAR: i32 = 512;

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
    watch: Watch,
    order: Option<Order>,
    /// Position that the drive was told to call its own, turns. Reports from before it are not
    /// taken.
    awaited: Option<f32>,
}

impl<S: Stepper<Scalar = f32>, const QUEUE: usize> Joint<S, QUEUE> {
    /// Builds the axis, disabled at hub angle 0. `stepper` is that of the configuration's scene.
    ///
    /// # Errors
    /// The policy, the gear, the motor or the node id is outside of its range.
    pub fn new(configuration: &Configuration, stepper: S) -> Result<Self, Error> {
        let Configuration { scene, policy, joint, direction, zero, node, .. } = *configuration;
        let origin = Angle { turns: 0, part: 0.0 };
        let watch = Watch::new(stepper.tick());
        // The axis last: what is large then need not wait on the stack for what may be refused.
        let (train, node) = (Drivetrain::new(&joint, direction, zero)?, Node::new(node)?);
        let axis = Axis::new(stepper, origin, policy)?;
        let (order, awaited) = (None, None);
        Ok(Self { scene, axis, train, measured: None, node, watch, order, awaited })
    }

    /// Returns the drive's node.
    pub fn node(&self) -> Node {
        self.node
    }

    /// Takes the shaft's angle and the drive's condition from a frame of the bus, if it is a report
    /// of this axis' drive. An angle that cannot be held leaves the axis without a measurement.
    pub fn hear_drive(&mut self, frame: &impl Frame) {
        if let Some(heartbeat) = self.node.heartbeat(frame) {
            self.watch.heard(heartbeat.condition());
        }
        let Some(estimates) = self.node.estimates(frame) else { return };
        if let Some(awaited) = self.awaited {
            let off = estimates.position - awaited;
            if !(-0.25..=0.25).contains(&off) {
                return;
            }
            self.awaited = None;
        }
        self.measured = estimates.angle();
    }

    /// The drive's condition in its latest heartbeat, if one has come.
    pub fn condition(&self) -> Option<Condition> {
        self.watch.condition()
    }

    /// Returns the frame that the drive is to get beside the setpoint, once.
    pub fn take_order(&mut self) -> Option<Order> {
        self.order.take()
    }

    /// Makes the next tick if the one that came is due, as [`Axis::tick_if_due`] does, with the
    /// drive's reports watched.
    #[inline(always)]
    pub fn tick_if_due(&mut self, timing: &Timing) -> Option<Tick<f32>> {
        timing.due.then(|| self.tick(timing.missed))
    }

    /// Makes the next tick, before which `missed` ticks did not take place.
    #[inline(always)]
    pub fn tick(&mut self, missed: u32) -> Tick<f32> {
        self.tick_by(missed, Generator::tick)
    }

    /// Makes the next tick as [`Self::tick`] does, with `advance` as in [`Axis::tick_by`].
    #[inline(always)]
    pub fn tick_by(
        &mut self,
        missed: u32,
        advance: impl FnOnce(&mut Generator<S, QUEUE>) -> Setpoint<f32>,
    ) -> Tick<f32> {
        if let Some(cause) = self.watch.tick(missed, self.axis.mode()) {
            self.stop(cause);
        }
        self.axis.missed(missed);
        self.axis.tick_by(advance)
    }

    /// Stops the axis. After a fault of the drive it is then disabled: the shaft may be anywhere,
    /// and holding the setpoint would make the next enabling a jump.
    #[cold]
    #[inline(never)]
    pub fn stop(&mut self, cause: Cause) {
        self.axis.stop(cause);
        if cause == Cause::DriveFault {
            self.axis.disable();
        }
    }

    /// Carries out a command that needs no plan. Those that do ([`crate::Work`]), and those that
    /// only ask, change nothing.
    ///
    /// # Errors
    /// The axis is in another mode, its drive has not reported an angle, is silent or faulty, the
    /// angle of [`Command::Home`] is not in [`HOME_RANGE`], or a [`Command::Change`] is refused.
    pub fn carry_out(&mut self, command: &Command) -> Result<(), Refusal<'static>> {
        match *command {
            Command::Enable => {
                if let Some(Condition::Fault(code)) = self.condition() {
                    return Err(Refusal::DriveFault(code));
                }
                if self.watch.is_silent() {
                    return Err(Refusal::DriveSilent);
                }
                let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
                self.axis.enable(self.train.mapping().to_link(shaft))?;
            }
            Command::Clear => match self.axis.mode() {
                Mode::Disabled => self.order = Some(Order::ClearErrors),
                mode => return Err(Refusal::Mode(mode)),
            },
            Command::Disable => self.axis.disable(),
            Command::Stop => self.axis.stop(Cause::Requested),
            Command::Home(angle) => self.home(angle)?,
            Command::Change(change) => change::carry_out(&mut self.axis, &change)?,
            _ => {}
        }
        Ok(())
    }

    /// Calls the angle where a disabled axis stands `angle`, rad.
    fn home(&mut self, angle: f64) -> Result<(), Refusal<'static>> {
        let (min, max) = HOME_RANGE;
        Error::check("home.angle", angle, min, max, "rad")?;
        let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
        match self.axis.mode() {
            Mode::Disabled => {
                let shaft = self.brought_near(shaft);
                self.train.home(shaft, Angle::from_radians(angle).cast());
            }
            mode => return Err(Refusal::Mode(mode)),
        }
        Ok(())
    }

    /// Has the drive call its shaft's angle a fraction of a turn if it is [`FAR`] from its zero.
    /// Returns the angle as the drive reports it from then on. Until it does there is no
    /// measurement.
    fn brought_near(&mut self, shaft: Angle<f32>) -> Angle<f32> {
        if shaft.turns.saturating_abs() < FAR {
            return shaft;
        }
        self.order = Some(Order::SetPosition(shaft.part));
        self.awaited = Some(shaft.part);
        self.measured = None;
        Angle { turns: 0, part: shaft.part }
    }

    /// Takes a planned move and returns the number of its first tick, as [`Axis::take`] does, if
    /// the drive's frames can carry it.
    ///
    /// # Errors
    /// The position, velocity or torque that does not fit the frame, or the axis' own refusal.
    pub fn take(&mut self, planned: &PlannedMove<f32>) -> Result<u32, Error> {
        admit(&self.scene, &self.train, planned)?;
        self.axis.take(planned)
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
    use stillbeam::drive::ClassicFrame;
    use stillbeam::drive::odrive::{EncoderEstimates, Heartbeat};
    use stillbeam::{PlainMove, Profile};

    use super::*;
    use crate::axes::{CONFIGURATIONS, Joint};
    use crate::bench::disabled;

    fn joint() -> Joint {
        disabled(&CONFIGURATIONS[0])
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

    fn hear_at(joint: &mut Joint, position: f32) {
        let estimates = EncoderEstimates { position, velocity: 0.0 };
        let frame: ClassicFrame = joint.node().estimates_frame(&estimates).expect("eight bytes");
        joint.hear_drive(&frame);
    }

    fn hear(joint: &mut Joint, errors: u32, state: u8) {
        let heartbeat = Heartbeat { errors, state, procedure_result: 0 };
        let frame: ClassicFrame = joint.node().heartbeat_frame(&heartbeat).expect("eight bytes");
        joint.hear_drive(&frame);
    }

    fn moving() -> Joint {
        let mut joint = joint();
        hear_at(&mut joint, 0.125);
        hear(&mut joint, 0, 1);
        joint.carry_out(&Command::Enable).expect("it has reported");
        hear(&mut joint, 0, 8);
        let motion = PlainMove::To { profile: Profile::Quintic, duration: 1.7, to: 1.57 };
        let planned = joint.axis.plan_context().and_then(|context| context.plan(&motion));
        joint.axis.take(&planned.expect("within the limits")).expect("there is room");
        for k in 0..80 {
            tick(&mut joint, k % 10 == 0);
        }
        joint
    }

    fn tick(joint: &mut Joint, heard: bool) -> Tick<f32> {
        if heard {
            hear(joint, 0, 8);
        }
        joint.axis.heard();
        joint.tick(0)
    }

    /// The path is braked, the axis then off; enabled again, it begins where the shaft is.
    #[test]
    fn a_fault_of_the_drive_stops_the_axis_and_switches_it_off() {
        let mut joint = moving();
        assert_eq!(joint.axis.mode(), Mode::Enabled);
        hear(&mut joint, 0x40, 1);
        let first = joint.tick(0);
        assert_eq!((first.mode, joint.axis.cause()), (Mode::Stopping, Some(Cause::DriveFault)));
        let mut before = first.setpoint.rate;
        while joint.axis.mode() != Mode::Disabled {
            let rate = joint.tick(0).setpoint.rate;
            assert!((rate - before).abs() <= 15.0 * 0.01 * 1.001, "{before} to {rate} rad/s");
            before = rate;
        }
        assert_eq!(joint.carry_out(&Command::Enable), Err(Refusal::DriveFault(0x40)));
        assert_eq!(joint.carry_out(&Command::Clear), Ok(()));
        assert_eq!(joint.take_order(), Some(Order::ClearErrors));
        assert_eq!(joint.take_order(), None);
        hear(&mut joint, 0, 1);
        hear_at(&mut joint, 0.125);
        assert_eq!(joint.carry_out(&Command::Enable), Ok(()));
        assert!(joint.axis.generator().hub().angle.in_turns().abs() < 1e-6);
        assert_eq!(joint.carry_out(&Command::Clear), Err(Refusal::Mode(Mode::Enabled)));
    }

    /// A drive that is not heard may follow all the same: the axis holds, and takes moves again
    /// when it hears the drive.
    #[test]
    fn a_silent_drive_stops_the_axis_which_holds() {
        let mut joint = moving();
        let stopped = (0..36).find(|_| tick(&mut joint, false).mode != Mode::Enabled);
        // The last heartbeat was 10 ticks before: the 36th tick without one stops it.
        assert_eq!(stopped, Some(25));
        assert_eq!(joint.axis.cause(), Some(Cause::DriveLost));
        for _ in 0..200 {
            tick(&mut joint, false);
        }
        assert_eq!(joint.axis.mode(), Mode::Stopped);
        assert_eq!(joint.carry_out(&Command::Enable), Err(Refusal::DriveSilent));
        hear(&mut joint, 0, 8);
        assert_eq!(joint.carry_out(&Command::Enable), Ok(()));
        // A drive that comes back switched off is no longer where it was told to be.
        hear(&mut joint, 0, 1);
        joint.tick(0);
        assert_eq!(
            (joint.axis.mode(), joint.axis.cause()),
            (Mode::Disabled, Some(Cause::DriveFault))
        );
    }

    /// Far from its zero the drive is told a new one, and reports from before it are not taken.
    #[test]
    fn homing_far_away_moves_the_drives_zero() {
        let mut joint = joint();
        hear_at(&mut joint, 2_000.25);
        assert_eq!(joint.carry_out(&Command::Home(0.5)), Ok(()));
        assert_eq!(joint.take_order(), Some(Order::SetPosition(0.25)));
        hear_at(&mut joint, 2_000.25);
        assert_eq!(joint.carry_out(&Command::Enable), Err(Refusal::NotMeasured));
        hear_at(&mut joint, 0.25);
        assert_eq!(joint.carry_out(&Command::Enable), Ok(()));
        let angle = joint.axis.generator().hub().angle.in_turns();
        assert!((angle - 0.5 / core::f64::consts::TAU).abs() < 1e-6, "{angle}");
    }
}
