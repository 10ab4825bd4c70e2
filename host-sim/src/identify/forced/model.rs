//! The sensor's signal as the hub's angle makes it.
//!
//! A mode's deflection under a turning hub is `−g s²/(s² + 2ζωs + ω²) θ = g (−1 + (2ζωs + ω²)/(s² +
//! 2ζωs + ω²)) θ`. The second form needs no derivative of the encoder. What measures accelerations
//! or torques has two further derivatives, and a term of the rigid arm. There the sensor and its
//! model both pass the same low-pass, which makes the derivatives finite.

use nalgebra::{DMatrix, DVector};

use super::filter::{Bank, Lowpass, Pair};
use crate::identify::log::{Kind, Log};
use crate::identify::separable::Separable;

/// Corner of the low-pass of sensors that measure accelerations, in first frequencies.
const CORNER: f64 = 4.0;

/// Steps of central differences: of ln ω and ln ζ, and of the delay in rad of the first mode.
const STEP: f64 = 1e-5;

/// A log in the form that is fitted.
#[derive(Clone, Debug)]
pub struct Record {
    /// The log.
    pub name: String,
    /// Times from its first row, s.
    pub time: Vec<f64>,
    /// Hub angle, rad.
    pub hub: Vec<f64>,
    /// The sensor.
    pub value: DVector<f64>,
}

impl Record {
    /// Takes a log that has a hub's angle.
    pub fn of(log: &Log) -> Self {
        Self {
            name: log.name.clone(),
            time: log.time.clone(),
            hub: log.hub.clone().unwrap_or_default(),
            value: DVector::from_column_slice(&log.sensor),
        }
    }

    /// Length, s.
    pub fn length(&self) -> f64 {
        self.time[self.time.len() - 1] - self.time[0]
    }

    /// Returns the rows between two fractions of the length.
    pub fn part(&self, from: f64, to: f64) -> Self {
        let (count, at) = (self.time.len(), |x: f64| (x * self.time.len() as f64) as usize);
        let range = at(from).min(count)..at(to).min(count);
        Self {
            name: self.name.clone(),
            time: self.time[range.clone()].to_vec(),
            hub: self.hub[range.clone()].to_vec(),
            value: DVector::from_column_slice(&self.value.as_slice()[range]),
        }
    }

    /// Returns the hub's angle `delay` s earlier, linear between the rows, from its first value.
    fn delayed_hub(&self, delay: f64) -> Vec<f64> {
        let mut k = 0;
        let last = self.time.len() - 1;
        let at = |t: f64, k: &mut usize| {
            while *k + 1 < last && self.time[*k + 1] < t {
                *k += 1;
            }
            let share = (t - self.time[*k]) / (self.time[*k + 1] - self.time[*k]);
            self.hub[*k] + share.clamp(0.0, 1.0) * (self.hub[*k + 1] - self.hub[*k])
        };
        self.time.iter().map(|t| at(t - delay, &mut k) - self.hub[0]).collect()
    }
}

/// Structure of the model.
#[derive(Clone, Copy, Debug)]
pub struct Structure {
    /// Quantity that the sensor measures.
    pub kind: Kind,
    /// Number of modes.
    pub modes: usize,
    /// Known low-pass of the sensor.
    pub lowpass: Option<Lowpass>,
    /// Roughly the first frequency, Hz.
    pub about: f64,
    /// Range of the delay, s.
    pub delay: (f64, f64),
}

impl Structure {
    /// True if the sensor measures an acceleration, or a torque.
    pub fn is_inertial(&self) -> bool {
        matches!(self.kind, Kind::Acceleration | Kind::Torque)
    }

    /// Returns the low-pass that an inertial sensor and its model pass.
    fn smoothing(&self) -> Option<Pair> {
        let lowpass = Lowpass { frequency: CORNER * self.about, ratio: 0.7 };
        self.is_inertial().then(|| lowpass.pair())
    }

    /// Returns what is compared with the model: the sensor, behind the low-pass if it is inertial.
    pub fn observed(&self, record: &Record) -> DVector<f64> {
        let Some(pair) = self.smoothing() else { return record.value.clone() };
        let first = record.value[0];
        let input = record.value.iter().map(|value| value - first).collect();
        let bank = Bank::new(&[pair], &record.time, input);
        let smooth = bank.response(&[pair.omega * pair.omega], &[0]);
        DVector::from_vec(smooth.into_iter().map(|value| value + first).collect())
    }

    /// Number of gains, which all records share.
    pub fn gains(&self) -> usize {
        self.modes + usize::from(self.is_inertial())
    }

