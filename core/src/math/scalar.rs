//! The scalar of the tick: `f32` on the target, `f32` or `f64` on the host.

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use super::Words;

/// A real number of the tick path.
///
/// Only `+ − × ÷`, the absolute value, comparisons and conversions: these are IEEE-exact on every
/// target, so that a run gives the same bits everywhere. There is deliberately no `sin`, `sqrt` or
/// `mul_add`: the first two would pull libm into the tick, the last would change bits between
/// machines.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Words
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// ½.
    const HALF: Self;
    /// 2.
    const TWO: Self;

    /// Distance from 1 to the next number.
    const EPSILON: Self;

    /// Rounds to nearest, ties to even.
    fn from_f64(value: f64) -> Self;

    /// Exact.
    fn to_f64(self) -> f64;

    /// Rounds to nearest, ties to even.
    fn from_u32(value: u32) -> Self;

    /// The nearest whole number, halves to even, and what is left: `self = whole + rest` exactly.
    ///
    /// `|self| < 2²¹ − ½`, the nearest of which is a whole number of 22 bits. Outside of it, and
    /// for NaN, both are arbitrary.
    fn split(self) -> (i32, Self);

    /// The signed binary fraction `value / 2⁶⁴`, in `−½ ..= ½`, to the scalar's precision.
    fn from_fraction(value: i64) -> Self;

    /// `(sin 2πx, cos 2πx)` of an angle in turns.
    ///
    /// `x` in turns, `|x| ≤ 1000`. Reduced to the nearest quarter turn (exact), then minimax
    /// polynomials on `±⅛` turn: degree 7 and 8 for `f32`, 13 and 14 for `f64`.
    /// Error: at most 1.5e-7 (`f32`) and 4e-16 (`f64`) for `|x| ≤ ½`; asserted by the tests.
    /// Source: Chebyshev fits in `x²` with 40 digits; fit errors 2e-8 and 2e-17.
    fn sin_cos_turns(self) -> (Self, Self);

    /// The absolute value, exact.
    fn abs(self) -> Self;

    /// Finite: neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

macro_rules! scalar {
    ($t:ty, $shift:expr, $whole:expr, $fraction:expr, $sin:expr, $cos:expr) => {
        impl Scalar for $t {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const TWO: Self = 2.0;
            const EPSILON: Self = <$t>::EPSILON;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $t
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }

            #[inline(always)]
            fn from_u32(value: u32) -> Self {
                value as $t
            }

            #[inline(always)]
            fn split(self) -> (i32, Self) {
                // Added to 1.5 × 2^(mantissa bits), a number loses what is behind its point, and
                // the lowest bits are the whole part: four instructions, no branch.
                let shifted = self + $shift;
                ($whole(shifted.to_bits()), self + ($shift - shifted))
            }

            #[inline(always)]
            fn from_fraction(value: i64) -> Self {
                $fraction(value)
            }

            #[inline(always)]
            fn sin_cos_turns(self) -> (Self, Self) {
                let (quarters, r) = (4.0 * self).split();
                let z = r * r;
                let s = r * horner(&$sin, z);
                let c = 1.0 + z * horner(&$cos, z);
                let (s, c) = if quarters & 1 == 0 { (s, c) } else { (c, -s) };
                if quarters & 2 == 0 { (s, c) } else { (-s, -c) }
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$t>::abs(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                <$t>::is_finite(self)
            }
        }
    };
}

/// `Σ cₖ zᵏ`.
#[inline(always)]
fn horner<T: Scalar, const N: usize>(coefficients: &[T; N], z: T) -> T {
    let mut sum = coefficients[N - 1];
    for i in (0..N - 1).rev() {
        sum = sum * z + coefficients[i];
    }
    sum
}

/// Coefficients per turn as coefficients per quarter turn, `cₖ / 4^(2k + first)`: exact.
const fn quarter<const N: usize>(mut c: [f64; N], first: u32) -> [f64; N] {
    let mut k = 0;
    while k < N {
        c[k] /= (1u64 << (2 * (2 * k as u32 + first))) as f64;
        k += 1;
    }
    c
}

/// Converts as [`quarter`] does, in `f32`.
const fn quarter_f32<const N: usize>(c: [f32; N], first: u32) -> [f32; N] {
    let mut scaled = c;
    let mut k = 0;
    while k < N {
        scaled[k] /= (1u64 << (2 * (2 * k as u32 + first))) as f32;
        k += 1;
    }
    scaled
}

// The upper half carries 32 bits, more than an f32 holds; one conversion instead of a soft one.
scalar!(
    f32,
    12_582_912.0,
    // The 22 bits below the one that 1.5 sets, sign-extended.
    |bits: u32| ((bits << 10) as i32) >> 10,
    |value: i64| (value >> 32) as i32 as f32 * (1.0 / 4_294_967_296.0),
    const { quarter_f32([core::f32::consts::TAU, -41.341_663, 81.592_54, -75.401_61], 1) },
    const { quarter_f32([-19.739_208, 64.939_37, -85.448_82, 59.424_107], 2) }
);

scalar!(
    f64,
    6_755_399_441_055_744.0,
    |bits: u64| bits as i32,
    |value: i64| value as f64 * (1.0 / 18_446_744_073_709_551_616.0),
    const {
        quarter(
            [
                core::f64::consts::TAU,
                -41.341_702_240_399_636,
                81.605_249_275_948_04,
                -76.705_859_704_274_55,
                42.058_685_020_160_894,
                -15.093_804_209_987_114,
                3.780_868_959_302_295_5,
            ],
            1,
        )
    },
    const {
        quarter(
            [
                -19.739_208_802_178_717,
                64.939_394_022_668_24,
                -85.456_817_206_643_8,
                60.244_641_352_702_01,
                -26.426_253_275_854_72,
                7.903_206_911_569_678,
                -1.699_034_394_066_063_6,
            ],
            2,
        )
    }
);

#[cfg(test)]
mod tests {
    use super::Scalar;

    /// Worst error of sine and cosine over ±½ turn.
    fn worst<T: Scalar>() -> f64 {
        (-50_000..=50_000)
            .map(|i| {
                let x = T::from_f64(f64::from(i) / 100_000.0);
                let (sin, cos) = x.sin_cos_turns();
                let exact = (core::f64::consts::TAU * x.to_f64()).sin_cos();
                (sin.to_f64() - exact.0).abs().max((cos.to_f64() - exact.1).abs())
            })
            .fold(0.0, f64::max)
    }

    // Miri's own sine, the judge here, errs on purpose; 200,000 of them take it ten minutes.
    #[cfg_attr(miri, ignore)]
    #[test]
    fn sine_and_cosine_keep_their_stated_error() {
        assert!(worst::<f32>() <= 1.5e-7, "f32: {:e}", worst::<f32>());
        assert!(worst::<f64>() <= 4e-16, "f64: {:e}", worst::<f64>());
    }

    #[test]
    fn quarter_turns_are_exact() {
        for (turns, expected) in
            [(0.0, (0.0, 1.0)), (0.25, (1.0, 0.0)), (0.5, (0.0, -1.0)), (-0.25, (-1.0, 0.0))]
        {
            assert_eq!(
                f32::from_f64(turns).sin_cos_turns(),
                (expected.0 as f32, expected.1 as f32)
            );
            assert_eq!(turns.sin_cos_turns(), expected);
        }
    }
}
