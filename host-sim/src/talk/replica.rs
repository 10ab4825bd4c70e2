//! An axis on the host, built from the firmware's description.

use stillbeam::axis::{Cause, Mode, Policy, Tick};
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::Node;
use stillbeam::motor::Drivetrain;
use stillbeam::planner::Planner;
use stillbeam::{Angle, Limits, PlainMove, UniformScene};
use stillbeam_protocol::{Command, Description};
use stillbeam_wiring::drive::{Switch, demand};
use stillbeam_wiring::{Configuration, Work};

use super::arm::{self, Arm, apart};
use crate::error::Error;

/// The same axis with the same code and method, on this machine. Its queue is longer, so that a
/// move which the firmware accepted is never refused here.
pub struct Replica {
    axis: Box<dyn Arm>,
    tick: f64,
    node: Node,
    switch: Switch,
    limits: Limits,
    /// Ticks that did not take place before the coming one.
    missed: u32,
    /// Planner, set up on first use.
    planner: Option<Planner<f32, 2>>,
}

impl Replica {
    /// Creates the axis as described. With `patient`, the host does not know when the firmware
    /// hears it, and takes its word for a lost link.
    ///
    /// # Errors
    /// An error is returned if the firmware runs a method that is not in the list or describes an
    /// impossible axis.
    pub fn new(description: &Description<'_>, patient: bool) -> Result<Self, Error> {
        let Description { method, scene, tick, policy, joint, direction, zero, node, .. } =
            *description;
        let policy = if patient { Policy { patience: 0.0, ..policy } } else { policy };
        // The host sets up whatever payload it is told.
        let payloads = &[];
        let configuration =
            Configuration { scene, payloads, policy, joint, direction, zero: 0.0, node };
        let axis = arm::build(method, &configuration, zero, tick)?;
        let (node, switch) = (Node::new(node)?, Switch::default());
        Ok(Self { axis, tick, node, switch, limits: policy.limits, missed: 0, planner: None })
    }

    /// Carries out a command that the firmware has accepted. `shaft` is where the shaft is, for a
    /// host that does not see the drive's frames.
    ///
    /// # Errors
    /// The host's axis refuses it: the two are not in the same state.
    pub fn apply(&mut self, command: &Command, shaft: Option<Angle<f32>>) -> Result<(), Error> {
        match Work::of(command) {
            Some(Work::Move(motion)) => self.follow(&motion),
            Some(Work::Still { to, duration }) => self.follow_still(to, duration),
            Some(Work::Payload(payload)) => {
                self.planner = None;
                self.axis.reload(payload, self.tick)
            }
            Some(Work::Path(spline)) => self.axis.begin_path(spline).map_err(apart),
            Some(Work::Row(row, last)) => self.axis.offer(row, last).map_err(apart),
            None => self.axis.carry_out(command, shaft).map_err(apart),
        }
    }

    fn follow(&mut self, motion: &PlainMove) -> Result<(), Error> {
        let planned = self.axis.plan_context().map_err(apart)?.plan(motion)?;
        self.axis.take(&planned).map(drop).map_err(apart)
    }

    fn follow_still(&mut self, to: f64, duration: Option<f64>) -> Result<(), Error> {
        let context = self.axis.plan_context().map_err(apart)?;
        let planner = match self.planner.take() {
            Some(planner) => planner,
            None => Planner::new(self.axis.scene(), self.tick)?,
        };
        let planned = context.plan_still(&planner, to, duration);
        self.planner = Some(planner);
        self.axis.take(&planned?).map(drop).map_err(apart)
    }

    /// Notes that a word from the host was heard.
    pub fn heard(&mut self) {
        self.axis.heard();
    }

    /// Takes a frame that the drive has sent.
    pub fn hear_drive(&mut self, frame: &ClassicFrame) {
        self.axis.hear_drive(frame);
    }

    /// Notes that `ticks` ticks did not take place before the coming one.
    pub fn missed(&mut self, ticks: u32) {
        self.missed = self.missed.saturating_add(ticks);
    }

    /// Takes the firmware's word for a stop that the host cannot foresee.
    pub fn stop(&mut self, cause: Cause) {
        self.axis.stop(cause);
    }

    /// Makes the next tick. Returns it with the cause of a stop.
    pub fn step(&mut self) -> (Tick<f32>, Option<Cause>) {
        let tick = self.axis.tick(core::mem::take(&mut self.missed));
        (tick, self.axis.cause())
    }

    /// Returns the frames to the drive at a tick, in their order: what was asked for beside the
    /// setpoints, the setpoint while the drive is on, and a switch, if any.
    pub fn told(&mut self, tick: &Tick<f32>) -> impl Iterator<Item = ClassicFrame> + use<> {
        let node = self.node;
        let order = self.axis.take_order().and_then(|order| order.frame(node));
        let demand = demand(self.axis.train(), tick);
        let position = demand.and_then(|demand| node.set_input_pos(&demand));
        let switch = self.switch.turn(tick.mode).and_then(|on| node.set_axis_state(on));
        order.into_iter().chain(position.map(|encoded| encoded.payload)).chain(switch)
    }

    /// The mode.
    pub fn mode(&self) -> Mode {
        self.axis.mode()
    }

    /// True at rest with no move waiting.
    pub fn rests(&self) -> bool {
        self.axis.rests()
    }

    /// The drive's node.
    pub fn node(&self) -> Node {
        self.node
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// The arm as it is now.
    pub fn scene(&self) -> &UniformScene {
        self.axis.scene()
    }

    /// Limits of the hub's motion.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Returns the drivetrain from link to motor.
    pub fn train(&self) -> &Drivetrain<f32> {
        self.axis.train()
    }
}
