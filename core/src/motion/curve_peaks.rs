//! Greatest rate, acceleration and jerk on a quintic with a bulge.

use core::f64::consts::TAU;

use super::{BULGE, Peaks};
use crate::math::{Each, Scalar};

/// Coefficients of `u … u¹¹`.
const DEGREE: usize = BULGE + 5;

/// Nodes at which [`curve_peaks`] looks.
const NODES: u32 = 128;

/// Greatest magnitudes on the quintic `c` with the bulge `d`, both in turns, over `duration` s: the
/// largest of 129 nodes, dense at the ends where a curve may be steep, refined by the parabola
/// through its neighbours. Error 1e-4 of a peak. Not finite where a coefficient is not.
pub(crate) fn curve_peaks<T: Scalar>(c: &[T; 5], d: &[T; BULGE], duration: f64) -> Peaks {
    let mut derivative = monomials(c, d);
    let mut scale = TAU;
    let [rate, acceleration, jerk] = [1, 2, 3].each(|order: usize| {
        // Coefficient k is that of u^k from here on, the first `order` of them gone.
        for k in 0..DEGREE {
            let power = (k + 2).saturating_sub(order);
            derivative[k] = derivative[k] * T::from_u32(power as u32);
        }
        scale *= 2.0 / duration;
        scale * greatest(&derivative, order - 1)
    });
    Peaks { rate, acceleration, jerk }
}

/// `c₁u + … + c₅u⁵ + (1 − 3u² + 3u⁴ − u⁶)(d₀ + … + d₅u⁵)`, the constant left out.
fn monomials<T: Scalar>(c: &[T; 5], d: &[T; BULGE]) -> [T; DEGREE] {
    let three = T::TWO + T::ONE;
    let mut all = [T::ZERO; DEGREE];
    all[..5].copy_from_slice(c);
    for (power, factor) in [(0, T::ONE), (2, -three), (4, three), (6, -T::ONE)] {
        for k in 0..BULGE {
            // d₀'s own constant is left out.
            if k + power > 0 {
                all[k + power - 1] += factor * d[k];
            }
        }
    }
    all
}

/// Greatest `|Σ cₖ u^(k − skipped)|` over −1 … 1.
fn greatest<T: Scalar>(c: &[T; DEGREE], skipped: usize) -> f64 {
    let at = |node: u32| {
        let x = T::from_u32(node) * T::from_f64(2.0 / f64::from(NODES)) - T::ONE;
        let u = T::HALF * x * (T::TWO + T::ONE - x * x);
        let mut sum = c[DEGREE - 1];
        for k in (skipped..DEGREE - 1).rev() {
            sum = sum * u + c[k];
        }
        sum
    };
    let magnitude = |value: T| if value < T::ZERO { -value } else { value };
    let (mut before, mut here) = (at(0), at(0));
    let mut most = T::ZERO;
    for node in 0..=NODES {
        let after = at((node + 1).min(NODES));
        let mut peak = magnitude(here);
        let (bend, tilt) = (before - T::TWO * here + after, after - before);
        let turns = (here - before) * (after - here) <= T::ZERO && bend != T::ZERO;
        // Two nodes beside a peak may have the same value; an end has itself for a neighbour.
        if turns && 0 < node && node < NODES {
            peak = magnitude(here - tilt * tilt / (T::TWO * T::TWO * T::TWO * bend));
        }
        // What is no number stays: whoever compares it then refuses.
        if peak > most || !peak.is_finite() {
            most = peak;
        }
        (before, here) = (here, after);
    }
    most.to_f64()
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::curve_peaks;
    use crate::math::Each;

    /// In f32 the acceleration is the same at both nodes beside its peak, which lies 1.6e-3 above
    /// them.
    #[test]
    fn a_peak_between_two_equal_nodes_is_found() {
        let turn = (1.1092286186237776 - 0.3) / TAU;
        let bulge = [
            0.4650151331384065,
            -0.49602381957645497,
            0.48301947613298424,
            -0.9140001887505063,
            0.9485116682146686,
            0.8586503032246565,
        ];
        let c = [0.9375, 0.0, -0.625, 0.0, 0.1875].each(|c| (c * turn) as f32);
        let found = curve_peaks(&c, &bulge.each(|d: f64| (d / TAU) as f32), 0.07);
        assert!((found.acceleration / 5390.054 - 1.0).abs() < 1e-4, "{found:?}");
    }
}
