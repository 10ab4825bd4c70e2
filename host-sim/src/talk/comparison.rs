//! Compares every setpoint and every drive frame of the firmware with the host's own.

use std::collections::VecDeque;

use stillbeam::Angle;
use stillbeam::axis::{Cause, Mode, Tick};
use stillbeam::drive::ClassicFrame;
use stillbeam_protocol::{Command, Description, Report, frame, slcan};

use super::body::Body;
use super::drive::Drive;
use super::{Machine, Replica};
use crate::error::Error;

/// The axes of firmware and host.
#[derive(Default)]
pub(super) struct Comparison {
    axes: Vec<Axis>,
    /// Received ticks that are not yet compared, by axis.
    ticks: Vec<VecDeque<(Tick<f32>, Option<Cause>)>>,
    bus: slcan::Splitter,
    frames: VecDeque<(ClassicFrame, u16)>,
    /// Number of the next tick to be compared.
    next: u32,
    /// Number of setpoints and of frames that were equal.
    equal: [usize; 2],
}

/// One axis of firmware and host.
pub(super) struct Axis {
    pub(super) replica: Replica,
    pub(super) drive: Drive,
    /// Accepted commands, each with the tick before which it was carried out.
    accepted: VecDeque<(u32, Command)>,
    /// Ticks before which the firmware heard the host.
    heard: VecDeque<u32>,
    /// Frames of the drive, each with the tick before which the firmware has them.
    reports: VecDeque<(u32, ClassicFrame)>,
    /// Ticks that did not take place, with the number of the tick after them.
    missed: VecDeque<(u32, u32)>,
    pub(super) history: Vec<Tick<f32>>,
}

impl Axis {
    /// Records that the firmware has a frame of the drive before tick `tick`.
    pub(super) fn report(&mut self, tick: u32, frame: ClassicFrame) {
        self.reports.push_back((tick, frame));
    }
}

impl Comparison {
    /// Adds an axis. Its emulated arm stands at 0.05, 0.1, … turns. With `loaded`, its drive turns
    /// a machine.
    ///
    /// # Errors
    /// An axis that is no machine.
    pub(super) fn add(
        &mut self,
        replica: Replica,
        description: &Description<'_>,
        loaded: bool,
    ) -> Result<(), Error> {
        let hub = Angle { turns: 0, part: 0.05 * (1 + self.axes.len()) as f32 };
        let shaft = replica.train().mapping().to_motor(hub);
        let drive = if loaded {
            Drive::with_body(replica.node(), Body::new(description, hub.radians())?)
        } else {
            Drive::new(replica.node(), shaft.in_turns() as f32)
        };
        let (accepted, heard, reports, missed) = Default::default();
        let history = Vec::new();
        self.axes.push(Axis { replica, drive, accepted, heard, reports, missed, history });
        Ok(())
    }

    /// Notes that the firmware has at least `axes` axes.
    pub(super) fn expect(&mut self, axes: usize) {
        if self.ticks.len() < axes {
            self.ticks.resize_with(axes, VecDeque::new);
        }
    }

    /// Returns the number of axes that the firmware has.
    pub(super) fn expected(&self) -> usize {
        self.ticks.len()
    }

    pub(super) fn axes(&self) -> &[Axis] {
        &self.axes
    }

    pub(super) fn axes_mut(&mut self) -> &mut [Axis] {
        &mut self.axes
    }

    pub(super) fn next(&self) -> u32 {
        self.next
    }

    pub(super) fn equal(&self) -> [usize; 2] {
        self.equal
    }

    /// Records that the firmware has accepted a command, before tick `tick`.
    pub(super) fn accept(&mut self, axis: u8, tick: u32, command: Command) {
        if let Some(axis) = self.axes.get_mut(usize::from(axis)) {
            axis.accepted.push_back((tick, command));
        }
    }

    /// Records that the firmware has heard the host, before tick `tick`.
    pub(super) fn heard(&mut self, tick: u32) {
        for axis in &mut self.axes {
            axis.heard.push_back(tick);
        }
    }

    /// Records that `missed` ticks will not take place before tick `tick`.
    pub(super) fn miss(&mut self, tick: u32, missed: u32) {
        if missed > 0 {
            for axis in &mut self.axes {
                axis.missed.push_back((tick, missed));
            }
        }
    }

    /// Returns the number of the latest tick that has come.
    pub(super) fn latest(&self) -> u32 {
        let latest = self.ticks.first().and_then(|queue| queue.back());
        latest.map_or(self.next.saturating_sub(1), |(tick, _)| tick.number)
    }

