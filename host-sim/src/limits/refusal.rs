//! A motion that exceeds a limit, in one line: the move, the limit, the need, and a remedy.

use std::fmt;

use stillbeam::Remedy;

use super::case::place;
use super::{Peak, Quantity};
use crate::error::Error;
use crate::table::significant;

/// Rounding error by which a limit may be exceeded, as in the core.
const ROUNDING: f64 = 1e-9;

/// The same of the jerk, which is found by difference quotients.
const ROUNDING_OF_JERK: f64 = 1e-7;

/// A limit that is exceeded during a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Quantity that is limited.
    pub quantity: Quantity,
    /// Magnitude that the move needs, and its time.
    pub peak: Peak,
    /// The limit.
    pub limit: f64,
    /// Index of the move in its scene.
    pub index: usize,
}

impl Excess {
    /// Returns the excess, or `None` if the peak keeps the limit.
    pub fn of(quantity: Quantity, peak: Peak, limit: f64, index: usize) -> Option<Self> {
        let rounding = if quantity == Quantity::Jerk { ROUNDING_OF_JERK } else { ROUNDING };
        let exceeds = peak.value > limit * (1.0 + rounding);
        exceeds.then_some(Self { quantity, peak, limit, index })
    }

    /// Returns the peak divided by the limit.
    pub fn ratio(&self) -> f64 {
        self.peak.value / self.limit
    }
}

/// Change to the move that would keep the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// Remedy that the core names.
    Remedy(Remedy),
    /// No duration of this move keeps the limit. Pulses of the shaper that come this late, s, still
    /// carry an earlier move.
    Pulses(f64),
    /// No duration up to this one, s, keeps the limit.
    None(f64),
    /// The move takes the shortest time within the limits of the hub's motion.
    Bounds,
    /// The method's own setpoints exceed the limit, which the arm itself keeps.
    Method,
}

/// A motion that is not accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refusal {
    /// Limit that is exceeded.
    pub excess: Excess,
    /// Number of moves in the scene.
    pub count: usize,
    /// Change that would keep the limit.
    pub way: Way,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Excess { quantity, peak, limit, index } = self.excess;
        let unit = quantity.unit();
        // A tick is what a turn a tick is held against.
        let given = if quantity == Quantity::Turn { 1.0 / limit } else { limit };
        write!(f, "{} = {}: ", quantity.parameter(), significant(given, 9))?;
        write!(f, "{}", place(index, self.count))?;
        if self.count > 1 {
            write!(f, " (move {} of {})", index + 1, self.count)?;
        }
        write!(
            f,
            " needs {} {unit} at {} s, must be at most ",
            number(peak.value),
            seconds(peak.at)
        )?;
        write!(f, "{} {unit}", significant(limit, 9))?;
        if quantity == Quantity::Turn {
            write!(f, ", one radian a tick")?;
        }
        match self.way {
            Way::Remedy(remedy) => write!(f, "; {remedy}"),
            Way::Pulses(delay) => write!(
                f,
                "; no duration of this move helps: the shaper\u{2019}s pulses still carry the move \
                 before; let that one settle for {} s at least, or make it longer",
                seconds(delay)
            ),
            Way::None(most) => write!(
                f,
                "; no duration of this move up to {} s helps; raise the limit",
                seconds(most)
            ),
            Way::Bounds => write!(
                f,
                "; this move takes the shortest time within the limits of rate, acceleration, \
                 deceleration and jerk: lower one of them, or use a profile with a duration"
            ),
            Way::Method => write!(
                f,
                "; that is the method\u{2019}s own torque, the arm itself keeps the limit; use another \
                 method, a longer move or a shorter tick"
            ),
        }
    }
}

impl From<Refusal> for Error {
    fn from(refusal: Refusal) -> Self {
        Self::new(refusal)
    }
}

/// Formats a need with as many decimals as tell it from a limit that is close by.
fn number(value: f64) -> String {
    match value {
        _ if value.is_infinite() => "an infinite value of".to_owned(),
        _ if value >= 0.01 => format!("{value:.6}"),
        _ => format!("{value:.6e}"),
    }
}

/// Rounds a time to a nanosecond, so that it can be typed back.
pub(super) fn seconds(time: f64) -> f64 {
    (time * 1e9).round() / 1e9 + 0.0
}
