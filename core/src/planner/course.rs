//! From anywhere to rest by one move or by two: a stop, and a course by way of one.

use super::{Flex, Still, StillMove, Survey};
use crate::Error;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::Limits;

/// Stops that are tried take this many first periods at most, each longer than the one before by so
/// much.
const LONGEST: f64 = 8.0;
const LONGER: f64 = 1.12;

/// How far the hub goes on, of what it would at an even loss of its rate: as it comes, and a third
/// less and more.
const WAYS: [f64; 3] = [1.0, 0.67, 1.33];

/// How to get somewhere and be at rest there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// From where the hub is.
    pub first: StillMove,
    /// From the rest at the end of the first.
    pub then: Option<StillMove>,
    /// The greater magnitudes of the two, and the residuals of both.
    pub survey: Survey,
}

impl From<(StillMove, Survey)> for Course {
    fn from((first, survey): (StillMove, Survey)) -> Self {
        Self { first, then: None, survey }
    }
}

impl Course {
    /// s.
    pub fn duration(&self) -> f64 {
        self.first.duration() + self.then.map_or(0.0, |then| then.duration())
    }
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// The shortest course within the limits from any state of hub and arm to rest at `to` rad.
    ///
    /// One move where there is one. A long move is too smooth to brake a vibration without swinging
    /// far out: then a [stop](Self::stop) comes first, and a move from rest to rest behind it, to be
    /// pushed once the first is taken. The error is that of the single move, or of the second.
    pub fn course(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        limits: &Limits,
    ) -> Result<Course, Error> {
        let error = match self.shortest_from(from, flex, to, limits) {
            Ok(found) => return Ok(found.into()),
            Err(error) => error,
        };
        let Ok((first, before)) = self.stop(from, flex, limits) else { return Err(error) };
        let (then, after) = self.shortest(first.to, to, limits)?;
        let survey = Survey {
            torque: before.torque.max(after.torque),
            moment: before.moment.max(after.moment),
            deflection: before.deflection.max(after.deflection),
            residual: before.residual + after.residual,
        };
        Ok(Course { first, then: Some(then), survey })
    }

    /// A short move within the limits from any state of hub and arm to rest, wherever that is: about
    /// where the hub gets to at an even loss of its rate. Some 20 durations are tried, each
    /// three ways; the error is that of the last.
    pub fn stop(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        limits: &Limits,
    ) -> Result<(StillMove, Survey), Error> {
        let limits = self.with_own(limits)?;
        let (here, period) = (from.angle.radians(), self.first_period());
        let mut ticks = libm::ceil(0.9 * period / self.tick);
        loop {
            let duration = ticks * self.tick;
            let even = duration * (0.5 * from.rate + duration * from.acceleration / 12.0);
            // A hub at rest has one way only.
            let ways = if even == 0.0 { &WAYS[..1] } else { &WAYS };
            let mut found = Err(Error::TooShort { duration, shortest: 0.9 * period });
            for way in ways {
                found = self.first_within(from, flex, here + way * even, ticks as u32, &limits);
                if let Ok(found) = found {
                    return Ok(self.surveyed(found, flex, &limits));
                }
            }
            if duration > LONGEST * period {
                return found;
            }
            ticks = libm::ceil(LONGER * ticks);
        }
    }
}
