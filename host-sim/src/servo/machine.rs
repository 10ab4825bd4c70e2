//! Machines: motor, gear, friction, encoder, and the drive with its gains.

use std::path::Path;

use stillbeam::drive::{cia402 as pdo, moteus as registers};

use super::{Between, Servo, Wire, cia402, machine_file, moteus, odrive};
use crate::error::Error;
use crate::plant::{Encoder, Friction, Gear, Motor, Parts};

/// A motor with its gear, and the drive that turns it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Machine {
    /// Motor, gear and friction.
    pub parts: Parts,
    /// Counts of the encoder a turn.
    pub counts: u32,
    /// Age of a reading, s.
    pub latency: f64,
    /// The drive.
    pub drive: Protocol,
}

/// A drive with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Protocol {
    /// ODrive, CAN simple.
    Odrive(odrive::Config),
    /// moteus.
    Moteus(moteus::Config),
    /// CiA 402.
    Cia402(cia402::Config),
}

impl Default for Machine {
    /// A direct drive with a small motor and a little friction, on an ODrive with its own gains.
    fn default() -> Self {
        Self {
            parts: Parts {
                gear: Gear::default(),
                friction: Friction {
                    coulomb: 0.01,
                    breakaway: 0.012,
                    viscous: 1e-3,
                    ..Friction::default()
                },
                motor: Motor { rotor_inertia: 1e-4, torque: Some(5.0), ..Motor::default() },
            },
            counts: 8192,
            latency: 0.0,
            drive: Protocol::Odrive(odrive::Config::default()),
        }
    }
}

/// Embedded machine files: `(name, text of the file)`.
const EMBEDDED: [(&str, &str); 4] = [
    ("odrive-tuned", include_str!("../../machines/odrive-tuned.toml")),
    ("moteus-tuned", include_str!("../../machines/moteus-tuned.toml")),
    ("cia402-tuned", include_str!("../../machines/cia402-tuned.toml")),
    ("geared", include_str!("../../machines/geared.toml")),
];

impl Protocol {
    /// Names of the drives, as they are typed.
    pub const NAMES: [&'static str; 3] = ["odrive", "moteus", "cia402"];

    /// Returns the drive of that name with its own gains.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "odrive" => Some(Self::Odrive(odrive::Config::default())),
            "moteus" => Some(Self::Moteus(moteus::Config::default())),
            "cia402" => Some(Self::Cia402(cia402::Config::default())),
            _ => None,
        }
    }

    /// Name of the drive.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Odrive(_) => "odrive",
            Self::Moteus(_) => "moteus",
            Self::Cia402(_) => "cia402",
        }
    }

    /// Returns the same drive with another way between setpoints, of offsets too.
    pub fn with_between(self, between: Between) -> Self {
        match self {
            Self::Odrive(config) => Self::Odrive(odrive::Config { between, ..config }),
            Self::Moteus(config) => Self::Moteus(moteus::Config { between, ..config }),
            Self::Cia402(config) => {
                Self::Cia402(cia402::Config { between, offsets: between, ..config })
            }
        }
    }
}

impl Machine {
    /// Opens an embedded machine by name, or else a machine file by path.
    ///
    /// # Errors
    /// A file that is no machine, with line, column and key.
    pub fn open(name_or_path: &str) -> Result<Self, Error> {
        if let Some((name, text)) = EMBEDDED.iter().find(|(name, _)| *name == name_or_path) {
            return Self::parse(name, text);
        }
        let path = Path::new(name_or_path);
        if !path.exists() {
            let known = EMBEDDED.map(|(name, _)| name).join(", ");
            return Err(Error::new(format_args!(
                "--machine = {name_or_path}: no such file; must be a machine file or one of {known}"
            )));
        }
        let text = std::fs::read_to_string(path)
            .map_err(|cause| Error::file(path, format_args!("{cause}; must be a machine file")))?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Parses the text of a machine file. Errors begin with `name`.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        machine_file::parse(name, text)
    }

    /// Returns the drive, switched off.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn servo(&self, period: f64) -> Result<Box<dyn Servo>, Error> {
        let most = self.parts.motor.torque.unwrap_or(f64::INFINITY);
        Ok(match self.drive {
            Protocol::Odrive(config) => Box::new(odrive::Odrive::new(config, most, period)),
            Protocol::Moteus(config) => Box::new(moteus::Moteus::new(config, most, period)),
            Protocol::Cia402(config) => Box::new(cia402::Csp::new(config, most, period)),
        })
    }

    /// Returns the protocol's bytes.
    ///
    /// # Errors
    /// Counts or a rated torque out of range.
    pub fn wire(&self) -> Result<Wire, Error> {
        Ok(match self.drive {
            Protocol::Odrive(_) => Wire::Odrive,
            Protocol::Moteus(_) => Wire::Moteus(registers::Servo::new(1, 0.1)?),
            Protocol::Cia402(config) => {
                Wire::Cia402(pdo::Drive::new(1, self.counts, config.rated_torque)?)
            }
        })
    }

    /// Returns the encoder, read every `interval` s.
    ///
    /// # Errors
    /// Counts or a latency out of range.
    pub fn encoder(&self, interval: f64) -> Result<Encoder, Error> {
        Encoder::new(self.counts, self.latency, interval)
    }
}
