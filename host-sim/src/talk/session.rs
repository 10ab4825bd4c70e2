//! Requests and answers, tick by tick, with everything that comes back compared.

use std::collections::VecDeque;

use stillbeam::Angle;
use stillbeam::axis::{Cause, Mode, Tick};
use stillbeam::drive::{ClassicFrame, Sequence};
use stillbeam_protocol::frame::{self, Splitter, decode};
use stillbeam_protocol::{Command, Report, Request, Status, slcan};

use super::drive::Drive;
use super::{Machine, Replica};
use crate::error::Error;

/// Ticks between two heartbeats.
const HEARTBEAT: u32 = 10;

/// The firmware's answer to a request.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// Carried out before the tick of that number.
    Accepted(u32),
    /// Refused, and why.
    Refused(String),
    /// How it is.
    Status(Status),
}

/// A conversation.
pub struct Session {
    machine: Machine,
    link: Splitter,
    bus: slcan::Splitter,
    sequence: u16,
    /// Sequence numbers of requests that are not answered.
    open: VecDeque<u16>,
    answers: VecDeque<(u16, Answer)>,
    /// Ticks that came and are not compared, by axis.
    ticks: Vec<VecDeque<(Tick<f32>, Option<Cause>)>>,
    frames: VecDeque<(ClassicFrame, u16)>,
    axes: Vec<Axis>,
    /// Number of the next tick to be compared.
    next: u32,
    /// Number of the next tick to be made, where time is granted.
    upcoming: u32,
    silent: bool,
    /// Setpoints and frames that were compared.
    compared: [usize; 2],
}

struct Axis {
    replica: Replica,
    drive: Drive,
    /// What was accepted, with the tick before which it was carried out.
    accepted: VecDeque<(u32, Command)>,
    /// Ticks before which the firmware heard the host.
    heard: VecDeque<u32>,
    history: Vec<Tick<f32>>,
}

