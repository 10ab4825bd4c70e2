//! Finds the lines of a record one by one, and fits them together.

use std::f64::consts::TAU;

use nalgebra::DVector;

use super::excerpt::Excerpt;
use super::fit::Asked;
use super::lines::{Line, Lines};
use super::modes::{self, Found, Harmonics};
use crate::identify::covariance::standard_errors;
use crate::identify::separable::{self, Solution};
use crate::identify::spectrum::Spectrum;

/// Prominence of a peak above those around it from which it is a line.
pub(super) const PROMINENT: f64 = 5.0;

/// Share of the squares that the first line must take if its peak does not stand out.
const MOST_OF_IT: f64 = 0.5;

/// Parts of a record in which a faint mode is looked for, and its periods in one at least.
const EARLY: [f64; 3] = [1.0, 0.25, 0.06];
const PERIODS_TO_SEE: f64 = 8.0;

/// Decrease of the squares that a line must bring, in units of `ln(n)/n` of n samples. White noise
/// alone brings 2 at its highest peak.
const WORTH: f64 = 8.0;

/// Share of the squares that amplitude terms must take, and their growth in standard errors.
const AMPLITUDE: f64 = 0.05;
const SURE: f64 = 4.0;

/// Damping ratios at which a line's search starts.
const RATIOS: [f64; 6] = [3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1];

/// Fits all lines together, with amplitude terms of the first one if they are known or show now.
pub(super) fn jointly(excerpt: &Excerpt, lines: &[Line], bent: bool) -> (Lines, Solution) {
    let with = of_lines(excerpt, lines, true);
    if bent {
        return with;
    }
    let plain = of_lines(excerpt, lines, false);
    if is_bent(&plain, &with) { with } else { plain }
}

/// Finds the next mode if it is too faint to be worth a line by the squares alone.
pub(super) fn faint(
    excerpt: &Excerpt,
    left: &DVector<f64>,
    lines: &[Line],
    known: &[Line],
    asked: &Asked<'_>,
    harmonics: Harmonics,
) -> Option<Line> {
    let frequencies: Vec<f64> = known.iter().map(Line::frequency).collect();
    let (low, high) = modes::range(&frequencies, asked.theory);
    let sampled = 0.25 * (excerpt.time.len() - 1) as f64 / excerpt.length();
    let is_harmonic = |hz: f64| {
        let line = Line { omega: TAU * hz, ratio: 0.0 };
        modes::harmonic_of(line, known[0]).is_some()
    };
    let admits = |hz: f64| {
        is_apart(excerpt, lines, hz) && (harmonics == Harmonics::IfNoOther || !is_harmonic(hz))
    };
    // What decays fast stands out at the beginning.
    let peaks = EARLY.iter().filter_map(|share| {
        let early = Excerpt { value: left.clone(), ..excerpt.clone() };
        let early = early.part(0.0, share * excerpt.length());
        let is_long = early.time.len() > 32 && early.length() * low > PERIODS_TO_SEE;
        let spectrum = is_long.then(|| Spectrum::of(&early.time, early.value.as_slice()))?;
        spectrum.peak(low, high.min(sampled), &admits)
    });
    let peak = peaks.max_by(|a, b| a.prominence.total_cmp(&b.prominence))?;
    if peak.prominence < PROMINENT {
        return None;
    }
    let start = start(excerpt, left, peak.frequency);
    let model = Lines { time: excerpt.time.clone(), start: vec![start], bent: None };
    let solution = separable::fit(&model, left, &model.unknowns());
    Some(model.lines(&solution.p)[0])
}

/// True if a frequency can be told from those of the lines.
fn is_apart(excerpt: &Excerpt, lines: &[Line], hz: f64) -> bool {
    let least = |line: &Line| (2.0 / excerpt.length()).max(0.03 * line.frequency());
    lines.iter().all(|line| (hz - line.frequency()).abs() > least(line))
}

pub(super) fn of_lines(excerpt: &Excerpt, lines: &[Line], bent: bool) -> (Lines, Solution) {
    let (time, start) = (excerpt.time.clone(), lines.to_vec());
    let model = Lines { time, start, bent: bent.then_some(0) };
    let solution = separable::fit(&model, &excerpt.value, &model.unknowns());
    (model, solution)
}

/// True if the damping of the first line changes with its amplitude for sure.
pub(super) fn is_bent(plain: &(Lines, Solution), with: &(Lines, Solution)) -> bool {
    let (model, Solution { p, c, residual }) = with;
    if with.1.squares() > (1.0 - AMPLITUDE) * plain.1.squares() {
        return false;
    }
    let growth = 2 * model.start.len();
    let lag = model.time.len() / 20;
    let error = standard_errors(&model.slopes(p, c), residual, &[growth], lag)[0];
    p[growth] > SURE * error
}

pub(super) fn found(model: &Lines, solution: &Solution) -> Vec<Found> {
    let lines = model.lines(&solution.p);
    let c = &solution.c;
    let of =
        |(k, &line): (usize, &Line)| Found { line, amplitude: c[1 + 2 * k].hypot(c[2 + 2 * k]) };
    lines.iter().enumerate().map(of).collect()
}

/// Returns the next line of a record and what is left without it, if it is worth one.
pub(super) fn next(
    excerpt: &Excerpt,
    left: &DVector<f64>,
    lines: &[Line],
) -> Option<(Line, DVector<f64>)> {
    let count = excerpt.time.len();
    let length = excerpt.length();
    let spectrum = Spectrum::of(&excerpt.time, left.as_slice());
    let nyquist = 0.5 * (count - 1) as f64 / length;
    let admits = |hz: f64| is_apart(excerpt, lines, hz);
    let peak = spectrum.peak(1.0 / length, 0.95 * nyquist, &admits)?;
    let is_prominent = peak.prominence >= PROMINENT;
    if !is_prominent && !lines.is_empty() {
        return None;
    }
    let line = start(excerpt, left, peak.frequency);
    let model = Lines { time: excerpt.time.clone(), start: vec![line], bent: None };
    let solution = separable::fit(&model, left, &model.unknowns());
    let gain = 1.0 - solution.squares() / left.norm_squared();
    let noise = WORTH * (count as f64).ln() / count as f64;
    let worth = if is_prominent { noise } else { MOST_OF_IT };
    (gain > worth).then(|| (model.lines(&solution.p)[0], solution.residual))
}

/// Returns the best of several starting values near a peak of the spectrum.
fn start(excerpt: &Excerpt, left: &DVector<f64>, peak: f64) -> Line {
    let spacing = 0.35 / excerpt.length();
    let trials = (-2..=2).flat_map(|k| {
        let hz = (peak + f64::from(k) * spacing).max(0.2 * peak);
        RATIOS.map(|ratio| Line { omega: TAU * hz, ratio })
    });
    let squares = |line: &Line| {
        let model = Lines { time: excerpt.time.clone(), start: vec![*line], bent: None };
        separable::project(&model, left, &model.unknowns()).squares()
    };
    let best = trials.map(|line| (squares(&line), line)).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(Line { omega: TAU * peak, ratio: RATIOS[2] }, |(_, line)| line)
}
