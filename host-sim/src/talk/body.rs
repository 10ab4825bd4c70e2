//! The machine behind an emulated drive: motor, gear, friction and the reference rod, in lock-step
//! with the firmware's ticks.

use std::f64::consts::TAU;

use stillbeam::Scene;
use stillbeam::motor::{Demand, Direction};
use stillbeam_protocol::Description;

use crate::error::Error;
use crate::plant::{Effort, Encoder, Friction, Gear, Motor, Options, Parts, Plant};
use crate::servo::odrive::{Config, Odrive};
use crate::servo::{Between, Servo, Target};

/// Fineness of the rod.
const OPTIONS: Options = Options { order: 5, tolerance: 1e-7 };

/// Counts of the encoder a turn of the motor.
const COUNTS: u32 = 16_384;

/// Bandwidth of the velocity loop by the whole inertia, rad/s. Tuned by the rotor's alone, the loop
/// is too soft to hold an arm upright against gravity.
const BANDWIDTH: f64 = 12.0;

/// Rate at which a brake holds the hub of a drive that is off, 1/s.
const BRAKE: f64 = 200.0;

/// A drive's loops and its machine.
pub(super) struct Body {
    plant: Plant,
    servo: Odrive,
    encoder: Encoder,
    /// Sense of rotation of the drive's turns against the hub's.
    sign: f64,
    /// The drive's turns where the hub's angle is 0.
    zero: f64,
    tick: f64,
    t: f64,
    /// Setpoint of the drive, turns, and the greatest angle of the hub behind it, rad.
    setpoint: f64,
    behind: f64,
    /// Reading of the encoder, turns of the drive.
    reading: f64,
}

impl Body {
    /// Puts the arm of a description at rest with the hub at `angle` rad, on a motor with the gear,
    /// friction and rotor that the description gives.
    ///
    /// # Errors
    /// An axis that is no hub which turns.
    pub fn new(description: &Description<'_>, angle: f64) -> Result<Self, Error> {
        let Description { scene, joint, tick, direction, zero, .. } = *description;
        let rotor = joint.rotor_inertia.max(1e-7);
        let parts = Parts {
            gear: Gear { ratio: joint.ratio, efficiency: joint.efficiency, ..Gear::default() },
            friction: Friction {
                coulomb: joint.coulomb,
                breakaway: 1.2 * joint.coulomb,
                viscous: joint.viscous,
                ..Friction::default()
            },
            motor: Motor { rotor_inertia: rotor, ..Motor::default() },
        };
        let arm = Scene::from(scene);
        let load = arm.hub.inertia + arm.rigid_inertia();
        let velocity_gain = TAU * (rotor + load / parts.ratio().powi(2)) * BANDWIDTH;
        let config = Config {
            position_gain: BANDWIDTH / 3.0,
            velocity_gain,
            integrator_gain: velocity_gain,
            velocity_limit: 1e3,
            bandwidth: 1500.0,
            rate: 4000.0,
            between: Between::Linear,
            filter_bandwidth: None,
            filter_inertia: 0.0,
        };
        let servo = Odrive::new(config, f64::INFINITY, tick);
        let encoder = Encoder::new(COUNTS, 0.0, servo.interval())?;
        let plant = Plant::at_rest(&arm, &parts, angle, &OPTIONS)?;
        let sign = if direction == Direction::Same { 1.0 } else { -1.0 };
        let zero = zero.in_turns();
        let mut body = Self {
            plant,
            servo,
            encoder,
            sign,
            zero,
            tick,
            t: 0.0,
            setpoint: 0.0,
            behind: 0.0,
            reading: 0.0,
        };
        body.read();
        Ok(body)
    }

    fn read(&mut self) {
        let turns = self.sign * self.plant.shaft().0 + self.zero;
        self.reading = self.encoder.read(turns);
    }

    /// The encoder's reading, turns of the drive.
    pub fn reading(&self) -> f64 {
        self.reading
    }

    /// Switches the drive's loops on where the shaft is.
    pub fn enable(&mut self) {
        self.servo.enable(self.reading);
        self.setpoint = self.reading;
    }

    /// Calls the shaft's angle `turns` from now on.
    pub fn call_it(&mut self, turns: f64) {
        self.zero += turns - self.reading;
        self.read();
    }

    /// Takes a setpoint.
    pub fn command(&mut self, demand: &Demand<f32>) {
        let position = demand.position.in_turns();
        let velocity = demand.velocity.into();
        let torque = demand.torque.into();
        self.servo.command(self.t, Target { position, velocity, torque });
        self.setpoint = position;
    }

    /// Lets drive and machine run for a tick. A drive that is off holds its shaft with a brake.
    ///
    /// # Errors
    /// A machine that cannot be simulated on.
    pub fn advance(&mut self, on: bool) -> Result<(), Error> {
        let interval = self.servo.interval();
        let updates = (self.tick / interval).round() as u32;
        let begin = self.t;
        for k in 1..=updates {
            let next = begin + interval * f64::from(k);
            self.read();
            let torque = if on { self.sign * self.servo.update(self.t, self.reading) } else { 0.0 };
            let brake = |_: f64, _: f64, rate: f64| -BRAKE * rate;
            let effort = if on { Effort::Held(torque) } else { Effort::Along(&brake) };
            self.plant.advance(next, &effort)?;
            self.t = next;
        }
        if on {
            let hub = self.sign * (self.setpoint - self.zero) * TAU / self.plant.parts().ratio();
            self.behind = self.behind.max((self.plant.shown().angle - hub).abs());
        }
        self.read();
        Ok(())
    }

    /// Shifts the encoder by `turns` of the motor.
    pub fn jump(&mut self, turns: f64) {
        self.encoder.jump(turns);
    }

    /// Greatest angle of the hub behind the latest setpoint while the drive was on, rad. Half a
    /// tick's turn of it is the drive's own lag.
    pub fn behind(&self) -> f64 {
        self.behind
    }

    /// Error of the energy balance over work and losses.
    pub fn energy_error(&self) -> f64 {
        let exchanged = self.plant.work().abs() + self.plant.lost().abs();
        self.plant.energy_error().abs() / exchanged.max(1e-9)
    }
}
