//! moteus' position mode: PD with an optional integral, and feed-forward torque.
//!
//! ```text
//! x_c += v_c T      the control position goes on at the commanded velocity between frames
//! τ    = τ_ff + k_p (x_c − x̂) + k_d (v_c − v̂) + ∫ k_i (x_c − x̂) dt, the integral within ± ilimit
//! ```
//!
//! The drive runs at 15 to 30 kHz. Here it runs at 8 kHz by default, at which its torque is held
//! for 0.125 ms. Source: moteus documentation, "Theory of operation" and `servo.pid_position`.

use super::{Between, Inputs, Servo};

/// Settings, by their names in `servo.pid_position`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// `kp`, N m/turn.
    pub kp: f64,
    /// `kd`, N m/(turn/s).
    pub kd: f64,
    /// `ki`, N m/(turn s).
    pub ki: f64,
    /// `ilimit`, N m.
    pub ilimit: f64,
    /// Bandwidth of the position filter, rad/s: 2π `pll_filter_hz` / 2.48.
    pub bandwidth: f64,
    /// Rate of the loops, Hz.
    pub rate: f64,
    /// Motion between two setpoints: the drive extrapolates.
    pub between: Between,
}

impl Default for Config {
    /// The drive's own defaults.
    fn default() -> Self {
        Self {
            kp: 4.0,
            kd: 0.05,
            ki: 1.0,
            ilimit: 0.0,
            bandwidth: 1013.0,
            rate: 8000.0,
            between: Between::Extrapolate,
        }
    }
}

/// A moteus in position mode.
#[derive(Clone, Debug)]
pub struct Moteus {
    config: Config,
    torque_limit: f64,
    inputs: Inputs,
    integral: f64,
}

impl Moteus {
    /// A drive with setpoints every `period` s, whose motor gives up to `torque_limit` N m.
    pub fn new(config: Config, torque_limit: f64, period: f64) -> Self {
        let inputs = Inputs::resting(config.between, period, config.bandwidth, config.rate);
        Self { config, torque_limit, inputs, integral: 0.0 }
    }
}

impl Servo for Moteus {
    fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    fn inputs_mut(&mut self) -> &mut Inputs {
        &mut self.inputs
    }

    fn enable(&mut self, reading: f64) {
        self.inputs.rest_at(reading);
        self.integral = 0.0;
    }

    fn update(&mut self, t: f64, reading: f64) -> f64 {
        let (position, velocity) = self.inputs.read(reading);
        let set = self.inputs.target(t);
        let Config { kp, kd, ki, ilimit, .. } = self.config;
        let error = set.position - position;
        self.integral = (self.integral + ki * error * self.interval()).clamp(-ilimit, ilimit);
        let torque = set.torque + kp * error + kd * (set.velocity - velocity) + self.integral;
        torque.clamp(-self.torque_limit, self.torque_limit)
    }
}
