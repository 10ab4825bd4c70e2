//! The shortest still move that the drive can make.

use super::{Departure, Flex, Manner, Still, StillMove, Survey};
use crate::Error;
use crate::math::Scalar;
use crate::motion::{Angle, Limits};

/// A limit that this many first periods do not keep is one that no duration does, e.g. a torque
/// below what the arm's weight needs.
const LONGEST: f64 = 300.0;

/// Most durations that are tried on the way up, and on the way back.
const TRIES: u32 = 16;

impl<T: Scalar, const K: usize> Still<T, K> {
    /// The shortest move from rest at `from` rad to rest at `to` rad that keeps the limits, and its
    /// survey: by the exact model, to a whole tick.
    pub fn shortest(
        &self,
        from: f64,
        to: f64,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        self.shortest_from(&Departure::at_rest(Angle::from_radians(from)), None, to, limits)
    }

    /// [`Self::shortest`] from any state of hub and arm.
    ///
    /// The duration grows as the exceeded limit says, then is halved back: at most 64 plans. The
    /// error is the limit that the longest of them exceeded.
    pub fn shortest_from(
        &self,
        from: &Departure,
        flex: Option<&Flex<T, K>>,
        to: f64,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        let limits = limits.validate()?;
        let in_manner = |ticks: u32, manner: Manner| -> Result<(StillMove, Survey), Error> {
            let duration = f64::from(ticks) * self.tick;
            let plan = self.plan_in(manner, from, flex, to, duration)?;
            limits.admit(&plan.peaks)?;
            let survey = self.survey(&plan, flex);
            survey.admit(&limits, self.scene.link.length)?;
            Ok((plan, survey))
        };
        let attempt = |ticks: u32| {
            let found = in_manner(ticks, Manner::Acceleration);
            let Err(error) = found else { return found };
            // The same time may do if what is exceeded is spared.
            match error {
                Error::LimitExceeded { parameter: "limits.rate", .. } => {
                    in_manner(ticks, Manner::Rate)
                }
                Error::LimitExceeded { parameter: "limits.jerk", .. } => {
                    in_manner(ticks, Manner::Jerk)
                }
                _ => Err(error),
            }
        };
        let mut failing = libm::ceil(0.9 * self.first_period() / self.tick) as u32;
        let mut reach = failing;
        let mut best = attempt(reach);
        for _ in 0..TRIES {
            let Err(error) = best else { break };
            if f64::from(reach) * self.tick > LONGEST * self.first_period() {
                break;
            }
            failing = reach;
            reach = (reach + 1).max(libm::ceil(f64::from(reach) * stretch(&error)) as u32);
            best = attempt(reach);
        }
        let mut found = best?;
        for _ in 0..TRIES {
            let middle = failing + (reach - failing) / 2;
            if middle <= failing || middle >= reach {
                break;
            }
            match attempt(middle) {
                Ok(shorter) => (found, reach) = (shorter, middle),
                Err(_) => failing = middle,
            }
        }
        Ok(found)
    }
}

/// How much longer a move has to be to keep a limit, if its shape does not change: 1.05 to 4 times.
fn stretch(error: &Error) -> f64 {
    let Error::LimitExceeded { parameter, limit, needed, .. } = *error else { return 1.1 };
    let excess = needed / limit;
    let factor = match parameter {
        "limits.rate" => excess,
        "limits.jerk" => libm::cbrt(excess),
        _ => libm::sqrt(excess),
    };
    factor.clamp(1.02, 4.0)
}
