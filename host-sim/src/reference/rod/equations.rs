//! The equations of motion of the inextensible planar rod.

use nalgebra::{Cholesky, SMatrix, SVector};
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::legendre::{Basis, POINTS, STATIONS};

/// A rod with N unknowns: the relative angle is `φ(x, t) = Σ aₖ(t) ψₖ(x)`, a point of the link at
/// hub-frame `X = r + ∫₀ˣ cos φ`, `Y = ∫₀ˣ sin φ`.
pub(super) struct Rod<const N: usize> {
    pub basis: Basis<N>,
    pub scene: Scene,
    /// `ρA L wₚ` of the points, the payload's mass at the tip, kg.
    masses: [f64; STATIONS],
    /// `EI/L ∫ψₖ'²`, N m: the stiffness matrix is diagonal.
    pub stiffness: [f64; N],
}

/// Where the link is, and how that depends on the unknowns; station by station.
pub(super) struct Configuration<const N: usize> {
    /// `∂X/∂aₖ`, m.
    ax: [[f64; N]; STATIONS],
    /// `∂Y/∂aₖ`, m.
    ay: [[f64; N]; STATIONS],
    /// X, Y (m) and the part of Ẍ, Ÿ that holds no ä (m/s²).
    rest: [[f64; 4]; STATIONS],
}

impl<const N: usize> Rod<N> {
    pub fn new(scene: &Scene) -> Self {
        let basis = Basis::new();
        let masses = std::array::from_fn(|s| match basis.weights.get(s) {
            Some(weight) => scene.link.mass * weight,
            None => scene.payload.mass,
        });
        let scale = scene.link.bending_stiffness / scene.link.length;
        let stiffness = std::array::from_fn(|k| scale * basis.bending[k]);
        Self { basis, scene: *scene, masses, stiffness }
    }

    /// The link at unknowns `a` (rad) and rates `v` (rad/s).
    pub fn configuration(&self, a: &SVector<f64, N>, v: &SVector<f64, N>) -> Configuration<N> {
        let mut gx = [[0.0; N]; POINTS];
        let mut gy = [[0.0; N]; POINTS];
        let mut g = [[0.0; 4]; POINTS];
        for (p, shapes) in self.basis.shapes.iter().enumerate() {
            let (mut angle, mut rate) = (0.0, 0.0);
            for k in 0..N {
                angle += shapes[k] * a[k];
                rate += shapes[k] * v[k];
            }
            let (sin, cos) = angle.sin_cos();
            for k in 0..N {
                gx[p][k] = -shapes[k] * sin;
                gy[p][k] = shapes[k] * cos;
            }
            g[p] = [cos, sin, -rate * rate * cos, -rate * rate * sin];
        }
        let l = self.scene.link.length;
        let mut out = Configuration {
            ax: [[0.0; N]; STATIONS],
            ay: [[0.0; N]; STATIONS],
            rest: [[0.0; 4]; STATIONS],
        };
        for s in 0..STATIONS {
            let (mut ax, mut ay, mut rest) = ([0.0; N], [0.0; N], [0.0; 4]);
            for q in 0..POINTS {
                let weight = l * self.basis.running[s][q];
                for k in 0..N {
                    ax[k] += weight * gx[q][k];
                    ay[k] += weight * gy[q][k];
                }
                for k in 0..4 {
                    rest[k] += weight * g[q][k];
                }
            }
            rest[0] += self.scene.hub.radius;
            out.ax[s] = ax;
            out.ay[s] = ay;
            out.rest[s] = rest;
        }
        out
    }

    /// `M(a)`, kg m².
    pub fn mass_matrix(&self, at: &Configuration<N>) -> SMatrix<f64, N, N> {
        let tip = &self.basis.tip;
        let mut mass = [[0.0; N]; N];
        for s in 0..STATIONS {
            for i in 0..N {
                let (x, y) = (self.masses[s] * at.ax[s][i], self.masses[s] * at.ay[s][i]);
                for j in 0..N {
                    mass[i][j] += x * at.ax[s][j] + y * at.ay[s][j];
                }
            }
        }
        SMatrix::from_fn(|i, j| mass[i][j] + self.scene.payload.inertia * tip[i] * tip[j])
    }

