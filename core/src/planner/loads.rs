//! Limits of what the arm answers with: kept by flying it, explained by its weight.

use core::f64::consts::TAU;

use super::{Flex, Still, StillMove};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, Remedy};

/// Angles on the way at which the weight is looked at.
const LOOKS: u32 = 32;

impl<T: Scalar, const K: usize> Still<T, K> {
    /// A planner all of whose moves keep the torque (N m, at the hub) and the bending moment (N m,
    /// at the clamp), where they are told. These are limits of the arm that the planner flies, so
    /// they stand here and not with a generator, which cannot check them: see [`Limits`]. A limit
    /// that a plan is handed besides is kept too.
    ///
    /// How true they are is said by [`Survey`](super::Survey).
    pub fn with_load_limits(self, torque: Option<f64>, moment: Option<f64>) -> Result<Self, Error> {
        let loads = Limits { torque, moment, ..Limits::default() }.validate()?;
        Ok(Self { loads, ..self })
    }

    /// The limits with the planner's own.
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

    /// The plan if it keeps the planner's own limits.
    pub(super) fn keeping_loads(
        &self,
        plan: StillMove,
        flex: Option<&Flex<T, K>>,
    ) -> Result<StillMove, Error> {
        if self.loads != Limits::default() {
            self.survey(&plan, flex).admit_loads(&self.loads)?;
        }
        Ok(plan)
    }

    /// What would keep a limit that [`Self::within`] or [`Self::shortest`] has refused a move to `to` rad
    /// for: the weight, if holding the arm somewhere on the way exceeds it, so that no duration helps;
    /// else the shortest duration that [`Self::within`] takes, which takes the time of
    /// [`Self::shortest`]; else a longer move.
    pub fn remedy(
        &self,
        error: Error,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        limits: &Limits,
    ) -> Remedy {
        if let Error::LimitExceeded { parameter, limit, .. } = error
            && let Some(weight) = self.weight_beyond(parameter, limit, from, to)
        {
            return weight;
        }
        match self.shortest_from(from, flex, to, limits) {
            Ok((plan, _)) => Remedy::Duration(plan.duration()),
            Err(_) => Remedy::Longer,
        }
    }

    /// The remedy that says so, if holding the arm on the way to `to` rad takes more than a load's
    /// limit.
    fn weight_beyond(
        &self,
        parameter: &str,
        limit: f64,
        from: &HubState<f64>,
        to: f64,
    ) -> Option<Remedy> {
        if self.scene.gravity == 0.0 || !matches!(parameter, "limits.torque" | "limits.moment") {
            return None;
        }
        let arm = &self.coarse.arms[0];
        let turn = to / TAU - from.angle.in_turns();
        let held = (0..=LOOKS).fold(0.0, |most: f64, look| {
            let angle = from.angle.plus(turn * f64::from(look) / f64::from(LOOKS));
            let mut hub = HubState { angle: Angle::cast::<T>(angle), ..HubState::ZERO };
            hub.update_sin_cos();
            let load = arm.load(&self.chain, &arm.rest(&self.chain, &hub), &hub);
            let held = if parameter == "limits.torque" { load.torque } else { load.moment };
            most.max(held.to_f64().abs())
        });
        (held > limit).then_some(Remedy::Weight(held))
    }
}
