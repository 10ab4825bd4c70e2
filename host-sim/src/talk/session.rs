//! Requests and answers, tick by tick. Everything that comes back is compared.

use std::collections::VecDeque;

use stillbeam::axis::Tick;
use stillbeam::motion::Waypoint;
use stillbeam_protocol::frame::{self, Splitter, decode};
use stillbeam_protocol::{Command, Refusal, Report, Request, Sample, Status};

use super::comparison::Comparison;
use super::drive::line;
use super::{Machine, Replica};
use crate::error::Error;

/// Time between two heartbeats, s.
const HEARTBEAT: f64 = 0.1;

/// Time within which every request is answered, s: many times the longest search for a still move.
const LONGEST: f64 = 1_000.0;

/// Time within which axes that are not told to turn on come to rest, s.
const REST: f64 = 60.0;

/// The firmware's answer to a request.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The request was carried out before the tick of that number.
    Accepted(u32),
    /// The request was refused, for that reason.
    Refused(String),
    /// The request was refused for want of room in the move queue, in those words.
    Full(String),
    /// The status of the axis.
    Status(Status),
    /// A recording has begun, of a sensor's column of that name.
    Recording(String),
    /// A recording has ended.
    Recorded {
        /// Samples that were sent.
        samples: u32,
        /// Samples that the line was too slow for, or that found no hub angle.
        lost: u32,
    },
}

/// A request that was sent.
#[derive(Clone, Copy, Debug)]
pub struct Posted {
    sequence: u16,
    axis: u8,
    command: Command,
}

/// A conversation.
pub struct Session {
    machine: Machine,
    link: Splitter,
    sequence: u16,
    /// Sequence numbers of requests that are not answered.
    open: VecDeque<u16>,
    answers: VecDeque<(u16, Answer)>,
    comparison: Comparison,
    /// Number of the next tick to be made, if time is granted.
    upcoming: u32,
    silent: bool,
    /// The tick after which a heartbeat was last sent.
    beaten: u32,
    /// True if something was sent that the firmware has not heard.
    unheard: bool,
    /// True if the drives turn machines.
    loaded: bool,
    /// Samples of the axis that is recorded, if one is.
    samples: Option<(u8, Vec<Sample>)>,
}

impl Session {
    /// Asks every axis for its description. The emulated arms stand at 0.05, 0.1, … turns.
    ///
    /// # Errors
    /// An error is returned if the firmware does not answer, or if this host cannot run along with
    /// it.
    pub fn begin(machine: Machine) -> Result<Self, Error> {
        Self::begin_with(machine, false)
    }

    /// Begins as [`Session::begin`] does, with the reference rod behind motor, gear and friction on
    /// every drive.
    ///
    /// # Errors
    /// Errors are those of [`Session::begin`], that of a board, whose drives are its own, and that
    /// of an axis which does not turn a hub.
    pub fn begin_loaded(machine: Machine) -> Result<Self, Error> {
        if !machine.is_emulated() {
            return Err(Error::new("--plant: must be with QEMU; a board has drives of its own"));
        }
        Self::begin_with(machine, true)
    }

    fn begin_with(machine: Machine, loaded: bool) -> Result<Self, Error> {
        let mut session = Self {
            machine,
            link: Splitter::new(),
            sequence: 0,
            open: VecDeque::new(),
            answers: VecDeque::new(),
            comparison: Comparison::default(),
            // The first tick needs no grant.
            upcoming: 1,
            silent: false,
            beaten: 0,
            unheard: false,
            loaded,
            samples: None,
        };
        let mut axis = 0;
        let mut axes = 1;
        while axis < axes {
            session.send(axis, Command::Describe)?;
            axes = session.wait_for_description(axis)?;
            axis += 1;
        }
        // The drives say where they are.
        session.wait(1)?;
        Ok(session)
    }

    /// Sends a request and goes on until it is answered: at once, or after the ticks that a plan
    /// takes.
    ///
    /// # Errors
    /// An error is returned if the firmware is gone or does otherwise than the host.
    pub fn ask(&mut self, axis: u8, command: Command) -> Result<Answer, Error> {
        let posted = self.post(axis, command)?;
        self.answer(posted)
    }

