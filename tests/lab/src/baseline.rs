//! The same time marching as a textbook writes it: matrices of a size known at run time, assembled
//! from the elements at every step, the effective matrix factored at every step.
//!
//! It is the baseline for the time that the core saves by doing this once. The results are the
//! same.

use nalgebra::{DMatrix, DVector, Matrix4, RowVector4};
use stillbeam::Scene;
use stillbeam::hub::HubState;
use stillbeam::stepper::Response;

/// Newmark δ = ½, β = ¼ with consistent mass, f64, any number of elements.
///
/// Equations and signs are those of [`stillbeam::stepper::Newmark`]: `q` the nodal deflections and
/// slopes in the hub frame, `v = q̇ + bθ̇`, `a = v̇`.
pub struct Textbook {
    scene: Scene,
    elements: usize,
    tick: f64,
    /// Matrices as assembled at the latest step.
    system: System,
    /// `b = M⁻¹F`.
    turn: DVector<f64>,
    q: DVector<f64>,
    v: DVector<f64>,
    a: DVector<f64>,
}

/// The assembled matrices of the free nodes.
struct System {
    /// `M`.
    mass: DMatrix<f64>,
    /// `K`.
    stiffness: DMatrix<f64>,
    /// `G = K_g − M_t`.
    spin: DMatrix<f64>,
    /// `g K_P`.
    tension: DMatrix<f64>,
    /// `S = ∫N'N'ᵀdx`.
    shortening: DMatrix<f64>,
    /// `F`.
    coupling: DVector<f64>,
    /// `g f_g`.
    weight: DVector<f64>,
}

impl Textbook {
    /// Creates the arm at rest in the undeformed state; `tick` in s, `elements` at least 1.
    pub fn new(scene: &Scene, elements: usize, tick: f64) -> Self {
        let elements = elements.max(1);
        let zero = DVector::zeros(2 * elements);
        let system = System::assemble(scene, elements);
        let turn = solve(system.mass.clone(), &system.coupling);
        let [q, v, a] = [zero.clone(), zero.clone(), zero];
        Self { scene: *scene, elements, tick, system, turn, q, v, a }
    }

    /// Moves to the static equilibrium with the hub at rest.
    pub fn settle(&mut self, hub: &HubState<f64>) {
        let System { stiffness, tension, weight, .. } = &self.system;
        self.q = solve(stiffness - tension * hub.sin, &(weight * -hub.cos));
        self.v.fill(0.0);
        self.a.fill(0.0);
    }

    /// Advances by one tick, from the hub at its beginning to the hub at its end.
    pub fn step(&mut self, before: &HubState<f64>, after: &HubState<f64>) {
        let h = self.tick;
        self.system = System::assemble(&self.scene, self.elements);
        let System { mass, stiffness, spin, tension, weight, .. } = &self.system;
        let (alpha, beta) = (self.scene.damping.alpha, self.scene.damping.beta);
        let v = &self.v + 0.5 * h * &self.a;
        let q =
            &self.q + 0.5 * h * (&self.v + &v) - 0.5 * h * (before.rate + after.rate) * &self.turn;
        let rate2 = after.rate * after.rate;
        let damping = alpha * mass + beta * stiffness;
        let tangent = stiffness + rate2 * spin - after.sin * tension;
        let load = mass * &v * -alpha
            - stiffness * (&v - after.rate * &self.turn) * beta
            - &tangent * &q
            - after.cos * weight;
        self.a = solve(mass + 0.5 * h * damping + 0.25 * h * h * tangent, &load);
        self.v = v + 0.5 * h * &self.a;
        self.q = q + 0.25 * h * h * &self.a;
    }

    /// Returns hub torque and tip, to second order in the deflections.
    pub fn response(&self, hub: &HubState<f64>) -> Response<f64> {
        let scene = &self.scene;
        let system = &self.system;
        let alpha = scene.damping.alpha;
        let forced = hub.acceleration + alpha * hub.rate;
        let q_dot = &self.v - hub.rate * &self.turn;
        let spin = &system.spin * &self.q;
        let carried = system.coupling.dot(&self.turn);
        let bent = (&system.tension * &self.q).dot(&self.q);
        let torque = scene.hub.inertia * hub.acceleration
            + (scene.rigid_inertia() - carried) * forced
            + system.coupling.dot(&(&self.a + alpha * &self.v))
            - forced * spin.dot(&self.q)
            - 2.0 * hub.rate * spin.dot(&q_dot)
            + hub.cos * (scene.gravity * scene.first_moment() - 0.5 * bent)
            - hub.sin * system.weight.dot(&self.q);
        let shortened = 0.5 * (&system.shortening * &self.q).dot(&self.q);
        Response { torque, tip: [scene.reach() - shortened, self.q[2 * self.elements - 2]] }
    }
}

