//! A drive and its machine, side by side in time.

use stillbeam::motor::{Demand, Direction, Drivetrain};
use stillbeam::{Angle, Setpoint};

use super::setpoints::Setpoints;
use super::{Machine, Servo, Target, Wire};
use crate::error::Error;
use crate::plant::{Effort, Encoder, Options, Plant, Shown};
use stillbeam::Scene;

/// Parts of a setpoint that are sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Feed {
    /// Velocity feed-forward.
    pub velocity: bool,
    /// Torque feed-forward.
    pub torque: bool,
    /// Friction is in the torque.
    pub friction: bool,
}

impl Feed {
    /// Position alone.
    pub const POSITION: Self = Self { velocity: false, torque: false, friction: false };
    /// Position and velocity.
    pub const VELOCITY: Self = Self { velocity: true, ..Self::POSITION };
    /// All three, with the friction that the machine has.
    pub const ALL: Self = Self { velocity: true, torque: true, friction: true };
}

/// Samples of the machine in a tick.
pub const SAMPLES: u32 = 4;

/// A run of the loop.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The machine, [`SAMPLES`] times a tick, from t = 0 on.
    pub shown: Vec<Shown>,
    /// Torque of the motor at the same times, N m.
    pub torque: Vec<f64>,
    /// Largest torque, N m.
    pub peak: f64,
    /// Fraction of the loop's updates at which the motor could not give what the loop asked for.
    pub saturated: f64,
    /// Error of the energy balance over the work and the losses.
    pub energy_error: f64,
}

/// A machine in the loop with its drive.
pub struct Bench {
    plant: Plant,
    servo: Box<dyn Servo>,
    encoder: Encoder,
    /// Setpoints as the drive receives them, one a tick.
    targets: Vec<Target>,
    tick: f64,
    /// Torque that the motor gives, N m.
    torque: f64,
}

impl Bench {
    /// Puts the arm of `scene` on the machine at rest at the first setpoint, and turns the
    /// setpoints into the frames of its drive.
    ///
    /// # Errors
    /// A machine or an arm out of range, or a setpoint that its frame does not hold.
    pub fn new(
        scene: &Scene,
        machine: &Machine,
        setpoints: &Setpoints,
        feed: Feed,
        options: &Options,
    ) -> Result<Self, Error> {
        let parts = machine.parts.validate()?;
        let tick = setpoints.tick;
        let servo = machine.servo(tick)?;
        let encoder = machine.encoder(servo.interval())?;
        let wire = machine.wire()?;
        let targets = targets(machine, &wire, setpoints, feed)?;
        let start = setpoints.list.first().map_or(0.0, |sent| sent.setpoint.angle.radians());
        let plant = Plant::at_rest(scene, &parts, start, options)?;
        Ok(Self { plant, servo, encoder, targets, tick, torque: 0.0 })
    }

    /// Runs all setpoints.
    ///
    /// # Errors
    /// A machine that cannot be simulated on.
    pub fn run(mut self) -> Result<Trace, Error> {
        let interval = self.servo.interval();
        let updates = (self.tick * self.targets.len() as f64 / interval).round() as u64;
        let sample = self.tick / f64::from(SAMPLES);
        let mut trace = Trace {
            shown: Vec::new(),
            torque: Vec::new(),
            peak: 0.0,
            saturated: 0.0,
            energy_error: 0.0,
        };
        let first = self.encoder.read(self.plant.shaft().0);
        self.servo.enable(first);
        let (mut sent, mut limited) = (0, 0_u64);
        for k in 0..updates {
            let t = interval * k as f64;
            let near = 0.5 * interval;
            while sent < self.targets.len() && self.tick * sent as f64 <= t + near {
                self.servo.command(t, self.targets[sent]);
                sent += 1;
            }
            if sample * trace.shown.len() as f64 <= t + near {
                trace.shown.push(self.plant.shown());
                trace.torque.push(self.torque);
            }
            limited += u64::from(self.update(t, interval)?);
            trace.peak = trace.peak.max(self.torque.abs());
        }
        trace.saturated = limited as f64 / updates as f64;
        let exchanged = self.plant.work().abs() + self.plant.lost().abs();
        trace.energy_error = self.plant.energy_error().abs() / exchanged.max(1e-9);
        Ok(trace)
    }

    /// Makes one update of the loop and lets the machine follow it. Returns true if the motor could
    /// not give what was asked for.
    fn update(&mut self, t: f64, interval: f64) -> Result<bool, Error> {
        let (shaft, rate) = self.plant.shaft();
        let reading = self.encoder.read(shaft);
        let wanted = self.servo.update(t, reading);
        let motor = self.plant.parts().motor;
        let (torque, limited) = motor.limited(wanted, self.torque, interval, rate);
        self.torque = torque;
        self.plant.advance(t + interval, &Effort::Held(torque))?;
        Ok(limited)
    }
}

/// Returns what the drive receives, one a tick.
fn targets(
    machine: &Machine,
    wire: &Wire,
    setpoints: &Setpoints,
    feed: Feed,
) -> Result<Vec<Target>, Error> {
    let joint = machine.parts.joint(feed.friction);
    let train = Drivetrain::<f32>::new(&joint, Direction::Same, 0.0)?;
    let demands: Vec<Demand<f32>> = setpoints
        .list
        .iter()
        .map(|sent| {
            let demand = train.demand(&single(&sent.setpoint));
            Demand {
                position: demand.position,
                velocity: if feed.velocity { demand.velocity } else { 0.0 },
                torque: if feed.torque { demand.torque } else { 0.0 },
            }
        })
        .collect();
    wire.admit(&demands)?;
    demands.iter().map(|demand| wire.carry(demand)).collect()
}

/// A setpoint in the precision of the target.
fn single(setpoint: &Setpoint<f64>) -> Setpoint<f32> {
    let Angle { turns, part } = setpoint.angle;
    Setpoint {
        angle: Angle { turns, part: part as f32 },
        rate: setpoint.rate as f32,
        acceleration: setpoint.acceleration as f32,
        torque: setpoint.torque as f32,
        tip: setpoint.tip.map(|x| x as f32),
    }
}
