//! Linear equations of a chain of nodes.

use nalgebra::{Matrix3, Vector3};

/// A block-tridiagonal matrix, three unknowns a node.
pub(super) struct Chain {
    pub diagonal: Vec<Matrix3<f64>>,
    /// Row i, column i − 1; the first is not used.
    pub lower: Vec<Matrix3<f64>>,
    /// Row i, column i + 1; the last is not used.
    pub upper: Vec<Matrix3<f64>>,
}

impl Chain {
    pub fn new(nodes: usize) -> Self {
        let zeros = vec![Matrix3::zeros(); nodes];
        Self { diagonal: zeros.clone(), lower: zeros.clone(), upper: zeros }
    }

    pub fn clear(&mut self) {
        for blocks in [&mut self.diagonal, &mut self.lower, &mut self.upper] {
            blocks.fill(Matrix3::zeros());
        }
    }

    /// Replaces `b` by the solution, from block row `first` on. The matrix is used up. Returns
    /// `None` if a pivot block is singular.
    pub fn solve(&mut self, first: usize, b: &mut [Vector3<f64>]) -> Option<()> {
        let n = self.diagonal.len();
        for i in first..n {
            if i > first {
                let lower = self.lower[i];
                self.diagonal[i] -= lower * self.upper[i - 1];
                b[i] -= lower * b[i - 1];
            }
            let inverse = self.diagonal[i].try_inverse()?;
            self.upper[i] = inverse * self.upper[i];
            b[i] = inverse * b[i];
        }
        for i in (first..n.saturating_sub(1)).rev() {
            b[i] -= self.upper[i] * b[i + 1];
        }
        Some(())
    }

    /// Returns true if the matrix, if symmetric, is positive definite from block row `first` on.
    /// The matrix is used up.
    pub fn is_positive_definite(&mut self, first: usize) -> bool {
        for i in first..self.diagonal.len() {
            if i > first {
                let Some(inverse) = self.diagonal[i - 1].try_inverse() else { return false };
                let lower = self.lower[i];
                self.diagonal[i] -= lower * inverse * self.upper[i - 1];
            }
            if self.diagonal[i].cholesky().is_none() {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn solves_as_a_full_matrix_does() {
        let n = 5;
        let mut chain = Chain::new(n);
        let mut full = DMatrix::zeros(3 * n, 3 * n);
        let entry = |i: usize, j: usize, k: usize| ((7 * i + 3 * j + 5 * k) % 11) as f64 / 11.0;
        for i in 0..n {
            chain.diagonal[i] = Matrix3::from_fn(|r, c| entry(i, r, c)) + 4.0 * Matrix3::identity();
            chain.lower[i] = Matrix3::from_fn(|r, c| entry(r, i, c));
            chain.upper[i] = Matrix3::from_fn(|r, c| entry(r, c, i));
            full.fixed_view_mut::<3, 3>(3 * i, 3 * i).copy_from(&chain.diagonal[i]);
            if i > 0 {
                full.fixed_view_mut::<3, 3>(3 * i, 3 * i - 3).copy_from(&chain.lower[i]);
                let upper = chain.upper[i - 1];
                full.fixed_view_mut::<3, 3>(3 * i - 3, 3 * i).copy_from(&upper);
            }
        }
        let x: Vec<Vector3<f64>> = (0..n).map(|i| Vector3::new(1.0, i as f64, -0.5)).collect();
        let flat = DVector::from_iterator(3 * n, x.iter().flat_map(|v| v.iter().copied()));
        let product = full * flat;
        let mut b: Vec<_> = (0..n).map(|i| product.fixed_rows::<3>(3 * i).into_owned()).collect();
        assert!(chain.solve(0, &mut b).is_some());
        for (found, exact) in b.iter().zip(&x) {
            assert!((found - exact).amax() < 1e-12);
        }
    }
}
