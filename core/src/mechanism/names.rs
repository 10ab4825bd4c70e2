//! Names of fields in lists, as errors tell them.

/// The names `list[0].field`, `list[1].field`, … of a field of every link or joint.
macro_rules! indexed {
    ($list:literal, $field:literal) => {
        [
            concat!($list, "[0].", $field),
            concat!($list, "[1].", $field),
            concat!($list, "[2].", $field),
            concat!($list, "[3].", $field),
            concat!($list, "[4].", $field),
            concat!($list, "[5].", $field),
            concat!($list, "[6].", $field),
            concat!($list, "[7].", $field),
        ]
    };
}

pub(super) use indexed;

use crate::Error;

/// Fields of a joint's limits, as an error of one joint and of a list of joints names them.
const LIMITS: [(&str, [&str; 8]); 6] = [
    ("limits.rate", indexed!("joints", "limits.rate")),
    ("limits.acceleration", indexed!("joints", "limits.acceleration")),
    ("limits.deceleration", indexed!("joints", "limits.deceleration")),
    ("limits.jerk", indexed!("joints", "limits.jerk")),
    ("limits.torque", indexed!("joints", "limits.torque")),
    ("limits.moment", indexed!("joints", "limits.moment")),
];

/// The error with the place of the joint, counted from 0, before a field of its limits.
pub(crate) fn of_joint(mut error: Error, joint: usize) -> Error {
    if let Error::OutOfRange { parameter, .. }
    | Error::LimitExceeded { parameter, .. }
    | Error::CannotCheck { parameter, .. } = &mut error
        && let Some((_, places)) = LIMITS.iter().find(|(field, _)| field == parameter)
        && let Some(place) = places.get(joint)
    {
        *parameter = place;
    }
    error
}
