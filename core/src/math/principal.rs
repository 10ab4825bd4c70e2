//! Two quadratic forms at once: axes along which both are sums of squares. Set-up only.

use super::{Band, Each, Scalar, dot};

/// Sweeps after which the iteration stops; two axes need one, eight about six.
const MAX_SWEEPS: usize = 30;

/// Axes with `vᵢᵀ K vⱼ = δᵢⱼ` and `vᵢᵀ G vⱼ = 0`, `i ≠ j`, as rows in no order; `K` positive
/// definite, `G` symmetric.
///
/// Gram and Schmidt's orthogonalisation in the metric of `K`, then Jacobi's rotations of pairs of
/// axes. Error: a few roundings of the largest entry of either form.
pub(crate) fn principal_axes<T: Scalar, const N: usize, const W: usize>(
    k: &Band<T, N, W>,
    g: &Band<T, N, W>,
) -> [[T; N]; N] {
    let mut axes = [[T::ZERO; N]; N];
    for i in 0..N {
        axes[i][i] = T::ONE;
        for j in 0..i {
            let along = form(k, &axes[j], &axes[i]);
            for e in 0..N {
                let part = along * axes[j][e];
                axes[i][e] -= part;
            }
        }
        let length = root(form(k, &axes[i], &axes[i]));
        axes[i] = axes[i].each(|x| x / length);
    }
    for _ in 0..MAX_SWEEPS {
        if !sweep(g, &mut axes) {
            break;
        }
    }
    axes
}

/// Turns every pair of axes once; false where there was nothing to turn.
fn sweep<T: Scalar, const N: usize, const W: usize>(
    g: &Band<T, N, W>,
    axes: &mut [[T; N]; N],
) -> bool {
    let mut turned = false;
    for p in 0..N {
        for q in p + 1..N {
            let off = form(g, &axes[p], &axes[q]);
            let (first, second) = (form(g, &axes[p], &axes[p]), form(g, &axes[q], &axes[q]));
            let size = first * first + second * second;
            if off * off <= T::EPSILON * T::EPSILON * size {
                continue;
            }
            turned = true;
            let twice = off + off;
            let difference = second - first;
            let far = root(difference * difference + twice * twice);
            let tangent =
                twice / (if difference < T::ZERO { difference - far } else { difference + far });
            let c = T::ONE / root(tangent * tangent + T::ONE);
            for e in 0..N {
                let (x, y) = (axes[p][e], axes[q][e]);
                axes[p][e] = c * (x - tangent * y);
                axes[q][e] = c * (tangent * x + y);
            }
        }
    }
    turned
}

/// `aᵀ A b`.
#[inline(never)]
fn form<T: Scalar, const N: usize, const W: usize>(
    matrix: &Band<T, N, W>,
    a: &[T; N],
    b: &[T; N],
) -> T {
    dot(a, &matrix.times(b))
}

/// Square root by Newton's iteration from above, until it no longer falls: within a rounding.
#[inline(never)]
pub(crate) fn root<T: Scalar>(x: T) -> T {
    let mut root = T::HALF * (x + T::ONE);
    loop {
        let next = T::HALF * (root + x / root);
        // Falling, it comes to an end; for NaN at once.
        if next < root { root = next } else { return root }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Band;
    use super::{form, principal_axes, root};

    /// Axes of `K = diag(1, 4)` and `G` with off-diagonals: `K` becomes the identity, `G` diagonal.
    #[test]
    fn both_forms_are_sums_of_squares_along_the_axes() {
        let (mut k, mut g) = (Band::<f64, 2, 2>::ZERO, Band::<f64, 2, 2>::ZERO);
        for (i, j, stiffness, other) in [(0, 0, 1.0, 3.0), (1, 1, 4.0, -2.0), (1, 0, 0.5, 1.0)] {
            k.add(i, j, stiffness);
            g.add(i, j, other);
        }
        let axes = principal_axes(&k, &g);
        for i in 0..2 {
            for j in 0..2 {
                let same = if i == j { 1.0 } else { 0.0 };
                assert!((form(&k, &axes[i], &axes[j]) - same).abs() < 1e-14, "K [{i}][{j}]");
            }
        }
        assert!(form(&g, &axes[0], &axes[1]).abs() < 1e-14);
    }

    #[test]
    fn roots_of_small_and_large_numbers() {
        for x in [1e-12, 0.25, 2.0, 1e9] {
            let found: f64 = root(x);
            assert!((found * found / x - 1.0).abs() < 1e-15 * 4.0, "{x}: {found}");
        }
    }
}
