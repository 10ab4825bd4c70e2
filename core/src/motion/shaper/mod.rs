//! Input shapers: a motion convolved with a few pulses, so that the vibrations they start cancel.
//!
//! A shaper is a table of at most five pulses; a motion passes it by being summed with its own
//! delayed copies ([`Shaped`]). Where a still move ends at rest with no delay and follows the arm's
//! exact kinematics, a shaper adds half a period or more and takes the arm for linear; it needs no
//! more than a frequency and a damping ratio, and fits any motion.
//!
//! Sources: Singer and Seering 1990 (ZV, ZVD), Singhose, Seering and Singer 1994 (EI, two-hump EI),
//! Rappole, Singer and Seering 1993 (three pulses within three quarters of a period: MZV).

mod kink;
mod shaped;

pub use kink::Kink;
pub(crate) use kink::ORDERS;
pub use shaped::Shaped;

use core::f64::consts::{PI, SQRT_2};
use core::fmt;

use heapless::Vec;

use crate::Error;
use crate::math::sqrt;

/// Most pulses of a shaper.
pub const MAX_PULSES: usize = 5;

/// A share of the motion and how much later it comes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Share; those of a shaper add up to 1.
    pub amplitude: f64,
    /// s, not in whole ticks in general.
    pub delay: f64,
}

/// A table of pulses, by rising delay.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Shaper {
    pulses: Vec<Pulse, MAX_PULSES>,
}

/// The shapers that follow from a frequency and a damping ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShaperKind {
    /// Zero vibration: two pulses half a period apart.
    Zv,
    /// Zero vibration and derivative: three pulses over one period.
    Zvd,
    /// Three pulses over three quarters of a period: between the two.
    Mzv,
    /// Extra insensitive: as long as ZVD, 5 % of vibration at the frequency itself for a wider
    /// band.
    Ei,
    /// Two-hump extra insensitive: four pulses over one and a half periods, 5 % within the band.
    TwoHumpEi,
}

impl ShaperKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Zv, Self::Mzv, Self::Zvd, Self::Ei, Self::TwoHumpEi];

    /// Name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Zv => "zv",
            Self::Zvd => "zvd",
            Self::Mzv => "mzv",
            Self::Ei => "ei",
            Self::TwoHumpEi => "2hump-ei",
        }
    }

    /// Returns the delay of the last pulse in damped periods.
    pub fn periods(self) -> f64 {
        match self {
            Self::Zv => 0.5,
            Self::Mzv => 0.75,
            Self::Zvd | Self::Ei => 1.0,
            Self::TwoHumpEi => 1.5,
        }
    }
}

impl fmt::Display for ShaperKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Vibration that EI and two-hump EI leave at their frequency, of the unshaped one.
const TOLERATED: f64 = 0.05;

impl Shaper {
    /// Computes the pulses for a vibration of `frequency` Hz (undamped, 0.01 to 10,000) and damping
    /// ratio `damping`, 0 to 0.9.
    pub fn new(kind: ShaperKind, frequency: f64, damping: f64) -> Result<Self, Error> {
        let frequency = Error::check("shaper.frequency", frequency, 0.01, 1e4, "Hz")?;
        let zeta = Error::check("shaper.damping", damping, 0.0, 0.9, "")?;
        let shrink = sqrt(1.0 - zeta * zeta);
        let period = 1.0 / (frequency * shrink);
        // Amplitude of the vibration after so many damped periods, of what it was.
        let decay = |periods: f64| libm::exp(-2.0 * periods * zeta * PI / shrink);
        let v = TOLERATED;
        let shares: &[(f64, f64)] = match kind {
            ShaperKind::Zv => &[(1.0, 0.0), (1.0, 0.5)],
            ShaperKind::Zvd => &[(1.0, 0.0), (2.0, 0.5), (1.0, 1.0)],
            ShaperKind::Mzv => {
                &[(1.0 - 1.0 / SQRT_2, 0.0), (SQRT_2 - 1.0, 0.375), (1.0 - 1.0 / SQRT_2, 0.75)]
            }
            ShaperKind::Ei => &[(1.0 + v, 0.0), (2.0 * (1.0 - v), 0.5), (1.0 + v, 1.0)],
            ShaperKind::TwoHumpEi => {
                let square = v * v;
                let x = libm::cbrt(square * (sqrt(1.0 - square) + 1.0));
                let outer = (3.0 * x * x + 2.0 * x + 3.0 * square) / (16.0 * x);
                &[(outer, 0.0), (0.5 - outer, 0.5), (0.5 - outer, 1.0), (outer, 1.5)]
            }
        };
        let pulses = shares.iter().map(|&(share, periods)| Pulse {
            amplitude: share * decay(periods),
            delay: periods * period,
        });
        Ok(Self::normalised(pulses))
    }

    /// Takes any table of one to five pulses: delays from 0 s on, rising; amplitudes with a
    /// positive sum, which is made 1.
    pub fn custom(pulses: &[Pulse]) -> Result<Self, Error> {
        Error::check("shaper.pulses", pulses.len() as f64, 1.0, MAX_PULSES as f64, "pulses")?;
        let mut before = 0.0;
        for pulse in pulses {
            before = Error::check("shaper.delay", pulse.delay, before, 1e4, "s")?;
            Error::check("shaper.amplitude", pulse.amplitude, -100.0, 100.0, "")?;
        }
        let sum: f64 = pulses.iter().map(|pulse| pulse.amplitude).sum();
        Error::check("shaper.amplitude", sum, 1e-6, 500.0, "in all")?;
        Ok(Self::normalised(pulses.iter().copied()))
    }

    fn normalised(pulses: impl Iterator<Item = Pulse>) -> Self {
        let mut pulses: Vec<Pulse, MAX_PULSES> = pulses.collect();
        let sum: f64 = pulses.iter().map(|pulse| pulse.amplitude).sum();
        for pulse in &mut pulses {
            pulse.amplitude /= sum;
        }
        Self { pulses }
    }

    /// Returns the table of pulses, by rising delay.
    pub fn pulses(&self) -> &[Pulse] {
        &self.pulses
    }

    /// Time that the shaper adds to a motion, s.
    pub fn delay(&self) -> f64 {
        self.pulses.last().map_or(0.0, |pulse| pulse.delay)
    }
}
