//! The keys of how an arm is mounted: `axis`, `hub.mass`, `gravity.tilt`, `gravity.direction`,
//! `carrier.rate`.

use stillbeam::{AxisKind, Mount};

use super::arm::{CarrierTable, GravityTable, HubTable};
use crate::error::Error;

/// Builds the mount. `axis` is the file's key, `rotary` without one.
pub(super) fn build(
    axis: Option<&str>,
    gravity: &GravityTable,
    carrier: &CarrierTable,
) -> Result<Mount, Error> {
    let axis = match axis {
        None | Some("rotary") => AxisKind::Rotary,
        Some("linear") => AxisKind::Linear,
        Some(other) => {
            return Err(Error::new(format_args!("axis = \"{other}\": must be rotary or linear")));
        }
    };
    for (key, value) in [("tilt", gravity.tilt), ("direction", gravity.direction)] {
        if value != 0.0 && gravity.acceleration == 0.0 {
            return Err(Error::new(format_args!(
                "gravity.{key} = {value}: given without gravity.acceleration; that must be given \
                 too, in m/s^2"
            )));
        }
    }
    if axis == AxisKind::Linear && carrier.rate != 0.0 {
        return Err(Error::new(format_args!(
            "carrier.rate = {}: must be absent with axis = \"linear\"",
            carrier.rate
        )));
    }
    Ok(Mount { axis, tilt: gravity.tilt, direction: gravity.direction, carrier: carrier.rate })
}

/// Returns what the hub itself resists a motion of its axis with: `hub.inertia` of one that turns,
/// `hub.mass` of a carriage.
pub(super) fn hub_inertia(hub: &HubTable, axis: AxisKind) -> Result<f64, Error> {
    match (axis, hub.mass) {
        (AxisKind::Rotary, None) => Ok(hub.inertia),
        (AxisKind::Rotary, Some(mass)) => Err(Error::new(format_args!(
            "hub.mass = {mass}: must be absent with axis = \"rotary\"; use hub.inertia, in kg m^2"
        ))),
        (AxisKind::Linear, _) if hub.inertia != 0.0 => Err(Error::new(format_args!(
            "hub.inertia = {}: must be absent with axis = \"linear\"; use hub.mass, in kg",
            hub.inertia
        ))),
        (AxisKind::Linear, mass) => Ok(mass.unwrap_or(0.0)),
    }
}
