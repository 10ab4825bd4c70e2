//! Limits of torque and clamp moment: kept by simulation, explained by the arm's weight.

use core::f64::consts::TAU;

use super::{Planner, Request, Target};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, Remedy};

/// Number of angles on the way at which the arm's weight is evaluated.
const LOOKS: u32 = 32;

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Makes every plan keep a limit of torque (N m, at the hub) and of bending moment (N m, at the
    /// clamp). They stand with the planner because a generator cannot check them: see [`Limits`].
    /// Of two limits, the planner's and the request's, the smaller holds.
    ///
    /// [`Prediction`](super::Prediction) gives their error.
    pub fn with_load_limits(self, torque: Option<f64>, moment: Option<f64>) -> Result<Self, Error> {
        let loads = Limits { torque, moment, ..Limits::default() }.validate()?;
        Ok(Self { loads, ..self })
    }

    /// Validates the limits and adds the planner's own.
    pub(super) fn with_own(&self, limits: &Limits) -> Result<Limits, Error> {
        let smaller = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        let limits = limits.validate()?;
        Ok(Limits {
            torque: smaller(limits.torque, self.loads.torque),
            moment: smaller(limits.moment, self.loads.moment),
            ..limits
        })
    }

    /// Says what would keep a limit for which [`Self::plan`] has refused `request` with `error`:
    /// the weight, if holding the arm somewhere on the way exceeds it, so that no duration helps;
    /// else the shortest duration that is accepted, which takes a search for it; else a longer
    /// move.
    #[must_use]
    pub fn remedy(&self, error: &Error, request: &Request<T, K>) -> Remedy {
        if let Error::LimitExceeded { parameter, limit, .. } = *error
            && let Target::Angle(to) = request.target
            && let Some(weight) = self.weight_beyond(parameter, limit, &request.from, to)
        {
            return weight;
        }
        match self.plan(&Request { duration: None, ..*request }) {
            Ok(plan) => Remedy::Duration(plan.duration()),
            Err(_) => Remedy::Longer,
        }
    }

    /// Returns [`Remedy::Weight`] if holding the arm on the way to `to` rad exceeds a load's limit.
    fn weight_beyond(
        &self,
        parameter: &str,
        limit: f64,
        from: &HubState<f64>,
        to: f64,
    ) -> Option<Remedy> {
        if self.scene.in_plane_gravity() == 0.0
            || !matches!(parameter, "limits.torque" | "limits.moment")
        {
            return None;
        }
        let arm = &self.coarse.arms[0];
        let turn = to / TAU - from.angle.in_turns();
        let held = (0..=LOOKS).fold(0.0, |most: f64, look| {
            let angle = from.angle.plus(turn * f64::from(look) / f64::from(LOOKS));
            let mut hub = HubState { angle: Angle::cast::<T>(angle), ..HubState::ZERO };
            hub.update_sin_cos(T::ZERO);
            let load = arm.load(&self.points, &arm.equilibrium(&self.points, &hub), &hub);
            let held = if parameter == "limits.torque" { load.torque } else { load.moment };
            most.max(held.to_f64().abs())
        });
        (held > limit).then_some(Remedy::Weight(held))
    }
}
