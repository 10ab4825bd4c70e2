//! ODrive's loops: position P, velocity PI, torque.
//!
//! ```text
//! v_des = clamp(v_set + k_p (x_set − x̂), ±vel_limit)
//! τ     = τ_set + k_v (v_des − v̂) + ∫ k_i (v_des − v̂) dt
//! ```
//!
//! The integrator decays by 1 % an update while the torque is limited. Source: ODrive
//! documentation, Control, and firmware 0.5.6, `MotorControl/controller.cpp`.

use super::{Between, Inputs, Servo, Target};

/// Settings, by their names in ODrive's `controller.config`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// `pos_gain`, (turn/s)/turn.
    pub position_gain: f64,
    /// `vel_gain`, N m/(turn/s).
    pub velocity_gain: f64,
    /// `vel_integrator_gain`, N m/turn.
    pub integrator_gain: f64,
    /// `vel_limit`, turn/s.
    pub velocity_limit: f64,
    /// `encoder.config.bandwidth`, rad/s.
    pub bandwidth: f64,
    /// Rate of the loops, Hz.
    pub rate: f64,
    /// Motion between two setpoints; `INPUT_MODE_PASSTHROUGH` holds.
    pub between: Between,
    /// `input_filter_bandwidth`, 1/s, if `INPUT_MODE_POS_FILTER` is on: a critically damped
    /// second-order filter on position and velocity. The torque is then the filter's acceleration
    /// times `filter_inertia`; the setpoint's own torque is not used.
    pub filter_bandwidth: Option<f64>,
    /// `inertia`, N m/(turn/s²).
    pub filter_inertia: f64,
}

impl Default for Config {
    /// The drive's own defaults, but for the velocity limit of 2 turn/s, which every machine has to
    /// raise.
    fn default() -> Self {
        Self {
            position_gain: 20.0,
            velocity_gain: 1.0 / 6.0,
            integrator_gain: 2.0 / 6.0,
            velocity_limit: 50.0,
            bandwidth: 1000.0,
            rate: 8000.0,
            between: Between::Hold,
            filter_bandwidth: None,
            filter_inertia: 0.0,
        }
    }
}

/// An ODrive in closed-loop position control.
#[derive(Clone, Debug)]
pub struct Odrive {
    config: Config,
    /// Largest torque, N m.
    torque_limit: f64,
    inputs: Inputs,
    filtered: Target,
    integrator: f64,
}

impl Odrive {
    /// A drive with setpoints every `period` s, whose motor gives up to `torque_limit` N m.
    pub fn new(config: Config, torque_limit: f64, period: f64) -> Self {
        let inputs = Inputs::resting(config.between, period, config.bandwidth, config.rate);
        Self { config, torque_limit, inputs, filtered: Target::default(), integrator: 0.0 }
    }

    /// Returns the setpoint behind the input mode.
    fn setpoint(&mut self, t: f64) -> Target {
        let input = self.inputs.target(t);
        let Some(bandwidth) = self.config.filter_bandwidth else { return input };
        let interval = self.interval();
        let ki = 2.0 * bandwidth;
        let kp = 0.25 * ki * ki;
        let now = &mut self.filtered;
        let acceleration =
            kp * (input.position - now.position) + ki * (input.velocity - now.velocity);
        now.torque = acceleration * self.config.filter_inertia;
        now.velocity += interval * acceleration;
        now.position += interval * now.velocity;
        *now
    }
}

impl Servo for Odrive {
    fn inputs(&self) -> &Inputs {
        &self.inputs
    }

    fn inputs_mut(&mut self) -> &mut Inputs {
        &mut self.inputs
    }

    fn enable(&mut self, reading: f64) {
        self.inputs.rest_at(reading);
        self.filtered = Target { position: reading, ..Target::default() };
        self.integrator = 0.0;
    }

    fn update(&mut self, t: f64, reading: f64) -> f64 {
        let (position, velocity) = self.inputs.read(reading);
        let set = self.setpoint(t);
        let Config { position_gain, velocity_gain, integrator_gain, velocity_limit, .. } =
            self.config;
        let held = |torque: f64| torque.clamp(-self.torque_limit, self.torque_limit);
        let wanted = (set.velocity.clamp(-velocity_limit, velocity_limit)
            + position_gain * (set.position - position))
            .clamp(-velocity_limit, velocity_limit);
        let error = wanted - velocity;
        let torque = held(set.torque) + velocity_gain * error + self.integrator;
        let limited = held(torque);
        if limited == torque {
            self.integrator += integrator_gain * self.interval() * error;
        } else {
            self.integrator *= 0.99;
        }
        limited
    }
}
