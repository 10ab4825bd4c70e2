//! Eigenvalues and vectors of a symmetric tridiagonal matrix. Set-up only.

use super::{Scalar, square_root};

/// Iterations for one eigenvalue; two are usual.
const MOST: usize = 40;

/// All eigenpairs by the implicit QL method: `diagonal` becomes the eigenvalues, in no order;
/// `beside[i]` stands between `i` and `i + 1`. Returns orthonormal vectors as rows.
///
/// Error: a few roundings of the largest eigenvalue.
/// Source: Bowdler, Martin, Reinsch and Wilkinson, Numer. Math. 11 (1968) 293, `tql2`.
pub(crate) fn eigen<T: Scalar, const N: usize>(
    diagonal: &mut [T; N],
    beside: &mut [T; N],
) -> [[T; N]; N] {
    let mut vectors = [[T::ZERO; N]; N];
    for i in 0..N {
        vectors[i][i] = T::ONE;
    }
    turn(diagonal, beside, &mut vectors);
    vectors
}

/// The same for a matrix that `vectors` have made tridiagonal: rows, turned on.
#[inline(never)]
pub(crate) fn turn<T: Scalar, const N: usize>(
    diagonal: &mut [T; N],
    beside: &mut [T; N],
    vectors: &mut [[T; N]; N],
) {
    for first in 0..N {
        for _ in 0..MOST {
            let last = end_of_block(diagonal, beside, first);
            if last == first {
                break;
            }
            step(diagonal, beside, vectors, first, last);
        }
    }
}

/// The last row of the block that begins with `first`: behind it nothing is left beside.
fn end_of_block<T: Scalar, const N: usize>(
    diagonal: &[T; N],
    beside: &[T; N],
    first: usize,
) -> usize {
    (first..N - 1)
        .find(|&i| {
            let size = diagonal[i].abs() + diagonal[i + 1].abs();
            // Half of a rounding of both: added, it changes nothing.
            size + T::HALF * beside[i].abs() == size
        })
        .unwrap_or(N - 1)
}

/// One implicit step of a block, shifted by the eigenvalue of its upper corner.
fn step<T: Scalar, const N: usize>(
    diagonal: &mut [T; N],
    beside: &mut [T; N],
    vectors: &mut [[T; N]; N],
    first: usize,
    last: usize,
) {
    let tilt = (diagonal[first + 1] - diagonal[first]) / (T::TWO * beside[first]);
    let long = square_root(tilt * tilt + T::ONE);
    let below = if tilt < T::ZERO { tilt - long } else { tilt + long };
    let mut g = diagonal[last] - diagonal[first] + beside[first] / below;
    let (mut sin, mut cos, mut shift) = (T::ONE, T::ONE, T::ZERO);
    for i in (first..last).rev() {
        let (f, b) = (sin * beside[i], cos * beside[i]);
        let length = square_root(f * f + g * g);
        beside[i + 1] = length;
        if length == T::ZERO {
            // The block is in two parts.
            diagonal[i + 1] -= shift;
            beside[last] = T::ZERO;
            return;
        }
        let per = T::ONE / length;
        (sin, cos) = (f * per, g * per);
        g = diagonal[i + 1] - shift;
        let r = (diagonal[i] - g) * sin + T::TWO * (cos * b);
        shift = sin * r;
        diagonal[i + 1] = g + shift;
        g = cos * r - b;
        for n in 0..N {
            let (x, y) = (vectors[i][n], vectors[i + 1][n]);
            vectors[i + 1][n] = sin * x + cos * y;
            vectors[i][n] = cos * x - sin * y;
        }
    }
    diagonal[first] -= shift;
    beside[first] = g;
    beside[last] = T::ZERO;
}
