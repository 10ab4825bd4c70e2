//! Static equilibrium of the chain, and the closed loop that it begins with.

use nalgebra::{Cholesky, DMatrix, DVector, Vector2};

use super::chain::Chain;
use super::equations::Freedom;
use super::kinematics::{Inertias, Motion};

/// Steps on the way to the full weight. With them Newton's method follows the branch that starts at
/// the straight links.
const LOAD_STEPS: u32 = 16;

impl Chain {
    /// Returns the chain at rest with its joints at the given angles, and straight links.
    pub fn straight(&self, angles: &[f64]) -> Motion {
        let mut q = DVector::zeros(self.size);
        for (link, angle) in self.links.iter().zip(angles) {
            q[link.angle] = *angle;
        }
        let zeros = DVector::zeros(self.size);
        Motion { q, v: zeros.clone(), a: zeros }
    }

    /// Moves the tip to the pin by Gauss-Newton steps of least norm in the free coordinates
    /// `moved`. Returns false if it cannot be reached.
    pub fn close(&self, motion: &mut Motion, moved: &[usize], pin: Vector2<f64>) -> bool {
        let reach = self.mechanism.total_length();
        for _ in 0..100 {
            let inertias = Inertias::of(self, motion);
            let tip = inertias.tip();
            let missing = pin - tip.place;
            if missing.norm() < 1e-14 * reach {
                return true;
            }
            let pull = tip.jacobian.select_columns(moved);
            let Some(inverse) = (&pull * pull.transpose()).try_inverse() else { return false };
            let step = pull.tr_mul(&(inverse * missing));
            // Long steps may jump to another closed loop.
            let length = (0.5 / step.amax()).min(1.0);
            for (k, &i) in moved.iter().enumerate() {
                motion.q[i] += length * step[k];
            }
        }
        (pin - Inertias::of(self, motion).tip().place).norm() < 1e-9 * reach
    }

    /// Moves the free coordinates to the static equilibrium next to the given state. Returns false
    /// if there is none that is stable.
    ///
    /// Without gravity the state itself is one, if the links are straight.
    pub fn settle(&self, motion: &mut Motion, freedom: &Freedom) -> bool {
        let straight = self.stiffnesses().all(|(i, _)| motion.q[i] == 0.0);
        if freedom.free.is_empty() || (self.mechanism.gravity == 0.0 && straight) {
            return true;
        }
        (1..=LOAD_STEPS).all(|step| {
            let share = f64::from(step) / f64::from(LOAD_STEPS);
            self.equilibrate(motion, freedom, share)
        })
    }

    /// Newton's method on `f(q) = Gᵀλ` and the pin's condition, at a share of the weight.
    fn equilibrate(&self, motion: &mut Motion, freedom: &Freedom, share: f64) -> bool {
        let n = freedom.free.len();
        let held = if freedom.pin.is_some() { 2 } else { 0 };
        let mut multipliers = Vector2::zeros();
        for _ in 0..50 {
            let residual = self.imbalance(motion, freedom, share, &multipliers);
            let mut matrix = DMatrix::zeros(n + held, n + held);
            for (k, &i) in freedom.free.iter().enumerate() {
                let step = 1e-6;
                let side = |sign: f64| {
                    let mut moved = motion.clone();
                    moved.q[i] += sign * step;
                    self.imbalance(&moved, freedom, share, &multipliers)
                };
                matrix.set_column(k, &((side(1.0) - side(-1.0)) / (2.0 * step)));
            }
            for row in 0..held {
                for k in 0..n {
                    matrix[(k, n + row)] = -matrix[(n + row, k)];
                }
            }
            // Positive definite: the equilibrium is stable, and so is the way to it.
            let stiffness = matrix.view((0, 0), (n, n)).into_owned();
            if freedom.pin.is_none() && Cholesky::new(stiffness).is_none() {
                return false;
            }
            let Some(change) = matrix.lu().solve(&residual) else { return false };
            for (k, &i) in freedom.free.iter().enumerate() {
                motion.q[i] -= change[k];
            }
            for row in 0..held {
                multipliers[row] -= change[n + row];
            }
            if change.rows(0, n).amax() < 1e-12 {
                return true;
            }
        }
        false
    }

    /// Returns the force that each free coordinate lacks for equilibrium, and the distance of the
    /// tip from the pin.
    fn imbalance(
        &self,
        motion: &Motion,
        freedom: &Freedom,
        share: f64,
        multipliers: &Vector2<f64>,
    ) -> DVector<f64> {
        let inertias = Inertias::of(self, motion);
        let mut forces = share * inertias.forces();
        for (i, stiffness) in self.stiffnesses() {
            forces[i] += stiffness * motion.q[i];
        }
        forces -= inertias.tip().jacobian.tr_mul(multipliers);
        let free = forces.select_rows(&freedom.free);
        match freedom.pin {
            None => free,
            Some(pin) => {
                let apart = inertias.tip().place - pin;
                let n = free.len();
                let mut all = free.resize_vertically(n + 2, 0.0);
                all.rows_mut(n, 2).copy_from(&apart);
                all
            }
        }
    }

    /// Returns the lowest and the highest angular frequency of the free coordinates next to the
    /// given state, rad/s. Coordinates without stiffness have none. 10 rad/s stand for a chain that
    /// is all rigid.
    pub fn frequencies(&self, motion: &Motion, free: &[usize]) -> [f64; 2] {
        if free.is_empty() {
            return [10.0; 2];
        }
        let mass = Inertias::of(self, motion).mass().select_rows(free).select_columns(free);
        let mut stiffness = DMatrix::zeros(self.size, self.size);
        for (i, value) in self.stiffnesses() {
            stiffness[(i, i)] = value;
        }
        let stiffness = stiffness.select_rows(free).select_columns(free);
        let Some(root) = Cholesky::new(mass).map(|root| root.unpack()) else { return [10.0; 2] };
        let solved = root.solve_lower_triangular(&stiffness);
        let scaled = solved.and_then(|half| root.solve_lower_triangular(&half.transpose()));
        let Some(scaled) = scaled else { return [10.0; 2] };
        let squares = scaled.symmetric_eigenvalues();
        let most = squares.iter().copied().fold(0.0, f64::max);
        let least =
            squares.iter().copied().filter(|w| *w > 1e-9 * most).fold(f64::INFINITY, f64::min);
        if least.is_finite() { [least.sqrt(), most.sqrt()] } else { [10.0; 2] }
    }
}
