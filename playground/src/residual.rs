//! Residual vibration, by the definition of `stillbeam-sim run`: the largest deflection of the tip
//! over a first period after arrival.

use crate::setpoints::Row;

/// Column of the deflection.
const DEFLECTION: usize = 6;

/// Least length of the time after arrival, ticks: see `stillbeam_sim::residual`.
const LEAST_TICKS: f64 = 6.0;

/// Returns the largest deflection over a first period, m, of rows from the arrival on. Without
/// gravity the arm's rest is straight.
///
/// Between samples a vibration passes higher than at them: the sinusoid through three samples.
pub fn largest(rows: &[Row], tick: f64, period: f64) -> f64 {
    let span = f64::max(period, LEAST_TICKS * tick);
    let last = libm::floor(span / tick + 1e-7) as usize;
    let at = |k: usize| rows[k][DEFLECTION];
    let within = rows.len().min(last + 1);
    let sampled = (0..within).map(|k| at(k).abs()).fold(0.0, f64::max);
    let triples = rows.len().saturating_sub(2).min(within);
    let between = (0..triples).map(|k| crest([at(k), at(k + 1), at(k + 2)], k == 0));
    between.fold(sampled, f64::max)
}

/// Returns the crest of the sinusoid through three samples that lies nearest to the middle one, as
/// a magnitude, or zero if none does. With `first`, the crest may also lie next to the first.
fn crest([before, here, after]: [f64; 3], first: bool) -> f64 {
    let cos = 0.5 * (before + after) / here;
    if !cos.is_finite() || cos.abs() >= 1.0 - 1e-12 {
        return 0.0;
    }
    let sin = libm::sqrt(1.0 - cos * cos);
    let half_change = 0.5 * (after - before) / sin;
    let peak = libm::hypot(here, half_change);
    if here.abs() >= before.abs() && here.abs() >= after.abs() {
        return peak.min(here.abs() * libm::sqrt(2.0 / (1.0 + cos.abs())));
    }
    let angle = libm::atan2(sin, cos);
    let phase = libm::atan(half_change / here);
    if first && cos > 0.0 && phase < -0.5 * angle && phase >= -angle {
        return peak.min(before.abs() * libm::sqrt(2.0 / (1.0 + cos)));
    }
    0.0
}
