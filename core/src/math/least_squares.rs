//! Linear least squares by normal equations, for a few unknowns in a box of unit size. Set-up only.

use super::{Each, Scalar};

/// The normal equations of functions at given samples, factored when the program is compiled:
/// `LDLᵀ`, the triangle `L` without its ones, and `1/D`.
pub(crate) struct Normal<const M: usize> {
    lower: [[f64; M]; M],
    inverse: [f64; M],
}

impl<const M: usize> Normal<M> {
    /// Of the matrix `Σ fᵢfⱼ`. Functions that are zero at every sample take no part.
    pub(crate) const fn of(mut matrix: [[f64; M]; M]) -> Self {
        let mut lower = [[0.0; M]; M];
        let mut inverse = [1.0; M];
        let mut i = 0;
        while i < M {
            if matrix[i][i] != 0.0 {
                inverse[i] = 1.0 / matrix[i][i];
                let mut r = i + 1;
                while r < M {
                    lower[r][i] = matrix[r][i] * inverse[i];
                    let mut c = i + 1;
                    while c < M {
                        matrix[r][c] -= lower[r][i] * matrix[i][c];
                        c += 1;
                    }
                    r += 1;
                }
            }
            i += 1;
        }
        Self { lower, inverse }
    }
}

/// Fits `Q` quantities as combinations of the same `M` functions.
pub(crate) struct LeastSquares<T, const M: usize, const Q: usize> {
    right: [[T; Q]; M],
}

impl<T: Scalar, const M: usize, const Q: usize> LeastSquares<T, M, Q> {
    pub(crate) fn new() -> Self {
        Self { right: [[T::ZERO; Q]; M] }
    }

    /// Takes in the functions' values at one sample, and the quantities'.
    pub(crate) fn add(&mut self, functions: &[T; M], quantities: &[T; Q]) {
        for i in 0..M {
            for q in 0..Q {
                self.right[i][q] += functions[i] * quantities[q];
            }
        }
    }

    /// The coefficients of each function.
    pub(crate) fn solve(self, normal: &Normal<M>) -> [[T; Q]; M] {
        let lower = normal.lower.each(|row| row.each(T::from_f64));
        let mut fitted = self.right;
        for i in 0..M {
            for j in 0..i {
                for q in 0..Q {
                    let part = lower[i][j] * fitted[j][q];
                    fitted[i][q] -= part;
                }
            }
        }
        for i in 0..M {
            let inverse = T::from_f64(normal.inverse[i]);
            fitted[i] = fitted[i].each(|x| inverse * x);
        }
        for i in (0..M).rev() {
            for j in 0..i {
                for q in 0..Q {
                    let part = lower[i][j] * fitted[i][q];
                    fitted[j][q] -= part;
                }
            }
        }
        fitted
    }
}

#[cfg(test)]
mod tests {
    use super::{LeastSquares, Normal};

    /// Over the samples, which are rows of the functions' values.
    fn normal<const M: usize>(samples: &[[f64; M]]) -> Normal<M> {
        let sum = |i: usize, j: usize| samples.iter().map(|f| f[i] * f[j]).sum();
        Normal::of(core::array::from_fn(|i| core::array::from_fn(|j| sum(i, j))))
    }

    /// Samples of a line are fitted by that line; a function that is zero throughout takes no part.
    #[test]
    fn a_line_is_found_among_its_samples() {
        let mut fit = LeastSquares::<f64, 3, 2>::new();
        let samples = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x| [1.0, x, 0.0]);
        for sample in &samples {
            let x = sample[1];
            fit.add(sample, &[2.0 - 3.0 * x, x]);
        }
        let found = fit.solve(&normal(&samples));
        let expected = [[2.0, 0.0], [-3.0, 1.0], [0.0, 0.0]];
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-13, "{found} is not {expected}");
        }
    }

    /// The normal equations leave what the functions cannot fit: of 0, 0, 1 the mean is a third.
    #[test]
    fn a_constant_is_fitted_by_the_mean() {
        let mut fit = LeastSquares::<f64, 1, 1>::new();
        for quantity in [0.0, 0.0, 1.0] {
            fit.add(&[1.0], &[quantity]);
        }
        let [[mean]] = fit.solve(&normal(&[[1.0]; 3]));
        assert!((mean - 1.0 / 3.0).abs() < 1e-15, "{mean}");
    }
}
