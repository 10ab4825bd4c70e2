//! Doubts about a forced fit: unknowns that look alike, delays, disagreement, gear play.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::fit::Forced;
use super::model::{Model, Record, Structure};
use crate::identify::covariance::standard_errors;
use crate::identify::separable::{self, Solution};
use crate::identify::spectrum::Spectrum;
use crate::identify::warning::Warning;

/// Correlation from which two unknowns cannot be told apart.
const ALIKE: f64 = 0.985;

/// Share of a period from which a delay is likely a filter.
const LONG: f64 = 0.05;

/// Decrease of the squares beyond a bound of the delay that says it is at that bound.
const BEYOND: f64 = 0.05;

/// Fit below which a log is doubted, and below which one is whose parts disagree in their damping
/// by that standard deviation of ln ζ.
const DOUBTED: f64 = 80.0;
const DIVIDED: f64 = 90.0;
const DAMPING: f64 = 0.5;

/// Share of the residual near the arm's own frequency from which gear play is likely.
const NEAR: f64 = 0.4;

/// Periods of a part of a single log.
const PERIODS: f64 = 10.0;

/// Warns of pairs of unknowns whose slopes are nearly the same.
pub fn inseparable(slopes: &DMatrix<f64>, structure: &Structure, warnings: &mut Vec<Warning>) {
    let delay = 2 * structure.modes;
    let named = [
        (0, "the frequency"),
        (1, "the damping"),
        (delay, "the delay"),
        (delay + 1, "the sensor's gain"),
    ];
    let norms: Vec<f64> = slopes.column_iter().map(|column| column.norm()).collect();
    let scaled = DMatrix::from_fn(slopes.nrows(), slopes.ncols(), |n, k| {
        slopes[(n, k)] / norms[k].max(1e-300)
    });
    let Some(covariance) = scaled.tr_mul(&scaled).try_inverse() else { return };
    for (i, (one, first)) in named.iter().enumerate() {
        for (other, second) in &named[i + 1..] {
            let variances = covariance[(*one, *one)] * covariance[(*other, *other)];
            let correlation = covariance[(*one, *other)] / variances.sqrt();
            if correlation.abs() > ALIKE {
                warnings.push(Warning::Inseparable { one: first, other: second, correlation });
            }
        }
    }
}

/// Warns of a delay that is long, or at an end of its range.
pub fn delay(model: &Model<'_>, solution: &Solution, warnings: &mut Vec<Warning>) {
    let index = 2 * model.structure.modes;
    let (delay_s, period) = (solution.p[index], TAU / solution.p[0].exp());
    let (_, high) = model.structure.delay;
    if delay_s > 0.999 * high {
        warnings.push(Warning::DelayAtBound { delay_s, bound: "upper" });
    } else if delay_s > LONG * period {
        let percent = 100.0 * delay_s / period;
        warnings.push(Warning::LongDelay { delay_s, percent });
    } else if delay_s < 1e-3 * period {
        let mut p = solution.p.clone();
        p[index] = -0.02 * period;
        let earlier = separable::project(model, &model.observed(), &p);
        if earlier.squares() < (1.0 - BEYOND) * solution.squares() {
            warnings.push(Warning::DelayAtBound { delay_s, bound: "lower" });
        }
    }
}

/// Returns the standard deviations of ln ω and ln ζ of the first mode between records, or between
/// parts of a long one, beyond their own errors.
pub fn spread(
    records: &[Record],
    structure: &Structure,
    solution: &Solution,
    warnings: &mut Vec<Warning>,
) -> [f64; 2] {
    let pieces: Vec<Record> = match records {
        [one] => {
            let periods = one.length() * solution.p[0].exp() / TAU;
            let count = (periods / PERIODS).floor().min(4.0) as usize;
            let part = |k: usize| one.part(k as f64 / count as f64, (k + 1) as f64 / count as f64);
            (0..count).map(part).collect()
        }
        several => several.to_vec(),
    };
    if pieces.len() < 2 {
        return [0.0; 2];
    }
    let estimates: Vec<[f64; 4]> =
        pieces.into_iter().map(|piece| estimate(piece, structure, solution)).collect();
    let count = estimates.len() as f64;
    let excess = [0, 1].map(|k| {
        let mean = estimates.iter().map(|e| e[k]).sum::<f64>() / count;
        let seen = estimates.iter().map(|e| (e[k] - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let own = estimates.iter().map(|e| e[k + 2].powi(2)).sum::<f64>() / count;
        (seen - own).max(0.0).sqrt()
    });
    if excess[0] > 0.005 {
        let hz = |fold: fn(f64, f64) -> f64, start: f64| {
            estimates.iter().map(|e| e[0].exp() / TAU).fold(start, fold)
        };
        let hz = [hz(f64::min, f64::INFINITY), hz(f64::max, 0.0)];
        warnings.push(Warning::WindowsDisagree { percent: 100.0 * excess[0], hz });
    }
    excess
}

/// Returns ln ω, ln ζ and their standard errors of one record.
fn estimate(record: Record, structure: &Structure, solution: &Solution) -> [f64; 4] {
    let records = [record];
    let model = Model { structure: *structure, records: &records };
    let found = separable::fit(&model, &model.observed(), &solution.p);
    let slopes = model.slopes(&found.p, &found.c);
    let lag = records[0].time.len() / 10;
    let errors = standard_errors(&slopes, &found.residual, &[0, 1], lag);
    [found.p[0], found.p[1], errors[0], errors[1]]
}

/// Warns of likely gear play: much of the sensor is unexplained, and that part vibrates at the
/// arm's own frequency. White noise, or another mode, would be unexplained elsewhere.
pub fn play(forced: &Forced, warnings: &mut Vec<Warning>) {
    let percent = forced.fit_percent();
    let is_divided = forced.spread[1] > DAMPING && percent < DIVIDED;
    if percent >= DOUBTED && !is_divided {
        return;
    }
    let count = forced.records[0].time.len();
    let residual = DVector::from_column_slice(&forced.solution.residual.as_slice()[..count]);
    let spectrum = Spectrum::of(&forced.records[0].time, residual.as_slice());
    let own = forced.mode(0)[0] / TAU;
    let power = |low: f64, high: f64| {
        let inside = spectrum
            .amplitude
            .iter()
            .enumerate()
            .filter(|(k, _)| (low..high).contains(&(*k as f64 * spectrum.spacing)));
        inside.map(|(_, amplitude)| amplitude * amplitude).sum::<f64>()
    };
    let share = power(0.6 * own, 1.6 * own) / power(0.0, f64::INFINITY);
    if share > NEAR {
        warnings.push(Warning::Play { percent, share: 100.0 * share });
    } else {
        warnings.push(Warning::PoorFit { percent });
    }
}
