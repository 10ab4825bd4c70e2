//! Derivatives of the quintic and of the bulges along a still move.

use crate::math::Scalar;
use crate::motion::BULGE;

/// `d/du`, `d²/du²` and `d³/du³` of `(1 − u²)³uᵏ`.
pub(super) fn bulges<T: Scalar>(u: T) -> [[T; BULGE]; 3] {
    let n = |k: u32| T::from_u32(k);
    let square = u * u;
    let w = T::ONE - square;
    let w2 = w * w;
    let b = w2 * w;
    let b1 = -(n(6) * u * w2);
    let b2 = n(6) * w * (n(4) * square - w);
    let b3 = n(24) * u * (n(3) * w - T::TWO * square);
    // u^(k−3) … u^k, nothing below u⁰.
    let mut powers = [T::ZERO, T::ZERO, T::ZERO, T::ONE];
    let mut out = [[T::ZERO; BULGE]; 3];
    for k in 0..BULGE {
        let k_ = k as u32;
        let q = powers[3];
        let q1 = n(k_) * powers[2];
        let q2 = n(k_ * k_.saturating_sub(1)) * powers[1];
        let q3 = n(k_ * k_.saturating_sub(1) * k_.saturating_sub(2)) * powers[0];
        out[0][k] = b1 * q + b * q1;
        out[1][k] = b2 * q + T::TWO * b1 * q1 + b * q2;
        out[2][k] = b3 * q + n(3) * (b2 * q1 + b1 * q2) + b * q3;
        powers = [powers[1], powers[2], powers[3], powers[3] * u];
    }
    out
}

/// `d/du`, `d²/du²` and `d³/du³` of the quintic.
pub(super) fn quintic<T: Scalar>(c: &[T; 5], u: T) -> [T; 3] {
    let n = |k: u32| T::from_u32(k);
    [
        (((n(5) * c[4] * u + n(4) * c[3]) * u + n(3) * c[2]) * u + n(2) * c[1]) * u + c[0],
        ((n(20) * c[4] * u + n(12) * c[3]) * u + n(6) * c[2]) * u + n(2) * c[1],
        (n(60) * c[4] * u + n(24) * c[3]) * u + n(6) * c[2],
    ]
}
