//! The moves that a user can ask for, and their planning.

use core::fmt;

use super::optimal::{Bounds, TimeOptimal};
use super::pass::Pass;
use super::plannable::{Plannable, Sealed};
use super::profile::whole_ticks;
use super::{BULGE, Limits, MoveSummary, PlainMove, Profile, Segment, admit};
use crate::Error;
use crate::hub::{Angle, HubState, MAX_ANGLE};
use crate::math::Scalar;

/// One entry of the queue of moves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Move {
    /// Rest to rest.
    To {
        /// The motion's shape.
        profile: Profile,
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
    },
    /// Smooth change of the rate, from what it is to `rate`, after Simo and Vu-Quoc:
    /// `θ̈ = (Δω/T)(1 − cos 2πs)`. The hub keeps turning after it.
    SpinUp {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Rate at the end, rad/s; 0 brings a turning hub to rest.
        rate: f64,
    },
    /// Rest to rest by a quintic that bulges: `θ = quintic + (1 − u²)³ Σ bₖuᵏ`, `u = 2t/T − 1`.
    /// With the bulge that [`Planner`](crate::planner::Planner) plans, the arm arrives without
    /// vibration.
    Still {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
        /// `b₀ … b₅`, rad.
        bulge: [f64; BULGE],
    },
    /// The hub keeps its rate: zero after every move but a spin-up.
    Dwell {
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
    },
    /// From the state that the hub has, at rest or turning, to an angle that it passes at a rate.
    /// The hub keeps turning after it, without acceleration.
    Pass {
        /// The motion's shape. A cubic and a trapezoid jump in acceleration; the others begin with
        /// the hub's own.
        profile: Profile,
        /// T, s; rounded to the nearest whole tick.
        duration: f64,
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
        /// Rate at the end, rad/s; 0 comes to rest there.
        rate: f64,
    },
    /// As [`Self::Pass`], in the shortest time that the bounds allow: see
    /// [`TimeOptimal::reach`](super::optimal::TimeOptimal::reach). The hub begins within them.
    Reach {
        /// Angle at the end, rad, counted from the same zero as the hub's.
        to: f64,
        /// Rate at the end, rad/s; 0 comes to rest there.
        rate: f64,
        /// Bounds of the motion, by which it is made.
        bounds: Bounds,
    },
    /// The fastest change of the rate that the bounds allow: see
    /// [`TimeOptimal::ramp`](super::optimal::TimeOptimal::ramp). The hub begins within them.
    Ramp {
        /// Rate at the end, rad/s; 0 brings a turning hub to rest.
        rate: f64,
        /// Bounds of the motion, by which it is made.
        bounds: Bounds,
    },
}

impl Move {
    /// Returns T, s, as asked for; 0 if the move takes the shortest time within its bounds.
    pub fn duration(&self) -> f64 {
        match self.kind() {
            Kind::Plain(plain) => plain.duration(),
            Kind::Pass { duration, .. } => duration,
            Kind::Shortest { .. } => 0.0,
        }
    }

    /// Returns the move with another duration, s. A still move no longer arrives still: its bulge
    /// belongs to the duration that it was planned for. A move in the shortest time stays as it is.
    #[must_use]
    pub fn lasting(self, duration: f64) -> Self {
        match self {
            Self::To { profile, to, .. } => Self::To { profile, duration, to },
            Self::SpinUp { rate, .. } => Self::SpinUp { duration, rate },
            Self::Still { to, bulge, .. } => Self::Still { duration, to, bulge },
            Self::Dwell { .. } => Self::Dwell { duration },
            Self::Pass { profile, to, rate, .. } => Self::Pass { profile, duration, to, rate },
            Self::Reach { .. } | Self::Ramp { .. } => self,
        }
    }

    /// Returns the whole number of ticks nearest to the duration, at least one.
    ///
    /// # Errors
    /// The duration is under half a tick or over 2²⁴ ticks, or none is asked for.
    pub fn ticks(&self, tick: f64) -> Result<u32, Error> {
        whole_ticks(self.duration(), tick)
    }
}

/// A [`Move`] by how it is planned.
enum Kind {
    Plain(PlainMove),
    Pass {
        profile: Profile,
        duration: f64,
        to: f64,
        rate: f64,
    },
    /// In the shortest time: to an angle, rad, or without one to any angle.
    Shortest {
        to: Option<f64>,
        rate: f64,
        bounds: Bounds,
    },
}

impl Move {
    fn kind(&self) -> Kind {
        match *self {
            Self::To { profile, duration, to } => {
                Kind::Plain(PlainMove::To { profile, duration, to })
            }
            Self::SpinUp { duration, rate } => Kind::Plain(PlainMove::SpinUp { duration, rate }),
            Self::Still { duration, to, bulge } => {
                Kind::Plain(PlainMove::Still { duration, to, bulge })
            }
            Self::Dwell { duration } => Kind::Plain(PlainMove::Dwell { duration }),
            Self::Pass { profile, duration, to, rate } => {
                Kind::Pass { profile, duration, to, rate }
            }
            Self::Reach { to, rate, bounds } => Kind::Shortest { to: Some(to), rate, bounds },
            Self::Ramp { rate, bounds } => Kind::Shortest { to: None, rate, bounds },
        }
    }
}

impl From<PlainMove> for Move {
    fn from(plain: PlainMove) -> Self {
        match plain {
            PlainMove::To { profile, duration, to } => Self::To { profile, duration, to },
            PlainMove::SpinUp { duration, rate } => Self::SpinUp { duration, rate },
            PlainMove::Still { duration, to, bulge } => Self::Still { duration, to, bulge },
            PlainMove::Dwell { duration } => Self::Dwell { duration },
        }
    }
}

impl fmt::Display for Move {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind() {
            Kind::Plain(plain) => plain.fmt(f),
            Kind::Pass { profile, duration, to, rate } => {
                write!(f, "{profile} to {to} rad at {rate} rad/s in {duration} s")
            }
            Kind::Shortest { to: Some(to), rate, .. } => {
                write!(f, "reach {to} rad at {rate} rad/s in the shortest time")
            }
            Kind::Shortest { to: None, rate, .. } => {
                write!(f, "ramp to {rate} rad/s in the shortest time")
            }
        }
    }
}

impl Sealed for Move {}

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
