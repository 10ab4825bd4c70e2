//! Requests and answers, tick by tick. Everything that comes back is compared.

mod intake;
mod shown;
mod tamper;

use std::collections::VecDeque;

use rayon::prelude::*;
use stillbeam::motion::Waypoint;
use stillbeam_protocol::frame::{self, Splitter};
use stillbeam_protocol::{Command, Request, Sample};

use super::comparison::Comparison;
use super::drive::line;
use super::{Answer, Machine};
use crate::error::Error;

/// Time between two heartbeats, s.
const HEARTBEAT: f64 = 0.1;

/// Time within which every request is answered, s: many times the longest search for a still move.
const LONGEST: f64 = 1_000.0;

/// Time within which axes that are not told to turn on come to rest, s.
const REST: f64 = 60.0;

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

    /// Keeps the samples of an axis from now on.
    pub(super) fn keep_samples(&mut self, axis: u8) {
        self.samples = Some((axis, Vec::new()));
    }

    /// Returns the samples that were kept, and keeps no more.
    pub(super) fn take_samples(&mut self) -> Vec<Sample> {
        self.samples.take().map(|(_, samples)| samples).unwrap_or_default()
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
        // Nothing of one machine is another's, and integrating them takes most of a run's time.
        let mut drives: Vec<_> =
            self.comparison.axes_mut().iter_mut().map(|axis| &mut axis.drive).collect();
        drives.par_iter_mut().try_for_each(|drive| drive.advance(tick))?;
        for axis in self.comparison.axes_mut() {
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
}
