//! Generalised symmetric eigenproblem by cyclic Jacobi rotations. Set-up only.

use super::{Band, Scalar, sqrt};

/// Sweeps after which the iteration stops; a 16 × 16 beam needs 6 to 8.
const MAX_SWEEPS: usize = 30;

/// Solves `K φ = λ M φ` for all `N` pairs, `K` positive definite, `M` symmetric.
///
/// Works on `A = S⁻¹ M S⁻ᵀ` with `K = S Sᵀ`, whose eigenvalues are `μ = 1/λ`: where `M` is a mass, the
/// lowest modes are then the largest eigenvalues, which Jacobi finds to full relative precision.
/// Returns `(μ, φ)`, `μ` descending, the vectors as rows with `φᵀ K φ = 1`.
/// Error: relative 1e-14 (f64) on the lowest half of the spectrum.
pub(crate) fn generalized_eigen<T: Scalar, const N: usize, const W: usize>(
    stiffness: &Band<T, N, W>,
    mass: &Band<T, N, W>,
) -> ([T; N], [[T; N]; N]) {
    let (s, a, v) = diagonal(stiffness, mass);
    let mut order: [usize; N] = core::array::from_fn(|i| i);
    order.sort_unstable_by(|&i, &j| a[j][j].to_f64().total_cmp(&a[i][i].to_f64()));
    let values = order.map(|i| a[i][i]);
    let vectors = order.map(|i| back_substitute(&s, &v[i]));
    (values, vectors)
}

/// Vectors with `vᵢᵀ K vⱼ = δᵢⱼ` and `vᵢᵀ M vⱼ = 0`, `i ≠ j`, as rows in no order; `K` positive
/// definite, `M` symmetric.
pub(crate) fn principal_axes<T: Scalar, const N: usize, const W: usize>(
    stiffness: &Band<T, N, W>,
    mass: &Band<T, N, W>,
) -> [[T; N]; N] {
    let (s, _, v) = diagonal(stiffness, mass);
    v.map(|row| back_substitute(&s, &row))
}

/// `S`, `V A Vᵀ` with nothing beside the diagonal, and `V`.
fn diagonal<T: Scalar, const N: usize, const W: usize>(
    stiffness: &Band<T, N, W>,
    mass: &Band<T, N, W>,
) -> ([[T; N]; N], [[T; N]; N], [[T; N]; N]) {
    let s = cholesky(stiffness);
    let mut a = reduced(mass, &s);
    let mut v = [[T::ZERO; N]; N];
    for i in 0..N {
        v[i][i] = T::ONE;
    }
    for _ in 0..MAX_SWEEPS {
        if !sweep(&mut a, &mut v) {
            break;
        }
    }
    (s, a, v)
}

/// Lower-triangular `S` with `K = S Sᵀ`.
fn cholesky<T: Scalar, const N: usize, const W: usize>(k: &Band<T, N, W>) -> [[T; N]; N] {
    let mut s = [[T::ZERO; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let mut c = k.get(i, j);
            for e in 0..j {
                c -= s[i][e] * s[j][e];
            }
            s[i][j] = if i == j { root(c) } else { c / s[j][j] };
        }
    }
    s
}

/// `S⁻¹ M S⁻ᵀ`.
fn reduced<T: Scalar, const N: usize, const W: usize>(
    m: &Band<T, N, W>,
    s: &[[T; N]; N],
) -> [[T; N]; N] {
    let mut a: [[T; N]; N] = core::array::from_fn(|i| core::array::from_fn(|j| m.get(i, j)));
    // Forward substitution on the columns, then, being symmetric, on the rows.
    for _ in 0..2 {
        for c in 0..N {
            for i in 0..N {
                for e in 0..i {
                    let product = s[i][e] * a[e][c];
                    a[i][c] -= product;
                }
                a[i][c] = a[i][c] / s[i][i];
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
fn sweep<T: Scalar, const N: usize>(a: &mut [[T; N]; N], v: &mut [[T; N]; N]) -> bool {
    // 1e-34 in f64.
    let least = T::from_f64(0.002) * T::EPSILON * T::EPSILON;
    let mut turned = false;
    for p in 0..N {
        for q in p + 1..N {
            let off = a[p][q];
            // Relative to its own diagonal pair: small eigenvalues keep their relative precision.
            let pair = a[p][p] * a[q][q];
            if off * off <= least * magnitude(pair) {
                continue;
            }
            turned = true;
            let theta = (a[q][q] - a[p][p]) / (T::TWO * off);
            let t = T::ONE / (magnitude(theta) + root(theta * theta + T::ONE));
            let t = if theta < T::ZERO { -t } else { t };
            let c = T::ONE / root(t * t + T::ONE);
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
#[inline(never)]
fn back_substitute<T: Scalar, const N: usize>(s: &[[T; N]; N], y: &[T; N]) -> [T; N] {
    let mut x = *y;
    for i in (0..N).rev() {
        x[i] = x[i] / s[i][i];
        for j in 0..i {
            let product = s[i][j] * x[i];
            x[j] -= product;
        }
    }
    x
}

fn magnitude<T: Scalar>(x: T) -> T {
    if x < T::ZERO { -x } else { x }
}

#[inline(never)]
fn root<T: Scalar>(x: T) -> T {
    T::from_f64(sqrt(x.to_f64()))
}
