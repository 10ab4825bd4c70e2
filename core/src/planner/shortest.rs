//! The shortest still move within the limits.

use super::problem::Scope;
use super::{Planner, Request, StillMove};
use crate::Error;
use crate::math::Scalar;

/// Longest duration that is tried, in first periods. A limit that it exceeds is exceeded by every
/// duration, e.g. a torque below what the arm's weight needs.
const LONGEST: f64 = 300.0;

/// Most durations that are tried on the way up, and on the way back.
const UP: u32 = 28;
const BACK: u32 = 16;

/// From another state than rest, longer is not always better: a vibration can be braked with little
/// in some durations and not in others. So the durations grow by [`CAREFULLY`] up to this many
/// first periods, and by what the exceeded limit says only from there on.
const CAREFUL: f64 = 8.0;
const CAREFULLY: f64 = 1.12;

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Plans the shortest move to `to` rad within the request's limits, to a whole tick.
    ///
    /// The duration grows as the exceeded limit says, then is halved back: at most 90 searches. The
    /// error is the limit that the longest of them exceeded.
    pub(super) fn shortest(&self, request: &Request<T, K>, to: f64) -> Result<StillMove, Error> {
        let attempt = |ticks| {
            self.path(request, to, ticks).and_then(|path| self.within_first(request, &path))
        };
        let mut failing = libm::ceil(0.9 * self.first_period() / self.tick) as u32;
        let mut reach = failing;
        let mut best = attempt(reach);
        for _ in 0..UP {
            let Err(error) = best else { break };
            let duration = f64::from(reach) * self.tick;
            if duration > LONGEST * self.first_period() {
                break;
            }
            failing = reach;
            let careful = !request.begins_at_rest() && duration < CAREFUL * self.first_period();
            let factor = if careful { CAREFULLY } else { stretch(&error) };
            reach = (reach + 1).max(libm::ceil(f64::from(reach) * factor) as u32);
            best = attempt(reach);
        }
        let mut found = best?;
        for _ in 0..BACK {
            let middle = failing + (reach - failing) / 2;
            if middle <= failing || middle >= reach {
                break;
            }
            match attempt(middle) {
                Ok(shorter) => (found, reach) = (shorter, middle),
                Err(_) => failing = middle,
            }
        }
        // With the second mode at rest too, if the limits leave room for it.
        let path = self.path(request, to, reach)?;
        let quiet = self.attempt(request, &path, request.objective, Scope::Second);
        Ok(quiet.unwrap_or(found))
    }
}

/// Factor by which a move of the same shape has to be longer to keep the exceeded limit, 1.02 to 4.
fn stretch(error: &Error) -> f64 {
    let (parameter, limit, needed) = match *error {
        Error::LimitExceeded { parameter, limit, needed, .. } => (parameter, limit, needed),
        Error::TooFast { rate, max, .. } => ("limits.rate", max, rate),
        _ => return 1.1,
    };
    let excess = needed / limit;
    let factor = match parameter {
        "limits.rate" => excess,
        "limits.jerk" => libm::cbrt(excess),
        _ => libm::sqrt(excess),
    };
    factor.clamp(1.02, 4.0)
}
