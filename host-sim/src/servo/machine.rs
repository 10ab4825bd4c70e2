//! Machine files: motor, gear, friction, encoder, and the drive with its gains.

use std::path::Path;

use serde::Deserialize;
use stillbeam::drive::{cia402 as pdo, moteus as registers};
use stillbeam::motor::Ratio;

use super::{Between, Servo, Wire, cia402, moteus, odrive};
use crate::document::Document;
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
    /// CiA 402, and its rated torque (0x6076), N m.
    Cia402(cia402::Config, f64),
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
            "cia402" => Some(Self::Cia402(cia402::Config::default(), 2.0)),
            _ => None,
        }
    }

    /// Name of the drive.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Odrive(_) => "odrive",
            Self::Moteus(_) => "moteus",
            Self::Cia402(..) => "cia402",
        }
    }

    /// Returns the same drive with another way between setpoints, of offsets too.
    pub fn with_between(self, between: Between) -> Self {
        match self {
            Self::Odrive(config) => Self::Odrive(odrive::Config { between, ..config }),
            Self::Moteus(config) => Self::Moteus(moteus::Config { between, ..config }),
            Self::Cia402(config, rated) => {
                Self::Cia402(cia402::Config { between, offsets: between, ..config }, rated)
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
        let document = Document::parse(name, text)?;
        let file: File = document.read()?;
        file.build().map_err(|error| document.locate(&error))
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
            Protocol::Cia402(config, _) => Box::new(cia402::Csp::new(config, most, period)),
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
            Protocol::Cia402(_, rated) => Wire::Cia402(pdo::Drive::new(1, self.counts, rated)?),
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

/// Declares a table whose absent keys keep what a value has.
macro_rules! table {
    ($table:ident { $($key:ident: $kind:ty,)* }) => {
        #[derive(Default, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        struct $table { $($key: Option<$kind>,)* }
    };
}

table! { GearTable {
    ratio: [u16; 2], efficiency: f64, stiffness: f64, damping: f64, backlash: f64,
    output_inertia: f64,
} }
table! { FrictionTable {
    coulomb: f64, breakaway: f64, stribeck_rate: f64, viscous: f64, presliding: f64,
} }
table! { MotorTable {
    rotor_inertia: f64, torque: f64, torque_rate: f64, speed: f64, cogging: f64,
    cogging_periods: u32,
} }
table! { EncoderTable { counts: u32, latency: f64, } }
table! { OdriveTable {
    position_gain: f64, velocity_gain: f64, integrator_gain: f64, velocity_limit: f64,
    bandwidth: f64, rate: f64, between: Between, filter_bandwidth: f64, filter_inertia: f64,
} }
table! { MoteusTable {
    kp: f64, kd: f64, ki: f64, ilimit: f64, bandwidth: f64, rate: f64, between: Between,
} }
table! { Cia402Table {
    position_gain: f64, velocity_gain: f64, integrator_gain: f64, bandwidth: f64, rate: f64,
    divider: u32, between: Between, offsets: Between, rated_torque: f64,
} }

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    gear: GearTable,
    friction: FrictionTable,
    motor: MotorTable,
    encoder: EncoderTable,
    odrive: Option<OdriveTable>,
    moteus: Option<MoteusTable>,
    cia402: Option<Cia402Table>,
}

impl File {
    fn build(self) -> Result<Machine, Error> {
        let Self { gear, friction, motor, encoder, odrive, moteus, cia402 } = self;
        let default = Machine::default();
        let drives = [odrive.is_some(), moteus.is_some(), cia402.is_some()];
        if drives.iter().filter(|given| **given).count() > 1 {
            return Err(Error::new("odrive, moteus, cia402: must be one of the three tables"));
        }
        let drive = match (odrive, moteus, cia402) {
            (Some(table), ..) => table.build()?,
            (_, Some(table), _) => table.build()?,
            (.., Some(table)) => table.build()?,
            _ => default.drive,
        };
        let parts = Parts {
            gear: gear.build(),
            friction: friction.build(&default.parts.friction),
            motor: motor.build(&default.parts.motor),
        };
        let machine = Machine {
            parts: parts.validate()?,
            counts: encoder.counts.unwrap_or(default.counts),
            latency: encoder.latency.unwrap_or(default.latency),
            drive,
        };
        machine.encoder(1e-3)?;
        machine.wire()?;
        Ok(machine)
    }
}

impl GearTable {
    fn build(self) -> Gear {
        let default = Gear::default();
        let ratio = self.ratio.map(|[motor, link]| Ratio { motor, link });
        Gear {
            ratio: ratio.unwrap_or(default.ratio),
            efficiency: self.efficiency.unwrap_or(default.efficiency),
            stiffness: self.stiffness,
            damping: self.damping.unwrap_or(default.damping),
            backlash: self.backlash.unwrap_or(default.backlash),
            output_inertia: self.output_inertia.unwrap_or(default.output_inertia),
        }
    }
}

impl FrictionTable {
    fn build(self, default: &Friction) -> Friction {
        let coulomb = self.coulomb.unwrap_or(default.coulomb);
        let ratio = if self.coulomb.is_some() { 1.0 } else { default.breakaway / default.coulomb };
        Friction {
            coulomb,
            breakaway: self.breakaway.unwrap_or(ratio * coulomb),
            stribeck_rate: self.stribeck_rate.unwrap_or(default.stribeck_rate),
            viscous: self.viscous.unwrap_or(default.viscous),
            presliding: self.presliding.unwrap_or(default.presliding),
        }
    }
}

impl MotorTable {
    fn build(self, default: &Motor) -> Motor {
        let mut cogging = default.cogging;
        cogging.amplitude = self.cogging.unwrap_or(cogging.amplitude);
        cogging.periods = self.cogging_periods.unwrap_or(cogging.periods);
        Motor {
            rotor_inertia: self.rotor_inertia.unwrap_or(default.rotor_inertia),
            torque: self.torque.or(default.torque),
            torque_rate: self.torque_rate,
            speed: self.speed,
            cogging,
        }
    }
}

/// Refuses a setting that is given and not within `least` to `most`.
fn within(key: &str, value: Option<f64>, least: f64, most: f64) -> Result<(), Error> {
    match value {
        Some(value) if !(least..=most).contains(&value) => {
            Err(Error::new(format_args!("{key} = {value}: must be {least} to {most}")))
        }
        _ => Ok(()),
    }
}

/// Refuses settings of the loops that are out of range. `gains` are keys and values.
fn loops(
    drive: &str,
    gains: &[(&str, Option<f64>)],
    bandwidth: Option<f64>,
    rate: Option<f64>,
) -> Result<(), Error> {
    for (key, value) in gains {
        within(&format!("{drive}.{key}"), *value, 0.0, 1e6)?;
    }
    within(&format!("{drive}.bandwidth"), bandwidth, 1.0, 1e5)?;
    within(&format!("{drive}.rate"), rate, 100.0, 40_000.0)?;
    // A tracking loop needs some updates in its own time constant.
    let (bandwidth, rate) = (bandwidth.unwrap_or(1013.0), rate.unwrap_or(4000.0));
    if bandwidth > 0.9 * rate {
        return Err(Error::new(format_args!(
            "{drive}.bandwidth = {bandwidth}: must be below 0.9 times the rate of {rate} Hz"
        )));
    }
    Ok(())
}

impl OdriveTable {
    fn build(self) -> Result<Protocol, Error> {
        let gains = [
            ("position_gain", self.position_gain),
            ("velocity_gain", self.velocity_gain),
            ("integrator_gain", self.integrator_gain),
            ("velocity_limit", self.velocity_limit),
            ("filter_inertia", self.filter_inertia),
        ];
        let default = odrive::Config::default();
        loops("odrive", &gains, self.bandwidth, self.rate.or(Some(default.rate)))?;
        within("odrive.filter_bandwidth", self.filter_bandwidth, 0.1, 1000.0)?;
        let inertia = self.filter_inertia.unwrap_or(0.0);
        Ok(Protocol::Odrive(odrive::Config {
            position_gain: self.position_gain.unwrap_or(default.position_gain),
            velocity_gain: self.velocity_gain.unwrap_or(default.velocity_gain),
            integrator_gain: self.integrator_gain.unwrap_or(default.integrator_gain),
            velocity_limit: self.velocity_limit.unwrap_or(default.velocity_limit),
            bandwidth: self.bandwidth.unwrap_or(default.bandwidth),
            rate: self.rate.unwrap_or(default.rate),
            between: self.between.unwrap_or(default.between),
            filter: self.filter_bandwidth.map(|bandwidth| odrive::Filter { bandwidth, inertia }),
        }))
    }
}

impl MoteusTable {
    fn build(self) -> Result<Protocol, Error> {
        let gains = [("kp", self.kp), ("kd", self.kd), ("ki", self.ki), ("ilimit", self.ilimit)];
        let default = moteus::Config::default();
        loops("moteus", &gains, self.bandwidth, self.rate.or(Some(default.rate)))?;
        Ok(Protocol::Moteus(moteus::Config {
            kp: self.kp.unwrap_or(default.kp),
            kd: self.kd.unwrap_or(default.kd),
            ki: self.ki.unwrap_or(default.ki),
            ilimit: self.ilimit.unwrap_or(default.ilimit),
            bandwidth: self.bandwidth.unwrap_or(default.bandwidth),
            rate: self.rate.unwrap_or(default.rate),
            between: self.between.unwrap_or(default.between),
        }))
    }
}

impl Cia402Table {
    fn build(self) -> Result<Protocol, Error> {
        let gains = [
            ("position_gain", self.position_gain),
            ("velocity_gain", self.velocity_gain),
            ("integrator_gain", self.integrator_gain),
        ];
        let default = cia402::Config::default();
        loops("cia402", &gains, self.bandwidth, self.rate.or(Some(default.rate)))?;
        within("cia402.divider", self.divider.map(f64::from), 1.0, 100.0)?;
        let config = cia402::Config {
            position_gain: self.position_gain.unwrap_or(default.position_gain),
            velocity_gain: self.velocity_gain.unwrap_or(default.velocity_gain),
            integrator_gain: self.integrator_gain.unwrap_or(default.integrator_gain),
            bandwidth: self.bandwidth.unwrap_or(default.bandwidth),
            rate: self.rate.unwrap_or(default.rate),
            divider: self.divider.unwrap_or(default.divider),
            between: self.between.unwrap_or(default.between),
            offsets: self.offsets.unwrap_or(default.offsets),
        };
        Ok(Protocol::Cia402(config, self.rated_torque.unwrap_or(2.0)))
    }
}
