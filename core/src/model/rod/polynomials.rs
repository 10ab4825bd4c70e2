//! Gauss's rule over the link, and the polynomials that the rod is made of, `ξ = x/L` from 0 to 1.

use super::POINTS;
use crate::math::{array, gauss_points};

/// The whole Gauss rule.
pub(super) const fn rule() -> ([f64; POINTS], [f64; POINTS]) {
    let (mut points, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
    let pairs = gauss_points();
    let mut p = 0;
    while p < POINTS {
        (points[p], weights[p]) = pairs[p];
        p += 1;
    }
    (points, weights)
}

/// Legendre polynomials `P₀ … P_{N−1}` of `2ξ − 1`.
pub(super) const fn legendre<const N: usize>(xi: f64) -> [f64; N] {
    let u = 2.0 * xi - 1.0;
    let mut p = [1.0; N];
    let mut k = 1;
    while k < N {
        let before = if k > 1 { p[k - 2] } else { 0.0 };
        p[k] = ((2 * k - 1) as f64 * u * p[k - 1] - (k - 1) as f64 * before) / k as f64;
        k += 1;
    }
    p
}

/// [`legendre`] at the points.
pub(super) const AT_POINTS: [[f64; POINTS + 1]; POINTS] = {
    let (points, _) = rule();
    let mut at = [[0.0; POINTS + 1]; POINTS];
    let mut p = 0;
    while p < POINTS {
        at[p] = legendre(points[p]);
        p += 1;
    }
    at
};

/// `ψⱼ(ξ) = ∫₀^ξ P_{j}(2ξ' − 1) dξ'`, `j = 0..N`, by the polynomials at ξ: degree 1 to `N`, zero at
/// the clamp.
pub(super) fn slopes<const N: usize>(xi: f64, p: &[f64; POINTS + 1]) -> [f64; N] {
    array(|j| if j == 0 { xi } else { (p[j + 1] - p[j - 1]) / (2 * (2 * j + 1)) as f64 })
}

/// Integrals of the interpolation through the points from the clamp to each point: rows are the
/// integral's ends. The same for every link, and not computed again at set-up.
pub(super) const RUNNING: [[f64; POINTS]; POINTS] = {
    let (points, weights) = rule();
    let mut running = [[0.0; POINTS]; POINTS];
    let mut i = 0;
    while i < POINTS {
        let mut k = 0;
        while k < POINTS {
            let integral = if k == 0 {
                points[i]
            } else {
                (AT_POINTS[i][k + 1] - AT_POINTS[i][k - 1]) / (2 * (2 * k + 1)) as f64
            };
            let mut j = 0;
            while j < POINTS {
                running[i][j] += (2 * k + 1) as f64 * weights[j] * AT_POINTS[j][k] * integral;
                j += 1;
            }
            k += 1;
        }
        i += 1;
    }
    running
};

/// Takes the values at the points to the tip: the polynomial through them.
pub(super) const END: [f64; POINTS] = {
    let (_, weights) = rule();
    let mut end = [0.0; POINTS];
    let mut p = 0;
    while p < POINTS {
        let (mut sum, mut j) = (0.0, 0);
        while j < POINTS {
            sum += (2 * j + 1) as f64 * AT_POINTS[p][j];
            j += 1;
        }
        end[p] = weights[p] * sum;
        p += 1;
    }
    end
};
