//! The machine: its arms, gears, drives, method and tick. Edit this file for another machine.

use stillbeam::axis::{Policy, StopLimits};
use stillbeam::motor::{self, Direction, Ratio};
use stillbeam::scene::Uniform;
use stillbeam::{Damping, Error, Hub, Limits, Link, Mount, Payload, UniformScene};
use stillbeam_methods::Method as _;

use crate::Configuration;

/// Number of axes in one tick.
pub const AXES: usize = 2;

/// The control period h, s. A whole number of µs and of the board's counts; the timer's period, the
/// board's counts and the policy's times are derived from it.
pub const TICK: f64 = 0.010;

/// The method, the same for every axis: any of the list in `methods/`. The firmware tells the host
/// its name, and the host runs the same one.
pub type Method = stillbeam_methods::Elastica2;

/// The method's stepper.
pub type Stepper = <Method as stillbeam_methods::Method>::Stepper;

/// Counts of an encoder in a turn of its shaft. The firmware warns where an f32 position loses
/// them.
pub const COUNTS: u32 = 8192;

/// Segments that the queue of an axis holds: one S-curve and a move more, or eight cubics.
pub const QUEUE: usize = 8;

/// An axis of this machine.
pub type Joint = crate::Joint<Stepper, QUEUE>;

/// The paper's member B with 30 g on a geared motor that is mounted upside down; an aluminium strip
/// of 0.5 m with 50 g in a vertical plane on a direct drive.
pub const CONFIGURATIONS: [Configuration; AXES] = [
    Configuration {
        scene: UniformScene {
            payload: of_mass(0.030),
            ..UniformScene::uniform(Link {
                length: 0.4,
                mass: 0.01904,
                bending_stiffness: 0.042656,
            })
        },
        payloads: &[of_mass(0.050)],
        policy: policy(5.0, 15.0),
        joint: motor::Joint {
            ratio: Ratio { motor: 6, link: 1 },
            efficiency: 0.9,
            rotor_inertia: 1e-5,
            coulomb: 0.01,
            viscous: 0.001,
            torque_constant: 0.08,
        },
        direction: Direction::Opposite,
        zero: 0.125,
        node: 1,
    },
    Configuration {
        scene: UniformScene {
            link: Link { length: 0.5, mass: 0.054, bending_stiffness: 0.92 },
            shape: Uniform,
            hub: Hub { radius: 0.03, inertia: 1e-4, stiffness: None },
            payload: of_mass(0.050),
            damping: Damping { alpha: 0.1, beta: 1e-4, joint: 0.0 },
            gravity: 9.81,
            mount: Mount::ROTARY,
        },
        payloads: &[of_mass(0.080)],
        policy: policy(8.0, 60.0),
        joint: motor::Joint {
            ratio: Ratio { motor: 1, link: 1 },
            efficiency: 1.0,
            rotor_inertia: 5e-5,
            coulomb: 0.02,
            viscous: 0.0,
            torque_constant: 0.5,
        },
        direction: Direction::Same,
        zero: -0.25,
        node: 2,
    },
];

/// Time without a word from the host after which an axis stops, s.
pub const PATIENCE: f64 = 0.5;

/// A payload of `mass` kg that is small, at the tip.
const fn of_mass(mass: f64) -> Payload {
    Payload { mass, inertia: 0.0, offset: 0.0 }
}

/// Policy with limits in rad/s and rad/s²; the axis waits for two missed ticks.
const fn policy(rate: f64, acceleration: f64) -> Policy {
    let limits = Limits {
        rate: Some(rate),
        acceleration: Some(acceleration),
        deceleration: None,
        jerk: None,
        torque: None,
        moment: None,
    };
    Policy { limits, stop: StopLimits::OF_MOVES, patience: PATIENCE, missed: 2 }
}

/// Builds the stepper of an arm: on the desktop, or on the target with the firmware's feature
/// `set-up`. Never called in the tick.
///
/// # Errors
/// The method refuses the scene or the tick.
// Inline, so that nothing of the stepper is compiled in this crate: what a tick calls has to be
// compiled in `firmware/tick`, at that crate's level.
#[inline]
pub fn stepper(scene: &UniformScene) -> Result<Stepper, Error> {
    Method::stepper(scene, TICK)
}