    /// Sends a row of a path, again and again until there is room for it.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`].
    pub fn offer(&mut self, axis: u8, row: Waypoint, last: bool) -> Result<Answer, Error> {
        let mut waited = 0;
        loop {
            match self.ask(axis, Command::Waypoint { row, last })? {
                // Rows before it wait for moves that take longer than a path's rows may lie apart.
                Answer::Full(_) if waited < self.ticks(LONGEST) => self.wait(1)?,
                answer => return Ok(answer),
            }
            waited += 1;
        }
    }

    /// Sends a request, for [`Session::answer`]. In between others may be asked. If a move is
    /// accepted meanwhile, the host learns it too late to run along.
    ///
    /// # Errors
    /// An error is returned if the line is broken.
    pub fn post(&mut self, axis: u8, command: Command) -> Result<Posted, Error> {
        self.send(axis, command).map(|sequence| Posted { sequence, axis, command })
    }

    /// Goes on until a request is answered.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`].
    pub fn answer(&mut self, posted: Posted) -> Result<Answer, Error> {
        let Posted { sequence, axis, command } = posted;
        let longest = self.ticks(LONGEST);
        let mut waited = 0;
        while self.open.contains(&sequence) {
            self.beat()?;
            self.exchange()?;
            waited += 1;
            if waited > longest {
                return Err(Error::new(format_args!("firmware: no answer for {LONGEST} s")));
            }
        }
        let place = self.answers.iter().position(|(of, _)| *of == sequence);
        let (_, answer) = place
            .and_then(|place| self.answers.remove(place))
            .ok_or_else(|| Error::new("firmware: an answer without content"))?;
        // Heartbeats' own.
        self.answers.clear();
        if let Answer::Accepted(tick) = answer {
            self.comparison.accept(axis, tick, command);
        }
        self.comparison.compare(&mut self.machine)?;
        Ok(answer)
    }

    /// Goes on for `ticks` ticks while the firmware hears heartbeats.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`].
    pub fn wait(&mut self, ticks: u32) -> Result<(), Error> {
        let end = self.comparison.next().saturating_add(ticks);
        while self.comparison.next() < end {
            self.beat()?;
            self.exchange()?;
            self.comparison.compare(&mut self.machine)?;
            self.answers.clear();
        }
        Ok(())
    }

    /// Goes on as [`Session::wait`] does, without a word to the firmware.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`].
    pub fn keep_silent(&mut self, ticks: u32) -> Result<(), Error> {
        self.silent = true;
        let outcome = self.wait(ticks);
        self.silent = false;
        outcome
    }

    /// Keeps the firmware from its tick for a time, s, as a fault of it would. Only QEMU can do
    /// this.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`]. A board, or a time beyond 0 to 65 ms, is refused too.
    pub fn stall(&mut self, seconds: f64) -> Result<(), Error> {
        let refused = |why| {
            Error::new(format_args!("stall = {seconds} s: must be 0 to 0.065 s in QEMU{why}"))
        };
        if !self.machine.is_emulated() {
            return Err(refused(", not on a board"));
        }
        if !(0.0..=0.065).contains(&seconds) {
            return Err(refused(""));
        }
        self.machine.stall((1e6 * seconds) as u16);
        // It counts from the last tick, with the next one due a tick later.
        let missed = (seconds / self.tick()) as u32;
        self.comparison.miss(self.upcoming, missed.saturating_sub(1));
        self.wait(1)
    }

    /// Goes on until every axis rests.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`]. An error is also returned if there is no rest within a
    /// minute.
    pub fn rest(&mut self) -> Result<(), Error> {
        for _ in 0..self.ticks(REST) {
            if self.comparison.axes().iter().all(|axis| axis.replica.rests()) {
                return Ok(());
            }
            self.wait(1)?;
        }
        Err(Error::new(format_args!(
            "rest: an axis still turns after {REST} s; spin to rate 0 first"
        )))
    }

    /// Sends arbitrary bytes to the firmware, as a bad line would.
    ///
    /// # Errors
    /// An error is returned if the line is broken.
    pub fn disturb(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.machine.send(bytes)
    }

