//! The angle profile of the paper: residual vibration of each profile over the duration of the
//! move.

use std::f64::consts::PI;

use stillbeam::Profile;

use super::{Run, reshaped};
use crate::dispatch::first_period;
use crate::error::Error;
use crate::solver::{Mass, Scalar, Solver, SolverKeys};

/// Residual vibration of member B with 30 g, undamped, after π by each profile.
#[derive(Clone, Debug)]
pub struct Profiles {
    /// The solver of all runs.
    pub solver: Solver,
    /// The paper's move in first periods: 2 s over member B's.
    pub paper: f64,
    /// Curves, one for each profile.
    pub curves: Vec<Curve>,
    /// Durations, in periods, after which a cubic leaves a linear oscillator at rest: the roots of
    /// `tan x = x` over π.
    pub cubic_zeros: [f64; 3],
}

/// One profile.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The profile.
    pub profile: Profile,
    /// Points (duration in first periods, residual as a fraction of L).
    pub points: Vec<(f64, f64)>,
    /// Residual after the paper's 2 s, fraction of L.
    pub at_paper: f64,
}

/// The paper's duration, and the range of the curves, in ticks of 10 ms.
const PAPER: u32 = 200;
const RANGE: std::ops::RangeInclusive<u32> = 100..=330;

impl Profiles {
    /// Runs every profile by the default solver in f64.
    pub fn compute() -> Result<Self, Error> {
        let keys = SolverKeys { scalar: Some(Scalar::F64), ..SolverKeys::default() };
        let scene = super::scene("b-tip30", keys)?;
        let solver = scene.solver.resolve()?;
        let tick = solver.tick;
        let period = first_period(&scene.arm, 8, Mass::Consistent)?;
        let residual = |profile, ticks: u32| {
            Run::of(reshaped(&scene, profile, f64::from(ticks) * tick))?.residual()
        };
        let curve = |profile| -> Result<Curve, Error> {
            let point = |ticks: u32| -> Result<(f64, f64), Error> {
                Ok((f64::from(ticks) * tick / period, residual(profile, ticks)?))
            };
            let points = RANGE.step_by(2).map(point).collect::<Result<_, _>>()?;
            Ok(Curve { profile, points, at_paper: residual(profile, PAPER)? })
        };
        Ok(Self {
            solver,
            paper: f64::from(PAPER) * tick / period,
            curves: Profile::ALL.into_iter().map(curve).collect::<Result<_, _>>()?,
            cubic_zeros: [1, 2, 3].map(|k| tangent_root(k) / PI),
        })
    }
}

impl Profiles {
    /// Returns the least residual of the other profiles after the paper's 2 s over the cubic's.
    pub fn margin(&self) -> f64 {
        let least = |cubic: bool| {
            let curves = self.curves.iter().filter(|c| (c.profile == Profile::Cubic) == cubic);
            curves.map(|curve| curve.at_paper).fold(f64::INFINITY, f64::min)
        };
        least(false) / least(true)
    }
}

/// Returns the root of `tan x = x` in `kπ..(k + ½)π`. It iterates from `x = kπ + atan x`, which
/// contracts.
fn tangent_root(k: u32) -> f64 {
    let base = f64::from(k) * PI;
    (0..40).fold(base, |x, _| base + x.atan())
}

#[cfg(test)]
mod tests {
    #[test]
    fn cubic_zeros() {
        for (k, expected) in [(1, 1.430), (2, 2.459), (3, 3.471)] {
            let ratio = super::tangent_root(k) / std::f64::consts::PI;
            assert!((ratio - expected).abs() < 6e-4, "{k}: {ratio}");
        }
    }
}
