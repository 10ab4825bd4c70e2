//! The constants of one axis.

use stillbeam::axis::Policy;
use stillbeam::motor::{self, Direction};
use stillbeam::{Payload, UniformScene};

/// Constants of one axis: arm, policy, gear, motor and drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Configuration {
    /// Arm at power-up.
    pub scene: UniformScene,
    /// Payloads that the arm may carry in place of the scene's own. The build prepares the arm with
    /// each of them.
    pub payloads: &'static [Payload],
    /// Limits, patience and missed ticks that the axis waits for.
    pub policy: Policy,
    /// Gear and motor.
    pub joint: motor::Joint<f64>,
    /// Sense of rotation of the motor against the hub.
    pub direction: Direction,
    /// Angle of the shaft where the hub's is 0, turns.
    pub zero: f64,
    /// Node id of the drive.
    pub node: u8,
}