    /// Keeps the samples of an axis from now on.
    pub(super) fn keep_samples(&mut self, axis: u8) {
        self.samples = Some((axis, Vec::new()));
    }

    /// Returns the samples that were kept, and keeps no more.
    pub(super) fn take_samples(&mut self) -> Vec<Sample> {
        self.samples.take().map(|(_, samples)| samples).unwrap_or_default()
    }

    /// Number of axes.
    pub fn axes(&self) -> u8 {
        self.comparison.axes().len() as u8
    }

    /// The host's side of an axis.
    pub fn replica(&self, axis: u8) -> Option<&Replica> {
        self.comparison.axes().get(usize::from(axis)).map(|axis| &axis.replica)
    }

    /// True if the emulated drive of an axis is on.
    pub fn drive_is_on(&self, axis: u8) -> Option<bool> {
        self.comparison.axes().get(usize::from(axis)).map(|axis| axis.drive.is_on())
    }

    /// Lets the encoder of an axis jump by `turns` of its motor.
    ///
    /// # Errors
    /// An axis that does not exist, or drives without machines.
    pub fn jump(&mut self, axis: u8, turns: f64) -> Result<(), Error> {
        let drive = self.drive(axis)?;
        match drive.body_mut() {
            Some(body) if turns.is_finite() => body.jump(turns),
            _ => {
                return Err(Error::new(format_args!(
                    "jump = {turns}: must be a number of turns, with --plant"
                )));
            }
        }
        Ok(())
    }

    /// Lets the drive of an axis switch itself off with an error.
    ///
    /// # Errors
    /// An axis that does not exist.
    pub fn fail(&mut self, axis: u8) -> Result<(), Error> {
        self.drive(axis)?.fail();
        Ok(())
    }

    /// Cuts the line between the bus and the drive of an axis, or mends it.
    ///
    /// # Errors
    /// An axis that does not exist.
    pub fn cut(&mut self, axis: u8, cut: bool) -> Result<(), Error> {
        self.drive(axis)?.cut(cut);
        Ok(())
    }

    fn drive(&mut self, axis: u8) -> Result<&mut super::drive::Drive, Error> {
        let count = self.comparison.axes().len();
        let found = self.comparison.axes_mut().get_mut(usize::from(axis));
        found.map(|axis| &mut axis.drive).ok_or_else(|| {
            Error::new(format_args!("axis = {axis}: must be 0 to {}", count.saturating_sub(1)))
        })
    }

    /// Of an axis with a machine: the greatest angle of its hub behind the latest setpoint, rad,
    /// and the error of its energy balance over work and losses.
    pub fn followed(&self, axis: u8) -> Option<[f64; 2]> {
        let body = self.comparison.axes().get(usize::from(axis))?.drive.body()?;
        Some([body.behind(), body.energy_error()])
    }

    /// Every tick of an axis so far.
    pub fn history(&self, axis: u8) -> &[Tick<f32>] {
        self.comparison.axes().get(usize::from(axis)).map_or(&[], |axis| &axis.history)
    }

    /// Setpoints and drive frames that were compared, all of them equal.
    pub fn compared(&self) -> [usize; 2] {
        self.comparison.equal()
    }

    /// Number of the next tick.
    pub fn now(&self) -> u32 {
        self.comparison.next()
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.comparison.axes().first().map_or(0.0, |axis| axis.replica.tick())
    }

    /// Converts a time to ticks, to the nearest, at least one.
    fn ticks(&self, seconds: f64) -> u32 {
        (seconds / self.tick()).round().max(1.0) as u32
    }

    /// Returns the lines that the firmware logged before the latest tick and since the last call,
    /// each with the number of ticks made until then. A line that it logs after a tick's setpoints
    /// shows with the next tick.
    pub fn log(&mut self) -> Vec<(u32, String)> {
        self.machine.log(self.comparison.next())
    }

    fn send(&mut self, axis: u8, command: Command) -> Result<u16, Error> {
        self.sequence = self.sequence.wrapping_add(1);
        let request = Request { sequence: self.sequence, axis, command };
        let mut bytes = [0; frame::MAX];
        let bytes = frame::encode(&request, &mut bytes)
            .map_err(|error| Error::new(format_args!("request: {error:?}")))?;
        self.machine.send(bytes)?;
        self.open.push_back(self.sequence);
        self.unheard = true;
        Ok(self.sequence)
    }

