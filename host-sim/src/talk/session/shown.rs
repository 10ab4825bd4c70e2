//! A conversation's axes, ticks, counts and log so far.

use stillbeam::axis::Tick;

use super::Session;
use crate::talk::Replica;

impl Session {
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
    pub(super) fn ticks(&self, seconds: f64) -> u32 {
        (seconds / self.tick()).round().max(1.0) as u32
    }

    /// Returns the lines that the firmware logged before the latest tick and since the last call,
    /// each with the number of ticks made until then. A line that it logs after a tick's setpoints
    /// shows with the next tick.
    pub fn log(&mut self) -> Vec<(u32, String)> {
        self.machine.log(self.comparison.next())
    }
}
