//! The curves of segments and their derivatives, as functions of `u = −1..1`.

use core::f64::consts::PI;

use crate::math::Scalar;

/// Coefficients of a bulge.
pub const BULGE: usize = 6;

/// `(Δ, dΔ/du, ½ d²Δ/du²)` of a shape in turns.
pub(super) type Derivatives<T> = (T, T, T);

/// Evaluates a cubic by repeated synthetic division: value, slope and half the curvature out of one
/// chain, without multiplying coefficients by their powers.
#[inline(always)]
pub(super) fn cubic<T: Scalar>([c1, c2, c3]: [T; 3], u: T) -> Derivatives<T> {
    let p = c3 * u;
    let p2 = p + c2;
    let p1 = p2 * u + c1;
    let q2 = p2 + p;
    (p1 * u, q2 * u + p1, q2 + p)
}

/// Evaluates a quintic in the same way as [`cubic`].
#[inline(always)]
pub(super) fn quintic<T: Scalar>([c1, c2, c3, c4, c5]: [T; 5], u: T) -> Derivatives<T> {
    let p = c5 * u;
    let p4 = p + c4;
    let p3 = p4 * u + c3;
    let p2 = p3 * u + c2;
    let p1 = p2 * u + c1;
    let q4 = p4 + p;
    let q3 = q4 * u + p3;
    let q2 = q3 * u + p2;
    let r3 = (q4 + p) * u + q3;
    (p1 * u, q2 * u + p1, r3 * u + q2)
}

#[inline(always)]
pub(super) fn harmonic<T: Scalar>([c1, c2]: [T; 2], a: T, b: T, u: T) -> Derivatives<T> {
    let (sin, cos) = (T::HALF * u).sin_cos_turns();
    let (pi, half_pi2) = (T::from_f64(PI), T::from_f64(0.5 * PI * PI));
    let p2 = c2 * u;
    let p1 = p2 + c1;
    (
        p1 * u + a * sin + b * (cos - T::ONE),
        p1 + p2 + pi * (a * cos - b * sin),
        c2 - half_pi2 * (a * sin + b * cos),
    )
}

/// `w³ Q(u)`, `w = 1 − u²`, `Q = d₀ + d₁u + … + d₅u⁵`.
#[inline(always)]
pub(super) fn bulge<T: Scalar>(d: &[T; BULGE], u: T) -> Derivatives<T> {
    let (mut q, mut q1, mut q2) = (d[BULGE - 1], T::ZERO, T::ZERO);
    for i in (0..BULGE - 1).rev() {
        q2 = if i < BULGE - 3 { q2 * u + q1 } else { q1 };
        q1 = if i < BULGE - 2 { q1 * u + q } else { q };
        q = q * u + d[i];
    }
    let [b, b1, b2] = dome(u);
    (b * q, b1 * q + b * q1, b2 * q + b1 * q1 + b * q2)
}

/// `w³`, its slope and half its curvature, `w = 1 − u²`.
#[inline(always)]
fn dome<T: Scalar>(u: T) -> [T; 3] {
    let three = T::TWO + T::ONE;
    let square = u * u;
    let w = T::ONE - square;
    let w2 = w * w;
    [w2 * w, -(T::TWO * three * u * w2), three * w * ((T::TWO + T::TWO) * square - w)]
}
