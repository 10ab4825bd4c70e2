//! Moves in the shortest time that the limits of the hub's motion allow: to an angle, or to a rate.

use stillbeam::Move;
use stillbeam::motion::optimal::Bounds;

use super::moves::{Here, MoveTable, Planning};
use crate::error::Error;

impl MoveTable {
    /// Builds the move of the profile `name`, "reach" or "ramp".
    pub(super) fn optimal(
        &self,
        name: &str,
        here: &mut Here,
        planning: &Planning<'_>,
    ) -> Result<Move, Error> {
        self.refuse("robust", self.robust)?;
        self.refuse("repeat", self.repeat)?;
        self.refuse("duration", self.duration)?;
        let limits = planning.limits.kinematic();
        if limits.acceleration.is_none() && limits.jerk.is_none() {
            return Err(Error::new(format_args!(
                "move.profile = \"{name}\": takes the shortest time within the limits; [limits] must \
                 hold acceleration or jerk"
            )));
        }
        let bounds = Bounds::new(&limits, planning.before.tick)?;
        if name == "reach" {
            let to = self.need("to", "rad", self.to)?;
            let rate = self.rate.unwrap_or(0.0);
            *here = Here { angle: Some(to), rate };
            Ok(Move::Reach { to, rate, bounds })
        } else {
            self.refuse("to", self.to)?;
            let rate = self.need("rate", "rad/s", self.rate)?;
            *here = Here { angle: None, rate };
            Ok(Move::Ramp { rate, bounds })
        }
    }
}
