//! Rows of a path, and the error that names one.

use core::fmt;

use crate::Error;

/// A row of a path: where the hub is at a time, and how it turns there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Waypoint {
    /// t, s from the path's beginning; in whole ticks or not.
    pub time: f64,
    /// θ, rad, counted from the same zero as the hub's.
    pub angle: f64,
    /// θ̇, rad/s. Where none is given the spline has the one that keeps θ̈ continuous, and a path's
    /// last row is at rest.
    pub rate: Option<f64>,
    /// θ̈, rad/s², of a quintic spline only. Where none is given it is that of the cubic spline
    /// through the rows, the mean of both sides, and 0 at a path's end.
    pub acceleration: Option<f64>,
}

impl Waypoint {
    /// The hub at `angle` rad at `time` s; the spline chooses its rate.
    pub const fn at(time: f64, angle: f64) -> Self {
        Self { time, angle, rate: None, acceleration: None }
    }

    /// Returns the waypoint with a rate, rad/s.
    #[must_use]
    pub const fn turning(self, rate: f64) -> Self {
        Self { rate: Some(rate), ..self }
    }

    /// Returns the waypoint `time` s later and `angle` rad further on: rows that are repeated, as
    /// in a cycle.
    #[must_use]
    pub fn shifted(self, time: f64, angle: f64) -> Self {
        Self { time: self.time + time, angle: self.angle + angle, ..self }
    }

    /// Returns the waypoint with an acceleration, rad/s².
    #[must_use]
    pub const fn accelerating(self, acceleration: f64) -> Self {
        Self { acceleration: Some(acceleration), ..self }
    }
}

/// Polynomials between the rows of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Spline {
    /// Cubics. θ̈ is a straight line between two rows. It is continuous at rows without a rate, and
    /// jumps at rows with one and at the path's ends. Its ticks are the cheapest.
    Cubic,
    /// Quintics. θ̈ is continuous everywhere: it begins with the hub's and ends with 0, or with
    /// that of the last row.
    Quintic,
}

impl Spline {
    /// Both splines.
    pub const ALL: [Self; 2] = [Self::Cubic, Self::Quintic];

    /// Returns the name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
        }
    }

    /// Returns the spline of that name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|spline| spline.name() == name)
    }
}

impl fmt::Display for Spline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// The reason why a row of a path is refused. Rows before it are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RowError {
    /// Number of the row, from 0.
    pub row: u32,
    /// The fault of the row, or of the way to it from the row before.
    pub error: Error,
}

impl fmt::Display for RowError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "waypoints[{}]: {}", self.row, self.error)
    }
}

impl core::error::Error for RowError {}
