//! Linear least squares by normal equations, for a few unknowns in a box of unit size. Set-up only.

use super::{Band, Each};

/// Fits `Q` quantities as combinations of the same `M` functions. Functions that are zero at every
/// sample take no part.
pub(crate) struct LeastSquares<const M: usize, const Q: usize> {
    normal: Band<f64, M, M>,
    right: [[f64; Q]; M],
}

impl<const M: usize, const Q: usize> LeastSquares<M, Q> {
    pub(crate) fn new() -> Self {
        Self { normal: Band::ZERO, right: [[0.0; Q]; M] }
    }

    /// Takes in the functions' values at one sample, and the quantities'.
    pub(crate) fn add(&mut self, functions: &[f64; M], quantities: &[f64; Q]) {
        for i in 0..M {
            for j in 0..=i {
                self.normal.add(i, j, functions[i] * functions[j]);
            }
            for q in 0..Q {
                self.right[i][q] += functions[i] * quantities[q];
            }
        }
    }

    /// The coefficients of each function, divided by its `scale`; zero where that is zero.
    pub(crate) fn solve(mut self, scale: &[f64; M]) -> [[f64; Q]; M] {
        for i in 0..M {
            if self.normal.get(i, i) == 0.0 {
                self.normal.add(i, i, 1.0);
            }
        }
        let factors = self.normal.factor();
        let mut coefficients = [[0.0; Q]; M];
        for q in 0..Q {
            let fitted = factors.solve(&self.right.each(|row| row[q]));
            for i in 0..M {
                if scale[i] != 0.0 {
                    coefficients[i][q] = fitted[i] / scale[i];
                }
            }
        }
        coefficients
    }
}

#[cfg(test)]
mod tests {
    use super::LeastSquares;

    /// Samples of a line are fitted by that line; a function that is zero throughout takes no part.
    #[test]
    fn a_line_is_found_among_its_samples() {
        let mut fit = LeastSquares::<3, 2>::new();
        for i in 0..5 {
            let x = f64::from(i) / 4.0;
            fit.add(&[1.0, x, 0.0], &[2.0 - 3.0 * x, x]);
        }
        let found = fit.solve(&[1.0, 1.0, 0.0]);
        let expected = [[2.0, 0.0], [-3.0, 1.0], [0.0, 0.0]];
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-13, "{found} is not {expected}");
        }
    }

    /// The normal equations leave what the functions cannot fit: of 0, 0, 1 the mean is a third.
    #[test]
    fn a_constant_is_fitted_by_the_mean() {
        let mut fit = LeastSquares::<1, 1>::new();
        for quantity in [0.0, 0.0, 1.0] {
            fit.add(&[1.0], &[quantity]);
        }
        let [[mean]] = fit.solve(&[2.0]);
        assert!((mean - 1.0 / 6.0).abs() < 1e-15, "a third in units of 2: {mean}");
    }
}
