//! The unit of the angles of moves and limits.

use std::f64::consts::TAU;

use serde::Deserialize;

use super::LimitsTable;
use super::moves::MoveTable;
use crate::error::Error;

/// Unit in which a scene file's angles are, in its moves and limits. Rates are in that unit per
/// second, accelerations and jerks alike.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum AngleUnit {
    /// Radians.
    #[default]
    Rad,
    /// Degrees.
    Deg,
    /// Turns.
    Turn,
}

impl AngleUnit {
    /// Returns an angle of this unit in rad.
    fn radians(self, angle: f64) -> f64 {
        match self {
            Self::Rad => angle,
            Self::Deg => angle.to_radians(),
            Self::Turn => angle * TAU,
        }
    }

    /// Returns the name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rad => "rad",
            Self::Deg => "deg",
            Self::Turn => "turn",
        }
    }

    /// Adds to the error of a move that its angles are in rad, if the file's are not.
    pub fn remarked(self, error: Error) -> Error {
        match self {
            Self::Rad => error,
            _ => Error::new(format_args!(
                "{error}; angles are in rad in this line, in {} in the file",
                self.name()
            )),
        }
    }

    /// Converts the angles of a move to rad.
    pub fn convert_move(self, table: &mut MoveTable) {
        let angles = [&mut table.from, &mut table.to, &mut table.rate];
        let rows = table.waypoints.iter_mut().flatten();
        let of_rows = rows.flat_map(|row| row.iter_mut().skip(1));
        for angle in angles.into_iter().filter_map(Option::as_mut).chain(of_rows) {
            *angle = self.radians(*angle);
        }
    }

    /// Converts the angles of the limits to rad.
    pub fn convert_limits(self, table: &mut LimitsTable) {
        let LimitsTable { rate, acceleration, deceleration, jerk, .. } = table;
        for limit in [rate, acceleration, deceleration, jerk].into_iter().flatten() {
            *limit = self.radians(*limit);
        }
    }
}