impl System {
    fn assemble(scene: &Scene, elements: usize) -> Self {
        let n = 2 * (elements + 1);
        let mut matrices: [DMatrix<f64>; 5] = std::array::from_fn(|_| DMatrix::zeros(n, n));
        let l = scene.link.length / elements as f64;
        let (radius, length, rho_a) =
            (scene.hub.radius, scene.link.length, scene.mass_per_length());
        let payload = scene.payload;
        for e in 0..elements {
            let at = |xi: f64| (e as f64 + xi) * l;
            let centrifugal = |xi: f64| {
                let x = at(xi);
                rho_a * (radius * (length - x) + 0.5 * (length * length - x * x))
                    + payload.mass * scene.reach()
            };
            let hanging = |xi: f64| rho_a * (length - at(xi)) + payload.mass;
            let mass = consistent_mass(rho_a, l);
            let local = [
                mass,
                bending(scene.link.bending_stiffness, l),
                axial(l, centrifugal) - mass,
                axial(l, hanging) * scene.gravity,
                axial(l, |_| 1.0),
            ];
            for (matrix, local) in matrices.iter_mut().zip(local) {
                let mut place = matrix.view_mut((2 * e, 2 * e), (4, 4));
                place += local;
            }
        }
        let [mut mass, stiffness, mut spin, tension, shortening] = matrices;
        mass[(n - 2, n - 2)] += payload.mass;
        spin[(n - 2, n - 2)] -= payload.mass;
        // Rigid motions of the nodes: a translation of 1 m, and a turn of 1 rad about the axis.
        let shift = DVector::from_fn(n, |i, _| if i % 2 == 0 { 1.0 } else { 0.0 });
        let turn =
            DVector::from_fn(n, |i, _| if i % 2 == 0 { radius + (i / 2) as f64 * l } else { 1.0 });
        let weight = &mass * shift * scene.gravity;
        mass[(n - 1, n - 1)] += payload.inertia;
        let coupling = &mass * turn;
        // The clamp: the first node does not move.
        let free = |matrix: DMatrix<f64>| matrix.remove_rows(0, 2).remove_columns(0, 2);
        Self {
            mass: free(mass),
            stiffness: free(stiffness),
            spin: free(spin),
            tension: free(tension),
            shortening: free(shortening),
            coupling: coupling.remove_rows(0, 2),
            weight: weight.remove_rows(0, 2),
        }
    }
}

/// Returns `A⁻¹ b` by Gauss elimination. The result is not a number if `A` is singular.
fn solve(a: DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    a.lu().solve(b).unwrap_or_else(|| DVector::repeat(b.len(), f64::NAN))
}

fn bending(ei: f64, l: f64) -> Matrix4<f64> {
    let (a, b, c) = (12.0, 6.0 * l, l * l);
    let rows =
        [[a, b, -a, b], [b, 4.0 * c, -b, 2.0 * c], [-a, -b, a, -b], [b, 2.0 * c, -b, 4.0 * c]];
    Matrix4::from_fn(|i, j| rows[i][j]) * (ei / l.powi(3))
}

fn consistent_mass(rho_a: f64, l: f64) -> Matrix4<f64> {
    let (a, b, c) = (22.0 * l, 13.0 * l, l * l);
    let rows = [
        [156.0, a, 54.0, -b],
        [a, 4.0 * c, b, -3.0 * c],
        [54.0, b, 156.0, -a],
        [-b, -3.0 * c, -a, 4.0 * c],
    ];
    Matrix4::from_fn(|i, j| rows[i][j]) * (rho_a * l / 420.0)
}

/// Returns `∫ P(ξ) N'N'ᵀ dx` for a force that is a polynomial of second degree in `ξ = x/ℓ`, by
/// four Gauss points.
fn axial(l: f64, p: impl Fn(f64) -> f64) -> Matrix4<f64> {
    let (near, far) = ((3.0 - 2.0 * 1.2_f64.sqrt()) / 7.0, (3.0 + 2.0 * 1.2_f64.sqrt()) / 7.0);
    let (heavy, light) = ((18.0 + 30_f64.sqrt()) / 36.0, (18.0 - 30_f64.sqrt()) / 36.0);
    let mut sum = Matrix4::zeros();
    for (z, weight) in [(near, heavy), (far, light)] {
        for z in [z.sqrt(), -z.sqrt()] {
            let xi = 0.5 * (1.0 + z);
            let slopes = RowVector4::new(
                6.0 * xi * (xi - 1.0) / l,
                1.0 - 4.0 * xi + 3.0 * xi * xi,
                6.0 * xi * (1.0 - xi) / l,
                3.0 * xi * xi - 2.0 * xi,
            );
            sum += 0.5 * weight * l * p(xi) * slopes.transpose() * slopes;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use stillbeam_sim::run::run;
    use stillbeam_sim::scenes;
    use stillbeam_sim::solver::{ELEMENTS, Scalar, Solver};
    use stillbeam_sim::trajectory::Side;

    #[test]
    fn gives_what_newmark_gives() {
        for name in ["d-fast", "s-gravity", "b-tip30-damped-hub", "pick-and-place"] {
            for elements in ELEMENTS {
                let scene = scenes::open(name).unwrap();
                let solver = Solver { elements, scalar: Scalar::F64, ..Solver::PAPER };
                let rows = run(&scene, &solver).unwrap();
                let trajectory = scene.trajectory(solver.tick).unwrap();
                let peak = rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
                let mut textbook = Textbook::new(&scene.arm, elements, solver.tick);
                let mut before = trajectory.at(0.0, Side::Right);
                textbook.settle(&before);
                for (k, row) in rows.iter().enumerate() {
                    let hub = trajectory.at(row.t_s, Side::Right);
                    if k > 0 {
                        textbook.step(&before, &hub);
                    }
                    before = hub;
                    let shown = HubState { acceleration: row.hub_accel_rad_s2, ..hub };
                    let Response { torque, tip: [x, y] } = textbook.response(&shown);
                    let tip = [x * hub.cos - y * hub.sin, x * hub.sin + y * hub.cos];
                    let apart = (tip[0] - row.tip_x_m).hypot(tip[1] - row.tip_y_m);
                    assert!(apart <= 1e-9 * scene.arm.link.length, "{name} {elements}: {apart} m");
                    let apart = (torque - row.torque_nm).abs() / peak;
                    assert!(apart <= 1e-9, "{name} {elements}: {apart} of the peak torque");
                }
            }
        }
    }
}
