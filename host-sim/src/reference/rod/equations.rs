//! The equations of motion of the inextensible planar rod.

use nalgebra::{Cholesky, SMatrix, SVector};
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::super::carrying::Carrying;
use super::legendre::{Basis, POINTS, STATIONS};

/// A rod with N unknowns: the relative angle is `φ(x, t) = Σ aₖ(t) ψₖ(x)`, a point of the link at
/// hub-frame `X = r + ∫₀ˣ cos φ`, `Y = ∫₀ˣ sin φ`.
pub(super) struct Rod<const N: usize> {
    pub basis: Basis<N>,
    pub scene: Scene,
    /// `ρA L wₚ` of the points, the payload's mass at the tip, kg.
    masses: [f64; STATIONS],
    /// `ψₖ` at the points, shape by shape.
    by_shape: [[f64; POINTS]; N],
    /// Matrix R, which integrates values at the points from the clamp to each station, m: station
    /// by station, and the same point by point.
    by_station: [[f64; POINTS]; STATIONS],
    by_point: [[f64; STATIONS]; POINTS],
    /// `Σₛ mₛ Rₛₚ Rₛ_q`, kg m²: the inertia that the angles at the points p and q share, without
    /// the cosine of their difference.
    shared: [[f64; POINTS]; POINTS],
    /// `EI/L ∫ψₖ'²`, N m: the stiffness matrix is diagonal.
    pub stiffness: [f64; N],
}

