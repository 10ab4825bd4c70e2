//! Warnings to read before trusting an identified arm.

use std::fmt;

/// Something in a log, or in what was found in it, that makes a figure less certain.
#[allow(missing_docs, reason = "the sentence of each variant says what its fields are")]
#[derive(Clone, Debug, PartialEq)]
pub enum Warning {
    /// Rows were left out.
    LeftOut { log: String, same_time: usize, empty: usize },
    /// Samples at the limit of the sensor's range were dropped.
    Clipped { log: String, count: usize, last_s: f64 },
    /// Samples that repeat the one before were dropped.
    Repeated { log: String, percent: f64 },
    /// Rows are missing.
    Gaps { log: String, count: usize, longest_s: f64 },
    /// Times are uneven.
    Jitter { log: String, percent: f64 },
    /// The arm was excited once more.
    SecondExcitation { log: String, at_s: f64 },
    /// Damping, and with it the frequency, changes with the amplitude.
    AmplitudeDependent { small: [f64; 2], large: [f64; 2], amplitude: [f64; 2], unit: String },
    /// Parts of a log, or logs, disagree by more than noise makes them.
    WindowsDisagree { percent: f64, hz: [f64; 2] },
    /// The record is short.
    FewPeriods { periods: f64 },
    /// The fit leaves much of the record unexplained.
    PoorFit { percent: f64 },
    /// A mode that was asked for is not in the log.
    NoMode { mode: usize },
    /// A mode lies at a multiple of the first.
    Harmonic { mode: usize, times: usize },
    /// A mode was not taken because it lies too high for the sampling.
    AboveNyquist { mode: usize, frequency: f64, limit: f64 },
    /// Vibrations beside the modes were fitted.
    Others { hz: Vec<f64> },
    /// Lightly damped modes that the record is too short to tell the damping of.
    DampingUnknown { mode: usize, interval: [f64; 2] },
    /// The hub did not move.
    HubAtRest { range: f64 },
    /// Unknowns that the log cannot tell apart.
    Inseparable { one: &'static str, other: &'static str, correlation: f64 },
    /// The delay is at an end of its range.
    DelayAtBound { delay_s: f64, bound: &'static str },
    /// The delay makes up a good part of a period.
    LongDelay { delay_s: f64, percent: f64 },
    /// The part of the record that is held out for validation is quiet.
    QuietValidation { percent: f64 },
    /// The validation is far worse than the fit.
    PoorValidation { fit: f64, validation: f64 },
    /// The sensor's gain is not what the arm's theory gives.
    Gain { measured: f64, theory: f64 },
    /// The hub's angle does not explain the vibration: likely gear play.
    Play { percent: f64, share: f64 },
    /// The arm's frequency is far from what its scene gives.
    FarFromScene { measured: f64, theory: f64 },
    /// The higher modes do not fit the arm.
    ModesMisfit { percent: f64 },
    /// α and β cannot give the damping ratios of both modes.
    DampingNotRayleigh { first: f64, second: f64 },
    /// The sensor's mass is not in the arm.
    SensorMassUnknown,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LeftOut { log, same_time, empty } => write!(
                f,
                "{log}: {same_time} rows with the time of the row before and {empty} rows without a \
                 number were left out"
            ),
            Self::Clipped { log, count, last_s } => write!(
                f,
                "{log}: {count} clipped samples were dropped, the last at {last_s:.3} s: the sensor's \
                 range is too small"
            ),
            Self::Repeated { log, percent } => write!(
                f,
                "{log}: {percent:.1} % of the samples repeat the one before and were dropped: the \
                 logger is faster than the sensor"
            ),
            Self::Gaps { log, count, longest_s } => {
                write!(f, "{log}: {count} gaps in the times, the longest of {longest_s:.4} s")
            }
            Self::Jitter { log, percent } => {
                write!(f, "{log}: intervals between rows vary by {percent:.0} %")
            }
            Self::SecondExcitation { log, at_s } => write!(
                f,
                "{log}: the arm was excited again at {at_s:.2} s; the log was used up to there"
            ),
            Self::FewPeriods { periods } => write!(
                f,
                "{periods:.1} periods of the first mode only: the damping is uncertain; record twenty \
                 or more"
            ),
            Self::PoorFit { percent } => {
                write!(
                    f,
                    "the fit explains {percent:.1} % of the record only: look at the residual"
                )
            }
            _ => self.explain_result(f),
        }
    }
}

