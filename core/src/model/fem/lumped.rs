//! Static condensation of massless rotations, as a lumped mass matrix needs it.

use super::assembly::{Assembly, CHAIN};
use crate::math::{Band, Each, array};

/// `T`, `D × N`: the full displacement that goes with the kept degrees of freedom when no moment
/// acts on the massless rotations, `T = [I; −K_φφ⁻¹ K_φw]`, rows in the order of the chain.
pub(crate) struct Condensation<const D: usize, const N: usize> {
    t: [[f64; N]; D],
}

impl<const D: usize, const N: usize> Condensation<D, N> {
    /// Keeps every deflection, and the tip's rotation where the payload gives it inertia.
    pub(crate) fn new(chain: &Assembly<f64, D>) -> Self {
        let kept = |i: usize| chain.mass.get(i, i) > 0.0;
        let mut t = [[0.0; N]; D];
        for (column, row) in (0..D).filter(|&i| kept(i)).enumerate() {
            t[row][column] = 1.0;
        }
        // Gauss-Seidel would do; elimination is exact. `k` loses one massless rotation at a time,
        // `t[i]` records it as a combination of the degrees that are left.
        let mut k: [[f64; D]; D] = array(|i| array(|j| chain.stiffness.get(i, j)));
        for p in (0..D).filter(|&p| !kept(p)) {
            let pivot = k[p];
            for i in (0..D).filter(|&i| i != p) {
                let factor = k[i][p] / pivot[p];
                for j in 0..D {
                    k[i][j] -= factor * pivot[j];
                }
            }
        }
        // Each massless row is now diagonal but for the kept columns: φ_p = −Σ k[p][w] w / k[p][p].
        for p in (0..D).filter(|&p| !kept(p)) {
            for (column, w) in (0..D).filter(|&i| kept(i)).enumerate() {
                t[p][column] = -k[p][w] / k[p][p];
            }
        }
        Self { t }
    }

    /// Degrees of freedom that stay: those with mass.
    pub(crate) fn kept(chain: &Assembly<f64, D>) -> usize {
        (0..D).filter(|&i| chain.mass.get(i, i) > 0.0).count()
    }

    /// The chain's degree of freedom `i` by the kept ones.
    pub(crate) fn row(&self, i: usize) -> &[f64; N] {
        &self.t[i]
    }

    /// `Tᵀ A T`.
    pub(crate) fn matrix(&self, a: &Band<f64, D, CHAIN>) -> Band<f64, N, N> {
        let mut reduced = Band::ZERO;
        for c in 0..N {
            let column = self.t.each(|row| row[c]);
            let product = self.vector(&a.times(&column));
            for r in c..N {
                reduced.add(r, c, product[r]);
            }
        }
        reduced
    }

    /// `Tᵀ f`.
    pub(crate) fn vector(&self, f: &[f64; D]) -> [f64; N] {
        array(|c| (0..D).map(|i| self.t[i][c] * f[i]).sum())
    }
}
