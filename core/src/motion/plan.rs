//! Cuts a move into segments, once a move. Its ends are computed in f64; what the tick evaluates is
//! computed in the precision of the tick.

use core::f64::consts::TAU;

use heapless::Vec;

use super::cubics::lay_cubics;
use super::demand::{Demand, admit};
use super::optimal::{Bounds, TimeOptimal};
use super::pass::Pass;
use super::segment::Shape;
use super::shapes::{Shapes, quintic, rest_to_rest, spin_up};
use super::{Limits, Move, Peaks, Profile, Remedy, Segment, curve_peaks};
use crate::Error;
use crate::error::MAX_TICKS;
use crate::hub::{Angle, HubState, MAX_ANGLE};
use crate::math::Scalar;

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
    /// The motion, first to last.
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
        let summary = plan_segments(motion, start, limits, tick, &mut |segment| {
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
        plan_segments::<f64>(&shortest, start, limits, tick, &mut |_| ()).map(|_| shortest)
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
            plan_segments::<f64>(&lasting(ticks), start, limits, tick, &mut |_| ()).is_ok()
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

/// Plans `motion` and hands its segments to `sink`, first to last; none if it is refused.
pub(crate) fn plan_segments<T: Scalar>(
    motion: &Move,
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let limits = limits.of_motion()?;
    match *motion {
        Move::Reach { .. } | Move::Ramp { .. } => plan_shortest(motion, start, &limits, tick, sink),
        _ => plan_lasting(motion, start, &limits, tick, sink),
    }
}

/// Plans a move that takes the shortest time.
// Not inlined: the plan of another move needs no stack for it.
#[inline(never)]
fn plan_shortest<T: Scalar>(
    motion: &Move,
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let shortest = match *motion {
        Move::Reach { to, rate, bounds } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            let end = HubState::turning(Angle::from_radians(to), rate);
            TimeOptimal::reach(&start, &end, &bounds)?
        }
        Move::Ramp { rate, bounds } => TimeOptimal::ramp(&start, rate, &bounds)?,
        // Those that have a duration never come here.
        _ => return plan_lasting(motion, start, limits, tick, sink),
    };
    shortest.admitted(limits, tick)?.lay(tick, sink)
}

/// Plans a move that has a duration.
fn plan_lasting<T: Scalar>(
    motion: &Move,
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let ticks = motion.ticks(tick)?;
    let duration = f64::from(ticks) * tick;
    let turned = |rate: f64| rate * duration / TAU;
    let rounded_by = duration - motion.duration();
    let (shapes, end, demand) = match *motion {
        Move::Pass { profile, to, rate, .. } => {
            let summary = plan_pass(profile, [to, rate], start, limits, [duration, tick], sink)?;
            return Ok(MoveSummary { ticks, rounded_by, ..summary });
        }
        Move::To { profile, to, .. } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            if start.rate != 0.0 {
                return Err(Error::NotAtRest { rate: start.rate });
            }
            let (delta, end) = turn_to(to, &start);
            (rest_to_rest(profile, delta), end, Demand::Turn(profile, delta * TAU))
        }
        Move::SpinUp { rate, .. } => {
            let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
            let change = rate - start.rate;
            let mean = 0.5 * (rate + start.rate);
            let end = HubState::turning(start.angle.plus(turned(mean)), rate);
            let demand = Demand::Spin { from: start.rate, to: rate };
            let (old, change) = (turned(start.rate), turned(change));
            (Shapes::One(spin_up(T::from_f64(old), T::from_f64(change))), end, demand)
        }
        Move::Still { to, bulge, .. } => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            if start.rate != 0.0 {
                return Err(Error::NotAtRest { rate: start.rate });
            }
            for b in bulge {
                Error::check("move.bulge", b, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            }
            let (delta, end) = turn_to(to, &start);
            let (c, d) = (quintic(T::from_f64(delta)), bulge.map(|b| T::from_f64(b / TAU)));
            let demand = Demand::Curve(curve_peaks(&c, &d, duration));
            (Shapes::One(Shape::Bulged { c, d }), end, demand)
        }
        // The shortest motions never come here.
        Move::Dwell { .. } | Move::Reach { .. } | Move::Ramp { .. } => {
            let angle = start.angle.plus(turned(start.rate));
            (Shapes::Hold, HubState::turning(angle, start.rate), Demand::Hold(start.rate))
        }
    };
    let peaks = demand.admit(limits, ticks, tick)?;
    emit(shapes, &start, ticks, tick, sink);
    Ok(MoveSummary { end, ticks, peaks, rounded_by })
}

/// Plans a move in `duration` s from any state to the angle `to`, rad, passed at `rate`, rad/s. Its
/// ticks are left to be told.
// Not inlined, for the same reason.
#[inline(never)]
fn plan_pass<T: Scalar>(
    profile: Profile,
    [to, rate]: [f64; 2],
    start: HubState<f64>,
    limits: &Limits,
    [duration, tick]: [f64; 2],
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
    let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
    let end = HubState::turning(Angle::from_radians(to), rate);
    let pass = Pass::new(profile, start, end, duration, tick);
    admit(limits, &pass.peaks, tick)?;
    pass.emit(start, sink);
    Ok(MoveSummary { end, ticks: 0, peaks: pass.peaks, rounded_by: 0.0 })
}

/// Turns from `start` to the angle `to`, rad, and the hub at rest there. The end is exactly that
/// angle, whatever the turns round to.
#[inline(always)]
fn turn_to(to: f64, start: &HubState<f64>) -> (f64, HubState<f64>) {
    let end = HubState::at_rest(Angle::from_radians(to));
    (end.angle.since(start.angle), end)
}

/// Hands the segments of a move from `start` to `sink`, first to last.
#[inline(always)]
fn emit<T: Scalar>(
    shapes: Shapes<T>,
    start: &HubState<f64>,
    ticks: u32,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) {
    match shapes {
        Shapes::Hold => sink(&Segment::cruise(start.angle, start.rate, ticks, tick)),
        Shapes::One(shape) => {
            let length = T::from_u32(ticks);
            let segment = Segment::new(start.angle, shape, length, T::ZERO, ticks, tick);
            // Every shape of one piece begins and ends without acceleration.
            let rate = T::from_f64(start.rate);
            sink(&segment.beginning(rate, T::ZERO).ending(T::ZERO));
        }
        Shapes::Cubics(pieces, turn) => lay_cubics(pieces, turn, start.angle, ticks, tick, sink),
    }
}
