//! The two axes of the campaign: those of the firmware's application as it is delivered. They are
//! kept here, and not taken from there, because the campaign's figures are theirs.

use stillbeam::axis::Policy;
use stillbeam::motor::{Direction, Joint, Ratio};
use stillbeam::{Damping, Hub, Limits, Link, Payload, Scene};

/// The control period h, s.
pub const TICK: f64 = 0.010;

/// Time without a word from the host after which an axis stops, s.
const PATIENCE: f64 = 0.5;

/// Time in which a stop from the greatest rate is over, s: several times what the slowest takes,
/// 2.12 · 5/15 = 0.7.
const STOP: f64 = 2.5;

/// Ticks after which a silent axis must be at rest: its patience, and a stop.
pub const SILENCE: u32 = ticks(PATIENCE + STOP);

/// A time in ticks, to the nearest.
pub const fn ticks(seconds: f64) -> u32 {
    (seconds / TICK + 0.5) as u32
}

/// One axis' constants.
#[derive(Clone, Copy, Debug)]
pub struct Configuration {
    /// The arm at power-up.
    pub scene: Scene,
    /// Limits and patience.
    pub policy: Policy,
    /// Gear and motor.
    pub joint: Joint<f64>,
    /// Which way the motor turns.
    pub direction: Direction,
    /// The shaft's angle, turns, where the hub's is 0.
    pub zero: f64,
}

/// A strip with 30 g on a gear that turns it round, and one of 0.5 m with 50 g in a vertical plane on
/// a direct drive.
pub const CONFIGURATIONS: [Configuration; 2] = [
    Configuration {
        scene: Scene {
            link: Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 },
            hub: Hub { radius: 0.0, inertia: 0.0 },
            payload: Payload { mass: 0.030, inertia: 0.0 },
            damping: Damping { alpha: 0.0, beta: 0.0 },
            gravity: 0.0,
        },
        policy: policy(5.0, 15.0),
        joint: Joint {
            ratio: Ratio { motor: 6, link: 1 },
            efficiency: 0.9,
            rotor_inertia: 1e-5,
            coulomb: 0.01,
            viscous: 0.001,
            torque_constant: 0.08,
        },
        direction: Direction::Opposite,
        zero: 0.125,
    },
    Configuration {
        scene: Scene {
            link: Link { length: 0.5, mass: 0.054, bending_stiffness: 0.92 },
            hub: Hub { radius: 0.03, inertia: 1e-4 },
            payload: Payload { mass: 0.050, inertia: 0.0 },
            damping: Damping { alpha: 0.1, beta: 1e-4 },
            gravity: 9.81,
        },
        policy: policy(8.0, 60.0),
        joint: Joint {
            ratio: Ratio { motor: 1, link: 1 },
            efficiency: 1.0,
            rotor_inertia: 5e-5,
            coulomb: 0.02,
            viscous: 0.0,
            torque_constant: 0.5,
        },
        direction: Direction::Same,
        zero: -0.25,
    },
];

/// Limits in rad/s and rad/s². Half a second of silence is a lost link; two missed ticks are waited
/// for.
const fn policy(rate: f64, acceleration: f64) -> Policy {
    let limits = Limits {
        rate: Some(rate),
        acceleration: Some(acceleration),
        jerk: None,
        torque: None,
        moment: None,
    };
    Policy { limits, patience: PATIENCE, missed: 2 }
}
