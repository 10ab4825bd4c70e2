//! Generalised symmetric eigenproblem by cyclic Jacobi rotations. Set-up only, f64.

use super::{Band, Each, array, sqrt};

/// Sweeps after which the iteration stops; a 16 × 16 beam needs 6 to 8.
const MAX_SWEEPS: usize = 30;

/// Solves `K φ = λ M φ` for all `N` pairs, `K` positive definite, `M` positive semi-definite.
///
/// Works on `A = S⁻¹ M S⁻ᵀ` with `K = S Sᵀ`, whose eigenvalues are `μ = 1/λ`: the lowest modes
/// are then the largest eigenvalues, which Jacobi finds to full relative precision.
/// Returns `(μ, φ)`, `μ` descending, the vectors as rows with `φᵀ K φ = 1`.
/// Error: relative 1e-14 on the lowest half of the spectrum.
pub(crate) fn generalized_eigen<const N: usize, const W: usize>(
    stiffness: &Band<f64, N, W>,
    mass: &Band<f64, N, W>,
) -> ([f64; N], [[f64; N]; N]) {
    let s = cholesky(stiffness);
    let mut a = reduced(mass, &s);
    let mut v = [[0.0; N]; N];
    for i in 0..N {
        v[i][i] = 1.0;
    }
    for _ in 0..MAX_SWEEPS {
        if !sweep(&mut a, &mut v) {
            break;
        }
    }
    let mut order: [usize; N] = array(|i| i);
    order.sort_unstable_by(|&i, &j| a[j][j].total_cmp(&a[i][i]));
    let values = order.each(|i| a[i][i]);
    let vectors = order.each(|i| back_substitute(&s, &v[i]));
    (values, vectors)
}

/// Lower-triangular `S` with `K = S Sᵀ`.
fn cholesky<const N: usize, const W: usize>(k: &Band<f64, N, W>) -> [[f64; N]; N] {
    let mut s = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let mut c = k.get(i, j);
            for e in 0..j {
                c -= s[i][e] * s[j][e];
            }
            s[i][j] = if i == j { sqrt(c) } else { c / s[j][j] };
        }
    }
    s
}

/// `S⁻¹ M S⁻ᵀ`.
fn reduced<const N: usize, const W: usize>(
    m: &Band<f64, N, W>,
    s: &[[f64; N]; N],
) -> [[f64; N]; N] {
    let mut a: [[f64; N]; N] = array(|i| array(|j| m.get(i, j)));
    // Forward substitution on the columns, then, being symmetric, on the rows.
    for _ in 0..2 {
        for c in 0..N {
            for i in 0..N {
                for e in 0..i {
                    a[i][c] -= s[i][e] * a[e][c];
                }
                a[i][c] /= s[i][i];
            }
        }
        for i in 0..N {
            for j in 0..i {
                let upper = a[j][i];
                a[j][i] = a[i][j];
                a[i][j] = upper;
            }
        }
    }
    a
}

/// One cyclic sweep; the rows of `v` collect the eigenvectors. False once nothing is left to turn.
fn sweep<const N: usize>(a: &mut [[f64; N]; N], v: &mut [[f64; N]; N]) -> bool {
    let mut turned = false;
    for p in 0..N {
        for q in p + 1..N {
            let off = a[p][q];
            // Relative to its own diagonal pair: small eigenvalues keep their relative precision.
            if off * off <= 1e-34 * (a[p][p] * a[q][q]).abs() {
                continue;
            }
            turned = true;
            let theta = (a[q][q] - a[p][p]) / (2.0 * off);
            let t =
                if theta < 0.0 { -1.0 } else { 1.0 } / (theta.abs() + sqrt(theta * theta + 1.0));
            let c = 1.0 / sqrt(t * t + 1.0);
            let s = t * c;
            for i in 0..N {
                let (x, y) = (a[i][p], a[i][q]);
                a[i][p] = c * x - s * y;
                a[i][q] = s * x + c * y;
            }
            for i in 0..N {
                let (x, y) = (a[p][i], a[q][i]);
                a[p][i] = c * x - s * y;
                a[q][i] = s * x + c * y;
                let (x, y) = (v[p][i], v[q][i]);
                v[p][i] = c * x - s * y;
                v[q][i] = s * x + c * y;
            }
        }
    }
    turned
}

/// `S⁻ᵀ y`.
fn back_substitute<const N: usize>(s: &[[f64; N]; N], y: &[f64; N]) -> [f64; N] {
    let mut x = *y;
    for i in (0..N).rev() {
        x[i] /= s[i][i];
        for j in 0..i {
            x[j] -= s[i][j] * x[i];
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::super::Band;
    use super::generalized_eigen;

    /// Two equal masses between three equal springs: k and 3k over m, in and out of step.
    #[test]
    fn two_masses_between_three_springs() {
        let (mut k, mut m) = (Band::<f64, 2, 2>::ZERO, Band::<f64, 2, 2>::ZERO);
        for i in 0..2 {
            k.add(i, i, 2.0 * 50.0);
            m.add(i, i, 0.25);
        }
        k.add(1, 0, -50.0);
        let (inverse, shapes) = generalized_eigen(&k, &m);
        for (found, expected) in inverse.into_iter().zip([200.0, 600.0]) {
            assert!((found * expected - 1.0).abs() < 1e-14, "{found} is not 1/{expected}");
        }
        for (i, sign) in [1.0, -1.0].into_iter().enumerate() {
            let ratio = shapes[i][1] / shapes[i][0];
            assert!((ratio - sign).abs() < 1e-14, "shape {i}: {ratio}");
            let norm: f64 = k.times(&shapes[i]).iter().zip(&shapes[i]).map(|(x, y)| x * y).sum();
            assert!((norm - 1.0).abs() < 1e-14, "φᵀKφ = {norm}");
        }
    }
}
