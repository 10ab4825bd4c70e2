//! Frequency, damping, gain and delay from logs with a hub's angle.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::filter::Lowpass;
use super::model::{Model, Record, Structure};
use super::verdict;
use crate::error::Error;
use crate::identify::covariance::standard_errors;
use crate::identify::fit_percent;
use crate::identify::log::Kind;
use crate::identify::ringdown::quantile;
use crate::identify::separable::{self, Solution};
use crate::identify::spectrum::Spectrum;
use crate::identify::warning::Warning;

/// Frequencies and damping ratios that the search starts from.
const FREQUENCIES: usize = 48;
const RATIOS: [f64; 3] = [0.01, 0.05, 0.2];

/// Starts that are followed to their end.
const FOLLOWED: usize = 3;

/// Longest delay, periods of the first mode.
const DELAY: f64 = 0.5;

/// Share of the squares without a drive that one must leave at most.
const DRIVEN: f64 = 0.8;

/// Share of a single log that is fitted; the rest is held out.
const SHARE: f64 = 0.6;

/// Request for forced logs.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// Modes.
    pub modes: usize,
    /// Quantity that the sensor measures.
    pub kind: Kind,
    /// Known low-pass of the sensor.
    pub lowpass: Option<Lowpass>,
    /// Frequencies that the scene gives, Hz.
    pub theory: Option<&'a [f64]>,
}

/// A fitted model of forced logs.
#[derive(Clone, Debug)]
pub struct Forced {
    /// Structure of the model.
    pub structure: Structure,
    /// The records that were fitted.
    pub records: Vec<Record>,
    /// The unknowns.
    pub solution: Solution,
    /// Standard errors of ln ω and ln ζ of each mode, and of the delay.
    pub errors: Vec<f64>,
    /// Standard deviation of ln ω and ln ζ of the first mode between records, or between parts of
    /// one, beyond their errors.
    pub spread: [f64; 2],
    /// How much of what was held out is explained, %.
    pub validation_percent: f64,
}

