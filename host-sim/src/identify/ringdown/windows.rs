//! Differences between parts of a record that its noise does not explain.

use nalgebra::{DMatrix, DVector};

use super::excerpt::Excerpt;
use super::lines::{Line, Lines};
use crate::identify::covariance::standard_errors;
use crate::identify::separable::{self, Separable};

/// Periods of a part at least, and most parts.
const PERIODS: f64 = 8.0;
const PARTS: f64 = 4.0;

/// Share of a line's first amplitude down to which it is followed.
const FAINT: f64 = 0.1;

/// Standard error of ln ζ above which a part says nothing.
const BLIND: f64 = 0.5;

/// Findings of one line in the parts of a record.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spread {
    /// Standard deviation of ln ω and ln ζ between the parts beyond that of their noise.
    pub excess: [f64; 2],
    /// Least and largest frequency of a part, Hz. Zero without parts.
    pub range: [f64; 2],
}

/// One line with amplitude terms that are held.
struct Held {
    lines: Lines,
    terms: Vec<f64>,
}

impl Held {
    fn all(&self, p: &[f64]) -> Vec<f64> {
        p.iter().chain(&self.terms).copied().collect()
    }
}

impl Separable for Held {
    fn basis(&self, p: &[f64]) -> DMatrix<f64> {
        self.lines.basis(&self.all(p))
    }

    fn slope(&self, p: &[f64], c: &[f64], j: usize) -> DVector<f64> {
        self.lines.slope(&self.all(p), c, j)
    }

    fn ranges(&self) -> Vec<(f64, f64)> {
        self.lines.ranges()[..2].to_vec()
    }
}

impl Spread {
    /// Fits the line to each of up to four parts of `alone`, the record without the other lines.
    /// `terms` are K and δ/ω, which are held.
    pub fn of(alone: &Excerpt, line: Line, terms: [f64; 2], lag: usize) -> Self {
        // Later the line is lost in the noise, and parts would disagree for that alone.
        let audible = (1.0 / FAINT).ln() / (line.ratio * line.omega);
        let length = alone.length().min(audible);
        let count = (length * line.frequency() / PERIODS).floor().min(PARTS);
        if count < 2.0 {
            return Self::default();
        }
        let width = length / count;
        let parts: Vec<[f64; 4]> = (0..count as usize)
            .map(|k| alone.part(k as f64 * width, (k + 1) as f64 * width + 1e-9))
            .filter(|part| part.time.len() > 12)
            .map(|part| estimate(&part, line, terms, lag))
            .filter(|estimate| estimate[3] < BLIND)
            .collect();
        if parts.len() < 2 {
            return Self::default();
        }
        let hz = |part: &[f64; 4]| part[0].exp() / std::f64::consts::TAU;
        Self {
            excess: [excess(&parts, 0), excess(&parts, 1)],
            range: [
                parts.iter().map(hz).fold(f64::INFINITY, f64::min),
                parts.iter().map(hz).fold(0.0, f64::max),
            ],
        }
    }
}

/// Returns ln ω, ln ζ and their standard errors.
fn estimate(part: &Excerpt, line: Line, terms: [f64; 2], lag: usize) -> [f64; 4] {
    let is_bent = terms != [0.0, 0.0];
    let lines = Lines { time: part.time.clone(), start: vec![line], bent: is_bent.then_some(0) };
    let start = lines.unknowns()[..2].to_vec();
    let held = Held { lines, terms: if is_bent { terms.to_vec() } else { Vec::new() } };
    let found = separable::fit(&held, &part.value, &start);
    let mut columns: Vec<DVector<f64>> =
        (0..2).map(|j| held.slope(&found.p, &found.c, j)).collect();
    columns.extend(held.basis(&found.p).column_iter().map(|column| column.into_owned()));
    let slopes = DMatrix::from_columns(&columns);
    let errors = standard_errors(&slopes, &found.residual, &[0, 1], lag);
    [found.p[0], found.p[1], errors[0], errors[1]]
}

/// Returns the standard deviation between the parts beyond their own errors.
fn excess(parts: &[[f64; 4]], unknown: usize) -> f64 {
    let count = parts.len() as f64;
    let mean = parts.iter().map(|part| part[unknown]).sum::<f64>() / count;
    let seen = parts.iter().map(|part| (part[unknown] - mean).powi(2)).sum::<f64>() / (count - 1.0);
    let own = parts.iter().map(|part| part[unknown + 2].powi(2)).sum::<f64>() / count;
    (seen - own).max(0.0).sqrt()
}
