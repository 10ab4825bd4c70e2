//! Peaks of a move as a function of its duration, and the shortest duration that keeps the limits.

use core::f64::consts::TAU;

use super::{Limits, Peaks, Profile, Remedy};
use crate::Error;
use crate::error::MAX_TICKS;

/// A move's motion but for its duration.
#[derive(Clone, Copy, Debug)]
pub(super) enum Demand {
    /// Rest to rest, by an angle in rad.
    Turn(Profile, f64),
    /// A change of the rate, rad/s.
    Spin { from: f64, to: f64 },
    /// A rate that is held, rad/s.
    Hold(f64),
    /// A curve that is made for its duration; in another it is another move.
    Curve(Peaks),
}

impl Demand {
    /// Greatest magnitudes if the move takes `duration` s. For a spin-up by Δω: 2Δω/T of
    /// acceleration, 2πΔω/T² of jerk.
    #[inline(always)]
    fn peaks(&self, duration: f64) -> Peaks {
        match *self {
            Self::Turn(profile, angle) => profile.peaks(angle, duration),
            Self::Spin { from, to } => {
                let change = (to - from).abs() / duration;
                Peaks {
                    rate: from.abs().max(to.abs()),
                    acceleration: 2.0 * change,
                    jerk: TAU * change / duration,
                }
            }
            Self::Hold(rate) => Peaks { rate: rate.abs(), acceleration: 0.0, jerk: 0.0 },
            Self::Curve(peaks) => peaks,
        }
    }

    /// The peaks in `ticks` ticks of `tick` s, if they keep the limits and a radian a tick.
    #[inline(always)]
    pub fn admit(&self, limits: &Limits, ticks: u32, tick: f64) -> Result<Peaks, Error> {
        let peaks = self.peaks(f64::from(ticks) * tick);
        admit(&self.held(limits), &peaks, tick).map(|()| peaks)
    }

    /// Returns the limits that the motion is held against: a change of the rate that keeps its sign
    /// has accelerations of one kind.
    #[inline(always)]
    fn held(&self, limits: &Limits) -> Limits {
        match *self {
            Self::Spin { from, to } if from * to >= 0.0 && from.abs() >= to.abs() => {
                limits.of_slowing()
            }
            Self::Spin { from, to } if from * to >= 0.0 => limits.of_speeding(),
            _ => *limits,
        }
    }

    /// Returns the shortest duration in whole ticks that keeps every limit, or why none does. It is
    /// found by bisection, as no peak grows with the duration.
    pub fn remedy(&self, limits: &Limits, tick: f64) -> Remedy {
        let limits = &self.held(limits);
        let peaks = |ticks: u32| self.peaks(f64::from(ticks) * tick);
        let fits = |ticks: u32| admit(limits, &peaks(ticks), tick).is_ok();
        if !fits(MAX_TICKS) {
            // A limit that the longest move exceeds is exceeded by every shorter one.
            let peaks = peaks(MAX_TICKS);
            return match *self {
                Self::Turn(..) if peaks.jerk.is_infinite() && limits.jerk.is_some() => {
                    Remedy::Smoother
                }
                Self::Hold(rate) => Remedy::Slower(rate),
                Self::Spin { from, to } if !slow(limits, &peaks, tick) => {
                    Remedy::Slower(if to.abs() < from.abs() { from } else { to })
                }
                _ => Remedy::Nearer(f64::from(MAX_TICKS) * tick),
            };
        }
        let (mut fails, mut least) = (0, MAX_TICKS);
        while least - fails > 1 {
            let middle = fails + (least - fails) / 2;
            if fits(middle) {
                least = middle;
            } else {
                fails = middle;
            }
        }
        Remedy::Duration(f64::from(least) * tick)
    }
}

/// True if the rate alone is within what is allowed.
fn slow(limits: &Limits, peaks: &Peaks, tick: f64) -> bool {
    admit(limits, &Peaks { acceleration: 0.0, jerk: 0.0, ..*peaks }, tick).is_ok()
}

/// Refuses peaks above a limit, more than a radian a tick, and peaks that are no numbers.
pub(crate) fn admit(limits: &Limits, peaks: &Peaks, tick: f64) -> Result<(), Error> {
    limits.admit(peaks)?;
    if peaks.rate * tick <= 1.0 {
        Ok(())
    } else {
        Err(Error::TooFast { rate: peaks.rate, max: 1.0 / tick })
    }
}