    /// Sends a heartbeat to the firmware every [`HEARTBEAT`], unless silence is asked for.
    fn beat(&mut self) -> Result<(), Error> {
        let latest = self.comparison.latest();
        if !self.silent && latest.wrapping_sub(self.beaten) >= self.ticks(HEARTBEAT) {
            self.beaten = latest;
            self.send(0, Command::Heartbeat)?;
        }
        Ok(())
    }

    /// Makes one more tick and takes in everything that comes with it.
    fn exchange(&mut self) -> Result<(), Error> {
        if !self.machine.is_emulated() {
            return self.take_in();
        }
        let tick = self.tick();
        for axis in self.comparison.axes_mut() {
            axis.drive.advance(tick)?;
            for frame in axis.drive.reports(self.unheard, self.machine.room_on_bus()) {
                self.machine.send_to_bus(&line(&frame));
                axis.report(self.upcoming, frame);
            }
        }
        let all_sent = self.machine.grant()?;
        if all_sent && core::mem::take(&mut self.unheard) {
            self.comparison.heard(self.upcoming);
        }
        // Answers come before the tick that was granted, but for those that take a plan.
        while !self.comparison.has(self.upcoming) {
            self.take_in()?;
        }
        self.upcoming += 1;
        Ok(())
    }

    fn wait_for_description(&mut self, axis: u8) -> Result<u8, Error> {
        self.machine.grant()?;
        self.upcoming += 1;
        while self.comparison.axes().len() <= usize::from(axis) {
            self.take_in()?;
        }
        Ok(self.comparison.expected() as u8)
    }

    /// Takes in the bytes that have come over the link.
    fn take_in(&mut self) -> Result<(), Error> {
        for byte in self.machine.receive()? {
            let Some(frame) = self.link.push(byte) else { continue };
            let mut bytes = frame.map(|frame| frame.to_vec()).unwrap_or_default();
            match decode::<Report<'_>>(&mut bytes) {
                Ok(report) => self.sort(&report)?,
                // A board's line may begin in the middle of a frame.
                Err(_) if self.comparison.axes().is_empty() => {}
                Err(error) => {
                    return Err(Error::new(format_args!(
                        "link: a frame came in garbled, {error:?}"
                    )));
                }
            }
        }
        Ok(())
    }

    fn sort(&mut self, report: &Report<'_>) -> Result<(), Error> {
        let (sequence, answer) = match *report {
            Report::Tick { axis, tick, cause } => {
                self.comparison.push(axis, tick, cause);
                return Ok(());
            }
            Report::Description { sequence, description } => {
                self.comparison.expect(description.axes.into());
                let patient = !self.machine.is_emulated();
                let replica = Replica::new(&description, patient)?;
                self.comparison.add(replica, &description, self.loaded)?;
                self.open.retain(|open| *open != sequence);
                return Ok(());
            }
            Report::Accepted { sequence, tick } => (sequence, Answer::Accepted(tick)),
            Report::Refused { sequence, refusal } => {
                let why = refusal.to_string();
                let is_full = matches!(refusal, Refusal::Queue { .. });
                (sequence, if is_full { Answer::Full(why) } else { Answer::Refused(why) })
            }
            Report::Status { sequence, status } => (sequence, Answer::Status(status)),
            Report::Recording { sequence, column, .. } => {
                (sequence, Answer::Recording(column.to_owned()))
            }
            Report::Sample { axis, sample } => {
                // Those of a recording that another host has begun are not kept.
                if let Some((_, samples)) = self.samples.as_mut().filter(|(of, _)| *of == axis) {
                    samples.push(sample);
                }
                return Ok(());
            }
            Report::Recorded { sequence, samples, lost } => {
                (sequence, Answer::Recorded { samples, lost })
            }
        };
        let known = self.open.contains(&sequence);
        self.open.retain(|open| *open != sequence);
        if known {
            self.answers.push_back((sequence, answer));
        }
        Ok(())
    }
}