    /// Number of columns of each record alone: an offset and the free vibration of every pole pair.
    fn own(&self) -> usize {
        1 + 2 * (self.modes + usize::from(self.lowpass.is_some()) + usize::from(self.is_inertial()))
    }

    /// Returns the columns of one record: gains, offset, free vibrations.
    pub fn columns(&self, record: &Record, p: &[f64]) -> DMatrix<f64> {
        let modes =
            (0..self.modes).map(|i| Pair { omega: p[2 * i].exp(), ratio: p[2 * i + 1].exp() });
        let filters: Vec<Pair> =
            self.lowpass.iter().map(Lowpass::pair).chain(self.smoothing()).collect();
        let pairs: Vec<Pair> = modes.chain(filters.iter().copied()).collect();
        let bank = Bank::new(&pairs, &record.time, record.delayed_hub(p[2 * self.modes]));
        let scale: f64 = filters.iter().map(|filter| filter.omega * filter.omega).product();
        let behind: Vec<usize> = (self.modes..pairs.len()).collect();
        let mut columns = Vec::new();
        for mode in 0..self.modes {
            let used: Vec<usize> = [mode].into_iter().chain(behind.iter().copied()).collect();
            let numerator: &[f64] = if self.is_inertial() {
                &[0.0, 0.0, 0.0, 0.0, -scale]
            } else {
                &[0.0, 0.0, -scale]
            };
            columns.push(bank.response(numerator, &used));
        }
        if self.is_inertial() {
            columns.push(bank.response(&[0.0, 0.0, scale], &behind));
        }
        columns.push(vec![1.0; record.time.len()]);
        let begin = record.time[0];
        for pair in &pairs {
            let pole = pair.pole();
            let free = || record.time.iter().map(|t| (pole * (t - begin)).exp());
            columns.push(free().map(|z| z.re).collect());
            columns.push(free().map(|z| z.im).collect());
        }
        let columns: Vec<DVector<f64>> = columns.into_iter().map(DVector::from_vec).collect();
        DMatrix::from_columns(&columns)
    }
}

/// The model of several records. Nonlinear unknowns: ln ω and ln ζ of each mode, the delay. Linear
/// ones: the gains, and for each record its offset and free vibrations.
#[derive(Clone, Debug)]
pub struct Model<'a> {
    pub structure: Structure,
    pub records: &'a [Record],
}

impl Model<'_> {
    /// Returns what is fitted, record after record.
    pub fn observed(&self) -> DVector<f64> {
        let all = self.records.iter().map(|record| self.structure.observed(record));
        DVector::from_vec(all.flat_map(|values| values.as_slice().to_vec()).collect())
    }

    /// Returns the slopes along all unknowns, nonlinear ones first.
    pub fn slopes(&self, p: &[f64], c: &[f64]) -> DMatrix<f64> {
        let mut columns: Vec<DVector<f64>> = (0..p.len()).map(|j| self.slope(p, c, j)).collect();
        columns.extend(self.basis(p).column_iter().map(|column| column.into_owned()));
        DMatrix::from_columns(&columns)
    }
}

impl Separable for Model<'_> {
    fn basis(&self, p: &[f64]) -> DMatrix<f64> {
        let (gains, own) = (self.structure.gains(), self.structure.own());
        let rows: usize = self.records.iter().map(|record| record.time.len()).sum();
        let mut basis = DMatrix::zeros(rows, gains + own * self.records.len());
        let mut row = 0;
        for (index, record) in self.records.iter().enumerate() {
            let columns = self.structure.columns(record, p);
            let count = columns.nrows();
            basis.view_mut((row, 0), (count, gains)).copy_from(&columns.columns(0, gains));
            basis
                .view_mut((row, gains + own * index), (count, own))
                .copy_from(&columns.columns(gains, own));
            row += count;
        }
        basis
    }

    fn slope(&self, p: &[f64], c: &[f64], j: usize) -> DVector<f64> {
        let is_delay = j == 2 * self.structure.modes;
        let step = if is_delay { STEP / p[0].exp() } else { STEP };
        let c = DVector::from_column_slice(c);
        let at = |step: f64| {
            let mut p = p.to_vec();
            p[j] += step;
            self.basis(&p) * &c
        };
        (at(step) - at(-step)) / (2.0 * step)
    }

    fn ranges(&self) -> Vec<(f64, f64)> {
        let about = (std::f64::consts::TAU * self.structure.about).ln();
        let mode =
            |i: usize| if i == 0 { (about - 1.5, about + 1.5) } else { (about, about + 5.0) };
        let modes = (0..self.structure.modes).flat_map(|i| [mode(i), (-9.0, -0.1)]);
        modes.chain([self.structure.delay]).collect()
    }
}