/// Fits the records together; `held` is kept out for validation.
///
/// # Errors
/// An error is returned if the fit explains nothing of the sensor, if there are less than two
/// periods, or if the first mode lies above half of the Nyquist frequency.
pub fn identify(
    records: Vec<Record>,
    held: Option<&Record>,
    asked: &Asked<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Forced, Error> {
    let rate = |record: &Record| (record.time.len() - 1) as f64 / record.length();
    let limit = 0.25 * records.iter().map(rate).fold(f64::INFINITY, f64::min);
    let length = records.iter().map(Record::length).fold(0.0, f64::max);
    let (structure, solution) = search(&records, asked, length, limit)?;
    let name = records[0].name.clone();
    let first = solution.p[0].exp() / TAU;
    if first > limit {
        return Err(Error::new(format_args!(
            "{name}: the first mode is at {first:.2} Hz; must be below {limit:.2} Hz, half of the \
             Nyquist frequency"
        )));
    }
    if length * first < 2.0 {
        return Err(Error::new(format_args!(
            "{name}: {:.2} periods of {first:.3} Hz; must be at least 2: record for {:.1} s or longer",
            length * first,
            20.0 / first
        )));
    }
    let model = Model { structure, records: &records };
    let lag = ((3.0 / first * rate(&records[0])) as usize).min(records[0].time.len() / 5);
    let unknowns = solution.p.len();
    let wanted: Vec<usize> = (0..unknowns).collect();
    let slopes = model.slopes(&solution.p, &solution.c);
    let errors = standard_errors(&slopes, &solution.residual, &wanted, lag);
    verdict::inseparable(&slopes, &structure, warnings);
    verdict::delay(&model, &solution, warnings);
    let spread = verdict::spread(&records, &structure, &solution, warnings);
    let validation_percent = validate(&records, held, &structure, &solution, warnings);
    let forced = Forced { structure, records, solution, errors, spread, validation_percent };
    verdict::play(&forced, warnings);
    Ok(forced)
}

/// Searches the first mode on a grid of frequencies, then adds the others one by one.
fn search(
    records: &[Record],
    asked: &Asked<'_>,
    length: f64,
    limit: f64,
) -> Result<(Structure, Solution), Error> {
    let (low, high) = match asked.theory {
        Some(theory) => (0.4 * theory[0], (2.0 * theory[0]).min(1.2 * limit)),
        None => (1.0 / length, 1.2 * limit),
    };
    let mut followed: Vec<f64> = Vec::new();
    let mut best: Option<(f64, Structure, Solution)> = None;
    for Trial { p, about, .. } in trials(records, asked, low, high) {
        if followed.iter().any(|other: &f64| (about / other).ln().abs() < 0.1) {
            continue;
        }
        followed.push(about);
        let structure = one_mode(asked, about);
        let model = Model { structure, records };
        let observed = model.observed();
        let solution = separable::fit(&model, &observed, &p);
        let left = solution.squares() / squares_about_mean(&observed);
        if best.as_ref().is_none_or(|(least, ..)| left < *least) {
            best = Some((left, structure, solution));
        }
        if followed.len() == FOLLOWED {
            break;
        }
    }
    match best {
        Some((_, structure, solution)) if is_driven(records, &structure, &solution) => {
            Ok(with_more_modes(records, structure, solution, asked, limit))
        }
        _ => Err(Error::new(format_args!(
            "{}: the hub's motion explains nothing of the sensor; must be a log of an arm that it \
             shakes: look at --hub, --sensor and --kind",
            records[0].name
        ))),
    }
}

/// A start of the search and how much of the sensor it leaves.
struct Trial {
    left: f64,
    p: [f64; 3],
    about: f64,
}

/// Returns the starts on a grid, the best first.
fn trials(records: &[Record], asked: &Asked<'_>, low: f64, high: f64) -> Vec<Trial> {
    let mut trials = Vec::new();
    for k in 0..FREQUENCIES {
        let about = low * (high / low).powf(k as f64 / (FREQUENCIES - 1) as f64);
        // Inertial sensors are compared behind a low-pass that goes with the frequency.
        let model = Model { structure: one_mode(asked, about), records };
        let observed = model.observed();
        let total = squares_about_mean(&observed);
        for ratio in RATIOS {
            for delay in [0.0, 0.1 / about] {
                let p = [(TAU * about).ln(), ratio.ln(), delay];
                let left = separable::project(&model, &observed, &p).squares() / total;
                trials.push(Trial { left, p, about });
            }
        }
    }
    trials.sort_by(|a, b| a.left.total_cmp(&b.left));
    trials
}

fn one_mode(asked: &Asked<'_>, about: f64) -> Structure {
    let Asked { kind, lowpass, .. } = *asked;
    Structure { kind, modes: 1, lowpass, about, delay: (0.0, DELAY / about) }
}

fn squares_about_mean(values: &DVector<f64>) -> f64 {
    values.add_scalar(-values.mean()).norm_squared()
}

/// True if the hub's motion explains a good part of what offsets and free vibrations do not.
fn is_driven(records: &[Record], structure: &Structure, solution: &Solution) -> bool {
    let undriven: f64 = records
        .iter()
        .map(|record| {
            let still = Solution { c: vec![0.0; structure.gains()], ..solution.clone() };
            let (observed, fitted) = predicted(record, structure, &still);
            (observed - fitted).norm_squared()
        })
        .sum();
    solution.squares() < DRIVEN * undriven
}
/// Adds modes where what is left of the sensor has its peaks.
fn with_more_modes(
    records: &[Record],
    mut structure: Structure,
    mut solution: Solution,
    asked: &Asked<'_>,
    limit: f64,
) -> (Structure, Solution) {
    while structure.modes < asked.modes {
        let count = records[0].time.len();
        let spectrum = Spectrum::of(&records[0].time, &solution.residual.as_slice()[..count]);
        let last = solution.p[2 * (structure.modes - 1)].exp() / TAU;
        let Some(peak) = spectrum.peak(2.0 * last, limit, &|_| true) else { break };
        let mut p = solution.p.clone();
        let delay = p.pop().unwrap_or(0.0);
        p.extend([(TAU * peak.frequency).ln(), 0.01_f64.ln(), delay]);
        structure.modes += 1;
        let model = Model { structure, records };
        solution = separable::fit(&model, &model.observed(), &p);
    }
    (structure, solution)
}

/// Returns how much is explained of what was not fitted, %: of the record that is held out, or of
/// the end of a single one by what its beginning gives.
fn validate(
    records: &[Record],
    held: Option<&Record>,
    structure: &Structure,
    solution: &Solution,
    warnings: &mut Vec<Warning>,
) -> f64 {
    if let Some(held) = held {
        return explained(held, structure, solution);
    }
    let (early, late) = (records[0].part(0.0, SHARE), records[0].part(SHARE, 1.0));
    let motion = |record: &Record| {
        let value = record.value.add_scalar(-record.value.mean());
        value.norm() / (value.len() as f64).sqrt()
    };
    let quiet = motion(&late) / motion(&early);
    if quiet < 0.3 {
        warnings.push(Warning::QuietValidation { percent: 100.0 * quiet });
    }
    let early = [early];
    let model = Model { structure: *structure, records: &early };
    let fitted = separable::fit(&model, &model.observed(), &solution.p);
    explained(&late, structure, &fitted)
}

/// Returns how much of a record the model explains with its gains, %. The record's offset and the
/// vibration that it begins with are its own.
pub fn explained(record: &Record, structure: &Structure, solution: &Solution) -> f64 {
    let (observed, fitted) = predicted(record, structure, solution);
    fit_percent(&observed, &(&observed - fitted))
}

/// Returns what is observed in a record and what the model makes of it.
fn predicted(
    record: &Record,
    structure: &Structure,
    solution: &Solution,
) -> (DVector<f64>, DVector<f64>) {
    let columns = structure.columns(record, &solution.p);
    let observed = structure.observed(record);
    let gains = structure.gains();
    let driven = columns.columns(0, gains) * DVector::from_column_slice(&solution.c[..gains]);
    let own: DMatrix<f64> = columns.columns(gains, columns.ncols() - gains).into_owned();
    let left = &observed - &driven;
    let free = own.clone().svd(true, true).solve(&left, 1e-9).map(|c| own * c);
    let free = free.unwrap_or_else(|_| DVector::zeros(observed.len()));
    (observed, driven + free)
}

impl Forced {
    /// Returns ω and ζ of a mode.
    pub fn mode(&self, mode: usize) -> [f64; 2] {
        [self.solution.p[2 * mode].exp(), self.solution.p[2 * mode + 1].exp()]
    }

    /// Returns the 95 % intervals of ω and ζ of a mode.
    pub fn intervals(&self, mode: usize) -> [[f64; 2]; 2] {
        let periods: f64 =
            self.records.iter().map(Record::length).sum::<f64>() * self.mode(0)[0] / TAU;
        let factor = quantile((2.0 * periods - 4.0).max(3.0));
        [0, 1].map(|k| {
            let value = self.solution.p[2 * mode + k];
            let half = factor * self.errors[2 * mode + k].hypot(self.spread[k]);
            [(value - half).exp(), (value + half).exp()]
        })
    }

    /// Delay of the sensor behind the hub's angle, s.
    pub fn delay(&self) -> f64 {
        self.solution.p[2 * self.structure.modes]
    }

    /// Gain of the first mode, sensor units per rad.
    pub fn gain(&self) -> f64 {
        self.solution.c[0]
    }

    /// Reading of the first record's sensor at rest.
    pub fn offset(&self) -> f64 {
        self.solution.c[self.structure.gains()]
    }

    /// Returns how much is explained of what was fitted, %.
    pub fn fit_percent(&self) -> f64 {
        fit_percent(&self.observed(), &self.solution.residual)
    }

    /// Returns what was fitted, record after record.
    pub fn observed(&self) -> DVector<f64> {
        Model { structure: self.structure, records: &self.records }.observed()
    }

    /// Returns what is observed in a record, and what this model makes of it.
    pub fn prediction(&self, record: &Record) -> (DVector<f64>, DVector<f64>) {
        predicted(record, &self.structure, &self.solution)
    }
}
