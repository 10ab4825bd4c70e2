//! Warnings that the modes of a ring-down give rise to.

use super::report::ModeReport;
use super::ringdown::Estimate;
use super::warning::Warning;

/// Periods below which the damping is uncertain.
const FEW: f64 = 8.0;

/// Relative width of an interval of the damping from which it counts as unknown.
const WIDE: f64 = 1.0;

/// Disagreement of a record's parts that is worth a warning.
const DISAGREE: f64 = 5e-4;

/// Warns of modes that are seen briefly, change with the amplitude, or of which the parts of the
/// record disagree. `first` are the estimates of the first mode, one a log.
pub fn of_modes(modes: &[ModeReport], first: &[Estimate], unit: &str, warnings: &mut Vec<Warning>) {
    let main = &modes[0];
    if let (Some(hz), Some(ratio)) = (main.large_frequency_hz, main.large_damping_ratio) {
        warnings.push(Warning::AmplitudeDependent {
            small: [main.frequency_hz, main.damping_ratio],
            large: [hz, ratio],
            amplitude: main.amplitude,
            unit: unit.to_owned(),
        });
    }
    if main.periods < FEW {
        warnings.push(Warning::FewPeriods { periods: main.periods });
    }
    for estimate in first.iter().filter(|estimate| estimate.spread.excess[0] > DISAGREE) {
        let percent = 100.0 * estimate.spread.excess[0];
        warnings.push(Warning::WindowsDisagree { percent, hz: estimate.spread.range });
    }
    for (index, mode) in modes.iter().enumerate() {
        let interval = mode.damping_interval;
        if interval[1] - interval[0] > WIDE * mode.damping_ratio {
            warnings.push(Warning::DampingUnknown { mode: index + 1, interval });
        }
    }
}
