//! Values at the Gauss points of a link from its coordinates, and sums over the points.
//!
//! The points lie in pairs about the middle. There `ψ₁ − ½` and `ψ₃` are odd and `ψ₂` is even, so
//! that a pair shares its products.

use super::quadrature::{offset, shapes};
use crate::math::Scalar;

/// `base + Σ_{k≥1} row[k] ψ_k(ξ_q)` at every point `q`.
#[inline(always)]
pub(super) fn at_points<T: Scalar, const W: usize, const Q: usize>(
    base: T,
    row: &[T; W],
) -> [T; Q] {
    let (middle, centre) = (Q / 2, base + T::HALF * row[1]);
    let mut at = [centre; Q];
    at[middle] = centre - T::from_f64(0.25) * row[2];
    for pair in 1..=middle {
        let [first, second, third] = shapes(offset::<Q>(pair)).map(T::from_f64);
        let even = centre + second * row[2];
        let mut odd = first * row[1];
        if W > 3 {
            odd += third * row[W - 1];
        }
        at[middle + pair] = even + odd;
        at[middle - pair] = even - odd;
    }
    at
}

/// `Σ_q ψ_k(ξ_q) at[q]` for every coordinate `k`, `ψ₀ = 1`.
#[inline(always)]
pub(super) fn over_points<T: Scalar, const W: usize, const Q: usize>(at: &[T; Q]) -> [T; W] {
    let middle = Q / 2;
    let mut sums = [T::ZERO; W];
    sums[0] = at[middle];
    sums[2] = T::from_f64(-0.25) * at[middle];
    for pair in 1..=middle {
        let [first, second, third] = shapes(offset::<Q>(pair)).map(T::from_f64);
        let (right, left) = (at[middle + pair], at[middle - pair]);
        let (sum, difference) = (right + left, right - left);
        sums[0] += sum;
        sums[2] += second * sum;
        // The first of a sum of products begins it: 0 + x is not folded away.
        if pair == 1 {
            sums[1] = first * difference;
            if W > 3 {
                sums[W - 1] = third * difference;
            }
        } else {
            sums[1] += first * difference;
            if W > 3 {
                sums[W - 1] += third * difference;
            }
        }
    }
    sums[1] += T::HALF * sums[0];
    sums
}

#[cfg(test)]
mod tests {
    use super::{at_points, over_points};
    use crate::chain::quadrature::Rule;

    fn assert_same<const W: usize, const Q: usize>() {
        let slopes = Rule::<W, Q>::new().slopes;
        let row: [f64; W] = core::array::from_fn(|k| 0.3 + 0.7 * k as f64);
        let at = at_points::<f64, W, Q>(0.2, &row);
        for q in 0..Q {
            let sum: f64 = 0.2 + (1..W).map(|k| slopes[q][k] * row[k]).sum::<f64>();
            assert!((at[q] - sum).abs() < 1e-15, "point {q}: {} is not {sum}", at[q]);
        }
        let sums = over_points::<f64, W, Q>(&at);
        for k in 0..W {
            let sum: f64 = (0..Q).map(|q| slopes[q][k] * at[q]).sum();
            assert!((sums[k] - sum).abs() < 1e-15, "coordinate {k}: {} is not {sum}", sums[k]);
        }
    }

    #[test]
    fn pairs_of_points_give_what_each_point_gives() {
        assert_same::<3, 3>();
        assert_same::<4, 5>();
    }
}
