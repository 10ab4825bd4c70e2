//! A measured log: columns of a CSV by name, in SI units, times from 0.

mod columns;
mod read;

use clap::ValueEnum;

pub use columns::{Columns, Kind};

use crate::error::Error;

/// A log as read.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// The file.
    pub name: String,
    /// Times from the first row, s, rising.
    pub time: Vec<f64>,
    /// Hub angle, rad, if there is a column of it.
    pub hub: Option<Vec<f64>>,
    /// Readings of the sensor, in `unit`.
    pub sensor: Vec<f64>,
    /// Name of the sensor's column.
    pub column: String,
    /// Quantity that the sensor measures.
    pub kind: Kind,
    /// SI unit of the sensor's numbers, or the name of one that is none.
    pub unit: String,
    /// Rows whose time is that of the row before; they are left out.
    pub same_time: usize,
    /// Rows without a finite number in a column that is read; they are left out.
    pub empty: usize,
}

/// Direction in which the sensor counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Sign {
    /// Towards growing hub angles, as the tip's deflection in the hub's frame does.
    #[default]
    #[value(name = "+")]
    Plus,
    /// Against them.
    #[value(name = "-")]
    Minus,
}

impl Log {
    /// Keeps the rows between two times from the first row, s.
    ///
    /// # Errors
    /// An error is returned if fewer than eight rows are left.
    pub fn between(mut self, from: Option<f64>, to: Option<f64>) -> Result<Self, Error> {
        let (low, high) = (from.unwrap_or(f64::NEG_INFINITY), to.unwrap_or(f64::INFINITY));
        if low.is_nan() || high.is_nan() || low >= high {
            return Err(Error::new(format_args!(
                "--from = {low}: must be less than --to = {high}, both in s from the first row"
            )));
        }
        let end = self.time.last().copied().unwrap_or(0.0);
        let kept: Vec<bool> = self.time.iter().map(|t| (low..=high).contains(t)).collect();
        self.keep(&kept);
        if self.time.len() < FEWEST {
            return Err(Error::new(format_args!(
                "{}: {} rows between --from and --to; must be at least {FEWEST}, the log is from 0 to \
                 {end:.3} s",
                self.name,
                self.time.len()
            )));
        }
        Ok(self)
    }

    /// Keeps the rows that are marked.
    pub fn keep(&mut self, marked: &[bool]) {
        let retain = |values: &mut Vec<f64>| {
            let mut marks = marked.iter();
            values.retain(|_| *marks.next().unwrap_or(&true));
        };
        retain(&mut self.time);
        retain(&mut self.sensor);
        self.hub.iter_mut().for_each(retain);
    }

    /// Returns the median time between rows, s.
    pub fn interval(&self) -> f64 {
        let mut steps: Vec<f64> = self.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        steps[steps.len() / 2]
    }

    /// Returns half the mean rate of the rows, Hz.
    pub fn nyquist(&self) -> f64 {
        let count = self.time.len();
        0.5 * (count - 1) as f64 / (self.time[count - 1] - self.time[0])
    }
}

/// Fewest rows of a log.
pub(super) const FEWEST: usize = 8;
