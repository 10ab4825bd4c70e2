//! The shortest still move that the drive can make.

use super::plan::Search;
use super::{Flex, Manner, Still, StillMove, Survey};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;
use crate::motion::{Limits, Move, admit};

/// A limit that this many first periods do not keep is one that no duration does, e.g. a torque
/// below what the arm's weight needs.
const LONGEST: f64 = 300.0;

/// Most durations that are tried on the way up, and on the way back.
const UP: u32 = 28;
const BACK: u32 = 16;

/// From another state than rest, longer is not always better: a vibration can be braked with little
/// in some durations and not in others. So the durations go up in small steps to this many first
/// periods, and by what the exceeded limit says only from there on.
const CAREFUL: f64 = 8.0;
const CAREFULLY: f64 = 1.12;

impl<T: Scalar, const K: usize> Still<T, K> {
    /// The shortest move from rest at `from` rad to rest at `to` rad that keeps the limits, and its
    /// survey: by the exact model, to a whole tick.
    pub fn shortest(
        &self,
        from: f64,
        to: f64,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        self.shortest_from(&HubState::at_rest(Angle::from_radians(from)), None, to, limits)
    }

    /// [`Self::shortest`] from any state of hub and arm.
    ///
    /// The duration grows as the exceeded limit says, then is halved back: at most 90 plans. The
    /// error is the limit that the longest of them exceeded; where the arm's weight does so by itself,
    /// it says so.
    pub fn shortest_from(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        let limits = self.with_own(limits)?;
        let attempt = |ticks| self.first_within(from, flex, to, ticks, &limits);
        let mut failing = libm::ceil(0.9 * self.first_period() / self.tick) as u32;
        let mut reach = failing;
        let mut best = attempt(reach);
        let resting = from.rate == 0.0 && from.acceleration == 0.0 && flex.is_none();
        for _ in 0..UP {
            let Err(error) = best else { break };
            if f64::from(reach) * self.tick > LONGEST * self.first_period() {
                break;
            }
            failing = reach;
            let careful = !resting && f64::from(reach) * self.tick < CAREFUL * self.first_period();
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
        let quiet =
            self.in_manner(Manner::Acceleration, from, flex, to, reach, &limits, Search::Second);
        Ok(self.surveyed(quiet.unwrap_or(found), flex, &limits))
    }

    /// [`Self::plan_from`] within the limits, and its survey: the second mode is left ringing, and
    /// something else than the acceleration spared, where the limits ask for it.
    pub fn within(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        let limits = self.with_own(limits)?;
        let ticks = Move::Dwell { duration }.ticks(self.tick)?;
        self.in_manner(Manner::Acceleration, from, flex, to, ticks, &limits, Search::Second)
            .or_else(|_| self.first_within(from, flex, to, ticks, &limits))
            .map(|found| self.surveyed(found, flex, &limits))
    }

    /// With only the first mode looked after.
    pub(super) fn first_within(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        ticks: u32,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        let attempt = |manner| self.in_manner(manner, from, flex, to, ticks, limits, Search::First);
        // The same time may do if what is exceeded is spared.
        attempt(Manner::Acceleration).or_else(|error| match error {
            Error::LimitExceeded { parameter: "limits.rate", .. } | Error::TooFast { .. } => {
                attempt(Manner::Rate)
            }
            Error::LimitExceeded { parameter: "limits.jerk", .. } => attempt(Manner::Jerk),
            _ => Err(error),
        })
    }

    #[allow(clippy::too_many_arguments)]
    fn in_manner(
        &self,
        manner: Manner,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        ticks: u32,
        limits: &Limits,
        search: Search,
    ) -> Result<(StillMove, Survey), Error> {
        let duration = f64::from(ticks) * self.tick;
        let plan = self.search(manner, from, flex, to, duration, search)?;
        admit(limits, &plan.peaks, self.tick)?;
        let survey =
            if limits_loads(limits) { self.survey(&plan, flex) } else { self.glance(&plan, flex) };
        survey.admit(limits, self.scene.link.length)?;
        Ok((plan, survey))
    }

    /// A plan with its survey in short steps, which a search does without where it limits no load.
    pub(super) fn surveyed(
        &self,
        (plan, survey): (StillMove, Survey),
        flex: Option<&Flex<T, K>>,
        limits: &Limits,
    ) -> (StillMove, Survey) {
        (plan, if limits_loads(limits) { survey } else { self.survey(&plan, flex) })
    }
}

/// True if torque or bending moment is limited.
fn limits_loads(limits: &Limits) -> bool {
    limits.torque.is_some() || limits.moment.is_some()
}

/// How much longer a move has to be to keep a limit, if its shape does not change: 1.02 to 4 times.
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
