//! Motions that a generator can plan: any move, or plain ones only.

use super::optimal::{Bounds, TimeOptimal};
use super::pass::Pass;
use super::plain::Kind;
use super::profile::whole_ticks;
use super::{Limits, Move, MoveSummary, PlainMove, Profile, Segment, admit};
use crate::Error;
use crate::hub::{Angle, HubState, MAX_ANGLE};
use crate::math::Scalar;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Move {}
    impl Sealed for super::PlainMove {}
}

/// A motion that can be cut into segments: a [`Move`] of any kind, or a [`PlainMove`].
///
/// A type rather than a value, so that a program which plans plain moves only holds no code for the
/// others.
pub trait Plannable: sealed::Sealed {
    /// Plans the motion from `start`, with setpoints every `tick` s, and hands its segments to
    /// `sink`, first to last. A motion that is refused may have handed over none.
    ///
    /// # Errors
    /// A parameter of the move out of range, a limit that it exceeds, or a limit of torque or
    /// moment, which a plan of the hub's motion cannot check.
    fn plan_segments<T: Scalar>(
        &self,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
        sink: &mut dyn FnMut(&Segment<T>),
    ) -> Result<MoveSummary, Error>;

    /// True if the hub keeps its rate and the motion may turn it by any number of turns.
    fn keeps_rate(&self) -> bool;
}

impl Plannable for Move {
    fn plan_segments<T: Scalar>(
        &self,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
        sink: &mut dyn FnMut(&Segment<T>),
    ) -> Result<MoveSummary, Error> {
        match self.kind() {
            Kind::Plain(plain) => plain.plan_segments(start, limits, tick, sink),
            Kind::Pass { profile, duration, to, rate } => {
                plan_pass(profile, [duration, to, rate], start, limits, tick, sink)
            }
            Kind::Shortest { to, rate, bounds } => {
                plan_shortest(to, rate, &bounds, start, limits, tick, sink)
            }
        }
    }

    fn keeps_rate(&self) -> bool {
        matches!(self, Self::Dwell { .. })
    }
}

/// Plans a move that takes the shortest time: to an angle, rad, or without one to any angle.
// Not inlined, as the next: the plan of another move needs no stack for it.
#[inline(never)]
fn plan_shortest<T: Scalar>(
    to: Option<f64>,
    rate: f64,
    bounds: &Bounds,
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let limits = limits.of_motion()?;
    let shortest = match to {
        Some(to) => {
            let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
            let end = HubState::turning(Angle::from_radians(to), rate);
            TimeOptimal::reach(&start, &end, bounds)?
        }
        None => TimeOptimal::ramp(&start, rate, bounds)?,
    };
    shortest.admitted(&limits, tick)?.lay(tick, sink)
}

/// Plans a [`Move::Pass`] from any state of the hub to an angle that it passes at a rate.
#[inline(never)]
fn plan_pass<T: Scalar>(
    profile: Profile,
    [duration, to, rate]: [f64; 3],
    start: HubState<f64>,
    limits: &Limits,
    tick: f64,
    sink: &mut dyn FnMut(&Segment<T>),
) -> Result<MoveSummary, Error> {
    let limits = limits.of_motion()?;
    let ticks = whole_ticks(duration, tick)?;
    let whole = f64::from(ticks) * tick;
    let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
    let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
    let end = HubState::turning(Angle::from_radians(to), rate);
    let pass = Pass::new(profile, start, end, whole, tick);
    admit(&limits, &pass.peaks, tick)?;
    pass.emit(start, sink);
    Ok(MoveSummary { end, ticks, peaks: pass.peaks, rounded_by: whole - duration })
}
