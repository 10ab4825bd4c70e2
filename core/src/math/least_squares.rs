//! Linear least squares by normal equations, for a few unknowns in a box of unit size. Set-up only.

use super::Band;

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
            let fitted = factors.solve(&self.right.map(|row| row[q]));
            for i in 0..M {
                if scale[i] != 0.0 {
                    coefficients[i][q] = fitted[i] / scale[i];
                }
            }
        }
        coefficients
    }
}