impl Warning {
    /// Writes the warnings that are about what was found.
    fn explain_result(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AmplitudeDependent { small, large, amplitude, unit } => write!(
                f,
                "damping changes with amplitude: {:.4} Hz and {:.3} % for small vibrations, {:.4} Hz \
                 and {:.3} % at {:.3} {unit}; seen from there down to {:.3} {unit}",
                small[0],
                100.0 * small[1],
                large[0],
                100.0 * large[1],
                amplitude[0],
                amplitude[1]
            ),
            Self::WindowsDisagree { percent, hz } => write!(
                f,
                "parts of the record disagree by {percent:.2} % of the first frequency, {:.4} to {:.4} \
                 Hz, more than noise makes; the interval was widened",
                hz[0], hz[1]
            ),
            Self::NoMode { mode } => {
                write!(f, "mode {mode} does not stand out of the noise in this log")
            }
            Self::Harmonic { mode, times } => write!(
                f,
                "mode {mode} lies at {times} times the first frequency: it may be a harmonic of the \
                 first mode, do not rely on it"
            ),
            Self::AboveNyquist { mode, frequency, limit } => write!(
                f,
                "a vibration at {frequency:.2} Hz may be mode {mode}, but lies above {limit:.2} Hz, \
                 half of the Nyquist frequency; sample faster"
            ),
            Self::Others { hz } => {
                let list: Vec<String> = hz.iter().map(|f| format!("{f:.2}")).collect();
                write!(f, "vibrations beside the modes were fitted too: {} Hz", list.join(", "))
            }
            Self::DampingUnknown { mode, interval } => write!(
                f,
                "the damping of mode {mode} is known to {:.3} to {:.3} % only",
                100.0 * interval[0],
                100.0 * interval[1]
            ),
            _ => self.explain_arm(f),
        }
    }

    /// Writes the warnings that are about the arm.
    fn explain_arm(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FarFromScene { measured, theory } => write!(
                f,
                "the first mode is at {measured:.4} Hz, the scene gives {theory:.4} Hz: another mode, \
                 or not this arm?"
            ),
            Self::ModesMisfit { percent } => write!(
                f,
                "frequencies of several modes fit the arm to {percent:.1} % only: mass or stiffness \
                 are spread otherwise than the scene says"
            ),
            Self::DampingNotRayleigh { first, second } => write!(
                f,
                "damping ratios of {:.3} and {:.3} % need a negative alpha or beta; the first mode's \
                 is kept",
                100.0 * first,
                100.0 * second
            ),
            Self::SensorMassUnknown => write!(
                f,
                "--sensor-mass is not given: a sensor at the tip lowers the frequency, and what is \
                 fitted contains it"
            ),
            _ => self.explain_forced(f),
        }
    }

    /// Writes the warnings of a log with a hub's angle.
    fn explain_forced(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HubAtRest { range } => write!(
                f,
                "the hub never moved, its angle varies by {range:.2e} rad: taken as a ring-down"
            ),
            Self::Inseparable { one, other, correlation } => write!(
                f,
                "{one} and {other} cannot be told apart in this log (correlation {correlation:.3}): a \
                 livelier motion would, or give one of them"
            ),
            Self::DelayAtBound { delay_s, bound } => write!(
                f,
                "the delay of {:.1} ms is at the {bound} end of its range: the hub's column may be \
                 late, or the sensor have a filter (--sensor-lowpass)",
                1e3 * delay_s
            ),
            Self::LongDelay { delay_s, percent } => write!(
                f,
                "the sensor lags by {:.1} ms, {percent:.0} % of a period: a filter in it? \
                 --sensor-lowpass takes a known one",
                1e3 * delay_s
            ),
            Self::QuietValidation { percent } => write!(
                f,
                "the part for validation is quiet, {percent:.0} % of the fitted part's motion: its \
                 figure says little; give a second log"
            ),
            Self::PoorValidation { fit, validation } => write!(
                f,
                "the model explains {fit:.1} % of what it was fitted to but {validation:.1} % of what \
                 was held out"
            ),
            Self::Gain { measured, theory } => write!(
                f,
                "the sensor's gain is {measured:.4} per rad, the arm's theory gives {theory:.4}: check \
                 its calibration, its place and --sign"
            ),
            Self::Play { percent, share } => write!(
                f,
                "likely gear play: the hub's angle explains {percent:.0} % of the sensor only, and \
                 {share:.0} % of the rest vibrates near the arm's own frequency; frequency and damping \
                 are not to be trusted. Measure the angle behind the gear, or record a ring-down with \
                 the hub held"
            ),
            _ => Ok(()),
        }
    }
}
