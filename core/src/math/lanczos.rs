//! The lowest pairs of a generalised symmetric eigenproblem by Lanczos's method. Set-up only, f64.

use super::{Band, Each, Ldl, array, dot, sqrt, tridiagonal};

/// Residual of a pair, of its own eigenvalue, that is no longer lessened: its eigenvalue errs by
/// the square of that, its vector by as much over the distance to the next.
const ENOUGH: f64 = 1e-11;

/// Most times that the method begins anew with the vectors that it found. Beams need none or one.
const MOST_ROUNDS: usize = 12;

/// Solves `K φ = λ M φ` for the lowest `P` pairs by `S ≥ P` steps, `K` positive definite, `M`
/// positive semi-definite.
///
/// Steps with `A = S⁻¹ M S⁻ᵀ`, `K = S Sᵀ`, whose eigenvalues are `μ = 1/λ`, each made orthogonal to
/// all before. A beam's `μ` fall so fast that four steps more than pairs find the lowest to
/// rounding, at a thirtieth of the cost of all of them by rotations.
/// Returns `(μ, φ)`, `μ` descending, the vectors as rows with `φᵀ K φ = 1`.
/// Error: `1e-14 μ₁` of every μ, as the rounding of `A` leaves it.
/// Source: Golub and Van Loan, Matrix Computations, 10.1 and 10.3.
pub(crate) fn lowest_eigen<const P: usize, const S: usize, const N: usize, const W: usize>(
    stiffness: &Band<f64, N, W>,
    mass: &Band<f64, N, W>,
) -> ([f64; P], [[f64; N]; P]) {
    let factors = stiffness.factored();
    let root = factors.inverse_pivots().each(sqrt);
    // Nothing a mode could be at right angles to: loads of all signs and sizes.
    let mut start: [f64; N] = array(|i| (5 * i % 8) as f64 - 2.5);
    let mut found = ([0.0; P], [[0.0; N]; P]);
    for _ in 0..MOST_ROUNDS {
        let (values, vectors, residual) = round::<P, S, N, W>(&factors, &root, mass, &start);
        found = (values, vectors);
        if residual <= ENOUGH {
            break;
        }
        start = array(|i| vectors.iter().map(|vector| vector[i]).sum());
    }
    (found.0, found.1.each(|y| factors.back_half(&root, &y)))
}

/// One round of `S` steps from `start`: eigenvalues, vectors of `A`, and the largest residual of
/// the pairs, of their own eigenvalues.
fn round<const P: usize, const S: usize, const N: usize, const W: usize>(
    factors: &Ldl<f64, N, W>,
    root: &[f64; N],
    mass: &Band<f64, N, W>,
    start: &[f64; N],
) -> ([f64; P], [[f64; N]; P], f64) {
    let mut basis = [[0.0; N]; S];
    let (mut diagonal, mut beside) = ([0.0; S], [0.0; S]);
    let mut next = scaled(start, 1.0 / sqrt(dot(start, start)));
    let mut left = 0.0;
    for s in 0..S.min(N) {
        basis[s] = next;
        next = factors.forth_half(root, &mass.times(&factors.back_half(root, &next)));
        let whole = dot(&next, &next);
        diagonal[s] = take_off(&basis[..=s], &mut next);
        // Where little is left of it, rounding has turned it back to those before.
        if dot(&next, &next) <= 1e-6 * whole {
            diagonal[s] += take_off(&basis[..=s], &mut next);
        }
        let square = dot(&next, &next);
        // What is but rounding is no direction: the steps so far hold all there is.
        if square <= 1e-28 * whole {
            left = 0.0;
            break;
        }
        left = sqrt(square);
        next = scaled(&next, 1.0 / left);
        if s + 1 < S {
            beside[s] = left;
        }
    }
    let vectors = tridiagonal::eigen(&mut diagonal, &mut beside);
    let mut order: [usize; S] = array(|i| i);
    order.sort_unstable_by(|&i, &j| diagonal[j].total_cmp(&diagonal[i]));
    let mut residual: f64 = 0.0;
    for &i in &order[..P] {
        residual = residual.max((left * vectors[i][S - 1]).abs() / diagonal[i]);
    }
    let combined = |p: usize| -> [f64; N] {
        let weights = &vectors[order[p]];
        array(|n| (0..S).map(|s| weights[s] * basis[s][n]).sum())
    };
    (array(|p| diagonal[order[p]]), array(combined), residual)
}

/// Takes its parts along the vectors of a basis off `x`, the last one's first. Returns that part.
fn take_off<const N: usize>(basis: &[[f64; N]], x: &mut [f64; N]) -> f64 {
    let mut last = 0.0;
    for (i, vector) in basis.iter().rev().enumerate() {
        let along = dot(vector, x);
        if i == 0 {
            last = along;
        }
        *x = array(|n| x[n] - along * vector[n]);
    }
    last
}

fn scaled<const N: usize>(x: &[f64; N], by: f64) -> [f64; N] {
    x.each(|x| by * x)
}
