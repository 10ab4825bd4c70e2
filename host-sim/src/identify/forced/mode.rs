//! The figures of a mode of a forced vibration.

use std::f64::consts::TAU;

use super::fit::Forced;
use super::model::Record;
use crate::identify::report::ModeReport;

impl Forced {
    /// Returns the figures of a mode.
    pub fn report(&self, mode: usize) -> ModeReport {
        let [omega, ratio] = self.mode(mode);
        let [omegas, ratios] = self.intervals(mode);
        let hz = |omega: f64| omega / TAU;
        let values = &self.records[0].value;
        let half = 0.5 * (values.max() - values.min());
        ModeReport {
            frequency_hz: hz(omega),
            frequency_interval_hz: omegas.map(hz),
            damping_ratio: ratio,
            damping_interval: ratios.map(|ratio| ratio.min(1.0)),
            periods: self.records.iter().map(Record::length).sum::<f64>() * hz(omega),
            amplitude: [half, 0.0],
            large_frequency_hz: None,
            large_damping_ratio: None,
        }
    }
}
