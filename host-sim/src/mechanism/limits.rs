//! Limits of a mechanism's drives, a set a joint: from its file, or from the command line.

use serde::Deserialize;
use stillbeam::Limits;

use crate::error::Error;

/// A `[joints.limits]` table.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct LimitsTable {
    rate: Option<f64>,
    acceleration: Option<f64>,
    deceleration: Option<f64>,
    jerk: Option<f64>,
    torque: Option<f64>,
}

impl LimitsTable {
    /// Builds the limits of the joint of that index. Refuses a value that is no limit, and any
    /// limit of a joint without a drive.
    pub(super) fn build(self, joint: usize, passive: bool) -> Result<Limits, Error> {
        let Self { rate, acceleration, deceleration, jerk, torque } = self;
        let limits = Limits { rate, acceleration, deceleration, jerk, torque, moment: None };
        if passive && limits != Limits::default() {
            return Err(Error::new(format_args!(
                "joints[{joint}].limits: must be absent of a passive joint, which has no drive"
            )));
        }
        limits.validate().map_err(|error| of_joint(joint, error))
    }
}

/// Puts the joint's place before an error that begins with `limits.`.
pub(super) fn of_joint(joint: usize, error: stillbeam::Error) -> Error {
    Error::new(format_args!("joints[{joint}].{error}"))
}

/// Sets one kind of limit as it was typed: one value for all joints, or one a joint.
///
/// # Errors
/// Another number of values.
pub fn type_in(
    limits: &mut [Limits],
    option: &str,
    values: Option<&[f64]>,
    set: fn(&mut Limits, f64),
) -> Result<(), Error> {
    let Some(values) = values else { return Ok(()) };
    if values.len() != 1 && values.len() != limits.len() {
        return Err(Error::new(format_args!(
            "{option} = {values:?}: must be one value for all joints, or {}, one a joint",
            limits.len()
        )));
    }
    for (limits, value) in limits.iter_mut().zip(values.iter().cycle()) {
        set(limits, *value);
    }
    Ok(())
}
