//! A generator of whatever stepper.

use stillbeam::motion::{Limits, MoveSummary, Path, RowError, Spline, Waypoint};
use stillbeam::{Angle, Error, Generator, Move};

use crate::{AnySetpoint, Held, Scalar};

/// Segments that wait in a generator's queue: two of the longest moves.
pub const QUEUE: usize = 14;

/// A [`Generator`] of whatever stepper. Every function is the generator's own of that name.
#[allow(missing_docs)]
pub trait AnyGenerator: Send + Sync {
    /// # Errors
    /// Those of [`Generator::push`].
    fn push(&mut self, motion: &Move) -> Result<MoveSummary, Error>;
    /// # Errors
    /// Those of [`Generator::limit`].
    fn limit(&mut self, limits: Limits) -> Result<(), Error>;
    /// # Errors
    /// Those of [`Generator::path`].
    fn path(&self, spline: Spline) -> Result<Path, Error>;
    /// # Errors
    /// Those of [`Generator::feed`].
    fn feed(
        &mut self,
        path: &mut Path,
        rows: &mut dyn Iterator<Item = Waypoint>,
    ) -> Result<bool, RowError>;
    /// Goes to `angle` rad, to turn on from there at `rate` rad/s.
    ///
    /// # Errors
    /// Those of [`Generator::retarget`].
    fn retarget(&mut self, angle: f64, rate: f64, duration: f64) -> Result<u32, Error>;
    fn tick(&mut self) -> AnySetpoint;
    fn setpoint_before(&self) -> AnySetpoint;
    fn is_holding(&self) -> bool;
    fn is_asleep(&self) -> bool;
    /// Returns h, s.
    fn period(&self) -> f64;
    /// Returns the angle of the link's tangent at its tip against the hub after the latest tick,
    /// rad.
    fn tip_angle(&self) -> f64;
}

impl<S: Held> AnyGenerator for Generator<S, QUEUE> {
    fn push(&mut self, motion: &Move) -> Result<MoveSummary, Error> {
        Self::push(self, motion)
    }

    fn limit(&mut self, limits: Limits) -> Result<(), Error> {
        Self::limit(self, limits)
    }

    fn path(&self, spline: Spline) -> Result<Path, Error> {
        Self::path(self, spline)
    }

    fn feed(
        &mut self,
        path: &mut Path,
        mut rows: &mut dyn Iterator<Item = Waypoint>,
    ) -> Result<bool, RowError> {
        Self::feed(self, path, &mut rows)
    }

    fn retarget(&mut self, angle: f64, rate: f64, duration: f64) -> Result<u32, Error> {
        let rate = stillbeam::Scalar::from_f64(rate);
        Self::retarget(self, Angle::from_radians(angle).cast(), rate, duration)
    }

    fn tick(&mut self) -> AnySetpoint {
        Scalar::any(Self::tick(self))
    }

    fn setpoint_before(&self) -> AnySetpoint {
        Scalar::any(Self::setpoint_before(self))
    }

    fn is_holding(&self) -> bool {
        Self::is_holding(self)
    }

    fn is_asleep(&self) -> bool {
        Self::is_asleep(self)
    }

    fn period(&self) -> f64 {
        self.stepper().tick()
    }

    fn tip_angle(&self) -> f64 {
        stillbeam::Scalar::to_f64(self.stepper().tip_angle(self.state()))
    }
}
