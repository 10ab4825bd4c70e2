//! Drives in the loop: setpoints through a drive's own loops to the motor of a [`crate::plant`].
//!
//! A [`Servo`] is a drive as its manual describes its loops, at their own rate. A setpoint reaches
//! it as the bytes of its protocol ([`Wire`]), every tick. What it does until the next one is
//! [`Between`]. A [`Bench`] lets drive and machine run, [`judge`] says how far hub and tip are from
//! the commanded motion, and [`trials`] compares what the setpoints are worth.
//!
//! | drive | loops | between two setpoints |
//! |---|---|---|
//! | [`odrive::Odrive`] | position P, velocity PI, 8 kHz | holds; `input_mode` filtered: a second-order filter |
//! | [`moteus::Moteus`] | position and velocity PD, 8 kHz | goes on at the last velocity |
//! | [`cia402::Csp`] | position P at 1 kHz, velocity PI at 4 kHz | a straight line, one period late; offsets held |

pub mod bench;
pub mod between;
pub mod cia402;
mod inputs;
pub mod judge;
pub mod machine;
mod machine_file;
pub mod moteus;
pub mod moving;
pub mod odrive;
pub mod page;
pub mod setpoints;
mod tracker;
pub mod trials;
mod wire;

pub use bench::{Bench, Trace};
pub use between::{Between, Target};
pub use inputs::Inputs;
pub use machine::{Machine, Protocol};
pub use wire::Wire;

/// A drive with its loops. Positions are turns of the motor's shaft, velocities turns/s, torques
/// N m.
pub trait Servo {
    /// Setpoints and encoder.
    fn inputs(&self) -> &Inputs;

    /// Setpoints and encoder, to be written.
    fn inputs_mut(&mut self) -> &mut Inputs;

    /// Interval of the loops, s.
    fn interval(&self) -> f64 {
        self.inputs().interval()
    }

    /// Switches on with the shaft at `reading`, where it stays until a setpoint comes.
    fn enable(&mut self, reading: f64);

    /// Takes a setpoint that arrives at time `t`, s.
    fn command(&mut self, t: f64, target: Target) {
        self.inputs_mut().command(t, target);
    }

    /// Makes one update of the loops at time `t`, s, with the encoder's reading. Returns the torque
    /// that the motor is to give.
    fn update(&mut self, t: f64, reading: f64) -> f64;

    /// Time by which the drive follows its setpoints later, by design, s.
    fn lag(&self) -> f64 {
        self.inputs().lag()
    }
}
