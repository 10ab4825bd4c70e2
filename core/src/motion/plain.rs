//! Moves whose segments begin and end at ticks, and their planning.
//!
//! Once a move: its ends are computed in f64; what the tick evaluates is computed in the precision
//! of the tick.

use core::f64::consts::TAU;
use core::fmt;

use super::cubics::lay_cubics;
use super::demand::Demand;
use super::plannable::{Plannable, Sealed};
use super::profile::whole_ticks;
use super::segment::Shape;
use super::shapes::{Shapes, quintic, rest_to_rest, spin_up};
use super::{BULGE, Limits, MoveSummary, Profile, Segment, curve_peaks};
use crate::Error;
use crate::hub::{Angle, HubState, MAX_ANGLE};
use crate::math::{Each, Scalar};

/// Those of the [`Move`](super::Move)s that begin and end at ticks, without acceleration but for a
/// profile's own jumps: what a wire carries and a small firmware plans.
///
/// A program that plans these only is 45 kB smaller than one that plans any [`Move`](super::Move).
/// Both give the same bits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PlainMove {
    /// See [`Move::To`](super::Move::To).
    To {
        /// The motion's shape.
        profile: Profile,
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
    },
    /// See [`Move::SpinUp`](super::Move::SpinUp).
    SpinUp {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Rate at the end, rad/s; 0 brings a turning hub to rest.
        rate: f64,
    },
    /// See [`Move::Still`](super::Move::Still).
    Still {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
        /// `b₀ … b₅`, rad.
        bulge: [f64; BULGE],
    },
    /// See [`Move::Dwell`](super::Move::Dwell).
    Dwell {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
    },
}

impl PlainMove {
    /// Returns T, s, as asked for.
    pub fn duration(&self) -> f64 {
        match *self {
            Self::To { duration, .. }
            | Self::SpinUp { duration, .. }
            | Self::Still { duration, .. }
            | Self::Dwell { duration } => duration,
        }
    }
}

impl fmt::Display for PlainMove {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::To { profile, duration, to } => {
                write!(f, "{profile} to {to} rad in {duration} s")
            }
            Self::SpinUp { duration, rate } => write!(f, "spin-up to {rate} rad/s in {duration} s"),
            Self::Still { duration, to, .. } => write!(f, "still to {to} rad in {duration} s"),
            Self::Dwell { duration } => write!(f, "dwell for {duration} s"),
        }
    }
}

impl Sealed for PlainMove {}

impl Plannable for PlainMove {
    // Where it is compiled for size too, a program that knows its profile links no other.
    #[inline(always)]
    fn plan_segments<T: Scalar>(
        &self,
        start: HubState<f64>,
        limits: &Limits,
        tick: f64,
        sink: &mut dyn FnMut(&Segment<T>),
    ) -> Result<MoveSummary, Error> {
        let limits = limits.of_motion()?;
        let ticks = whole_ticks(self.duration(), tick)?;
        let duration = f64::from(ticks) * tick;
        let (shapes, end, demand) = self.shapes(&start, duration)?;
        let peaks = demand.admit(&limits, ticks, tick)?;
        emit(shapes, &start, ticks, tick, sink);
        Ok(MoveSummary { end, ticks, peaks, rounded_by: duration - self.duration() })
    }

    #[inline(always)]
    fn keeps_rate(&self) -> bool {
        matches!(self, Self::Dwell { .. })
    }
}

impl PlainMove {
    /// Returns the formulas of a move that takes `duration` s, the hub at its end, and its demand.
    #[inline(always)]
    fn shapes<T: Scalar>(
        &self,
        start: &HubState<f64>,
        duration: f64,
    ) -> Result<(Shapes<T>, HubState<f64>, Demand), Error> {
        let turned = |rate: f64| rate * duration / TAU;
        Ok(match *self {
            Self::To { profile, to, .. } => {
                let (delta, end) = turn_to(to, start)?;
                (rest_to_rest(profile, delta), end, Demand::Turn(profile, delta * TAU))
            }
            Self::SpinUp { rate, .. } => {
                let rate = Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
                let change = rate - start.rate;
                let mean = 0.5 * (rate + start.rate);
                let end = HubState::turning(start.angle.plus(turned(mean)), rate);
                let demand = Demand::Spin { from: start.rate, to: rate };
                let (old, change) = (turned(start.rate), turned(change));
                (Shapes::One(spin_up(T::from_f64(old), T::from_f64(change))), end, demand)
            }
            Self::Still { to, bulge, .. } => {
                let (delta, end) = turn_to(to, start)?;
                for b in bulge {
                    Error::check("move.bulge", b, -MAX_ANGLE, MAX_ANGLE, "rad")?;
                }
                let (c, d) = (quintic(T::from_f64(delta)), bulge.each(|b| T::from_f64(b / TAU)));
                let demand = Demand::Curve(curve_peaks(&c, &d, duration));
                (Shapes::One(Shape::Bulged { c, d }), end, demand)
            }
            Self::Dwell { .. } => {
                let angle = start.angle.plus(turned(start.rate));
                (Shapes::Hold, HubState::turning(angle, start.rate), Demand::Hold(start.rate))
            }
        })
    }
}

/// Turns from `start`, at rest, to the angle `to`, rad, and the hub at rest there. The end is
/// exactly that angle, whatever the turns round to.
#[inline(always)]
fn turn_to(to: f64, start: &HubState<f64>) -> Result<(f64, HubState<f64>), Error> {
    let to = Error::check("move.to", to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
    if start.rate != 0.0 {
        return Err(Error::NotAtRest { rate: start.rate });
    }
    let end = HubState::at_rest(Angle::from_radians(to));
    Ok((end.angle.since(start.angle), end))
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
