//! Still moves of an axis: planned beside the tick, like every other move.

use crate::hub::HubState;
use crate::math::Scalar;
use crate::planner::{Planner, Request, Target};
use crate::{Error, PlanContext, PlannedMove};

impl PlanContext {
    /// Plans a move to `to` rad after which the arm is at rest: in `duration` s, rounded to whole
    /// ticks, or if none is told in the shortest time within the limits. Torque and bending moment
    /// are kept by the planner's model where the planner has
    /// [limits of them](Planner::with_load_limits).
    ///
    /// From rest, as a queue of moves that end at rest leaves it, in any number of ticks from now.
    /// Runs for 10⁵ to 10⁸ instructions: at a low priority, never in the tick.
    ///
    /// # Errors
    /// A hub that still turns there, a duration too short, a limit that is exceeded, each with its
    /// value and what it must be.
    pub fn plan_still<T: Scalar, const K: usize>(
        &self,
        planner: &Planner<T, K>,
        to: f64,
        duration: Option<f64>,
    ) -> Result<PlannedMove<T>, Error> {
        let start = self.start();
        if start.rate != 0.0 {
            return Err(Error::NotAtRest { rate: start.rate });
        }
        let request = Request {
            duration,
            limits: *self.limits(),
            ..Request::from_hub(HubState::at_rest(start.angle), Target::Angle(to))
        };
        let still = planner.plan(&request)?;
        self.plan(&still.plain())
    }
}
