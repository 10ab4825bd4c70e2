//! Axes for the unit tests.

use stillbeam::Setpoint;
use stillbeam_protocol::Command;

use crate::Configuration;
use crate::axes::{Joint, stepper};

/// Builds an axis whose drive has not reported.
pub(crate) fn disabled(configuration: &Configuration) -> Joint {
    let stepper = stepper(&configuration.scene).expect("the delivered arm");
    Joint::new(configuration, stepper).expect("the delivered axis")
}

/// Builds an axis that is enabled at hub angle 0.
pub(crate) fn enabled(configuration: &Configuration) -> Joint {
    let mut joint = disabled(configuration);
    joint.measured = Some(joint.train.mapping().zero());
    joint.carry_out(&Command::Enable).expect("it is measured");
    joint
}

/// Makes a tick with the host there and returns its setpoint.
pub(crate) fn tick(joint: &mut Joint) -> Setpoint<f32> {
    joint.axis.heard();
    joint.axis.tick().setpoint
}
