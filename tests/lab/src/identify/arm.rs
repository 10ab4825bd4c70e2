//! Random arms and how they are measured.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::scene::PointMass;
use stillbeam::{Link, Scene};
use stillbeam_sim::arm::natural;
use stillbeam_sim::error::Error;
use stillbeam_sim::identify::arm::Sensor;
use stillbeam_sim::identify::forced::Lowpass;

use crate::random::log;

/// Kind of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A ring-down of 20 periods at a signal-to-noise ratio of 10 dB.
    Long,
    /// One of 5 periods at 20 dB.
    Short,
    /// An accelerometer of known mass: jitter, gaps, steps of a converter, 25 dB.
    Accelerometer,
    /// A hub that moves, an encoder with steps, a sensor that is late, 25 dB.
    Forced,
    /// The same behind a known low-pass.
    Filtered,
}

impl Kind {
    /// All kinds, in the order of the logs' numbers.
    pub const ALL: [Self; 5] =
        [Self::Long, Self::Short, Self::Accelerometer, Self::Forced, Self::Filtered];

    /// Returns the name in a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Long => "ring-down, 20 periods, 10 dB",
            Self::Short => "ring-down, 5 periods, 20 dB",
            Self::Accelerometer => "accelerometer, jitter, gaps, steps",
            Self::Forced => "hub moves, sensor late",
            Self::Filtered => "hub moves, known low-pass",
        }
    }

    /// True if the log has a hub's angle.
    pub fn is_forced(self) -> bool {
        matches!(self, Self::Forced | Self::Filtered)
    }
}

/// An arm and how it is measured.
#[derive(Clone, Debug)]
pub struct Case {
    /// Kind of the log.
    pub kind: Kind,
    /// The arm, without the sensor.
    pub arm: Scene,
    /// Sensor that is on it.
    pub sensor: Option<Sensor>,
    /// EI that the scene claims, over the arm's.
    pub claimed: f64,
    /// Frequencies with the sensor, Hz.
    pub frequency: [f64; natural::MODES],
    /// Damping ratios with the sensor.
    pub ratio: [f64; natural::MODES],
    /// Samples a period.
    pub rate: f64,
    /// Length, periods.
    pub periods: f64,
    /// Signal-to-noise ratio, dB.
    pub noise: f64,
    /// Steps of the sensor's converter over its range, 0 for none.
    pub steps: f64,
    /// Standard deviation of the sampling times, intervals.
    pub jitter: f64,
    /// Share of samples that are lost in gaps.
    pub lost: f64,
    /// Delay of the sensor, s.
    pub delay: f64,
    /// Low-pass of the sensor.
    pub lowpass: Option<Lowpass>,
    /// Seed of the log's noise.
    pub seed: u64,
}

impl Case {
    /// Draws the case of that number.
    pub fn random(seed: u64, index: u64) -> Result<Self, Error> {
        let seed = seed ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let rng = &mut StdRng::seed_from_u64(seed);
        let kind = Kind::ALL[(index % Kind::ALL.len() as u64) as usize];
        let length = log(rng, 0.2, 1.0);
        let mass = log(rng, 0.02, 0.5);
        let mut arm = Scene::new(Link { length, mass, bending_stiffness: 1.0 });
        arm.payload.mass = if rng.random_bool(0.6) { mass * log(rng, 0.1, 2.0) } else { 0.0 };
        let wanted = log(rng, 1.5, 15.0);
        arm.link.bending_stiffness = (wanted / natural::frequencies(&arm)?[0]).powi(2);
        let sensor = (kind == Kind::Accelerometer).then(|| {
            let at = length * rng.random_range(0.7..1.0);
            Sensor { at, mass: mass * rng.random_range(0.02..0.2) }
        });
        let measured = mounted(&arm, sensor)?;
        let omega = std::f64::consts::TAU * natural::frequencies(&measured)?[0];
        // Light damping for long records, or a vibration of 5 periods would not show it.
        let ratio =
            if kind == Kind::Short { log(rng, 0.004, 0.03) } else { log(rng, 0.002, 0.015) };
        if rng.random_bool(0.5) {
            arm.damping.alpha = 2.0 * ratio * omega;
        } else {
            arm.damping.beta = 2.0 * ratio / omega;
        }
        let measured = mounted(&arm, sensor)?;
        let frequency = natural::frequencies(&measured)?;
        let ratio = natural::damping_ratios(&measured, &frequency)?;
        let claimed = rng.random_range(0.85..1.18);
        let case = Self {
            kind,
            arm,
            sensor,
            claimed,
            frequency,
            ratio,
            rate: 200.0,
            periods: 20.0,
            noise: 10.0,
            steps: 0.0,
            jitter: 0.0,
            lost: 0.0,
            delay: 0.0,
            lowpass: None,
            seed: rng.random(),
        };
        Ok(case.measured_as_usual(rng))
    }

    /// Draws how a log of this kind is measured.
    fn measured_as_usual(self, rng: &mut StdRng) -> Self {
        let first = self.frequency[0];
        match self.kind {
            Kind::Long => self,
            Kind::Short => Self { periods: 5.0, noise: 20.0, ..self },
            Kind::Accelerometer => Self {
                rate: rng.random_range(40.0..120.0),
                periods: rng.random_range(15.0..25.0),
                noise: 25.0,
                steps: 4096.0,
                jitter: rng.random_range(0.0..0.2),
                lost: rng.random_range(0.0..0.05),
                ..self
            },
            Kind::Forced | Kind::Filtered => Self {
                rate: rng.random_range(40.0..100.0),
                periods: rng.random_range(10.0..20.0),
                noise: 25.0,
                steps: 4096.0,
                jitter: rng.random_range(0.0..0.1),
                delay: rng.random_range(0.0..0.2) / first,
                lowpass: (self.kind == Kind::Filtered).then(|| Lowpass {
                    frequency: first * log(rng, 1.0, 5.0),
                    ratio: rng.random_range(0.6..1.0),
                }),
                ..self
            },
        }
    }

    /// Returns the arm with the sensor on it.
    pub fn measured(&self) -> Result<Scene, Error> {
        mounted(&self.arm, self.sensor)
    }

    /// Returns the arm that the scene claims.
    pub fn claimed(&self) -> Scene {
        let mut arm = self.arm;
        arm.link.bending_stiffness *= self.claimed;
        arm
    }
}

fn mounted(arm: &Scene, sensor: Option<Sensor>) -> Result<Scene, Error> {
    Ok(match sensor {
        Some(Sensor { at, mass }) => arm.with_mass(PointMass { position: at, mass })?,
        None => *arm,
    })
}
