//! The firmware around one axis: takes bytes, carries out requests, makes a tick when it comes. The
//! axis, the frames, the pace and the motor side are the firmware's own; only the wiring is written
//! here.

use std::collections::VecDeque;

use stillbeam::axis::{Axis, Mode, Pace, Tick};
use stillbeam::drive::ClassicFrame;
use stillbeam::drive::odrive::Node;
use stillbeam::motor::Demand;
use stillbeam::{Error, Payload, PlainMove, PlannedMove, UniformScene};
use stillbeam_protocol::frame::{Splitter, decode};
use stillbeam_protocol::{Command, Refusal, Request};
use stillbeam_wiring::Order;
use stillbeam_wiring::axes::{Joint, QUEUE, Stepper, stepper};
use stillbeam_wiring::{Configuration, Work};

use crate::machine::TICK;

/// Counts of the board's clock in a tick, µs.
pub const PERIOD: u32 = Pace::period(TICK, 1_000_000).expect("TICK is a whole number of µs");

/// Jobs that can wait for the planner, as in the application. One more is refused.
const JOBS: usize = 2;

/// Answer of the board to a request.
pub type Answer = Result<u32, Refusal<'static>>;

/// One axis of the application.
pub struct Board {
    joint: Joint,
    splitter: Splitter,
    pace: Pace,
    /// Jobs to be planned or set up next. Every other request is carried out as it comes.
    jobs: VecDeque<Work>,
    under_way: Option<UnderWay>,
    /// Ticks needed to plan a move or to set an arm up.
    takes: u32,
    /// Answers so far.
    pub answers: Vec<Answer>,
    /// Number of frames that came in garbled.
    pub garbled: u64,
    /// Number of ticks that did not take place.
    pub missed: u64,
    /// Number of ticks that came before they were due and were not made.
    pub early: u64,
    /// True if the axis was switched on since the last tick, at the position of the drive.
    begins: bool,
}

/// A job whose result is ready in `left` ticks.
struct UnderWay {
    left: u32,
    result: Ready,
}

// One at a time.
#[allow(clippy::large_enum_variant)]
enum Ready {
    /// A planned move. With `again`, it is planned once more if the axis' motion has changed
    /// meanwhile.
    Plan {
        motion: PlainMove,
        planned: PlannedMove<f32>,
        again: bool,
    },
    Arm {
        scene: UniformScene,
        stepper: Stepper,
    },
}

/// One tick of the board.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Number, mode, setpoint.
    pub tick: Tick<f32>,
    /// The demand on the shaft.
    pub demand: Demand<f32>,
    /// True for the first tick since the axis was switched on.
    pub begins: bool,
}

impl Board {
    /// Powers the board up. Planning a move takes `takes` ticks.
    pub fn new(configuration: &Configuration, takes: u32) -> Result<Self, Error> {
        Ok(Self {
            joint: Joint::new(configuration, stepper(&configuration.scene)?)?,
            splitter: Splitter::new(),
            pace: Pace::new(PERIOD),
            jobs: VecDeque::new(),
            under_way: None,
            takes,
            answers: Vec::new(),
            garbled: 0,
            missed: 0,
            early: 0,
            begins: false,
        })
    }

