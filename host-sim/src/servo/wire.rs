//! Setpoints as the bytes of a protocol, and back: what of them reaches the drive.

use stillbeam::drive::{DemandPeaks, Range};
use stillbeam::drive::{Encoded, cia402, moteus, odrive};
use stillbeam::motor::Demand;

use super::Target;
use crate::error::Error;

/// A protocol with what it needs to be decoded.
#[derive(Clone, Copy, Debug)]
pub enum Wire {
    /// Set_Input_Pos.
    Odrive,
    /// Position mode registers.
    Moteus(moteus::Servo),
    /// The PDO of target position and offsets.
    Cia402(cia402::Drive),
}

impl Wire {
    /// Contents of a frame.
    pub fn range(&self) -> Range {
        match self {
            Self::Odrive => odrive::RANGE,
            Self::Moteus(_) => moteus::RANGE,
            Self::Cia402(drive) => drive.range(),
        }
    }

    /// Refuses demands of which one does not fit its frame.
    ///
    /// # Errors
    /// The value that does not fit, and what does.
    pub fn admit(&self, demands: &[Demand<f32>]) -> Result<(), Error> {
        let mut peaks = DemandPeaks::default();
        demands.iter().for_each(|demand| peaks.note(demand));
        Ok(self.range().admit(&peaks)?)
    }

    /// Returns what the drive decodes from the bytes of a demand.
    ///
    /// # Errors
    /// A demand that is not finite or does not fit.
    pub fn carry(&self, demand: &Demand<f32>) -> Result<Target, Error> {
        let received = match self {
            Self::Odrive => {
                odrive::encode(demand).and_then(Encoded::whole).and_then(|b| odrive::decode(&b))
            }
            Self::Moteus(servo) => {
                servo.encode(demand).and_then(Encoded::whole).and_then(|b| servo.decode(&b))
            }
            Self::Cia402(drive) => {
                drive.encode(demand).and_then(Encoded::whole).map(|b| drive.decode(&b))
            }
        };
        let Demand { position, velocity, torque } = received.ok_or_else(|| {
            Error::new(format_args!("drive: {demand:?}: must be finite and fit the frame"))
        })?;
        Ok(Target {
            position: position.in_turns(),
            velocity: velocity.into(),
            torque: torque.into(),
        })
    }
}
