//! Static equilibrium of the rod and its frequencies.

use nalgebra::{Cholesky, DMatrix, SMatrix, SVector};

use stillbeam::hub::HubState;

use super::equations::Rod;

/// Load steps on the way to the full weight. With them Newton's method follows the branch that
/// starts at the straight link.
const LOAD_STEPS: u32 = 16;

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    /// Returns the static shape under gravity, rad, with the hub at rest at its angle. Returns
    /// `None` if it is not stable.
    ///
    /// Minimises `½ aᵀKa + g Σ mₛ (Xₛ sin χ + Yₛ cos χ)` over the stations.
    pub fn equilibrium(&self, hub: &HubState<f64>) -> Option<SVector<f64, N>> {
        let whole = self.scene.in_plane_gravity();
        let (sin, cos) = self.scene.gravity_direction().seen_from(hub);
        let mut a = SVector::zeros();
        if whole == 0.0 {
            return Some(a);
        }
        for step in 1..=LOAD_STEPS {
            let gravity = whole * f64::from(step) / f64::from(LOAD_STEPS);
            let mut change = f64::INFINITY;
            for _ in 0..50 {
                let (gradient, hessian) = self.potential(gravity, sin, cos, &a);
                // Positive definite: the equilibrium is stable, and so is the way to it.
                let delta = Cholesky::new(hessian)?.solve(&gradient);
                a -= delta;
                change = delta.amax();
                if change < 1e-13 * (1.0 + a.amax()) {
                    break;
                }
            }
            if change > 1e-9 {
                return None;
            }
        }
        Some(a)
    }

    fn potential(
        &self,
        gravity: f64,
        sin: f64,
        cos: f64,
        a: &SVector<f64, N>,
    ) -> (SVector<f64, N>, SMatrix<f64, N, N>) {
        let mut gradient = self.stiffness * a;
        let mut hessian = self.stiffness;
        for (p, shapes) in self.shapes.iter().enumerate() {
            let shapes = SVector::from(*shapes);
            let (s, c) = shapes.dot(a).sin_cos();
            let weight = gravity * self.outboard[p];
            gradient += shapes * (weight * (cos * c - sin * s));
            hessian -= shapes * shapes.transpose() * (weight * (sin * c + cos * s));
        }
        (gradient, hessian)
    }

    /// Returns the angular frequencies of the straight clamped rod, rad/s, ascending. The upper
    /// ones are those of the polynomials, far above the link's own.
    pub fn frequencies(&self) -> SVector<f64, N> {
        let rest = SVector::zeros();
        let mass = self.mass_matrix(&self.configuration(&rest, &rest));
        // With K = LLᵀ, ω⁻² are the eigenvalues of L⁻¹ M L⁻ᵀ.
        let stiffness = DMatrix::from_fn(N, N, |i, j| self.stiffness[(i, j)]);
        let mass = DMatrix::from_fn(N, N, |i, j| mass[(i, j)]);
        let lower = Cholesky::new(stiffness).expect("a stiff link").unpack();
        let half = lower.solve_lower_triangular(&mass).expect("no zero on the diagonal");
        let scaled =
            lower.solve_lower_triangular(&half.transpose()).expect("no zero on the diagonal");
        let mut omega: Vec<f64> = scaled
            .symmetric_eigenvalues()
            .iter()
            .map(|inverse| 1.0 / inverse.max(f64::MIN_POSITIVE).sqrt())
            .collect();
        omega.sort_by(f64::total_cmp);
        SVector::from_vec(omega)
    }
}
