//! Modes from several records of one arm, with intervals.

use std::f64::consts::TAU;

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::fit::Estimate;
use crate::identify::report::ModeReport;

/// Probability that an interval holds the truth.
pub const CONFIDENCE: f64 = 0.95;

/// Combines what records say of one mode.
///
/// ln ω and ln ζ are averaged with the weights of their errors. The interval is Student's, from the
/// error of the mean, the spread between the records beyond it, and that between parts of a record.
/// Degrees of freedom are two a period less the mode's four unknowns: residuals near the mode's own
/// frequency are about as many.
pub fn combine(estimates: &[Estimate]) -> ModeReport {
    let first = &estimates[0];
    let mean_of = |of: &dyn Fn(&Estimate) -> f64| {
        estimates.iter().map(of).sum::<f64>() / estimates.len() as f64
    };
    let omega = pool(estimates, 0, &|estimate| estimate.line.omega);
    let ratio = pool(estimates, 1, &|estimate| estimate.line.ratio);
    let large = |of: &dyn Fn(&Estimate) -> Option<f64>| {
        let values: Option<Vec<f64>> = estimates.iter().map(of).collect();
        values.map(|values| values.iter().sum::<f64>() / values.len() as f64)
    };
    ModeReport {
        frequency_hz: omega.0 / TAU,
        frequency_interval_hz: omega.1.map(|omega| omega / TAU),
        damping_ratio: ratio.0,
        damping_interval: ratio.1.map(|ratio| ratio.min(1.0)),
        periods: mean_of(&|estimate| estimate.periods),
        amplitude: first.amplitude,
        large_frequency_hz: large(&|estimate| Some(estimate.large?.omega / TAU)),
        large_damping_ratio: large(&|estimate| Some(estimate.large?.ratio)),
    }
}

/// Returns mean and interval of a positive unknown, by its logarithms.
fn pool(estimates: &[Estimate], k: usize, of: &dyn Fn(&Estimate) -> f64) -> (f64, [f64; 2]) {
    let count = estimates.len() as f64;
    let weight = |estimate: &Estimate| estimate.error[k].max(1e-9).powi(-2);
    let weights: f64 = estimates.iter().map(weight).sum();
    let mean = estimates.iter().map(|e| weight(e) * of(e).ln()).sum::<f64>() / weights;
    let own = 1.0 / weights;
    let seen = estimates.iter().map(|e| (of(e).ln() - mean).powi(2)).sum::<f64>();
    let between = if estimates.len() > 1 { seen / (count - 1.0) } else { 0.0 };
    let within = estimates.iter().map(|e| e.spread.excess[k].powi(2)).sum::<f64>() / count;
    let periods = estimates.iter().map(|e| e.periods).sum::<f64>();
    let freedom = (2.0 * periods - 4.0).max(3.0);
    let half = quantile(freedom) * (own + between + within).sqrt();
    (mean.exp(), [(mean - half).exp(), (mean + half).exp()])
}

/// Returns Student's two-sided quantile of `CONFIDENCE`.
pub fn quantile(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom).map_or(1.96, |t| t.inverse_cdf(0.5 + 0.5 * CONFIDENCE))
}
