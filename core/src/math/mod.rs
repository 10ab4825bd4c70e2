//! The little mathematics the beam needs, in fixed-size arrays.
//!
//! Functions of real numbers are called by path from here (never as methods), so that host and
//! target run the same code and give the same bits.

mod array;
mod band;
mod complex;
mod gauss;
mod jacobi;
mod lanczos;
mod least_squares;
mod principal;
mod propagator;
mod scalar;
mod tridiagonal;
mod words;

pub(crate) use array::{Each, array};
pub use band::{Band, HalfForm, Ldl};
pub(crate) use complex::Complex;
pub(crate) use gauss::{GAUSS_POINTS, gauss_points, polynomial};
pub(crate) use jacobi::generalized_eigen;
pub(crate) use lanczos::lowest_eigen;
pub(crate) use least_squares::{LeastSquares, Normal};
pub(crate) use principal::{principal_axes, root};
pub(crate) use propagator::{Functions, Matrix2, phi_functions};
pub use scalar::Scalar;
pub use words::Words;
pub(crate) use words::{layout_of, mix, named, read, words};

/// Square root, correctly rounded, the same bits everywhere. Set-up only.
pub(crate) fn sqrt(x: f64) -> f64 {
    libm::sqrt(x)
}

/// Square root to the precision of the scalar, the same bits everywhere. Set-up only.
pub(crate) fn square_root<T: Scalar>(x: T) -> T {
    T::from_f64(sqrt(x.to_f64()))
}

/// Sine and cosine of an angle in radians, by [`Scalar::sin_cos_turns`].
#[inline(always)]
pub(crate) fn sin_cos<T: Scalar>(radians: T) -> (T, T) {
    (T::from_f64(0.5 / core::f64::consts::PI) * radians).sin_cos_turns()
}

/// `Σ aᵢ bᵢ`.
#[inline(always)]
pub(crate) fn dot<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    const { assert!(N >= 1, "a vector has an element") }
    // From the first product: adding it to zero is an instruction that the compiler must keep.
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum += a[i] * b[i];
    }
    sum
}

/// `x` within `±most`.
#[inline(always)]
pub(crate) fn clip<T: Scalar>(x: T, most: T) -> T {
    if x > most {
        most
    } else if x < -most {
        -most
    } else {
        x
    }
}

/// Rounds a set-up vector to the scalar of the tick.
pub(crate) fn cast<T: Scalar, P: Scalar, const N: usize>(v: &[P; N]) -> [T; N] {
    v.each(round)
}

/// Rounds a number of set-up to the scalar of the tick.
#[inline(always)]
pub(crate) fn round<T: Scalar, P: Scalar>(value: P) -> T {
    T::from_f64(value.to_f64())
}
