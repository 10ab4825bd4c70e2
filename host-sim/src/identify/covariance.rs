//! Standard errors of fitted unknowns whose residuals are not independent.

use nalgebra::{DMatrix, DVector};

/// Standard errors, by the sandwich estimator.
///
/// With J the slopes of the model along all unknowns, each unknown errs by `Σₙ aₙ eₙ`, a its row of
/// `(JᵀJ)⁻¹Jᵀ` and e the residuals. The variance of that sum is estimated with Bartlett's weights
/// up to `lag` samples (Newey and West). It is not taken below that of independent residuals, which
/// an estimate from few samples may fall under by chance. An unknown that no sample depends on has
/// an infinite error.
pub fn standard_errors(
    slopes: &DMatrix<f64>,
    residual: &DVector<f64>,
    wanted: &[usize],
    lag: usize,
) -> Vec<f64> {
    let (rows, unknowns) = slopes.shape();
    let norms: Vec<f64> = (0..unknowns).map(|k| slopes.column(k).norm()).collect();
    let scaled = DMatrix::from_fn(rows, unknowns, |n, k| slopes[(n, k)] / norms[k].max(1e-300));
    let Some(inverse) = scaled.tr_mul(&scaled).try_inverse() else {
        return vec![f64::INFINITY; wanted.len()];
    };
    let free = rows.saturating_sub(unknowns).max(1) as f64;
    let variance = residual.norm_squared() / free;
    let of = |&k: &usize| {
        let weights = &scaled * inverse.column(k);
        let terms: Vec<f64> = weights.iter().zip(residual.iter()).map(|(a, e)| a * e).collect();
        let correlated = long_run(&terms, lag) * rows as f64 / free;
        let independent = variance * inverse[(k, k)];
        let error = correlated.max(independent).sqrt() / norms[k];
        if error.is_finite() { error } else { f64::INFINITY }
    };
    wanted.iter().map(of).collect()
}

/// Returns `Σ_{|l| ≤ lag} (1 − |l|/(lag + 1)) Σₙ uₙ uₙ₊ₗ`.
fn long_run(terms: &[f64], lag: usize) -> f64 {
    let at = |l: usize| terms.iter().zip(&terms[l..]).map(|(a, b)| a * b).sum::<f64>();
    let lag = lag.min(terms.len().saturating_sub(1));
    let weight = |l: usize| 1.0 - l as f64 / (lag + 1) as f64;
    at(0) + 2.0 * (1..=lag).map(|l| weight(l) * at(l)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng, rngs::StdRng};

    use super::*;

    /// The mean of a first-order process with correlation 0.8 errs by three times as much as one of
    /// independent samples: `√((1 + 0.8)/(1 − 0.8))`.
    #[test]
    fn correlated_noise_widens_the_error_of_a_mean() {
        let mut random = StdRng::seed_from_u64(7);
        let mut before = 0.0;
        let noise = DVector::from_fn(20_000, |_, _| {
            before = 0.8 * before + random.random_range(-1.0..1.0);
            before
        });
        let mean = noise.mean();
        let residual = noise.map(|x| x - mean);
        let slopes = DMatrix::from_element(20_000, 1, 1.0);
        let error = standard_errors(&slopes, &residual, &[0], 100)[0];
        let independent = residual.norm() / 20_000.0;
        assert!((error / independent - 3.0).abs() < 0.3, "{}", error / independent);
    }

    #[test]
    fn what_no_sample_depends_on_is_infinitely_uncertain() {
        let slopes = DMatrix::from_fn(50, 2, |n, k| if k == 0 { n as f64 } else { 0.0 });
        let residual = DVector::from_element(50, 1.0);
        assert_eq!(standard_errors(&slopes, &residual, &[1], 3), [f64::INFINITY]);
    }
}
