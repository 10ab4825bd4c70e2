//! The shape functions of the relative angle, and the quadrature that goes with them.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

/// Gauss points over the link: exact to degree 27. With 16 or 24 of them the runs of `tests/truth`
/// change by less than 2e-10 of L.
pub(super) const POINTS: usize = 14;
/// The points and the tip.
pub(super) const STATIONS: usize = POINTS + 1;

/// Integrated Legendre polynomials `ψₖ(ξ) = ∫₀^ξ P̃ₖ₋₁`, k = 1..N, on ξ = x/L = 0..1, with
/// `P̃ₖ(ξ) = Pₖ(2ξ − 1)`.
///
/// They span the polynomials of degree N that vanish at the clamp; their derivatives are
/// orthogonal, `∫₀¹ ψᵢ'ψⱼ' dξ = δᵢⱼ/(2i − 1)`, and only ψ₁ is not zero at the tip.
pub(super) struct Basis<const N: usize> {
    /// ξ of the points.
    pub points: [f64; POINTS],
    /// Weights of `∫₀¹ dξ`.
    pub weights: [f64; POINTS],
    /// `ψₖ` at the points.
    pub shapes: [[f64; N]; POINTS],
    /// `ψₖ(1)`.
    pub tip: [f64; N],
    /// `∫₀¹ ψₖ'² dξ`.
    pub bending: [f64; N],
    /// Row s integrates values at the points from 0 to station s; exact to degree 13.
    pub running: [[f64; POINTS]; STATIONS],
}

impl<const N: usize> Basis<N> {
    pub fn new() -> Self {
        const DEGREE: NonZeroUsize = NonZeroUsize::new(POINTS).unwrap();
        let rule = GaussLegendre::new(DEGREE);
        let mut pairs: Vec<(f64, f64)> =
            rule.iter().map(|&(x, w)| (0.5 * (1.0 + x), 0.5 * w)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));

        let mut basis = Self {
            points: [0.0; POINTS],
            weights: [0.0; POINTS],
            shapes: [[0.0; N]; POINTS],
            tip: [0.0; N],
            bending: std::array::from_fn(|k| 1.0 / (2 * k + 1) as f64),
            running: [[0.0; POINTS]; STATIONS],
        };
        basis.tip[0] = 1.0;
        for (p, (x, w)) in pairs.into_iter().enumerate() {
            basis.points[p] = x;
            basis.weights[p] = w;
            let integrals = integrals(x);
            basis.shapes[p] = std::array::from_fn(|k| integrals[k]);
        }
        for s in 0..STATIONS {
            let integrals = integrals(basis.points.get(s).copied().unwrap_or(1.0));
            for q in 0..POINTS {
                // The interpolant is Σ (2k+1) P̃ₖ(ξ) Σ_q w_q P̃ₖ(ξ_q) f_q: discrete orthogonality.
                let values = legendre(basis.points[q]);
                let sum: f64 =
                    (0..POINTS).map(|k| (2 * k + 1) as f64 * values[k] * integrals[k]).sum();
                basis.running[s][q] = basis.weights[q] * sum;
            }
        }
        basis
    }
}

/// Returns `P̃₀..P̃₁₆` at ξ, by the three-term recurrence.
fn legendre(x: f64) -> [f64; POINTS + 1] {
    let u = 2.0 * x - 1.0;
    let mut p = [1.0; POINTS + 1];
    p[1] = u;
    for k in 1..POINTS {
        let n = k as f64;
        p[k + 1] = ((2.0 * n + 1.0) * u * p[k] - n * p[k - 1]) / (n + 1.0);
    }
    p
}

/// Returns `∫₀^ξ P̃ₖ = (P̃ₖ₊₁ − P̃ₖ₋₁) / (2(2k + 1))`, and ξ for k = 0.
fn integrals(x: f64) -> [f64; POINTS] {
    let p = legendre(x);
    std::array::from_fn(|k| match k {
        0 => x,
        _ => (p[k + 1] - p[k - 1]) / (2 * (2 * k + 1)) as f64,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_integrals_are_exact() {
        let basis = Basis::<7>::new();
        for s in 0..STATIONS {
            let x = basis.points.get(s).copied().unwrap_or(1.0);
            let sum: f64 =
                (0..POINTS).map(|q| basis.running[s][q] * basis.points[q].powi(3).exp()).sum();
            // ∫ exp(x³) by its series.
            let mut exact = 0.0;
            let mut factorial = 1.0;
            for n in 0..20 {
                exact += x.powi(3 * n + 1) / (factorial * f64::from(3 * n + 1));
                factorial *= f64::from(n + 1);
            }
            assert!((sum - exact).abs() < 1e-9, "station {s}: {sum} against {exact}");
        }
    }

    #[test]
    fn shapes_vanish_at_the_clamp_and_at_the_tip_but_for_the_first() {
        assert_eq!(integrals(0.0)[0], 0.0);
        assert!(integrals(0.0)[1..7].iter().all(|psi| psi.abs() < 1e-15));
        assert!(integrals(1.0)[1..7].iter().all(|psi| psi.abs() < 1e-15));
    }
}
