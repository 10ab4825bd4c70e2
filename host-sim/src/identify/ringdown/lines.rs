//! Sums of decaying sines, fitted on the true time stamps.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::amplitude::{Envelope, envelope};
use crate::identify::separable::Separable;

/// Range of ln ζ, and how far ln ω may go from its start.
const RATIO: (f64, f64) = (-13.0, -0.36);
const OMEGA: f64 = 0.2;

/// Ranges of the amplitude terms: K, and δ over ω.
const GROWTH: (f64, f64) = (0.0, 100.0);
const SHIFT: (f64, f64) = (-0.2, 0.2);

/// Relative step of a central difference.
const STEP: f64 = 1e-6;

/// A decaying sine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// ω of the undamped vibration, rad/s.
    pub omega: f64,
    /// ζ.
    pub ratio: f64,
}

impl Line {
    /// Returns `ω/2π`, Hz.
    pub fn frequency(&self) -> f64 {
        self.omega / TAU
    }
}

/// The model: an offset, and lines that each have a cosine and a sine.
///
/// Nonlinear unknowns are ln ω and ln ζ of each line, and behind them K and δ/ω of the line
/// `bent`, whose damping changes with amplitude.
#[derive(Clone, Debug)]
pub struct Lines {
    /// Times from the beginning of the vibration, s.
    pub time: Vec<f64>,
    /// The lines to start from.
    pub start: Vec<Line>,
    /// The line with amplitude terms.
    pub bent: Option<usize>,
}

/// Shape of one line: its nonlinear unknowns.
#[derive(Clone, Copy)]
struct Shape {
    line: Line,
    growth: f64,
    shift: f64,
}

impl Shape {
    /// Returns the cosine and the sine at a time.
    fn at(&self, t: f64) -> [f64; 2] {
        let Line { omega, ratio } = self.line;
        let damped = omega * (1.0 - ratio * ratio).sqrt();
        let Envelope { amplitude, integral } = envelope(t, ratio * omega, self.growth);
        let (sin, cos) = (damped * t + self.shift * omega * integral).sin_cos();
        [amplitude * cos, amplitude * sin]
    }
}

impl Lines {
    /// Returns the unknowns at the start.
    pub fn unknowns(&self) -> Vec<f64> {
        let lines = self.start.iter().flat_map(|line| [line.omega.ln(), line.ratio.ln()]);
        lines.chain(self.bent.iter().flat_map(|_| [0.3, 0.0])).collect()
    }

    /// Returns the lines of a solution.
    pub fn lines(&self, p: &[f64]) -> Vec<Line> {
        (0..self.start.len()).map(|i| self.shape(p, i).line).collect()
    }

    /// Returns K and δ/ω of a line, zero without amplitude terms.
    pub fn terms(&self, p: &[f64], line: usize) -> [f64; 2] {
        let Shape { growth, shift, .. } = self.shape(p, line);
        [growth, shift]
    }

    /// Returns one line's share of the signal.
    pub fn signal(&self, p: &[f64], c: &[f64], line: usize) -> DVector<f64> {
        let shape = self.shape(p, line);
        let [cos, sin] = [c[1 + 2 * line], c[2 + 2 * line]];
        let of = |&t: &f64| {
            let [x, y] = shape.at(t);
            cos * x + sin * y
        };
        DVector::from_iterator(self.time.len(), self.time.iter().map(of))
    }

    /// Returns the slopes along all unknowns, nonlinear ones first.
    pub fn slopes(&self, p: &[f64], c: &[f64]) -> DMatrix<f64> {
        let mut columns: Vec<DVector<f64>> = (0..p.len()).map(|j| self.slope(p, c, j)).collect();
        columns.extend(self.basis(p).column_iter().map(|column| column.into_owned()));
        DMatrix::from_columns(&columns)
    }

    fn shape(&self, p: &[f64], line: usize) -> Shape {
        let terms = 2 * self.start.len();
        let [growth, shift] =
            if self.bent == Some(line) { [p[terms], p[terms + 1]] } else { [0.0, 0.0] };
        let line = Line { omega: p[2 * line].exp(), ratio: p[2 * line + 1].exp() };
        Shape { line, growth, shift }
    }

    /// Returns the line that an unknown belongs to.
    fn owner(&self, j: usize) -> usize {
        if j < 2 * self.start.len() { j / 2 } else { self.bent.unwrap_or(0) }
    }
}

impl Separable for Lines {
    fn basis(&self, p: &[f64]) -> DMatrix<f64> {
        let mut basis = DMatrix::from_element(self.time.len(), 1 + 2 * self.start.len(), 1.0);
        for line in 0..self.start.len() {
            let shape = self.shape(p, line);
            for (n, &t) in self.time.iter().enumerate() {
                let [cos, sin] = shape.at(t);
                basis[(n, 1 + 2 * line)] = cos;
                basis[(n, 2 + 2 * line)] = sin;
            }
        }
        basis
    }

    fn slope(&self, p: &[f64], c: &[f64], j: usize) -> DVector<f64> {
        let line = self.owner(j);
        let at = |step: f64| {
            let mut p = p.to_vec();
            p[j] += step;
            self.signal(&p, c, line)
        };
        // K is not negative: its slope at 0 is the one above.
        if p[j] == GROWTH.0 && j == 2 * self.start.len() {
            return (at(STEP) - at(0.0)) / STEP;
        }
        (at(STEP) - at(-STEP)) / (2.0 * STEP)
    }

    fn ranges(&self) -> Vec<(f64, f64)> {
        let around = |x: f64| (x - OMEGA, x + OMEGA);
        let lines = self.start.iter().flat_map(|line| [around(line.omega.ln()), RATIO]);
        lines.chain(self.bent.iter().flat_map(|_| [GROWTH, SHIFT])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::separable;

    #[test]
    fn lines_and_amplitude_terms_are_found_exactly() {
        let time: Vec<f64> = (0..3000).map(|k| 2e-3 * f64::from(k)).collect();
        let truth = [Line { omega: 38.0, ratio: 0.0014 }, Line { omega: 245.0, ratio: 0.005 }];
        let model = Lines { time, start: truth.to_vec(), bent: Some(0) };
        let p = [38.0_f64.ln(), 0.0014_f64.ln(), 245.0_f64.ln(), 0.005_f64.ln(), 3.0, -0.002];
        let y = model.basis(&p) * DVector::from_vec(vec![0.5, 9.0, -2.0, 1.0, 3.0]);
        let start = [Line { omega: 37.97, ratio: 0.003 }, Line { omega: 245.3, ratio: 0.003 }];
        let model = Lines { start: start.to_vec(), ..model };
        let found = separable::fit(&model, &y, &model.unknowns());
        for (j, expected) in p.iter().enumerate() {
            assert!((found.p[j] - expected).abs() < 1e-6, "{j}: {} {expected}", found.p[j]);
        }
    }
}
