//! A smoothing spline: the cubic spline that comes close to samples with little jerk.

use super::band::{Band, Factors};
use super::spline::{End, Folding, Form, Knots};

/// Samples of an angle: times in s from 0, rising, and angles in rad.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Times, s.
    pub times: &'a [f64],
    /// Angles, rad.
    pub angles: &'a [f64],
}

/// The normal equations of a fit without their smoothing.
///
/// The spline minimises `Σ (θ(tᵢ) − θᵢ)² + λ h⁵ ∫ (d³θ/dt³)² dt`. With even knots, `h` apart, the
/// integral is the sum of the third differences of the coefficients, squared, over `h⁵`: a P-spline
/// (Eilers and Marx, Statistical Science 11, 1996) without an approximation.
pub struct Equations<'a> {
    samples: Samples<'a>,
    knots: Knots,
    folding: Folding,
    close: Band,
    smooth: Band,
    right: Vec<f64>,
}

/// A fitted spline.
#[derive(Clone, Debug)]
pub struct Fit {
    knots: Knots,
    folding: Folding,
    /// Coefficients that the end conditions leave.
    coefficients: Vec<f64>,
    /// Elements of the inverse of the normal equations, within the band.
    inverse: Band,
    /// Sum of the squared residuals, rad².
    squares: f64,
    /// Greatest residual, rad.
    pub farthest: f64,
    /// Number of samples less the degrees of freedom that the spline took.
    free: f64,
    samples: f64,
}

impl<'a> Equations<'a> {
    /// Sets up the fit of a spline with these knots and ends.
    pub fn new(samples: Samples<'a>, knots: Knots, ends: [End; 2]) -> Self {
        let folding = Folding { all: knots.coefficients(), ends };
        let n = folding.left();
        let (mut close, mut smooth, mut right) = (Band::zero(n), Band::zero(n), vec![0.0; n]);
        for (&t, &angle) in samples.times.iter().zip(samples.angles) {
            let form = folding.form(&knots.angle(t));
            close.add(&form, 1.0);
            for (k, weight) in form {
                right[k] += weight * angle;
            }
        }
        for interval in 0..knots.count {
            smooth.add(&folding.form(&knots.jerk(interval)), 1.0);
        }
        Self { samples, knots, folding, close, smooth, right }
    }

    /// Solves the fit with the smoothing λ.
    pub fn fit(&self, smoothing: f64) -> Fit {
        let factors: Factors = self.close.plus(smoothing, &self.smooth).factor();
        let coefficients = factors.solve(&self.right);
        let inverse = factors.inverse();
        let (mut squares, mut farthest, mut taken) = (0.0, 0.0_f64, 0.0);
        for (&t, &angle) in self.samples.times.iter().zip(self.samples.angles) {
            let form = self.folding.form(&self.knots.angle(t));
            let off = value(&form, &coefficients) - angle;
            squares += off * off;
            farthest = farthest.max(off.abs());
            taken += inverse.form(&form);
        }
        let samples = self.samples.times.len() as f64;
        let (knots, folding) = (self.knots, self.folding);
        let free = (samples - taken).max(1e-9 * samples);
        Fit { knots, folding, coefficients, inverse, squares, farthest, free, samples }
    }
}

impl Fit {
    /// Estimate of the noise of the samples, rad, root mean square: `√(Σ rᵢ² / free)`.
    pub fn noise(&self) -> f64 {
        (self.squares / self.free).sqrt()
    }

    /// Sum of the squared residuals, rad², and the number of samples less the degrees of freedom
    /// that the spline took.
    pub fn residual(&self) -> [f64; 2] {
        [self.squares, self.free]
    }

    /// Generalised cross-validation: the mean squared error, rad², with which the other samples
    /// predict each one, by `n Σ rᵢ² / free²` (Craven and Wahba, Numerische Mathematik 31, 1979).
    pub fn prediction(&self) -> f64 {
        self.samples * self.squares / (self.free * self.free)
    }

    /// The spline's knots.
    pub fn knots(&self) -> Knots {
        self.knots
    }

    /// Returns the angle at `t` s, rad.
    pub fn angle(&self, t: f64) -> f64 {
        self.value(&self.knots.angle(t))
    }

    /// Returns the rate at a knot, rad/s.
    pub fn rate(&self, knot: usize) -> f64 {
        self.value(&self.knots.rate(knot))
    }

    /// Returns the acceleration at a knot, rad/s².
    pub fn acceleration(&self, knot: usize) -> f64 {
        self.value(&self.knots.acceleration(knot))
    }

    /// Returns the standard deviation of the rate at a knot, rad/s, of samples with that noise in
    /// rad.
    pub fn rate_error(&self, knot: usize, noise: f64) -> f64 {
        self.error(&self.knots.rate(knot), noise)
    }

    /// Returns the standard deviation of the acceleration at a knot, rad/s².
    pub fn acceleration_error(&self, knot: usize, noise: f64) -> f64 {
        self.error(&self.knots.acceleration(knot), noise)
    }

    fn value(&self, form: &Form) -> f64 {
        value(&self.folding.form(form), &self.coefficients)
    }

    fn error(&self, form: &Form, noise: f64) -> f64 {
        noise * self.inverse.form(&self.folding.form(form)).max(0.0).sqrt()
    }
}

fn value(form: &Form, coefficients: &[f64]) -> f64 {
    form.iter().map(|&(k, factor)| factor * coefficients[k]).sum()
}
