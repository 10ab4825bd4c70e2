//! Factors and solutions of the stage equations: symmetric, complex on the diagonal, with rows left
//! out that have no unknown.

use crate::math::{Complex, Scalar};

/// `LDLᵀ` of a complex symmetric matrix, without pivoting.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<T, const C: usize> {
    lower: [[Complex<T>; C]; C],
    /// `1/D`.
    inverse: [Complex<T>; C],
}

impl<T: Scalar, const C: usize> Factors<T, C> {
    /// Factors `matrix + diag(diagonal)`, of which the lower triangle is read, in the rows and
    /// columns that are `free`.
    #[inline(never)]
    pub fn new(matrix: &[[T; C]; C], diagonal: &[Complex<T>; C], free: &[bool; C]) -> Self {
        let mut lower = [[Complex::ZERO; C]; C];
        let mut inverse = [Complex::ZERO; C];
        for i in 0..C {
            if !free[i] {
                continue;
            }
            // Row i of L D, then of L.
            let mut row = [Complex::ZERO; C];
            let mut pivot = diagonal[i] + Complex::new(matrix[i][i], T::ZERO);
            for p in 0..i {
                if !free[p] {
                    continue;
                }
                let mut entry = Complex::new(matrix[i][p], T::ZERO);
                for r in 0..p {
                    entry = entry - row[r] * lower[p][r];
                }
                row[p] = entry;
                let scaled = entry * inverse[p];
                lower[i][p] = scaled;
                pivot = pivot - entry * scaled;
            }
            inverse[i] = pivot.inverse();
        }
        Self { lower, inverse }
    }

    /// Least pivot of the free rows, of a matrix that is real: negative of one that is not
    /// definite.
    pub fn least_pivot(&self, free: &[bool; C]) -> T {
        let mut least = T::from_f64(f64::INFINITY);
        for i in (0..C).filter(|&i| free[i]) {
            let pivot = T::ONE / self.inverse[i].re;
            least = if pivot < least { pivot } else { least };
        }
        least
    }

    /// Solves for one right side in the rows that are `free`; the others stay as they are, and are
    /// to be zero.
    #[inline(never)]
    pub fn solve(&self, right: &[Complex<T>; C], free: &[bool; C]) -> [Complex<T>; C] {
        let mut x = *right;
        for i in 0..C {
            if !free[i] {
                continue;
            }
            let mut sum = x[i];
            for p in 0..i {
                if free[p] {
                    sum = sum - self.lower[i][p] * x[p];
                }
            }
            x[i] = sum;
        }
        for i in (0..C).rev() {
            if !free[i] {
                continue;
            }
            // Column i of the lower factor is row i of the upper one.
            let mut sum = x[i] * self.inverse[i];
            for p in i + 1..C {
                if free[p] {
                    sum = sum - self.lower[p][i] * x[p];
                }
            }
            x[i] = sum;
        }
        x
    }
}

/// Solves two equations of two unknowns.
#[inline(always)]
pub(super) fn solve_pair<T: Scalar>(
    [[a, b], [c, d]]: [[Complex<T>; 2]; 2],
    [u, v]: [Complex<T>; 2],
) -> [Complex<T>; 2] {
    let inverse = (a * d - b * c).inverse();
    [(d * u - b * v) * inverse, (a * v - c * u) * inverse]
}
