//! Moves that pass into the next one without a stop, where the limits allow it.

use stillbeam::{Limits, Move, Profile};

use super::moves::{Here, MoveTable, Planning};
use crate::error::Error;
use crate::limits;
use crate::step::Step;

impl MoveTable {
    /// Builds the move with the rate at its end at which the next one follows: see
    /// [`Move::blended`]. It comes to rest if one of both then exceeded a limit, of torque and
    /// clamp moment too.
    pub(super) fn blended(
        &self,
        next: Option<&Self>,
        here: &mut Here,
        planning: &Planning<'_>,
    ) -> Result<Move, Error> {
        let next = next.filter(|next| next.goes_to_an_angle()).ok_or_else(|| {
            Error::new(
                "move.blend = true: the move after it must go to an angle in one of the profiles \
                 cubic, quintic, cycloid, trapezoid and s-curve",
            )
        })?;
        self.check_blend()?;
        let own = self.plain(here, planning)?;
        let mut steps = planning.before.steps.to_vec();
        let start = planning.before.end()?;
        steps.push(Step { motion: own.into(), settle: 0.0 });
        let behind = Planning { before: planning.before.with(&steps), ..*planning };
        // Both as they are if the hub stops between them.
        let following = next.plain(&mut { *here }, &behind)?;
        // Behind a shaper a move may exceed the limits that what leaves it keeps.
        let limits = if planning.before.shaper.is_some() {
            Limits::default()
        } else {
            planning.limits.kinematic()
        };
        let tick = planning.before.tick;
        let blended = own.blended(Some(&following), start, &limits, tick)?;
        let Move::Pass { rate, .. } = blended else { return Ok(own) };
        if rate == 0.0 || !keeps_limits(blended, following, planning)? {
            return Ok(own);
        }
        here.rate = rate;
        Ok(blended)
    }

    fn goes_to_an_angle(&self) -> bool {
        let shaped = self.profile.as_deref().is_some_and(|name| Profile::named(name).is_some());
        shaped && self.waypoints.is_none()
    }

    fn check_blend(&self) -> Result<(), Error> {
        if !self.goes_to_an_angle() {
            return Err(Error::new(
                "move.blend = true: must be absent but for a move to an angle in one of the \
                 profiles cubic, quintic, cycloid, trapezoid and s-curve",
            ));
        }
        let found = [("rate", self.rate), ("settle", Some(self.settle).filter(|t| *t != 0.0))];
        match found.into_iter().find_map(|(key, value)| Some((key, value?))) {
            Some((key, value)) => Err(Error::new(format_args!(
                "move.{key} = {value}: must be absent beside move.blend = true, which passes into \
                 the next move at a rate of its own"
            ))),
            None => Ok(()),
        }
    }
}

/// True if a move and the next one, which comes to rest, keep the limits that the core cannot
/// check: those behind a shaper, of torque and of the clamp moment.
fn keeps_limits(blended: Move, next: Move, planning: &Planning<'_>) -> Result<bool, Error> {
    let Planning { before, .. } = planning;
    let mut steps = before.steps.to_vec();
    let next = match next {
        Move::To { profile, duration, to } => Move::Pass { profile, duration, to, rate: 0.0 },
        next => next,
    };
    let both = [blended, next].map(|motion| Step { motion: motion.into(), settle: 0.0 });
    steps.extend(both);
    let case = before.with(&steps);
    Ok(limits::refusal(&case, &planning.aimed(), &|_| ())?.is_none())
}