    /// Takes bytes from the host.
    pub fn receive(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            let Some(frame) = self.splitter.push(byte) else { continue };
            match frame.and_then(decode::<Request>) {
                Ok(request) => self.answer(&request),
                Err(_) => self.garbled += 1,
            }
        }
    }

    /// Takes a request as if its frame had come, without encoding it.
    pub fn ask(&mut self, command: Command) {
        self.answer(&Request { sequence: 0, axis: 0, command });
    }

    /// Takes a frame from the drive.
    pub fn hear_drive(&mut self, frame: &ClassicFrame) {
        self.joint.hear_drive(frame);
    }

    /// Returns what the drive is told beside the setpoints, once.
    pub fn take_order(&mut self) -> Option<Order> {
        self.joint.take_order()
    }

    /// Makes a tick at that reading of the clock. Returns `None` if it is not due.
    pub fn tick(&mut self, now: u32) -> Option<Step> {
        let timing = self.pace.arrive(now);
        let Some(tick) = self.joint.tick_if_due(&timing) else {
            self.early += 1;
            return None;
        };
        self.missed += u64::from(timing.missed);
        let begins = std::mem::take(&mut self.begins);
        let step = Step { tick, demand: self.joint.train.demand(&tick.setpoint), begins };
        if let Some(job) = &mut self.under_way {
            job.left = job.left.saturating_sub(1);
        }
        self.work();
        Some(step)
    }

    /// The axis.
    pub fn axis(&self) -> &Axis<Stepper, QUEUE> {
        &self.joint.axis
    }

    /// The drive's node.
    pub fn node(&self) -> Node {
        self.joint.node()
    }

    /// Carries out a request, or hands it to the planner.
    fn answer(&mut self, request: &Request) {
        self.joint.axis.heard();
        if request.axis > 0 {
            self.answers.push(Err(Refusal::Axis(1)));
            return;
        }
        let Some(job) = Work::of(&request.command) else {
            let tick = self.joint.axis.clock();
            let answer = self.carry_out(&request.command).map(|()| tick);
            self.answers.push(answer);
            return;
        };
        if self.jobs.len() == JOBS {
            self.answers.push(Err(Refusal::Busy));
        } else {
            self.jobs.push_back(job);
            self.work();
        }
    }

    /// Does the planner's work that is due by now, one job after the other.
    fn work(&mut self) {
        loop {
            if self.under_way.as_ref().is_some_and(|job| job.left > 0) {
                return;
            }
            if let Some(job) = self.under_way.take() {
                self.hand_over(job.result);
                continue;
            }
            let Some(job) = self.jobs.pop_front() else { return };
            let begun = match job {
                Work::Move(motion) => self.plan(motion, true),
                Work::Payload(payload) => self.set_up(payload),
                // As a firmware without the planner of still moves, and without paths.
                Work::Still { .. } => Err(Refusal::NoPlanner),
                Work::Path(_) | Work::Row(..) => Err(Refusal::NoPaths),
            };
            self.begin(begun);
        }
    }

    fn begin(&mut self, result: Result<Ready, Refusal<'static>>) {
        match result {
            Ok(result) => self.under_way = Some(UnderWay { left: self.takes, result }),
            Err(refusal) => self.answers.push(Err(refusal)),
        }
    }

    fn plan(&self, motion: PlainMove, again: bool) -> Result<Ready, Refusal<'static>> {
        let planned = self.joint.axis.plan_context()?.plan(&motion)?;
        Ok(Ready::Plan { motion, planned, again })
    }

    fn set_up(&self, payload: Payload) -> Result<Ready, Refusal<'static>> {
        let scene = UniformScene { payload, ..self.joint.scene };
        Ok(Ready::Arm { scene, stepper: stepper(&scene)? })
    }

    fn hand_over(&mut self, result: Ready) {
        let tick = self.joint.axis.clock();
        let done = match result {
            Ready::Plan { motion, planned, again } => match self.joint.take(&planned) {
                Err(Error::Stale) if again => {
                    let begun = self.plan(motion, false);
                    return self.begin(begun);
                }
                taken => taken.map(drop).map_err(Refusal::from),
            },
            Ready::Arm { scene, stepper } => self.joint.replace(scene, stepper),
        };
        self.answers.push(done.map(|()| tick));
    }

    fn carry_out(&mut self, command: &Command) -> Result<(), Refusal<'static>> {
        let before = self.joint.axis.mode();
        self.joint.carry_out(command)?;
        self.begins |= *command == Command::Enable && before == Mode::Disabled;
        Ok(())
    }
}
