//! Inputs of a drive: setpoints from its bus, readings of its encoder.

use super::between::Interpolator;
use super::tracker::Tracker;
use super::{Between, Target};

/// Setpoints and the encoder of a drive.
#[derive(Clone, Debug)]
pub struct Inputs {
    setpoints: Interpolator,
    encoder: Tracker,
}

impl Inputs {
    /// Creates the inputs of a drive whose shaft rests at zero. Setpoints come every `period` s,
    /// readings `rate` times a second; `bandwidth` is that of the velocity estimate, rad/s.
    pub fn resting(between: Between, period: f64, bandwidth: f64, rate: f64) -> Self {
        Self {
            setpoints: Interpolator::resting(between, period, 0.0),
            encoder: Tracker::resting(0.0, bandwidth, 1.0 / rate),
        }
    }

    /// Begins anew with the shaft at rest at `reading`, turns.
    pub fn rest_at(&mut self, reading: f64) {
        self.setpoints.rest_at(reading);
        self.encoder.rest_at(reading);
    }

    /// Takes a setpoint that arrives at time `t`, s.
    pub fn command(&mut self, t: f64, target: Target) {
        self.setpoints.push(t, target);
    }

    /// Returns what the loops are to follow at time `t`, s.
    pub fn target(&self, t: f64) -> Target {
        self.setpoints.target(t)
    }

    /// Takes a reading, turns. Returns the estimates of position, turns, and velocity, turns/s.
    pub fn read(&mut self, reading: f64) -> (f64, f64) {
        self.encoder.update(reading)
    }

    /// Returns the time between two readings, s.
    pub fn interval(&self) -> f64 {
        self.encoder.interval()
    }

    /// Returns the time by which the loops follow the setpoints later, s.
    pub fn lag(&self) -> f64 {
        self.setpoints.lag()
    }
}
