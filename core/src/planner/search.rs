//! Plans a move of a given end and duration within its limits.

use super::prediction::limits_loads;
use super::problem::{Problem, RINGS, Scope};
use super::{Kinematics, Objective, Path, Planner, Request, StillMove};
use crate::Error;
use crate::math::Scalar;
use crate::motion::{Move, admit};

/// A search for the second mode is a gain if the residual falls to this fraction at most, and the
/// acceleration grows by this factor at most.
const GAIN: f64 = 0.85;
const PRICE: f64 = 1.5;

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// The path of a request, to `to` rad in `ticks` ticks.
    pub(super) fn path(&self, request: &Request<T, K>, to: f64, ticks: u32) -> Result<Path, Error> {
        let to = Error::check("move.to", to, -1e6, 1e6, "rad")?;
        let ticks = Move::Dwell { duration: f64::from(ticks) * self.tick }.ticks(self.tick)?;
        let most = if self.scene.gravity == 0.0 { 1e6 } else { 0.0 };
        let rate = Error::check("request.rate", request.rate, 0.0 - most, most, "rad/s")?;
        Ok(Path { from: request.from, to, rate, ticks, tick: self.tick })
    }

    /// Plans the path with both modes brought to rest, or if that exceeds a limit, the first only.
    pub(super) fn within(&self, request: &Request<T, K>, path: &Path) -> Result<StillMove, Error> {
        match self.attempt(request, path, request.objective, Scope::Second) {
            // Another error comes from the first mode already.
            Err(
                Error::LimitExceeded { .. } | Error::TooFast { .. } | Error::DeflectsTooFar { .. },
            ) => self.within_first(request, path),
            found => found,
        }
    }

    /// Plans the path with the first mode brought to rest. If that exceeds a limit of the hub's
    /// motion, the same duration may do with another objective.
    pub(super) fn within_first(
        &self,
        request: &Request<T, K>,
        path: &Path,
    ) -> Result<StillMove, Error> {
        let attempt = |objective| self.attempt(request, path, objective, Scope::First);
        attempt(request.objective).or_else(|error| match error {
            Error::LimitExceeded { parameter: "limits.rate", .. } | Error::TooFast { .. } => {
                attempt(Objective::Rate)
            }
            Error::LimitExceeded { parameter: "limits.jerk", .. } => attempt(Objective::Jerk),
            _ => Err(error),
        })
    }

    /// Plans the path and refuses it if it exceeds a limit.
    pub(super) fn attempt(
        &self,
        request: &Request<T, K>,
        path: &Path,
        objective: Objective,
        scope: Scope,
    ) -> Result<StillMove, Error> {
        let plan = self.search(request, path, objective, scope)?;
        let limits = &request.limits;
        admit(limits, &plan.peaks, self.tick)?;
        let loads = limits_loads(limits);
        if loads || request.deflection.is_some() {
            let arm = request.arm.as_ref();
            let prediction = if loads { self.predict(&plan, arm) } else { self.glance(&plan, arm) };
            prediction.admit_loads(limits)?;
            if let Some(most) = request.deflection {
                prediction.admit_deflection(most * self.scene.link.length)?;
            }
        }
        Ok(plan)
    }

    /// Searches for the move along a path, whatever it exceeds.
    fn search(
        &self,
        request: &Request<T, K>,
        path: &Path,
        objective: Objective,
        scope: Scope,
    ) -> Result<StillMove, Error> {
        let solve = |objective, scope| Problem::new(self, request, path, objective, scope)?.solve();
        if request.kinematics == Kinematics::Linear {
            return solve(objective, Scope::Linear);
        }
        let plan = match solve(objective, Scope::First) {
            // Three arms that are nearly one, or a short time, ask for too much.
            Err(Error::NotStill { .. }) if self.robust => solve(objective, Scope::Outer),
            found => found,
        }?;
        let first_only = objective != Objective::Acceleration || self.robust;
        if scope != Scope::Second || first_only || plan.residual < RINGS {
            return Ok(plan);
        }
        let mut simulations = plan.simulations;
        for objective in [Objective::Smooth, objective] {
            let Ok(other) = solve(objective, Scope::Second) else { continue };
            simulations += other.simulations;
            if other.residual < GAIN * plan.residual
                && other.peaks.acceleration < PRICE * plan.peaks.acceleration
            {
                return Ok(StillMove { simulations, ..other });
            }
        }
        Ok(StillMove { simulations, ..plan })
    }
}