/// Position and motion of the link in hub axes. Each quantity has its own array, so that the loops
/// over points and stations run through memory in order, several at a time.
pub(super) struct Configuration {
    /// Cosine and sine of φ, point by point.
    cos: [f64; POINTS],
    sin: [f64; POINTS],
    /// X, Y (m), their rates (m/s) and the part of Ẍ, Ÿ that holds no ä (m/s²), station by station.
    stations: [[f64; STATIONS]; 6],
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
        let by_station = basis.running.map(|row| row.map(|weight| scene.link.length * weight));
        let by_point = transposed(&by_station);
        let by_shape = transposed(&basis.shapes);
        let of = |p: usize, q: usize| -> f64 {
            (0..STATIONS).map(|s| masses[s] * by_point[p][s] * by_point[q][s]).sum()
        };
        let shared = std::array::from_fn(|p| std::array::from_fn(|q| of(p, q)));
        Self { basis, scene: *scene, masses, by_shape, by_station, by_point, shared, stiffness }
    }

    /// Returns the configuration at unknowns `a` (rad) and rates `v` (rad/s).
    pub fn configuration(&self, a: &SVector<f64, N>, v: &SVector<f64, N>) -> Configuration {
        let (angle, rate) = (self.at_points(a), self.at_points(v));
        let (mut cos, mut sin) = ([0.0; POINTS], [0.0; POINTS]);
        for p in 0..POINTS {
            (sin[p], cos[p]) = angle[p].sin_cos();
        }
        // (cos φ)˙ = −φ̇ sin φ, (sin φ)˙ = φ̇ cos φ, and once more with φ̈ left out.
        let product = |x: &[f64; POINTS], y: &[f64; POINTS]| -> [f64; POINTS] {
            std::array::from_fn(|p| x[p] * y[p])
        };
        let (across, along) = (product(&rate, &sin), product(&rate, &cos));
        let slopes = [
            cos,
            sin,
            across.map(|x| -x),
            along,
            product(&rate, &along).map(|x| -x),
            product(&rate, &across).map(|x| -x),
        ];
        let mut stations = slopes.map(|slope| self.integral(&slope));
        for x in &mut stations[0] {
            *x += self.scene.hub.radius;
        }
        Configuration { cos, sin, stations }
    }

    /// Returns `Σ aₖ ψₖ` at the points.
    fn at_points(&self, a: &SVector<f64, N>) -> [f64; POINTS] {
        let mut sum = [0.0; POINTS];
        for k in 0..N {
            for p in 0..POINTS {
                sum[p] += a[k] * self.by_shape[k][p];
            }
        }
        sum
    }

    /// Integrates `slope`, given at the points, from the clamp to each station.
    fn integral(&self, slope: &[f64; POINTS]) -> [f64; STATIONS] {
        let mut sum = [0.0; STATIONS];
        for (q, slope) in slope.iter().enumerate() {
            for s in 0..STATIONS {
                sum[s] += slope * self.by_point[q][s];
            }
        }
        sum
    }

    /// Returns `M(a)`, kg m²: `Mᵢⱼ = Σ ψᵢ(p) ψⱼ(q) cos(φₚ − φ_q)` times the inertia that the points
    /// share.
    pub fn mass_matrix(&self, at: &Configuration) -> SMatrix<f64, N, N> {
        let mut moved = [[0.0; POINTS]; N];
        for q in 0..POINTS {
            let (cos, sin) = (at.cos[q], at.sin[q]);
            let mut row = [0.0; POINTS];
            for p in 0..POINTS {
                row[p] = self.shared[q][p] * (cos * at.cos[p] + sin * at.sin[p]);
            }
            for j in 0..N {
                let shape = self.by_shape[j][q];
                for p in 0..POINTS {
                    moved[j][p] += shape * row[p];
                }
            }
        }
        let (tip, twist) = (&self.basis.tip, self.scene.payload.inertia);
        let mut mass = SMatrix::zeros();
        for i in 0..N {
            for j in 0..=i {
                let sum = dot(&self.by_shape[i], &moved[j]) + twist * tip[i] * tip[j];
                (mass[(i, j)], mass[(j, i)]) = (sum, sum);
            }
        }
        mass
    }

    /// Returns the absolute acceleration of a station in hub axes without the part due to ä, m/s².
    /// Drag and weight count as accelerations.
    fn bias(&self, at: &Configuration, s: usize, hub: &HubState<f64>) -> [f64; 2] {
        let [x, y, xd, yd, cx, cy] = at.stations.map(|quantity| quantity[s]);
        let Carrying { rate, acceleration, velocity, push, weight } =
            Carrying::of(&self.scene, hub);
        let alpha = self.scene.damping.alpha;
        [
            cx - 2.0 * rate * yd - acceleration * y - rate * rate * x
                + alpha * (xd - rate * y)
                + weight[0],
            cy + 2.0 * rate * xd + acceleration * x - rate * rate * y
                + alpha * (yd + rate * x)
                + (push + alpha * velocity)
                + weight[1],
        ]
    }

    /// Returns `ä` (rad/s²) from `∫ρA Aᵢ·a dx + m_p Aᵢ·a(L) + J_p ψᵢ(L)(…) + EI-terms = 0`. The
    /// result is not a number if the state is not.
    pub fn acceleration(
        &self,
        at: &Configuration,
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
        // What the stations outboard of a point weigh on its angle.
        let (mut along, mut across) = ([0.0; POINTS], [0.0; POINTS]);
        for s in 0..STATIONS {
            let [x, y] = self.bias(at, s, hub).map(|bias| self.masses[s] * bias);
            for p in 0..POINTS {
                along[p] += self.by_station[s][p] * x;
                across[p] += self.by_station[s][p] * y;
            }
        }
        let moment: [f64; POINTS] =
            std::array::from_fn(|p| at.cos[p] * across[p] - at.sin[p] * along[p]);
        for k in 0..N {
            force[k] -= dot(&self.by_shape[k], &moment);
        }
        match Cholesky::new(self.mass_matrix(at)) {
            Some(factor) => factor.solve(&force),
            None => SVector::repeat(f64::NAN),
        }
    }

    /// Returns `αΣψⱼ(L)ȧⱼ + θ̈ + αθ̇`: the payload's angular acceleration without the part due to
    /// ä, drag included.
    fn turning(&self, v: &SVector<f64, N>, hub: &HubState<f64>) -> f64 {
        let alpha = self.scene.damping.alpha;
        let spin: f64 = (0..N).map(|k| self.basis.tip[k] * v[k]).sum();
        let Carrying { rate, acceleration, .. } = Carrying::of(&self.scene, hub);
        alpha * (spin + rate) + acceleration
    }

    /// Returns the hub torque and the bending moment at the clamp, N m. On a linear axis the first is
    /// the force on the carriage, N.
    ///
    /// Torque: `J_h θ̈` and the moment of all inertia forces, drag and weight about the axis, `∫(X
    /// a_Y − Y a_X) dm`. Moment: the same about the clamp at `(r, 0)`, without the hub's own.
    pub fn loads(
        &self,
        at: &Configuration,
        v: &SVector<f64, N>,
        acceleration: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> [f64; 2] {
        let tip = &self.basis.tip;
        let spin: f64 = (0..N).map(|k| tip[k] * acceleration[k]).sum();
        let mut moment = self.scene.payload.inertia * (spin + self.turning(v, hub));
        let mut shear = 0.0;
        let bent = self.at_points(acceleration);
        let along = self.integral(&std::array::from_fn(|p| -bent[p] * at.sin[p]));
        let across = self.integral(&std::array::from_fn(|p| bent[p] * at.cos[p]));
        for s in 0..STATIONS {
            let [ax, ay] = self.bias(at, s, hub);
            let (ax, ay) = (ax + along[s], ay + across[s]);
            let (x, y) = (at.stations[0][s], at.stations[1][s]);
            moment += self.masses[s] * ((x - self.scene.hub.radius) * ay - y * ax);
            shear += self.masses[s] * ay;
        }
        let own = self.scene.hub.inertia;
        let torque = if self.scene.mount.is_linear() {
            shear + own * (hub.acceleration + Carrying::of(&self.scene, hub).weight[1])
        } else {
            moment + self.scene.hub.radius * shear + own * hub.acceleration
        };
        [torque, moment]
    }
}

impl Configuration {
    /// Returns hub-frame X and Y of the tip, m.
    pub fn tip(&self) -> [f64; 2] {
        [self.stations[0][POINTS], self.stations[1][POINTS]]
    }
}

/// Returns the sum of the products, in four partial sums that do not wait for each other.
fn dot(x: &[f64; POINTS], y: &[f64; POINTS]) -> f64 {
    let mut sum = [0.0; 4];
    for p in 0..POINTS {
        sum[p % 4] += x[p] * y[p];
    }
    (sum[0] + sum[1]) + (sum[2] + sum[3])
}

fn transposed<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> [[f64; R]; C] {
    std::array::from_fn(|c| std::array::from_fn(|r| rows[r][c]))
}
