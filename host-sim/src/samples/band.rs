//! Symmetric band matrices with three diagonals beside the main one.

/// Diagonals beside the main one.
const WIDTH: usize = 3;

/// Lower half of a symmetric band matrix: `rows[i][j]` is the element `(i, i − j)`.
#[derive(Clone, Debug)]
pub struct Band {
    rows: Vec<[f64; WIDTH + 1]>,
}

/// `L D Lᵀ` of a positive definite band matrix, `L` with ones on its diagonal.
#[derive(Clone, Debug)]
pub struct Factors {
    /// `rows[i][0]` is `D`; `rows[i][j]` is `L` at `(i, i − j)`.
    rows: Vec<[f64; WIDTH + 1]>,
}

impl Band {
    /// Creates the zero matrix of order `n`.
    pub fn zero(n: usize) -> Self {
        Self { rows: vec![[0.0; WIDTH + 1]; n] }
    }

    /// Adds `weight v vᵀ`. `v` is zero but for the elements that are given by index, which lie
    /// within the band. An index may occur twice.
    pub fn add(&mut self, v: &[(usize, f64)], weight: f64) {
        for &(i, x) in v {
            for &(k, y) in v {
                if k <= i {
                    self.rows[i][i - k] += weight * x * y;
                }
            }
        }
    }

    /// Returns `self + factor · other`.
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let sum = |(a, b): (&[f64; WIDTH + 1], &[f64; WIDTH + 1])| {
            std::array::from_fn(|j| a[j] + factor * b[j])
        };
        Self { rows: self.rows.iter().zip(&other.rows).map(sum).collect() }
    }

    /// Factors the matrix, which must be positive definite.
    pub fn factor(&self) -> Factors {
        let mut rows = self.rows.clone();
        for i in 0..rows.len() {
            for j in (0..=WIDTH.min(i)).rev() {
                let k = i - j;
                let mut sum = rows[i][j];
                for m in j + 1..=WIDTH.min(i) {
                    if m - j <= WIDTH.min(k) {
                        sum -= rows[i][m] * rows[i - m][0] * rows[k][m - j];
                    }
                }
                rows[i][j] = if j == 0 { sum } else { sum / rows[k][0] };
            }
        }
        Factors { rows }
    }
}

impl Factors {
    /// Returns the `x` with `L D Lᵀ x = b`.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        let n = x.len();
        for i in 0..n {
            for j in 1..=WIDTH.min(i) {
                x[i] -= self.rows[i][j] * x[i - j];
            }
        }
        for i in (0..n).rev() {
            x[i] /= self.rows[i][0];
            for j in 1..=WIDTH.min(n - 1 - i) {
                x[i] -= self.rows[i + j][j] * x[i + j];
            }
        }
        x
    }

    /// Returns those elements of the inverse that lie within the band, after Hutchinson and de Hoog
    /// (Numerische Mathematik 47, 1985): the other elements are not needed for them.
    pub fn inverse(&self) -> Band {
        let n = self.rows.len();
        let mut inverse = Band::zero(n);
        for i in (0..n).rev() {
            let most = WIDTH.min(n - 1 - i);
            for j in (0..=most).rev() {
                let mut sum = if j == 0 { 1.0 / self.rows[i][0] } else { 0.0 };
                for k in 1..=most {
                    sum -= self.rows[i + k][k] * inverse.at(i + k, i + j);
                }
                inverse.rows[i + j][j] = sum;
            }
        }
        inverse
    }
}

impl Band {
    fn at(&self, i: usize, k: usize) -> f64 {
        let (high, low) = (i.max(k), i.min(k));
        if high - low > WIDTH { 0.0 } else { self.rows[high][high - low] }
    }

    /// Returns `vᵀ A v`, `v` as in [`Self::add`].
    pub fn form(&self, v: &[(usize, f64)]) -> f64 {
        let row =
            |&(i, x): &(usize, f64)| v.iter().map(|&(k, y)| x * y * self.at(i, k)).sum::<f64>();
        v.iter().map(row).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with the bands of the fit, and one column of its inverse by hand-made products.
    #[test]
    fn factors_solve_and_invert() {
        let n = 9;
        let mut a = Band::zero(n);
        for i in 0..n - 3 {
            a.add(&[(i, 1.0), (i + 1, -3.0), (i + 2, 3.0), (i + 3, -1.0)], 0.7);
            a.add(&[(i, 0.1), (i + 1, 0.6), (i + 2, 0.3)], 1.0 + i as f64);
        }
        a.add(&[(n - 1, 1.0)], 1.0);
        a.add(&[(n - 2, 1.0)], 2.0);
        let factors = a.factor();
        let inverse = factors.inverse();
        for i in 0..n {
            let mut unit = vec![0.0; n];
            unit[i] = 1.0;
            let x = factors.solve(&unit);
            for k in 0..n {
                let product: f64 = (0..n).map(|m| a.at(k, m) * x[m]).sum();
                assert!((product - unit[k]).abs() < 1e-10, "({k}, {i}): {product}");
                if i.abs_diff(k) <= WIDTH {
                    assert!((inverse.at(k, i) - x[k]).abs() < 1e-10 * x[i], "({k}, {i})");
                }
            }
        }
    }
}
