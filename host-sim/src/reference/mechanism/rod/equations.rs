//! Equations of motion: accelerations of the free coordinates, torques of the driven joints.

use nalgebra::{Cholesky, DMatrix, DVector, Matrix2, Matrix2xX, Vector2};

use stillbeam::scene::Damping;

use super::chain::Chain;
use super::kinematics::{Inertias, Motion};

/// Unknowns of the equations: the free coordinates, and the pin where the tip is held.
pub(super) struct Freedom {
    /// Indices of the free coordinates.
    pub free: Vec<usize>,
    /// Place of the pin, m.
    pub pin: Option<Vector2<f64>>,
}

/// Rate at which a violation of the pin's condition dies out, 1/s. Nothing but rounding and the
/// integrator's tolerance makes one.
const PIN_RATE: f64 = 100.0;

impl Chain {
    /// Computes the accelerations of the free coordinates, into `motion.a`, where those of the
    /// driven joints are given. Returns the forces on all coordinates: 0 on free ones, a driven
    /// joint's torque. `None` if the pin asks for what the free coordinates cannot give.
    ///
    /// Solves `M q̈ + f + K(q + βq̇) = Gᵀλ` and, of a pinned tip, `G q̈ + ẍ₀ + 2γẋ + γ²(x − pin) =
    /// 0`.
    pub fn accelerate(&self, motion: &mut Motion, freedom: &Freedom) -> Option<DVector<f64>> {
        for &i in &freedom.free {
            motion.a[i] = 0.0;
        }
        let inertias = Inertias::of(self, motion);
        let mass = inertias.mass();
        let mut forces = inertias.forces();
        let beta = self.mechanism.damping.beta;
        for (i, stiffness) in self.stiffnesses() {
            forces[i] += stiffness * (motion.q[i] + beta * motion.v[i]);
        }
        if freedom.free.is_empty() {
            // All links rigid, all joints driven: the torques are all there is.
            return freedom.pin.is_none().then_some(forces);
        }
        let inverse = Cholesky::new(mass.select_rows(&freedom.free).select_columns(&freedom.free))?;
        let mut a = -inverse.solve(&forces.select_rows(&freedom.free));
        let mut held = Vector2::zeros();
        if let Some(pin) = freedom.pin {
            let tip = inertias.tip();
            let pull = tip.jacobian.select_columns(&freedom.free);
            let wanted = -tip.acceleration
                - 2.0 * PIN_RATE * tip.velocity
                - PIN_RATE * PIN_RATE * (tip.place - pin);
            let (by_pin, change) = hold(&inverse, &pull, wanted - &pull * &a)?;
            a += by_pin;
            held = change;
        }
        for (k, &i) in freedom.free.iter().enumerate() {
            motion.a[i] = a[k];
        }
        let by_free = mass.select_columns(&freedom.free) * &a;
        let by_pin = inertias.tip().jacobian.tr_mul(&held);
        forces += by_free - by_pin;
        for &i in &freedom.free {
            forces[i] = 0.0;
        }
        Some(forces)
    }

    /// Returns the derivative of the free accelerations over the free coordinates and over their
    /// rates, as far as the links' stiffness and damping make it: the stiff part. `None` as with
    /// [`Self::accelerate`].
    pub fn stiff_part(&self, motion: &Motion, freedom: &Freedom) -> Option<[DMatrix<f64>; 2]> {
        let inertias = Inertias::of(self, motion);
        let mass = inertias.mass().select_rows(&freedom.free).select_columns(&freedom.free);
        let inverse = Cholesky::new(mass)?;
        let mut stiffness = DMatrix::zeros(self.size, self.size);
        for (i, value) in self.stiffnesses() {
            stiffness[(i, i)] = value;
        }
        let stiffness = stiffness.select_rows(&freedom.free).select_columns(&freedom.free);
        let mut by_place = -inverse.solve(&stiffness);
        if freedom.pin.is_some() {
            let pull = inertias.tip().jacobian.select_columns(&freedom.free);
            for mut column in by_place.column_iter_mut() {
                let (by_pin, _) = hold(&inverse, &pull, -(&pull * &column))?;
                column += by_pin;
            }
        }
        let Damping { alpha, beta, .. } = self.mechanism.damping;
        let n = freedom.free.len();
        let by_rate = beta * &by_place - DMatrix::from_diagonal_element(n, n, alpha);
        Some([by_place, by_rate])
    }

    /// Stops the tip: the rates of the free coordinates change by `−M⁻¹Gᵀ(GM⁻¹Gᵀ)⁻¹ẋ`, a plastic
    /// impact. Returns the tip's place.
    pub fn catch(&self, motion: &mut Motion, free: &[usize]) -> Option<Vector2<f64>> {
        if free.is_empty() {
            return None;
        }
        let inertias = Inertias::of(self, motion);
        let mass = inertias.mass().select_rows(free).select_columns(free);
        let tip = inertias.tip();
        let pull = tip.jacobian.select_columns(free);
        let (change, _) = hold(&Cholesky::new(mass)?, &pull, -tip.velocity)?;
        for (k, &i) in free.iter().enumerate() {
            motion.v[i] += change[k];
        }
        Some(tip.place)
    }
}

/// Returns the change of the free coordinates that moves the tip by `wanted` at the least energy,
/// and the multipliers that make it.
fn hold(
    inverse: &Cholesky<f64, nalgebra::Dyn>,
    pull: &Matrix2xX<f64>,
    wanted: Vector2<f64>,
) -> Option<(DVector<f64>, Vector2<f64>)> {
    let columns: DMatrix<f64> = inverse.solve(&pull.transpose()).resize(pull.ncols(), 2, 0.0);
    let yielding: Matrix2<f64> = (pull * &columns).fixed_resize(0.0);
    // A tip that cannot move in some direction has no multiplier there.
    let scale = yielding.trace();
    let moves_both_ways = yielding.determinant() > 1e-12 * scale * scale;
    if !moves_both_ways {
        return None;
    }
    let multipliers = yielding.try_inverse()? * wanted;
    Some((columns * multipliers, multipliers))
}
