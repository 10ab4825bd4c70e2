//! A CiA 402 drive in cyclic synchronous position mode.
//!
//! The target position (0x607A) is interpolated in a straight line over the interpolation period
//! (0x60C2), so that the drive follows a period late. The velocity offset (0x60B1) is added to the
//! output of the position loop, the torque offset (0x60B2) to that of the velocity loop; the
//! profile does not say that offsets are interpolated, and they are held unless `offsets` says
//! otherwise. Source: CiA 402-2 / IEC 61800-7-201, cyclic synchronous position mode. The gains are
//! the maker's: the profile has none.

use super::between::Interpolator;
use super::{Between, Inputs, Servo, Target};

/// Settings.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// Position loop, 1/s.
    pub position_gain: f64,
    /// Velocity loop, N m/(turn/s).
    pub velocity_gain: f64,
    /// Integral of the velocity loop, N m/turn.
    pub integrator_gain: f64,
    /// Bandwidth of the velocity estimate, rad/s.
    pub bandwidth: f64,
    /// Rate of the velocity loop, Hz.
    pub rate: f64,
    /// Updates of the velocity loop in one of the position loop.
    pub divider: u32,
    /// Motion between two target positions.
    pub between: Between,
    /// Course between two offsets of velocity and torque.
    pub offsets: Between,
    /// Rated torque (0x6076), N m.
    pub rated_torque: f64,
}

impl Default for Config {
    /// Gains as an ODrive's, in loops of 4 and 1 kHz.
    fn default() -> Self {
        Self {
            position_gain: 20.0,
            velocity_gain: 1.0 / 6.0,
            integrator_gain: 2.0 / 6.0,
            bandwidth: 1000.0,
            rate: 4000.0,
            divider: 4,
            between: Between::Linear,
            offsets: Between::Hold,
            rated_torque: 2.0,
        }
    }
}

/// The drive.
#[derive(Clone, Debug)]
pub struct Csp {
    config: Config,
    torque_limit: f64,
    /// Target positions, and the encoder.
    inputs: Inputs,
    offsets: Interpolator,
    /// Output of the position loop, turns/s.
    wanted: f64,
    /// Updates until the position loop's next.
    countdown: u32,
    integrator: f64,
}

impl Csp {
    /// A drive that is told an interpolation period of `period` s, whose motor gives up to
    /// `torque_limit` N m.
    pub fn new(config: Config, torque_limit: f64, period: f64) -> Self {
        Self {
            config,
            torque_limit,
            inputs: Inputs::resting(config.between, period, config.bandwidth, config.rate),
            offsets: Interpolator::resting(config.offsets, period, 0.0),
            wanted: 0.0,
            countdown: 0,
            integrator: 0.0,
        }
    }
}

impl Servo for Csp {
    fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    fn inputs_mut(&mut self) -> &mut Inputs {
        &mut self.inputs
    }

    fn enable(&mut self, reading: f64) {
        self.inputs.rest_at(reading);
        self.offsets.rest_at(0.0);
        (self.wanted, self.countdown, self.integrator) = (0.0, 0, 0.0);
    }

    fn command(&mut self, t: f64, target: Target) {
        self.inputs.command(t, target);
        self.offsets.push(t, target);
    }

    fn update(&mut self, t: f64, reading: f64) -> f64 {
        let (position, velocity) = self.inputs.read(reading);
        let offsets = self.offsets.target(t);
        if self.countdown == 0 {
            self.countdown = self.config.divider.max(1);
            let set = self.inputs.target(t).position;
            self.wanted = self.config.position_gain * (set - position);
        }
        self.countdown -= 1;
        let error = self.wanted + offsets.velocity - velocity;
        let torque = offsets.torque + self.config.velocity_gain * error + self.integrator;
        let limited = torque.clamp(-self.torque_limit, self.torque_limit);
        if limited == torque {
            self.integrator += self.config.integrator_gain * self.interval() * error;
        }
        limited
    }
}
