//! How a mechanism is stepped: the `[solver]` table of its scene file, and the same on the command
//! line.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::solver::Scalar;

/// The keys. What is absent is left to the next in line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MechanismKeys {
    /// Setpoint interval, s.
    pub tick: Option<f64>,
    /// Precision of the tick.
    pub scalar: Option<Scalar>,
    /// Curvature coordinates a flexible link: 2 or 3.
    pub coordinates: Option<i64>,
}

/// A solver with every key resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MechanismSolver {
    /// h, s.
    pub tick: f64,
    /// Precision of the tick.
    pub scalar: Scalar,
    /// Curvature coordinates a flexible link: 2 or 3.
    pub coordinates: usize,
}

impl MechanismKeys {
    /// Returns these keys, with `other`'s in place of absent ones.
    pub fn or(self, other: Self) -> Self {
        Self {
            tick: self.tick.or(other.tick),
            scalar: self.scalar.or(other.scalar),
            coordinates: self.coordinates.or(other.coordinates),
        }
    }

    /// Returns the solver, with absent keys at their defaults: 10 ms, f32, two coordinates.
    pub fn resolve(self) -> Result<MechanismSolver, Error> {
        let tick = self.tick.unwrap_or(0.01);
        if !(1e-6..=1.0).contains(&tick) {
            return Err(Error::new(format_args!("solver.tick = {tick}: must be 0.000001 to 1 s")));
        }
        let given = self.coordinates.unwrap_or(2);
        let coordinates = usize::try_from(given).ok().filter(|n| (2..=3).contains(n));
        let coordinates = coordinates.ok_or_else(|| {
            Error::new(format_args!(
                "solver.coordinates = {given}: must be 2 or 3 curvatures a flexible link"
            ))
        })?;
        Ok(MechanismSolver { tick, scalar: self.scalar.unwrap_or(Scalar::F32), coordinates })
    }
}

impl MechanismSolver {
    /// Describes the solver in a few words, e.g. `2 curvatures a link, 10 ms, f32`.
    pub fn describe(&self) -> String {
        let Self { tick, scalar, coordinates } = self;
        format!("{coordinates} curvatures a link, {} ms, {}", tick * 1e3, scalar.name())
    }
}
