//! Plans of moves, and the shortest duration that keeps the limits.

use core::f64::consts::TAU;

use heapless::Vec;

use super::demand::Demand;
use super::optimal::{Bounds, TimeOptimal};
use super::{Limits, Move, Peaks, Plannable, Remedy, Segment};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::{Angle, HubState, MAX_ANGLE};

/// Segments of the longest plan: seven of constant jerk, and one up to the next tick.
pub const MAX_SEGMENTS: usize = 8;

/// Durations that are tried grow by one part in so many: time in which the peaks change little.
const STEP: u32 = 32;

/// Duration, end and peaks of a planned move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveSummary {
    /// Hub at its end: the next move's start.
    pub end: HubState<f64>,
    /// Whole ticks it takes.
    pub ticks: u32,
    /// Greatest magnitudes of rate, acceleration and jerk.
    pub peaks: Peaks,
    /// Planned duration less requested duration, s: the change by rounding to whole ticks.
    pub rounded_by: f64,
}

/// A move that was accepted: its segments and its summary.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Plan {
    /// The motion, first to last and without a gap. A stretch that holds no tick is a segment too,
    /// whose [count](Segment::count) is 0.
    pub segments: Vec<Segment<f64>, MAX_SEGMENTS>,
    /// Duration, end and peaks.
    pub summary: MoveSummary,
}

impl Plan {
    /// Plans `motion` from `start`, with setpoints every `tick` s.
    ///
    /// # Errors
    /// A parameter of the move out of range, a limit that it exceeds (see [`Self::remedy`]), or a
    /// limit of torque or moment, which a plan of the hub's motion cannot check.
    pub fn new(
        motion: &Move,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Self, Error> {
        let mut segments = Vec::new();
        let summary = motion.plan_segments(start, limits, tick, &mut |segment| {
            // No move has more.
            let _ = segments.push(*segment);
        })?;
        Ok(Self { segments, summary })
    }

    /// Returns a change that keeps the limits, for a move that [`Self::new`] refuses because of one
    /// of them: the shortest duration in whole ticks that keeps every limit of the motion and one
    /// radian a tick, or the reason why none does.
    pub fn remedy(motion: &Move, start: HubState<f64>, limits: &Limits, tick: f64) -> Remedy {
        let demand = match *motion {
            Move::To { profile, to, .. } => {
                Demand::Turn(profile, to - TAU * start.angle.in_turns())
            }
            Move::SpinUp { rate, .. } => Demand::Spin { from: start.rate, to: rate },
            Move::Dwell { .. } => Demand::Hold(start.rate),
            // A still move is planned for its duration; in another it is another curve.
            // The peaks of a motion that ends turning need not fall with the duration.
            Move::Still { .. } | Move::Pass { .. } => return Remedy::Longer,
            // One that takes the shortest time has no other within its bounds.
            Move::Reach { .. } | Move::Ramp { .. } => return Remedy::Longer,
        };
        demand.remedy(limits, tick)
    }

    /// Returns `motion` with the shortest duration in whole ticks that keeps every limit of the
    /// motion and one radian a tick; the duration it comes with does not matter. A still move and a
    /// dwell come back as they are: the one is planned for its duration, the other keeps every
    /// limit in any.
    ///
    /// # Errors
    /// No limit at all, or one that no duration keeps; what [`Self::new`] refuses.
    pub fn shortest(
        motion: &Move,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Move, Error> {
        limits.any_of_motion()?;
        let shortest = match *motion {
            Move::Still { .. } | Move::Dwell { .. } => *motion,
            Move::Reach { .. } | Move::Ramp { .. } => *motion,
            Move::Pass { .. } => Self::shortest_pass(motion, start, limits, tick)?,
            _ => motion.lasting(match Self::remedy(motion, start, limits, tick) {
                Remedy::Duration(duration) => duration,
                // Refused below.
                _ => f64::from(MAX_TICKS) * tick,
            }),
        };
        shortest.plan_segments::<f64>(start, limits, tick, &mut |_| ()).map(|_| shortest)
    }

    /// Returns a move from any state in the first duration that keeps the limits, from the shortest
    /// upwards that any motion with them has. Its peaks need not fall with the duration: a hub that
    /// is turning may have to turn back if it is given longer.
    fn shortest_pass(
        motion: &Move,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
    ) -> Result<Move, Error> {
        let Move::Pass { to, rate, .. } = *motion else { return Ok(*motion) };
        let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        let end = HubState::turning(Angle::from_radians(to), rate);
        // Without a limit of acceleration or jerk no time is the shortest.
        let least = Bounds::new(limits, tick)
            .and_then(|bounds| TimeOptimal::reach(&start, &end, &bounds))
            .map_or(0.0, |shortest| shortest.duration());
        let lasting = |ticks: u32| motion.lasting(f64::from(ticks) * tick);
        let fits = |ticks: u32| {
            lasting(ticks).plan_segments::<f64>(start, limits, tick, &mut |_| ()).is_ok()
        };
        let mut fails = (least / tick - 1e-6).clamp(0.0, f64::from(MAX_TICKS - 1)) as u32;
        let mut reach = fails + 1;
        while !fits(reach) {
            if reach == MAX_TICKS {
                return Ok(lasting(MAX_TICKS));
            }
            fails = reach;
            reach = (reach + reach / STEP + 1).min(MAX_TICKS);
        }
        while reach - fails > 1 {
            let middle = fails + (reach - fails) / 2;
            if fits(middle) {
                reach = middle;
            } else {
                fails = middle;
            }
        }
        Ok(lasting(reach))
    }
}
