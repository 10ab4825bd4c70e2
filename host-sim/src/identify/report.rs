//! Identified arms in numbers. Field names carry their units, as they stand in JSON.

use serde::Serialize;

/// One natural mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeReport {
    /// Natural frequency without damping, of small vibrations, Hz.
    pub frequency_hz: f64,
    /// Its 95 % interval.
    pub frequency_interval_hz: [f64; 2],
    /// Damping ratio of small vibrations.
    pub damping_ratio: f64,
    /// Its 95 % interval.
    pub damping_interval: [f64; 2],
    /// Periods that were seen.
    pub periods: f64,
    /// Amplitudes that it was seen at, first and last, in the sensor's unit.
    pub amplitude: [f64; 2],
    /// Frequency at the first of them, Hz, if it changes with the amplitude.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub large_frequency_hz: Option<f64>,
    /// Damping ratio at the first of them, if it changes with the amplitude.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub large_damping_ratio: Option<f64>,
}

/// Result of an identification from logs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// `ring-down` or `forced`.
    pub case: &'static str,
    /// The logs that were fitted.
    pub logs: Vec<String>,
    /// The log that was held out, if there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub validation_log: Option<String>,
    /// Name of the sensor's column.
    pub sensor: String,
    /// SI unit of the sensor.
    pub unit: String,
    /// Part of the first log that was fitted, s from its first row.
    pub used_s: [f64; 2],
    /// Modes, the first one first.
    pub modes: Vec<ModeReport>,
    /// `100 (1 − ‖y − ŷ‖/‖y − ȳ‖)` of what was fitted.
    pub fit_percent: f64,
    /// The same of what was held out.
    pub validation_percent: f64,
    /// Delay of the sensor behind the hub's angle, s. Absent without a hub's angle.
    pub delay_s: Option<f64>,
    /// Gain from the hub's angle to the sensor, sensor units per rad. Absent without a hub's angle.
    pub scale: Option<f64>,
    /// Reading of the sensor at rest.
    pub offset: f64,
    /// Frequencies of vibrations beside the modes that were fitted too, Hz.
    pub other_frequencies_hz: Vec<f64>,
    /// The arm's parameters by its modes. Absent without a scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm: Option<ArmFit>,
    /// Warnings to read before trusting it.
    pub warnings: Vec<String>,
}

/// A value of the scene that was fitted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fitted {
    /// Key of the scene file.
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// As the scene has it. Absent if it has none.
    pub documented: Option<f64>,
    /// As fitted.
    pub fitted: f64,
    /// Its 95 % interval, from that of the first frequency.
    pub interval: [f64; 2],
}

impl Fitted {
    /// Returns fitted over documented, less one, in %.
    pub fn change_percent(&self) -> Option<f64> {
        self.documented.map(|documented| 100.0 * (self.fitted / documented - 1.0))
    }
}

/// Parameters of a scene's arm by its modes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArmFit {
    /// The scene.
    pub scene: String,
    /// Fitted values.
    pub values: Vec<Fitted>,
    /// Frequencies of the scene as documented, the sensor's mass on it, Hz.
    pub documented_frequency_hz: Vec<f64>,
    /// Frequencies of the fitted arm, the sensor's mass on it, Hz.
    pub fitted_frequency_hz: Vec<f64>,
    /// Frequencies of the fitted arm without the sensor's mass, Hz.
    pub bare_frequency_hz: Vec<f64>,
    /// α, 1/s.
    pub alpha_per_s: f64,
    /// β, s.
    pub beta_s: f64,
}
