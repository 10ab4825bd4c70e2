//! The firmware around one axis: bytes in, requests carried out, a tick when it comes. The axis, the
//! frames, the pace and the motor side are the firmware's own; what stands here is its wiring.

use std::collections::VecDeque;

use stillbeam::axis::{Axis, Cause, Mode, Pace, Refused, Tick};
use stillbeam::beam::OneElement;
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::Node;
use stillbeam::motor::{Demand, Drivetrain};
use stillbeam::stepper::Newmark;
use stillbeam::{Angle, Error as CoreError, Move, Planned, Rejected, Scene};
use stillbeam_protocol::frame::{Splitter, decode};
use stillbeam_protocol::{Command, Refusal, Request};

use super::machine::{Configuration, TICK};
use crate::error::Error;

/// Counts of the board's clock a tick.
pub const PERIOD: u32 = 10_000;

type Stepper = Newmark<f32, 2, 2>;

/// What the board said to a request.
pub type Answer = Result<u32, Refusal<'static>>;

/// One axis of the application.
pub struct Board {
    axis: Axis<Stepper, 8>,
    train: Drivetrain<f32>,
    node: Node,
    scene: Scene,
    measured: Option<Angle<f32>>,
    splitter: Splitter,
    pace: Pace,
    /// Requests that wait while a move is planned.
    requests: VecDeque<Request>,
    planning: Option<Planning>,
    /// Ticks that planning a move takes.
    takes: u32,
    /// Answers since they were last taken.
    pub answers: Vec<Answer>,
    /// Frames that came in garbled.
    pub garbled: u64,
    /// Ticks that did not take place.
    pub missed: u64,
    /// The axis was switched on since the last tick, where the drive stands.
    begins: bool,
}

struct Planning {
    motion: Move,
    planned: Planned<f32>,
    left: u32,
    again: bool,
}

/// One tick of the board.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Number, mode, setpoint.
    pub tick: Tick<f32>,
    /// The demand on the shaft.
    pub demand: Demand<f32>,
    /// It is the first since the axis was switched on.
    pub begins: bool,
}

impl Board {
    /// Powers up. `takes` ticks go by while a move is planned.
    pub fn new(configuration: &Configuration, takes: u32) -> Result<Self, Error> {
        let Configuration { scene, policy, joint, direction, zero } = *configuration;
        let origin = Angle { turns: 0, part: 0.0 };
        Ok(Self {
            axis: Axis::new(stepper(&scene)?, origin, policy)?,
            train: Drivetrain::new(&joint, direction, zero)?,
            node: Node::new(1)?,
            scene,
            measured: None,
            splitter: Splitter::new(),
            pace: Pace::new(PERIOD),
            requests: VecDeque::new(),
            planning: None,
            takes,
            answers: Vec::new(),
            garbled: 0,
            missed: 0,
            begins: false,
        })
    }

    /// Bytes from the host.
    pub fn receive(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            let Some(frame) = self.splitter.push(byte) else { continue };
            match frame.and_then(decode::<Request>) {
                Ok(request) => self.requests.push_back(request),
                Err(_) => self.garbled += 1,
            }
        }
        self.work();
    }

    /// A request as if its frame had come, for those who have no use for bytes.
    pub fn ask(&mut self, command: Command) {
        self.requests.push_back(Request { sequence: 0, axis: 0, command });
        self.work();
    }

    /// A frame from the drive.
    pub fn hear_drive(&mut self, frame: &ClassicFrame) {
        if let Some(estimates) = self.node.estimates(frame) {
            let shaft = Angle { turns: 0, part: 0.0 };
            // As the application: what a float says in turns, below 2²¹ of them.
            if estimates.position.abs() < 2_097_152.0 {
                self.measured = Some(shaft.plus(estimates.position));
            }
        }
    }

    /// A tick at that reading of the clock.
    pub fn tick(&mut self, now: u32) -> Step {
        let timing = self.pace.arrive(now);
        if timing.missed > 0 {
            self.missed += u64::from(timing.missed);
            self.axis.missed(timing.missed);
        }
        let tick = self.axis.tick();
        let begins = std::mem::take(&mut self.begins);
        let step = Step { tick, demand: self.train.demand(&tick.setpoint), begins };
        if let Some(planning) = &mut self.planning {
            planning.left = planning.left.saturating_sub(1);
        }
        self.work();
        step
    }

    /// The axis.
    pub fn axis(&self) -> &Axis<Stepper, 8> {
        &self.axis
    }

    /// The drive's node.
    pub fn node(&self) -> Node {
        self.node
    }

    /// Carries out what can be by now, in order.
    fn work(&mut self) {
        loop {
            if self.planning.as_ref().is_some_and(|planning| planning.left > 0) {
                return;
            }
            if let Some(planning) = self.planning.take() {
                self.hand_over(planning);
                continue;
            }
            let Some(request) = self.requests.pop_front() else { return };
            self.axis.heard();
            if request.axis > 0 {
                self.answers.push(Err(Refusal::Axis(1)));
            } else if let Command::Move(motion) = request.command {
                self.plan(motion, true);
            } else {
                let tick = self.axis.clock();
                let answer = self.carry_out(request.command).map(|()| tick);
                self.answers.push(answer);
            }
        }
    }

    /// Begins to plan. Where the axis' motion has changed meanwhile it is done once more.
    fn plan(&mut self, motion: Move, again: bool) {
        let departure = self.axis.departure().map_err(Refusal::from);
        match departure.and_then(|departure| Ok(departure.plan(&motion)?)) {
            Ok(planned) => {
                self.planning = Some(Planning { motion, planned, left: self.takes, again });
            }
            Err(refusal) => self.answers.push(Err(refusal)),
        }
    }

    fn hand_over(&mut self, planning: Planning) {
        match self.axis.take(&planning.planned) {
            Ok(_) => self.answers.push(Ok(self.axis.clock())),
            Err(Refused::Queue(Rejected::Stale)) if planning.again => {
                self.plan(planning.motion, false);
            }
            Err(refused) => self.answers.push(Err(refused.into())),
        }
    }

    fn carry_out(&mut self, command: Command) -> Result<(), Refusal<'static>> {
        match command {
            Command::Enable => {
                let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
                let begins = self.axis.mode() == Mode::Disabled;
                self.axis.enable(self.train.mapping().to_link(shaft))?;
                self.begins |= begins;
            }
            Command::Disable => self.axis.disable(),
            Command::Stop => self.axis.stop(Cause::Requested),
            Command::Payload(payload) => {
                let scene = Scene { payload, ..self.scene };
                self.axis.replace(stepper(&scene)?)?;
                self.scene = scene;
            }
            Command::Home(angle) => {
                if !(-1e6..=1e6).contains(&angle) {
                    let (min, max, unit) = (-1e6, 1e6, "rad");
                    let parameter = "home.angle";
                    return Err(
                        CoreError::OutOfRange { parameter, value: angle, min, max, unit }.into()
                    );
                }
                let shaft = self.measured.ok_or(Refusal::NotMeasured)?;
                match self.axis.mode() {
                    Mode::Disabled => self.train.home(shaft, Angle::from_radians(angle).cast()),
                    mode => return Err(Refusal::Mode(mode)),
                }
            }
            // As a firmware without the planner of still moves.
            Command::Still { .. } => return Err(Refusal::NoPlanner),
            Command::Move(_) | Command::Heartbeat | Command::Describe | Command::Status => {}
        }
        Ok(())
    }
}

fn stepper(scene: &Scene) -> Result<Stepper, CoreError> {
    Newmark::new(&OneElement::consistent(scene)?, TICK)
}
