//! The moves a user can ask for.

use core::f64::consts::TAU;
use core::fmt;

use super::optimal::Bounds;
use super::plain::Kind;
use super::{BULGE, Peaks};
use crate::Error;
use crate::error::MAX_TICKS;

/// The shape of a rest-to-rest move over `s = t/T ∈ 0..1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Profile {
    /// `3s² − 2s³`, the profile that explains the paper's runs. The acceleration jumps at both
    /// ends.
    Cubic,
    /// `10s³ − 15s⁴ + 6s⁵`.
    Quintic,
    /// `s − sin(2πs)/2π`.
    Cycloid,
    /// Constant acceleration, rate, deceleration, a third of the time each. The acceleration
    /// jumps four times.
    Trapezoid,
    /// Constant jerk in seven equal stretches: + 0 − 0 − 0 +.
    SCurve,
}

impl Profile {
    /// All profiles.
    pub const ALL: [Self; 5] =
        [Self::Cubic, Self::Quintic, Self::Cycloid, Self::Trapezoid, Self::SCurve];

    /// Returns the name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cubic => "cubic",
            Self::Quintic => "quintic",
            Self::Cycloid => "cycloid",
            Self::Trapezoid => "trapezoid",
            Self::SCurve => "s-curve",
        }
    }

    /// Returns the profile of that name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|profile| profile.name() == name)
    }

    /// Returns the peaks of a turn by `angle` rad in `duration` s.
    ///
    /// Cubic 1.5, 6; quintic 1.875, 10/√3, 60; cycloid 2, 2π, 4π²; trapezoid 1.5, 4.5;
    /// S-curve 1.75, 6.125, 42.875: times angle over T, T², T³.
    pub fn peaks(self, angle: f64, duration: f64) -> Peaks {
        let (rate, acceleration, jerk) = match self {
            Self::Cubic => (1.5, 6.0, f64::INFINITY),
            Self::Quintic => (1.875, 5.773_502_691_896_258, 60.0),
            Self::Cycloid => (2.0, TAU, TAU * TAU),
            Self::Trapezoid => (1.5, 4.5, f64::INFINITY),
            Self::SCurve => (1.75, 6.125, 42.875),
        };
        let scale = angle.abs() / duration;
        Peaks {
            rate: rate * scale,
            acceleration: acceleration * scale / duration,
            // A move of zero length has no jumps.
            jerk: if angle == 0.0 { 0.0 } else { jerk * scale / (duration * duration) },
        }
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

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

/// Returns the whole number of ticks of `tick` s nearest to `duration` s, at least one.
///
/// # Errors
/// The duration is under half a tick or over 2²⁴ ticks.
pub(super) fn whole_ticks(duration: f64, tick: f64) -> Result<u32, Error> {
    let most = tick * f64::from(MAX_TICKS);
    let duration = Error::check("move.duration", duration, 0.5 * tick, most, "s")?;
    Ok(((duration / tick + 0.5) as u32).max(1))
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

#[cfg(test)]
mod tests {
    use super::{Move, Profile};

    #[test]
    fn names_are_found_again() {
        for profile in Profile::ALL {
            assert_eq!(Profile::named(profile.name()), Some(profile));
        }
        assert_eq!(Profile::named("bang-bang"), None);
    }

    /// Half the time: twice the rate, four times the acceleration, eight times the jerk.
    #[test]
    fn peaks_scale_with_the_duration() {
        for profile in Profile::ALL {
            let (slow, fast) = (profile.peaks(-1.5, 2.0), profile.peaks(1.5, 1.0));
            assert_eq!(fast.rate, 2.0 * slow.rate, "{}", profile.name());
            assert_eq!(fast.acceleration, 4.0 * slow.acceleration, "{}", profile.name());
            assert_eq!(fast.jerk, 8.0 * slow.jerk, "{}", profile.name());
            assert_eq!(profile.peaks(0.0, 1.0).jerk, 0.0, "no move has no jumps");
        }
    }

    #[test]
    fn durations_are_rounded_to_the_nearest_tick() {
        let ticks = |duration: f64| Move::Dwell { duration }.ticks(0.01);
        assert_eq!(ticks(0.0149), Ok(1));
        assert_eq!(ticks(0.0151), Ok(2));
        assert_eq!(ticks(0.0051), Ok(1));
        assert!(ticks(0.0049).is_err() && ticks(f64::NAN).is_err());
    }
}
