//! Profiles of moves from rest to rest, and the ticks of a duration.

use core::f64::consts::TAU;
use core::fmt;

use super::Peaks;
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

/// Returns the whole number of ticks of `tick` s nearest to `duration` s, at least one.
///
/// # Errors
/// The duration is under half a tick or over 2²⁴ ticks.
pub(super) fn whole_ticks(duration: f64, tick: f64) -> Result<u32, Error> {
    let most = tick * f64::from(MAX_TICKS);
    let duration = Error::check("move.duration", duration, 0.5 * tick, most, "s")?;
    Ok(((duration / tick + 0.5) as u32).max(1))
}

#[cfg(test)]
mod tests {
    use super::{Profile, whole_ticks};

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
        let ticks = |duration: f64| whole_ticks(duration, 0.01);
        assert_eq!(ticks(0.0149), Ok(1));
        assert_eq!(ticks(0.0151), Ok(2));
        assert_eq!(ticks(0.0051), Ok(1));
        assert!(ticks(0.0049).is_err() && ticks(f64::NAN).is_err());
    }
}
