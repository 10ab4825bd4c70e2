//! Acceleration of a segment at its two ends, used where segments join inside a tick.

use core::f64::consts::PI;

use super::{Rest, Segment};
use crate::math::{Each, Scalar, array};

/// θ̈, rad/s², and its first three derivatives by the tick.
pub(crate) type Course<T> = [T; 4];

impl<T: Scalar> Segment<T> {
    /// θ̈ and its derivatives at the segment's true beginning and at its true end, from within.
    pub(crate) fn courses(&self) -> [Course<T>; 2] {
        [-T::ONE, T::ONE].each(|u| {
            let scale = T::HALF * self.acceleration_scale;
            let (per_tick, square) = (self.advance, self.advance * self.advance);
            let [second, third, fourth, fifth] = self.curvature_at(u);
            [
                scale * second,
                scale * per_tick * third,
                scale * square * fourth,
                scale * square * per_tick * fifth,
            ]
        })
    }

    /// Second to fifth derivative of the curve at `u = ±1`, turns.
    fn curvature_at(&self, u: T) -> [T; 4] {
        let n = T::from_f64;
        let [_, c2, c3] = self.low;
        let cubic = [T::TWO * c2 + n(6.0) * c3 * u, n(6.0) * c3, T::ZERO, T::ZERO];
        match self.rest {
            Rest::Cubic { .. } => cubic,
            Rest::Quintic(high) => plus(cubic, quintic(high, u)),
            Rest::Harmonic([a, b]) => {
                const SQUARE: f64 = PI * PI;
                let [second, third] = [n(SQUARE) * b, n(SQUARE * PI) * a];
                plus(cubic, [second, third, -(n(SQUARE) * second), -(n(SQUARE) * third)])
            }
            Rest::Bulged { high, d } => plus(plus(cubic, quintic(high, u)), bulge(&d, u)),
            Rest::Cruise { .. } => [T::ZERO; 4],
        }
    }
}

fn plus<T: Scalar>(a: [T; 4], b: [T; 4]) -> [T; 4] {
    array(|i| a[i] + b[i])
}

/// Second to fifth derivative of `c₄u⁴ + c₅u⁵`.
fn quintic<T: Scalar>([c4, c5]: [T; 2], u: T) -> [T; 4] {
    let n = T::from_f64;
    [
        n(12.0) * c4 + n(20.0) * c5 * u,
        n(24.0) * c4 * u + n(60.0) * c5,
        n(24.0) * c4 + n(120.0) * c5 * u,
        n(120.0) * c5,
    ]
}

/// Second to fifth derivative of `(1 − u²)³Q(u)` at `u = ±1`: `(1 − u²)³ = ∓(8x³ ± 12x⁴ + 6x⁵ …)`
/// at `u = ±1 + x`.
fn bulge<T: Scalar>(d: &[T], u: T) -> [T; 4] {
    let (mut q, mut slope, mut half_bend) = (T::ZERO, T::ZERO, T::ZERO);
    for &d in d.iter().rev() {
        half_bend = half_bend * u + slope;
        slope = slope * u + q;
        q = q * u + d;
    }
    let n = T::from_f64;
    [
        T::ZERO,
        -(n(48.0) * u * q),
        -(n(288.0) * q + n(192.0) * u * slope),
        -(n(720.0) * u * q + n(1440.0) * slope + n(960.0) * u * half_bend),
    ]
}