impl Session {
    /// Asks every axis what it is. The emulated arms stand at 0.05, 0.1, … turns.
    ///
    /// # Errors
    /// The firmware does not answer, or is none that this host can run along with.
    pub fn begin(machine: Machine) -> Result<Self, Error> {
        let mut session = Self {
            machine,
            link: Splitter::new(),
            bus: slcan::Splitter::new(),
            sequence: 0,
            open: VecDeque::new(),
            answers: VecDeque::new(),
            ticks: Vec::new(),
            frames: VecDeque::new(),
            axes: Vec::new(),
            next: 0,
            // The first tick needs no grant.
            upcoming: 1,
            silent: false,
            compared: [0; 2],
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

    /// Sends a request and goes on until it is answered.
    ///
    /// # Errors
    /// The firmware is gone, or does otherwise than the host.
    pub fn ask(&mut self, axis: u8, command: Command) -> Result<Answer, Error> {
        let sequence = self.send(axis, command)?;
        while self.open.contains(&sequence) {
            self.exchange()?;
        }
        let place = self.answers.iter().position(|(of, _)| *of == sequence);
        let (_, answer) = place
            .and_then(|place| self.answers.remove(place))
            .ok_or_else(|| Error::new("firmware: an answer without content"))?;
        if let (Answer::Accepted(tick), Some(axis)) =
            (&answer, self.axes.get_mut(usize::from(axis)))
        {
            axis.accepted.push_back((*tick, command));
        }
        self.compare()?;
        Ok(answer)
    }

    /// Goes on for so many ticks, heard by the firmware.
    ///
    /// # Errors
    /// As [`Session::ask`].
    pub fn wait(&mut self, ticks: u32) -> Result<(), Error> {
        let end = self.next.saturating_add(ticks);
        while self.next < end {
            if !self.silent && self.open.is_empty() && self.next.is_multiple_of(HEARTBEAT) {
                self.send(0, Command::Heartbeat)?;
            }
            self.exchange()?;
            self.compare()?;
            self.answers.clear();
        }
        Ok(())
    }

    /// As [`Session::wait`], without a word.
    ///
    /// # Errors
    /// As [`Session::ask`].
    pub fn keep_silent(&mut self, ticks: u32) -> Result<(), Error> {
        self.silent = true;
        let outcome = self.wait(ticks);
        self.silent = false;
        outcome
    }

    /// Goes on until every axis rests.
    ///
    /// # Errors
    /// As [`Session::ask`], or no rest within a minute.
    pub fn rest(&mut self) -> Result<(), Error> {
        for _ in 0..6000 {
            if self.axes.iter().all(|axis| axis.replica.rests()) {
                return Ok(());
            }
            self.wait(1)?;
        }
        Err(Error::new("rest: an axis still turns after 6000 ticks; accepted is a spin to rate 0"))
    }

    /// Number of axes.
    pub fn axes(&self) -> u8 {
        self.axes.len() as u8
    }

    /// The host's side of an axis.
    pub fn replica(&self, axis: u8) -> Option<&Replica> {
        self.axes.get(usize::from(axis)).map(|axis| &axis.replica)
    }

    /// Whether the emulated drive of an axis is on.
    pub fn drive_is_on(&self, axis: u8) -> Option<bool> {
        self.axes.get(usize::from(axis)).map(|axis| axis.drive.is_on())
    }

    /// Every tick of an axis so far.
    pub fn history(&self, axis: u8) -> &[Tick<f32>] {
        self.axes.get(usize::from(axis)).map_or(&[], |axis| &axis.history)
    }

    /// Setpoints and drive frames that were compared, all of them equal.
    pub fn compared(&self) -> [usize; 2] {
        self.compared
    }

    /// Number of the next tick.
    pub fn now(&self) -> u32 {
        self.next
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.axes.first().map_or(0.0, |axis| axis.replica.tick())
    }

    /// Lines that the firmware has logged since it was last asked.
    pub fn log(&mut self) -> Vec<String> {
        self.machine.log()
    }

    fn send(&mut self, axis: u8, command: Command) -> Result<u16, Error> {
        self.sequence = self.sequence.wrapping_add(1);
        let request = Request { sequence: self.sequence, axis, command };
        let mut bytes = [0; frame::MAX];
        let bytes = frame::encode(&request, &mut bytes)
            .map_err(|error| Error::new(format_args!("request: {error:?}")))?;
        self.machine.send(bytes)?;
        self.open.push_back(self.sequence);
        Ok(self.sequence)
    }

    /// One more tick, and all that comes with it.
    fn exchange(&mut self) -> Result<(), Error> {
        if !self.machine.is_emulated() {
            return self.take_in();
        }
        for axis in &self.axes {
            self.machine.send_to_bus(&axis.drive.estimates());
        }
        let all_sent = self.machine.grant()?;
        if all_sent && !self.open.is_empty() {
            for axis in &mut self.axes {
                axis.heard.push_back(self.upcoming);
            }
        }
        self.upcoming += 1;
        // Answers come before the tick that was granted.
        while (all_sent && !self.open.is_empty())
            || self
                .ticks
                .iter()
                .any(|queue| queue.back().is_none_or(|(tick, _)| tick.number + 1 < self.upcoming))
        {
            self.take_in()?;
        }
        Ok(())
    }

    fn wait_for_description(&mut self, axis: u8) -> Result<u8, Error> {
        self.machine.grant()?;
        self.upcoming += 1;
        while self.axes.len() <= usize::from(axis) {
            self.take_in()?;
        }
        // All of them say how many there are; the queues of ticks are as many.
        Ok(self.ticks.len() as u8)
    }

    /// Takes in what has come over the link.
    fn take_in(&mut self) -> Result<(), Error> {
        for byte in self.machine.receive()? {
            let Some(frame) = self.link.push(byte) else { continue };
            let mut bytes = frame.map(|frame| frame.to_vec()).unwrap_or_default();
            match decode::<Report<'_>>(&mut bytes) {
                Ok(report) => self.sort(&report)?,
                // A board's line may begin in the middle of a frame.
                Err(_) if self.axes.is_empty() => {}
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
                let axis = usize::from(axis);
                while self.ticks.len() <= axis {
                    self.ticks.push(VecDeque::new());
                }
                self.ticks[axis].push_back((tick, cause));
                return Ok(());
            }
            Report::Description { sequence, description } => {
                while self.ticks.len() < usize::from(description.axes) {
                    self.ticks.push(VecDeque::new());
                }
                let emulated = self.machine.is_emulated();
                let replica = Replica::new(&description, !emulated)?;
                let hub = Angle { turns: 0, part: 0.05 * (1 + self.axes.len()) as f32 };
                let shaft = replica.train().mapping().to_motor(hub);
                let drive = Drive::new(replica.node(), shaft.in_turns() as f32);
                let (accepted, heard) = (VecDeque::new(), VecDeque::new());
                self.axes.push(Axis { replica, drive, accepted, heard, history: Vec::new() });
                self.open.retain(|open| *open != sequence);
                return Ok(());
            }
            Report::Accepted { sequence, tick } => (sequence, Answer::Accepted(tick)),
            Report::Refused { sequence, refusal } => {
                (sequence, Answer::Refused(refusal.to_string()))
            }
            Report::Status { sequence, status } => (sequence, Answer::Status(status)),
        };
        let known = self.open.contains(&sequence);
        self.open.retain(|open| *open != sequence);
        if known {
            self.answers.push_back((sequence, answer));
        }
        Ok(())
    }

    /// Compares every tick that all axes have made.
    fn compare(&mut self) -> Result<(), Error> {
        if !self.machine.is_emulated() {
            self.join();
        }
        while self.ticks.iter().all(|queue| !queue.is_empty()) {
            for axis in 0..self.axes.len() {
                let Some((tick, cause)) = self.ticks[axis].pop_front() else { continue };
                if tick.number != self.next {
                    let (number, next) = (tick.number, self.next);
                    return Err(Error::new(format_args!(
                        "axis {axis}: tick {number} came where {next} was due"
                    )));
                }
                self.compare_one(axis, &tick, cause)?;
            }
            self.next += 1;
        }
        Ok(())
    }

    /// A board has been running before: begins with the tick that has come first.
    fn join(&mut self) {
        let first =
            self.ticks.iter().filter_map(|queue| queue.front()).map(|(tick, _)| tick.number);
        if let (0, Some(first)) = (self.compared[0], first.max()) {
            for queue in &mut self.ticks {
                queue.retain(|(tick, _)| tick.number >= first);
            }
            self.next = first;
        }
    }

    fn compare_one(
        &mut self,
        number: usize,
        tick: &Tick<f32>,
        cause: Option<Cause>,
    ) -> Result<(), Error> {
        let emulated = self.machine.is_emulated();
        let axis = &mut self.axes[number];
        while axis.heard.pop_front_if(|heard| *heard <= tick.number).is_some() {
            axis.replica.heard();
        }
        while let Some((_, command)) = axis.accepted.pop_front_if(|(at, _)| *at <= tick.number) {
            // What the host cannot measure it takes from the setpoint that shows it.
            let shown = axis.replica.train().mapping().to_motor(tick.setpoint.angle);
            let shaft = if emulated { axis.drive.shaft() } else { shown };
            axis.replica.apply(&command, shaft)?;
        }
        if !emulated && let (Some(cause), Mode::Enabled) = (cause, axis.replica.mode()) {
            axis.replica.stop(cause);
        }
        let (ours, our_cause) = axis.replica.step();
        let ours = Tick { number: tick.number, ..ours };
        let report = |tick, cause| Report::Tick { axis: number as u8, tick, cause };
        let theirs = encoded(&report(*tick, cause))?;
        // Before it is enabled, a board's axis stands where the host does not know.
        let comparable = emulated || tick.mode != Mode::Disabled;
        if comparable && theirs != encoded(&report(ours, our_cause))? {
            return Err(Error::new(format_args!(
                "axis {number}, tick {}: the firmware's setpoint is not the host's: {:?}, {:?} \
                 against {:?}, {:?}",
                tick.number, tick, cause, ours, our_cause
            )));
        }
        axis.history.push(*tick);
        self.compared[0] += 1;
        if emulated { self.compare_frames(number, tick) } else { Ok(()) }
    }

    /// The drive frames of a tick: the setpoint, and the switch where the mode has changed.
    fn compare_frames(&mut self, number: usize, tick: &Tick<f32>) -> Result<(), Error> {
        let (demand, switched) = self.axes[number].replica.told(tick);
        let node = self.axes[number].replica.node();
        let position = demand.and_then(|demand| node.set_input_pos::<ClassicFrame>(&demand));
        let switch = switched.and_then(|on| node.set_axis_state::<ClassicFrame>(on));
        let stamp = (u32::from(Sequence(tick.number as u16).0) * 10 % 60_000) as u16;
        for ours in position.map(|encoded| encoded.payload).into_iter().chain(switch) {
            let theirs = self.next_frame()?;
            if theirs != (ours, stamp) {
                return Err(Error::new(format_args!(
                    "axis {number}, tick {}: the frame on the bus is not the host's: {theirs:?} \
                     against {:?}",
                    tick.number,
                    (ours, stamp)
                )));
            }
            self.axes[number].drive.hear(&theirs.0);
            self.compared[1] += 1;
        }
        Ok(())
    }

    fn next_frame(&mut self) -> Result<(ClassicFrame, u16), Error> {
        for _ in 0..500 {
            if let Some(frame) = self.frames.pop_front() {
                return Ok(frame);
            }
            for byte in self.machine.receive_from_bus()? {
                if let Some(line) = self.bus.push(byte) {
                    let text = String::from_utf8_lossy(line).into_owned();
                    let frame = slcan::decode(line);
                    let frame = frame
                        .ok_or_else(|| Error::new(format_args!("bus: \"{text}\" is no frame")))?;
                    self.frames.push_back(frame);
                }
            }
        }
        Err(Error::new("bus: no frame for 10 s"))
    }
}

/// The report's bytes: equal bytes are equal bits.
fn encoded(report: &Report<'_>) -> Result<Vec<u8>, Error> {
    let mut bytes = [0; frame::MAX];
    let bytes = frame::encode(report, &mut bytes);
    bytes.map(<[u8]>::to_vec).map_err(|error| Error::new(format_args!("report: {error:?}")))
}