    /// Takes a setpoint that has come.
    pub(super) fn push(&mut self, axis: u8, tick: Tick<f32>, cause: Option<Cause>) {
        self.expect(usize::from(axis) + 1);
        self.ticks[usize::from(axis)].push_back((tick, cause));
    }

    /// True if all axes have sent tick `number`.
    pub(super) fn has(&self, number: u32) -> bool {
        self.ticks.iter().all(|queue| queue.back().is_some_and(|(tick, _)| tick.number >= number))
    }

    /// Compares every tick that all axes have made.
    pub(super) fn compare(&mut self, machine: &mut Machine) -> Result<(), Error> {
        if !machine.is_emulated() {
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
                self.compare_one(machine, axis, &tick, cause)?;
            }
            self.next += 1;
        }
        Ok(())
    }

    /// Begins with the tick that has come first, because a board may have been running before.
    fn join(&mut self) {
        let first =
            self.ticks.iter().filter_map(|queue| queue.front()).map(|(tick, _)| tick.number);
        if let (0, Some(first)) = (self.equal[0], first.max()) {
            for queue in &mut self.ticks {
                queue.retain(|(tick, _)| tick.number >= first);
            }
            self.next = first;
        }
    }

    fn compare_one(
        &mut self,
        machine: &mut Machine,
        number: usize,
        tick: &Tick<f32>,
        cause: Option<Cause>,
    ) -> Result<(), Error> {
        let emulated = machine.is_emulated();
        let axis = &mut self.axes[number];
        while axis.heard.pop_front_if(|heard| *heard <= tick.number).is_some() {
            axis.replica.heard();
        }
        while let Some((_, frame)) = axis.reports.pop_front_if(|(at, _)| *at <= tick.number) {
            axis.replica.hear_drive(&frame);
        }
        while let Some((_, command)) = axis.accepted.pop_front_if(|(at, _)| *at <= tick.number) {
            // What the host cannot measure it takes from the setpoint that shows it.
            let shown = axis.replica.train().mapping().to_motor(tick.setpoint.angle);
            axis.replica.apply(&command, (!emulated).then_some(shown))?;
        }
        while let Some((_, missed)) = axis.missed.pop_front_if(|(at, _)| *at <= tick.number) {
            axis.replica.missed(missed);
        }
        if !emulated && let (Some(cause), Mode::Enabled) = (cause, axis.replica.mode()) {
            axis.replica.stop(cause);
        }
        // A drive that fails while its axis holds after a stop switches it off.
        if !emulated && tick.mode == Mode::Disabled && axis.replica.mode() == Mode::Stopped {
            axis.replica.stop(Cause::DriveFault);
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
        self.equal[0] += 1;
        if emulated { self.compare_frames(machine, number, tick) } else { Ok(()) }
    }

    /// Compares the drive frames of a tick.
    fn compare_frames(
        &mut self,
        machine: &mut Machine,
        number: usize,
        tick: &Tick<f32>,
    ) -> Result<(), Error> {
        let axis = &mut self.axes[number];
        let told = axis.replica.told(tick);
        let period = axis.replica.tick();
        let stamp = slcan::stamp(tick.sequence(), (1e6 * period).round() as u32);
        axis.drive.await_setpoint(period);
        for ours in told {
            let theirs = self.next_frame(machine)?;
            if theirs != (ours, stamp) {
                return Err(Error::new(format_args!(
                    "axis {number}, tick {}: the frame on the bus is not the host's: {theirs:?} \
                     against {:?}",
                    tick.number,
                    (ours, stamp)
                )));
            }
            self.axes[number].drive.hear(&theirs.0);
            self.equal[1] += 1;
        }
        Ok(())
    }

    fn next_frame(&mut self, machine: &mut Machine) -> Result<(ClassicFrame, u16), Error> {
        for _ in 0..500 {
            if let Some(frame) = self.frames.pop_front() {
                return Ok(frame);
            }
            for byte in machine.receive_from_bus()? {
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

/// Returns the report's bytes. Equal bytes are equal bits.
fn encoded(report: &Report<'_>) -> Result<Vec<u8>, Error> {
    let mut bytes = [0; frame::MAX];
    let bytes = frame::encode(report, &mut bytes);
    bytes.map(<[u8]>::to_vec).map_err(|error| Error::new(format_args!("report: {error:?}")))
}
