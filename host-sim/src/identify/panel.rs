//! Logs and their fits, for pictures.

use super::forced::{Forced, Record};
use super::ringdown::{Excerpt, Ringdown};

/// Measured and fitted values of a log, for a picture.
#[derive(Clone, Debug)]
pub struct Panel {
    /// The log.
    pub log: String,
    /// Times from the first row, s.
    pub time: Vec<f64>,
    /// Hub angle at those times, rad. Empty where the log has none.
    pub hub: Vec<f64>,
    /// The sensor.
    pub measured: Vec<f64>,
    /// The model.
    pub fitted: Vec<f64>,
}

impl Panel {
    /// Takes a ring-down.
    pub(super) fn of_ringdown(ringdown: &Ringdown) -> Self {
        let Excerpt { name, begin, time, value } = &ringdown.excerpt;
        Self {
            log: name.clone(),
            time: time.iter().map(|t| begin + t).collect(),
            hub: Vec::new(),
            measured: value.as_slice().to_vec(),
            fitted: (value - &ringdown.solution.residual).as_slice().to_vec(),
        }
    }

    /// Takes a record of a forced vibration.
    pub(super) fn of_record(fit: &Forced, record: &Record) -> Self {
        let (measured, fitted) = fit.prediction(record);
        Self {
            log: record.name.clone(),
            time: record.time.clone(),
            hub: record.hub.clone(),
            measured: measured.as_slice().to_vec(),
            fitted: fitted.as_slice().to_vec(),
        }
    }
}
