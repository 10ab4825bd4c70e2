//! The Gauss-Legendre rule of eight points, and polynomials by their coefficients.

/// Points of the rule: exact to degree 15.
pub(crate) const GAUSS_POINTS: usize = 8;

/// `(ξ, weight)` on 0..1, lower half; the upper half mirrors it.
const HALF_RULE: [(f64, f64); GAUSS_POINTS / 2] = [
    (0.019_855_071_751_231_884, 0.050_614_268_145_188_13),
    (0.101_666_761_293_186_64, 0.111_190_517_226_687_24),
    (0.237_233_795_041_835_5, 0.156_853_322_938_943_64),
    (0.408_282_678_752_175_1, 0.181_341_891_689_181),
];

/// `(ξ, weight)` of the rule on 0..1, ascending.
pub(crate) const fn gauss_points() -> [(f64, f64); GAUSS_POINTS] {
    let mut points = [(0.0, 0.0); GAUSS_POINTS];
    let mut p = 0;
    while p < GAUSS_POINTS / 2 {
        let (xi, weight) = HALF_RULE[p];
        points[p] = (xi, weight);
        points[GAUSS_POINTS - 1 - p] = (1.0 - xi, weight);
        p += 1;
    }
    points
}

/// `Σ cₖ sᵏ`.
pub(crate) fn polynomial<const N: usize>(coefficients: &[f64; N], s: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}
