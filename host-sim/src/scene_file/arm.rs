//! The arm of a scene file: its tables put together, and what measurements leave to be deduced.

use serde::Deserialize;
use stillbeam::{Damping, Hub, Payload, Scene};

use super::File;
use super::deduced::Deduced;
use super::link::Stiffness;
use super::measured::{self, Unknown};
use super::mount;
use super::values::{Given, Modes};
use crate::arm::natural;
use crate::error::Error;

/// A `[hub]` table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct HubTable {
    radius: f64,
    pub(super) inertia: f64,
    pub(super) mass: Option<f64>,
    stiffness: Option<Given>,
}

/// A `[payload]` table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct PayloadTable {
    mass: f64,
    inertia: f64,
    offset: f64,
}

/// A `[gravity]` table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct GravityTable {
    pub(super) acceleration: f64,
    pub(super) tilt: f64,
    pub(super) direction: f64,
}

/// A `[carrier]` table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct CarrierTable {
    pub(super) rate: f64,
}

/// Builds the arm of a file, validated, and notes what was deduced.
pub(super) fn build(file: &File) -> Result<(Scene, Deduced), Error> {
    let unknown = unknown(file)?;
    let stiffness = match unknown {
        None | Some(Unknown::Joint) => Stiffness::Given,
        Some(Unknown::Link | Unknown::Both) => Stiffness::Deduced,
    };
    let built = file.link.build(stiffness)?;
    let joint = match file.hub.stiffness {
        Some(Given::Number(stiffness)) => Some(stiffness),
        Some(Given::Deduced) | None => None,
    };
    let mount = mount::build(file.axis.as_deref(), &file.gravity, &file.carrier)?;
    let mut arm = Scene {
        link: built.link,
        shape: built.shape,
        hub: Hub {
            radius: file.hub.radius,
            inertia: mount::hub_inertia(&file.hub, mount.axis)?,
            stiffness: joint,
        },
        payload: Payload {
            mass: file.payload.mass,
            inertia: file.payload.inertia,
            offset: file.payload.offset,
        },
        damping: Damping::default(),
        gravity: file.gravity.acceleration,
        mount,
    }
    .validate()?;
    let mut deduced = Deduced::default();
    if let (Some(unknown), Some(frequency)) = (unknown, &file.link.frequency) {
        let fit = measured::fit(&arm, &frequency.0, unknown)?;
        arm.link.bending_stiffness *= fit.stiffness;
        arm.hub.stiffness = fit.joint;
        deduced.fitted(&arm, &fit, unknown, frequency, built.is_material);
    }
    arm.damping = file.damping.build(&arm, &mut deduced)?;
    Ok((arm.validate()?, deduced))
}

/// Returns what the file's frequencies are to tell.
fn unknown(file: &File) -> Result<Option<Unknown>, Error> {
    let is_joint = file.hub.stiffness == Some(Given::Deduced);
    let Some(frequency) = &file.link.frequency else {
        if is_joint {
            return Err(Error::new(
                "hub.stiffness = \"deduced\": must be beside link.frequency, measured in Hz, or be a \
                 number in N m/rad",
            ));
        }
        return Ok(None);
    };
    check(frequency)?;
    Ok(Some(match (is_joint, frequency.0.len()) {
        (false, _) => Unknown::Link,
        (true, 1) => Unknown::Joint,
        (true, _) => Unknown::Both,
    }))
}

fn check(frequency: &Modes) -> Result<(), Error> {
    let list = &frequency.0;
    let ascending = list.windows(2).all(|pair| pair[0] < pair[1]);
    let in_range = list.iter().all(|value| (1e-3..=1e5).contains(value));
    if ascending && in_range && list.len() <= natural::MODES {
        return Ok(());
    }
    Err(Error::new(format_args!(
        "link.frequency = {}: must be 0.001 to 100000 Hz of the first mode, or of the first {} at most, \
         ascending",
        frequency.text(),
        natural::MODES
    )))
}
