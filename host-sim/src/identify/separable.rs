//! Least squares in which most unknowns are linear, by variable projection.
//!
//! The model is `y = Φ(p) c`. For every trial of the few nonlinear unknowns p the linear ones c are
//! solved exactly, so that the search sees p alone (Golub and Pereyra). Kaufman's Jacobian and
//! Levenberg's and Marquardt's damping find p.

use nalgebra::{DMatrix, DVector};

/// Iterations after which a search ends.
const ITERATIONS: usize = 60;

/// Relative decrease of the squares at which a search has converged.
const CONVERGED: f64 = 1e-11;

/// Damping beyond which no step is tried.
const STIFFEST: f64 = 1e9;

/// A model that is linear in most of its unknowns.
pub trait Separable {
    /// Returns Φ, one row a sample.
    fn basis(&self, p: &[f64]) -> DMatrix<f64>;

    /// Returns `∂(Φc)/∂pⱼ`.
    fn slope(&self, p: &[f64], c: &[f64], j: usize) -> DVector<f64>;

    /// Returns the range of each nonlinear unknown.
    fn ranges(&self) -> Vec<(f64, f64)>;
}

/// A fitted model.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Nonlinear unknowns.
    pub p: Vec<f64>,
    /// Linear unknowns.
    pub c: Vec<f64>,
    /// `y − Φ(p) c`.
    pub residual: DVector<f64>,
}

impl Solution {
    /// Returns the sum of the residual's squares.
    pub fn squares(&self) -> f64 {
        self.residual.norm_squared()
    }
}

/// Solves the linear unknowns at fixed nonlinear ones.
pub fn project(model: &dyn Separable, y: &DVector<f64>, p: &[f64]) -> Solution {
    Projection::of(model, y, p).into_solution(p)
}

/// Fits the model to `y`, from the nonlinear unknowns `start`.
pub fn fit(model: &dyn Separable, y: &DVector<f64>, start: &[f64]) -> Solution {
    let ranges = model.ranges();
    let mut p = clamped(start, &ranges);
    let mut here = Projection::of(model, y, &p);
    let mut damping = 1e-3;
    for _ in 0..ITERATIONS {
        let jacobian = here.jacobian(model, &p);
        let gradient = jacobian.tr_mul(&here.residual);
        let normal = jacobian.tr_mul(&jacobian);
        let before = here.residual.norm_squared();
        let mut gained = None;
        while damping < STIFFEST {
            let Some(step) = damped_step(&normal, &gradient, damping) else { break };
            let trial: Vec<f64> = p.iter().zip(step.iter()).map(|(p, step)| p - step).collect();
            let trial = clamped(&trial, &ranges);
            let there = Projection::of(model, y, &trial);
            let after = there.residual.norm_squared();
            if after < before {
                gained = Some(before - after);
                (p, here) = (trial, there);
                damping *= 0.1;
                break;
            }
            damping *= 10.0;
        }
        if gained.is_none_or(|gain| gain <= CONVERGED * before) {
            break;
        }
        damping = damping.max(1e-12);
    }
    here.into_solution(&p)
}

/// The linear problem at one trial.
struct Projection {
    /// Orthonormal basis of Φ's columns.
    q: DMatrix<f64>,
    c: Vec<f64>,
    residual: DVector<f64>,
}

impl Projection {
    fn of(model: &dyn Separable, y: &DVector<f64>, p: &[f64]) -> Self {
        let basis = model.basis(p);
        let (q, r) = basis.qr().unpack();
        let along = q.tr_mul(y);
        let residual = y - &q * &along;
        let c = solve_triangular(&r, &along);
        Self { q, c, residual }
    }

    /// Returns Kaufman's Jacobian of the residual: the slopes without their part along Φ, negative.
    fn jacobian(&self, model: &dyn Separable, p: &[f64]) -> DMatrix<f64> {
        let slopes: Vec<DVector<f64>> = (0..p.len()).map(|j| model.slope(p, &self.c, j)).collect();
        let slopes = DMatrix::from_columns(&slopes);
        let along = self.q.tr_mul(&slopes);
        &self.q * along - slopes
    }

    fn into_solution(self, p: &[f64]) -> Solution {
        Solution { p: p.to_vec(), c: self.c, residual: self.residual }
    }
}

/// Solves `R c = b` from the last row. An unknown that no sample depends on is zero.
fn solve_triangular(r: &DMatrix<f64>, b: &DVector<f64>) -> Vec<f64> {
    let count = b.len();
    let least = 1e-12 * (0..count).map(|i| r[(i, i)].abs()).fold(0.0, f64::max);
    let mut c = vec![0.0; count];
    for i in (0..count).rev() {
        let rest: f64 = (i + 1..count).map(|k| r[(i, k)] * c[k]).sum();
        if r[(i, i)].abs() > least {
            c[i] = (b[i] - rest) / r[(i, i)];
        }
    }
    c
}

/// Returns `(N + λ diag N)⁻¹ g`, `None` if the matrix is singular.
fn damped_step(
    normal: &DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
) -> Option<DVector<f64>> {
    let mut matrix = normal.clone();
    let floor = 1e-12 * matrix.diagonal().max();
    for i in 0..matrix.nrows() {
        matrix[(i, i)] += damping * matrix[(i, i)].max(floor) + floor * 1e-3;
    }
    Some(matrix.cholesky()?.solve(gradient))
}

fn clamped(p: &[f64], ranges: &[(f64, f64)]) -> Vec<f64> {
    p.iter().zip(ranges).map(|(p, range)| p.clamp(range.0, range.1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `y = c₀ + c₁ exp(−e^p t)`.
    struct Exponential(Vec<f64>);

    impl Separable for Exponential {
        fn basis(&self, p: &[f64]) -> DMatrix<f64> {
            let rate = p[0].exp();
            let of = |i: usize, k: usize| if k == 0 { 1.0 } else { (-rate * self.0[i]).exp() };
            DMatrix::from_fn(self.0.len(), 2, of)
        }

        fn slope(&self, p: &[f64], c: &[f64], _: usize) -> DVector<f64> {
            let rate = p[0].exp();
            let of = |i: usize, _| -c[1] * rate * self.0[i] * (-rate * self.0[i]).exp();
            DVector::from_fn(self.0.len(), of)
        }

        fn ranges(&self) -> Vec<(f64, f64)> {
            vec![(-10.0, 10.0)]
        }
    }

    #[test]
    fn an_exponential_is_found_exactly() {
        let model = Exponential((0..200).map(|k| 0.02 * f64::from(k)).collect());
        let y = DVector::from_iterator(200, model.0.iter().map(|t| 3.0 - 2.0 * (-1.7 * t).exp()));
        let found = fit(&model, &y, &[-1.5]);
        assert!((found.p[0].exp() - 1.7).abs() < 1e-9, "{}", found.p[0].exp());
        assert!((found.c[0] - 3.0).abs() < 1e-9 && (found.c[1] + 2.0).abs() < 1e-9);
    }

    #[test]
    fn a_range_is_kept() {
        let model = Exponential((0..200).map(|k| 0.02 * f64::from(k)).collect());
        let y = DVector::from_iterator(200, model.0.iter().map(|t| (-1.7e5 * t).exp()));
        assert!(fit(&model, &y, &[0.0]).p[0] <= 10.0);
    }
}
