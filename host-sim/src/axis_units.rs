//! Units and names of an axis: radians and torque where the hub turns, metres and force where it is
//! a carriage.

use std::borrow::Cow;

use stillbeam::AxisKind;

/// Names and units of the motion of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisUnits {
    /// Name of the position.
    pub name: &'static str,
    /// Unit of the position.
    pub position: &'static str,
    /// Units of its derivatives.
    pub rate: &'static str,
    /// Unit of the acceleration.
    pub acceleration: &'static str,
    /// Unit of the jerk.
    pub jerk: &'static str,
    /// Name of what drives the axis.
    pub effort: &'static str,
    /// Unit of it.
    pub effort_unit: &'static str,
}

/// The units of an axis.
pub const fn of(axis: AxisKind) -> AxisUnits {
    match axis {
        AxisKind::Rotary => AxisUnits {
            name: "angle",
            position: "rad",
            rate: "rad/s",
            acceleration: "rad/s\u{b2}",
            jerk: "rad/s\u{b3}",
            effort: "torque",
            effort_unit: "N m",
        },
        AxisKind::Linear => AxisUnits {
            name: "position",
            position: "m",
            rate: "m/s",
            acceleration: "m/s\u{b2}",
            jerk: "m/s\u{b3}",
            effort: "force",
            effort_unit: "N",
        },
    }
}

/// Returns a refusal in the units of its axis.
///
/// The core plans every motion alike, and so do the checks of limits: their refusals speak of
/// radians and of torque. On a linear axis the numbers are those of metres and of force. What stays
/// an angle or a moment there keeps its unit: the link's bend, the clamp moment, gravity's
/// direction.
pub fn worded(axis: AxisKind, text: &str) -> Cow<'_, str> {
    if axis == AxisKind::Rotary || text.contains("gravity.") || text.contains("against the hub") {
        return Cow::Borrowed(text);
    }
    let mut text = text
        .replace("rad/s", "m/s")
        .replace("one radian a tick", "one metre a tick")
        .replace("the hub turns", "the carriage moves")
        .replace("a number in rad ", "a number in m ")
        .replace(" rad:", " m:")
        .replace(" rad,", " m,");
    if let Some(start) = text.strip_suffix(" rad") {
        text = format!("{start} m");
    }
    if !text.contains("limits.moment") {
        text = text.replace("N m,", "N,").replace("N m;", "N;").replace("N m at", "N at");
        if let Some(start) = text.strip_suffix("N m") {
            text = format!("{start}N");
        }
    }
    Cow::Owned(text)
}

#[cfg(test)]
mod tests {
    use stillbeam::AxisKind::{Linear, Rotary};

    use super::worded;

    #[test]
    fn a_refusal_of_a_carriage_speaks_of_metres_and_newtons() {
        for (rotary, linear) in [
            (
                "limits.rate: the move needs 7.500000 rad/s, must be at most 4 rad/s; use a longer \
                 move or raise the limit",
                "limits.rate: the move needs 7.500000 m/s, must be at most 4 m/s; use a longer move \
                 or raise the limit",
            ),
            (
                "limits.torque = 2: move needs 3.1 N m at 0.2 s, must be at most 2 N m; use a longer \
                 move",
                "limits.torque = 2: move needs 3.1 N at 0.2 s, must be at most 2 N; use a longer move",
            ),
            (
                "move.to = 1e9: must be -1000000 to 1000000 rad",
                "move.to = 1e9: must be -1000000 to 1000000 m",
            ),
            ("limits.torque = 0: must be 0.1 to 9 N m", "limits.torque = 0: must be 0.1 to 9 N"),
        ] {
            assert_eq!(worded(Linear, rotary), linear);
            assert_eq!(worded(Rotary, rotary), rotary);
        }
    }

    /// The bend of a link is an angle and its clamp moment a moment on every axis.
    #[test]
    fn angles_and_moments_of_the_link_keep_their_units() {
        for text in [
            "move.duration: the tip is expected to turn 2.500 rad against the hub, must be at most \
             2.000 rad; use a longer move",
            "limits.moment = 2: move needs 3.1 N m at 0.2 s, must be at most 2 N m; use a longer move",
            "gravity.tilt = 3: must be 0 to 1.5707963267948966 rad",
        ] {
            assert_eq!(worded(Linear, text), text);
        }
    }
}
