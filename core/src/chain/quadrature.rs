//! The Gauss-Legendre points of a link, and the integrals along it that do not change.

use crate::math::{Each, array};

/// Distance of the points of the rule of `Q` points from the middle of −1..1, and their weights,
/// from the middle outwards.
const THREE: [(f64, f64); 2] = [(0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];
const FIVE: [(f64, f64); 3] = [
    (0.0, 128.0 / 225.0),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Distance of a pair of points from the middle of −1..1; the pairs count from 1 outwards.
#[inline(always)]
pub(super) const fn offset<const Q: usize>(pair: usize) -> f64 {
    const { assert!(Q == 3 || Q == 5, "rules of 3 and of 5 points") }
    if Q == 3 { THREE[pair].0 } else { FIVE[pair].0 }
}

/// `ψ₁ − ½`, `ψ₂` and `ψ₃` at `x` of −1..1.
#[inline(always)]
pub(super) const fn shapes(x: f64) -> [f64; 3] {
    [0.5 * x, 0.25 * (x * x - 1.0), 0.25 * x * (x * x - 1.0)]
}

/// `(ξ, weight)` of the rule of `Q` points on 0..1, 3 or 5 of them.
fn rule<const Q: usize>() -> [(f64, f64); Q] {
    let half: &[(f64, f64)] = if Q == 3 { &THREE } else { &FIVE };
    array(|q| {
        let middle = Q / 2;
        let (x, weight) = half[q.abs_diff(middle)];
        let x = if q < middle { -x } else { x };
        (0.5 + 0.5 * x, 0.5 * weight)
    })
}

/// `ψ_k(ξ) = ∫₀^ξ P_{k−1}(2s − 1) ds`, k from 1; for k = 0 the 1 by which the joint turns the link.
#[cfg(test)]
fn slope(k: usize, xi: f64) -> f64 {
    use crate::math::polynomial;
    match k {
        0 => 1.0,
        1 => xi,
        2 => polynomial(&[0.0, -1.0, 1.0], xi),
        _ => polynomial(&[0.0, 1.0, -3.0, 2.0], xi),
    }
}

/// Points and weights for integrals over a link of unit length and mass.
///
/// Its point at `ξ_g` is the clamp plus `Σ_q run[g][q] t_q`, `t_q` the tangent at point `q`: the
/// integral of the polynomial through the tangents.
pub(super) struct Rule<const W: usize, const Q: usize> {
    /// `ψ_k(ξ_q)` as `slopes[q][k]`.
    #[cfg(test)]
    pub slopes: [[f64; W]; Q],
    /// `∫₀¹`: the weights.
    pub weights: [f64; Q],
    /// `Σ_g w_g run[g][q]`: first moment of mass.
    pub first: [f64; Q],
    /// `Σ_g w_g run[g][q] run[g][p]`: second moment.
    pub second: [[f64; Q]; Q],
}

impl<const W: usize, const Q: usize> Rule<W, Q> {
    pub fn new() -> Self {
        let points = rule::<Q>();
        // ℓ_q at x, the polynomial that is 1 at point q and 0 at the others.
        let lagrange = |q: usize, x: f64| {
            let others = (0..Q).filter(|&p| p != q);
            others.map(|p| (x - points[p].0) / (points[q].0 - points[p].0)).product::<f64>()
        };
        let run: [[f64; Q]; Q] = points.each(|(end, _)| {
            array(|q| points.iter().map(|(xi, weight)| end * weight * lagrange(q, end * xi)).sum())
        });
        let weights = points.each(|(_, weight)| weight);
        let sum = |term: &dyn Fn(usize) -> f64| (0..Q).map(|g| weights[g] * term(g)).sum::<f64>();
        Self {
            #[cfg(test)]
            slopes: points.each(|(xi, _)| array(|k| slope(k, xi))),
            weights,
            first: array(|q| sum(&|g| run[g][q])),
            second: array(|q| array(|p| sum(&|g| run[g][q] * run[g][p]))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Rule;

    /// A straight rod: mass 1, first moment ½ and second ⅓ about its end.
    fn assert_straight<const W: usize, const Q: usize>() {
        let rule = Rule::<W, Q>::new();
        let second: f64 = rule.second.iter().flatten().sum();
        for (sum, exact) in [
            (rule.weights.iter().sum::<f64>(), 1.0),
            (rule.first.iter().sum(), 0.5),
            (second, 1.0 / 3.0),
        ] {
            assert!((sum - exact).abs() < 1e-15, "{sum} is not {exact}");
        }
    }

    #[test]
    fn moments_of_a_straight_rod_are_exact() {
        assert_straight::<3, 3>();
        assert_straight::<4, 5>();
    }
}
