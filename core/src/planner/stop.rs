//! Stops, and moves by way of a stop.

use super::{ArmState, Planner, Prediction, Request, StillMove, Target};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::Scalar;

/// Longest stop that is tried, in first periods, and the ratio of one tried duration to the last.
const LONGEST: f64 = 8.0;
const LONGER: f64 = 1.12;

/// Ways that are tried, relative to that at an even loss of rate.
const WAYS: [f64; 3] = [1.0, 0.67, 1.33];

/// One move, or a stop and a move from rest behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopThenMove {
    /// The first move, from the state of the request.
    pub first: StillMove,
    /// The second move, from rest where the first one ends.
    pub then: Option<StillMove>,
}

impl StopThenMove {
    /// Duration of both moves, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.first.duration() + self.then.map_or(0.0, |then| then.duration())
    }

    /// Predicts the arm's answer to both moves: the greater magnitudes, and the sum of the
    /// residuals.
    #[must_use]
    pub fn predict<T: Scalar, const K: usize>(
        &self,
        planner: &Planner<T, K>,
        arm: Option<&ArmState<T, K>>,
    ) -> Prediction {
        let before = planner.predict(&self.first, arm);
        let Some(then) = &self.then else { return before };
        let after = planner.predict(then, None);
        Prediction {
            torque: before.torque.max(after.torque),
            moment: before.moment.max(after.moment),
            deflection: before.deflection.max(after.deflection),
            residual: before.residual + after.residual,
        }
    }
}

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Plans a request, by way of a stop where no single move keeps the limits.
    ///
    /// A long move is too smooth to brake a vibration without swinging far out. Then a stop comes
    /// first, and the shortest move from rest behind it, to be pushed once the first is taken.
    ///
    /// # Errors
    /// The error of the single move, or of the second of two.
    pub fn plan_by_stop(&self, request: &Request<T, K>) -> Result<StopThenMove, Error> {
        let error = match self.plan(request) {
            Ok(first) => return Ok(StopThenMove { first, then: None }),
            Err(error) => error,
        };
        if request.target == Target::Stop {
            return Err(error);
        }
        let stop = Request { target: Target::Stop, rate: 0.0, duration: None, ..*request };
        let Ok(first) = self.plan(&stop) else { return Err(error) };
        let from = HubState::at_rest(Angle::from_radians(first.to));
        let behind = Request { from, arm: None, duration: None, ..*request };
        Ok(StopThenMove { first, then: Some(self.plan(&behind)?) })
    }

    /// Plans a short move to rest about where the hub gets to at an even loss of its rate. Some 20
    /// durations are tried if none is given, each with three ways. The error is that of the last.
    pub(super) fn stop(
        &self,
        request: &Request<T, K>,
        asked: Option<u32>,
    ) -> Result<StillMove, Error> {
        let (here, period) = (request.from.angle.radians(), self.first_period());
        let mut ticks = asked.map_or(libm::ceil(0.9 * period / self.tick), f64::from);
        loop {
            let duration = ticks * self.tick;
            let from = &request.from;
            let even = duration * (0.5 * from.rate + duration * from.acceleration / 12.0);
            // A hub at rest has one way only.
            let ways = if even == 0.0 { &WAYS[..1] } else { &WAYS };
            let mut found = Err(Error::TooShort { duration, shortest: 0.9 * period });
            for way in ways {
                found = self
                    .path(request, here + way * even, ticks as u32)
                    .and_then(|path| self.within_first(request, &path));
                if found.is_ok() {
                    return found;
                }
            }
            if asked.is_some() || duration > LONGEST * period {
                return found;
            }
            ticks = libm::ceil(LONGER * ticks);
        }
    }
}
