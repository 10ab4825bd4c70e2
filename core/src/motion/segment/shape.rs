//! A formula of a segment, before it has a length.

use core::f64::consts::PI;

use super::Rest;
use crate::math::Scalar;
use crate::motion::curve::BULGE;

/// Turns from the segment's middle, as a function of `u`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape<T> {
    /// `c₁u + c₂u² + c₃u³`.
    Cubic([T; 3]),
    /// `c₁u + … + c₅u⁵`.
    Quintic([T; 5]),
    /// `c₁u + c₂u² + a sin πu + b (cos πu − 1)`.
    Harmonic { c: [T; 2], a: T, b: T },
    /// `c₁u + … + c₅u⁵ + (1 − u²)³(d₀ + d₁u + … + d₅u⁵)`: the second term bulges between the ends
    /// and changes neither angle, rate nor acceleration there.
    Bulged { c: [T; 5], d: [T; BULGE] },
}

/// A bound of `|c₁ + 2c₂u + 3c₃u²|`: without its middle term it lies between its values at the
/// middle and at the ends.
fn steepest<T: Scalar>([c1, c2, c3]: [T; 3]) -> T {
    let abs = |x: T| if x < T::ZERO { -x } else { x };
    let (middle, end) = (abs(c1), abs(c1 + (T::TWO + T::ONE) * c3));
    let most = if middle < end { end } else { middle };
    most + T::TWO * abs(c2)
}

impl<T: Scalar> Shape<T> {
    pub(super) fn low(&self) -> [T; 3] {
        match *self {
            Self::Cubic(c) => c,
            Self::Harmonic { c: [c1, c2], .. } => [c1, c2, T::ZERO],
            Self::Quintic([c1, c2, c3, _, _]) | Self::Bulged { c: [c1, c2, c3, _, _], .. } => {
                [c1, c2, c3]
            }
        }
    }

    pub(super) fn rest(&self) -> Rest<T> {
        match *self {
            Self::Cubic(c) => Rest::Cubic { steepest: steepest(c) },
            Self::Quintic([_, _, _, c4, c5]) => Rest::Quintic([c4, c5]),
            Self::Harmonic { a, b, .. } => Rest::Harmonic([a, b]),
            Self::Bulged { c: [_, _, _, c4, c5], d } => Rest::Bulged { high: [c4, c5], d },
        }
    }

    /// `Δ(−1)`, `Δ(1)` and `d²Δ/du²(1)`.
    pub(super) fn ends(&self) -> [T; 3] {
        let n = T::from_f64;
        let (odd, even, bend) = match *self {
            Self::Cubic([c1, c2, c3]) => (c1 + c3, c2, n(2.0) * c2 + n(6.0) * c3),
            Self::Quintic([c1, c2, c3, c4, c5]) | Self::Bulged { c: [c1, c2, c3, c4, c5], .. } => {
                let bend = n(2.0) * c2 + n(6.0) * c3 + n(12.0) * c4 + n(20.0) * c5;
                (c1 + c3 + c5, c2 + c4, bend)
            }
            Self::Harmonic { c: [c1, c2], b, .. } => {
                (c1, c2 - n(2.0) * b, n(2.0) * c2 + n(PI * PI) * b)
            }
        };
        [even - odd, even + odd, bend]
    }
}