    /// Absolute acceleration of a station in hub axes but for `Σ A ä`, drag and weight counted as
    /// accelerations, m/s².
    fn bias(
        &self,
        at: &Configuration<N>,
        s: usize,
        v: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> [f64; 2] {
        let [x, y, cx, cy] = at.rest[s];
        let (mut xd, mut yd) = (0.0, 0.0);
        for k in 0..N {
            xd += at.ax[s][k] * v[k];
            yd += at.ay[s][k] * v[k];
        }
        let (rate, acceleration) = (hub.rate, hub.acceleration);
        let (alpha, gravity) = (self.scene.damping.alpha, self.scene.gravity);
        [
            cx - 2.0 * rate * yd - acceleration * y - rate * rate * x
                + alpha * (xd - rate * y)
                + gravity * hub.sin,
            cy + 2.0 * rate * xd + acceleration * x - rate * rate * y
                + alpha * (yd + rate * x)
                + gravity * hub.cos,
        ]
    }

    /// `ä` (rad/s²) from `∫ρA Aᵢ·a dx + m_p Aᵢ·a(L) + J_p ψᵢ(L)(…) + EI-terms = 0`. Not a number
    /// where the state is not.
    pub fn acceleration(
        &self,
        at: &Configuration<N>,
        a: &SVector<f64, N>,
        v: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> SVector<f64, N> {
        let tip = &self.basis.tip;
        let turning = self.turning(v, hub);
        let beta = self.scene.damping.beta;
        let mut force = SVector::<f64, N>::from_fn(|k, _| {
            -self.stiffness[k] * (a[k] + beta * v[k])
                - self.scene.payload.inertia * tip[k] * turning
        });
        for s in 0..STATIONS {
            let [x, y] = self.bias(at, s, v, hub).map(|bias| self.masses[s] * bias);
            for k in 0..N {
                force[k] -= at.ax[s][k] * x + at.ay[s][k] * y;
            }
        }
        match Cholesky::new(self.mass_matrix(at)) {
            Some(factor) => factor.solve(&force),
            None => SVector::repeat(f64::NAN),
        }
    }

    /// `αΣψⱼ(L)ȧⱼ + θ̈ + αθ̇`: the payload's angular acceleration but for ä, drag included.
    fn turning(&self, v: &SVector<f64, N>, hub: &HubState<f64>) -> f64 {
        let alpha = self.scene.damping.alpha;
        let spin: f64 = (0..N).map(|k| self.basis.tip[k] * v[k]).sum();
        alpha * (spin + hub.rate) + hub.acceleration
    }

    /// Hub torque and bending moment at the clamp, N m.
    ///
    /// Torque: `J_h θ̈` and the moment of all inertia forces, drag and weight about the axis,
    /// `∫(X a_Y − Y a_X) dm`. Moment: the same about the clamp at `(r, 0)`, without the hub's own.
    pub fn loads(
        &self,
        at: &Configuration<N>,
        v: &SVector<f64, N>,
        acceleration: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> [f64; 2] {
        let tip = &self.basis.tip;
        let spin: f64 = (0..N).map(|k| tip[k] * acceleration[k]).sum();
        let mut moment = self.scene.payload.inertia * (spin + self.turning(v, hub));
        let mut shear = 0.0;
        for s in 0..STATIONS {
            let [mut ax, mut ay] = self.bias(at, s, v, hub);
            for k in 0..N {
                ax += at.ax[s][k] * acceleration[k];
                ay += at.ay[s][k] * acceleration[k];
            }
            let [x, y, ..] = at.rest[s];
            moment += self.masses[s] * ((x - self.scene.hub.radius) * ay - y * ax);
            shear += self.masses[s] * ay;
        }
        let torque =
            moment + self.scene.hub.radius * shear + self.scene.hub.inertia * hub.acceleration;
        [torque, moment]
    }
}

impl<const N: usize> Configuration<N> {
    /// Hub-frame X and Y of the tip, m.
    pub fn tip(&self) -> [f64; 2] {
        let [x, y, ..] = self.rest[POINTS];
        [x, y]
    }
}
