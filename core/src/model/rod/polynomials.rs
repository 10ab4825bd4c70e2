//! Gauss's rule over the link, and the polynomials that the rod is made of, `ξ = x/L` from 0 to 1.

use super::POINTS;
use crate::math::{Each, array, gauss_points};

/// The whole Gauss rule.
pub(super) fn rule() -> ([f64; POINTS], [f64; POINTS]) {
    (gauss_points().each(|(xi, _)| xi), gauss_points().each(|(_, weight)| weight))
}

/// Legendre polynomials `P₀ … P_{N−1}` of `2ξ − 1`.
pub(super) fn legendre<const N: usize>(xi: f64) -> [f64; N] {
    let u = 2.0 * xi - 1.0;
    let mut p = [1.0; N];
    for k in 1..N {
        let before = if k > 1 { p[k - 2] } else { 0.0 };
        p[k] = ((2 * k - 1) as f64 * u * p[k - 1] - (k - 1) as f64 * before) / k as f64;
    }
    p
}

/// `ψⱼ(ξ) = ∫₀^ξ P_{j}(2ξ' − 1) dξ'`, `j = 0..N`: degree 1 to `N`, zero at the clamp.
pub(super) fn slopes<const N: usize>(xi: f64) -> [f64; N] {
    let p = legendre::<POINTS>(xi);
    array(|j| if j == 0 { xi } else { (p[j + 1] - p[j - 1]) / (2 * (2 * j + 1)) as f64 })
}

/// Integrates the interpolation through the points from the clamp to each point.
pub(super) fn running_integrals(
    points: &[f64; POINTS],
    weights: &[f64; POINTS],
) -> [[f64; POINTS]; POINTS] {
    let at = points.each(legendre::<{ POINTS + 1 }>);
    array(|i| {
        array(|j| {
            let mut sum = 0.0;
            for k in 0..POINTS {
                let integral = if k == 0 {
                    points[i]
                } else {
                    (at[i][k + 1] - at[i][k - 1]) / (2 * (2 * k + 1)) as f64
                };
                sum += (2 * k + 1) as f64 * weights[j] * at[j][k] * integral;
            }
            sum
        })
    })
}
