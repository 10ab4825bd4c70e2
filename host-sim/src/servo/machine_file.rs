//! Machine files: the tables of a machine, whose absent keys keep their defaults.

use serde::Deserialize;
use stillbeam::motor::Ratio;

use super::tracker::MOST_BANDWIDTH;
use super::{Machine, Protocol, cia402, moteus, odrive};
use crate::document::Document;
use crate::error::Error;
use crate::plant::{Friction, Gear, Motor, Parts};

/// Parses the text of a machine file. Errors begin with `name`, and have line, column and key.
pub(super) fn parse(name: &str, text: &str) -> Result<Machine, Error> {
    let document = Document::parse(name, text)?;
    let file: File = document.read()?;
    file.build().map_err(|error| document.locate(&error))
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

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct File {
    gear: GearTable,
    friction: FrictionTable,
    motor: MotorTable,
    encoder: EncoderTable,
    odrive: Option<odrive::Config>,
    moteus: Option<moteus::Config>,
    cia402: Option<cia402::Config>,
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
            (Some(config), ..) => Protocol::Odrive(config),
            (_, Some(config), _) => Protocol::Moteus(config),
            (.., Some(config)) => Protocol::Cia402(config),
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
            drive: drive.validate()?,
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

impl Protocol {
    fn validate(self) -> Result<Self, Error> {
        match self {
            Self::Odrive(odrive::Config { bandwidth, rate, .. })
            | Self::Moteus(moteus::Config { bandwidth, rate, .. })
            | Self::Cia402(cia402::Config { bandwidth, rate, .. }) => {
                self.validate_gains()?;
                validate_tracker(self.name(), bandwidth, rate)?;
            }
        }
        match self {
            Self::Odrive(config) => {
                let filter = config.filter_bandwidth.unwrap_or(1.0);
                within("odrive.filter_bandwidth", filter, 0.1, 1000.0)?;
            }
            Self::Moteus(_) => {}
            Self::Cia402(config) => {
                within("cia402.divider", f64::from(config.divider), 1.0, 100.0)?;
            }
        }
        Ok(self)
    }

    fn validate_gains(&self) -> Result<(), Error> {
        let gains = match self {
            Self::Odrive(config) => vec![
                ("position_gain", config.position_gain),
                ("velocity_gain", config.velocity_gain),
                ("integrator_gain", config.integrator_gain),
                ("velocity_limit", config.velocity_limit),
                ("filter_inertia", config.filter_inertia),
            ],
            Self::Moteus(config) => vec![
                ("kp", config.kp),
                ("kd", config.kd),
                ("ki", config.ki),
                ("ilimit", config.ilimit),
            ],
            Self::Cia402(config) => vec![
                ("position_gain", config.position_gain),
                ("velocity_gain", config.velocity_gain),
                ("integrator_gain", config.integrator_gain),
            ],
        };
        let drive = self.name();
        gains
            .into_iter()
            .try_for_each(|(key, value)| within(&format!("{drive}.{key}"), value, 0.0, 1e6))
    }
}

/// Refuses settings of the estimate of the velocity that it cannot follow.
fn validate_tracker(drive: &str, bandwidth: f64, rate: f64) -> Result<(), Error> {
    within(&format!("{drive}.bandwidth"), bandwidth, 1.0, 1e5)?;
    within(&format!("{drive}.rate"), rate, 100.0, 40_000.0)?;
    // A tracking loop needs some updates in its own time constant; from 0.828 on it swings up.
    if bandwidth > MOST_BANDWIDTH * rate {
        return Err(Error::new(format_args!(
            "{drive}.bandwidth = {bandwidth}: must be below {MOST_BANDWIDTH} times the rate of {rate} Hz"
        )));
    }
    Ok(())
}

/// Refuses a value that is not within `least` to `most`.
fn within(key: &str, value: f64, least: f64, most: f64) -> Result<(), Error> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Error::new(format_args!("{key} = {value}: must be {least} to {most}")))
}
