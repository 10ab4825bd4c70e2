//! The equations of motion of the inextensible planar rod.

use nalgebra::{Cholesky, SMatrix, SVector};
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::super::carrying::{Carrier, Carrying};
use super::legendre::{Basis, POINTS, STATIONS, VARIED_POINTS, VARIED_STATIONS};

/// A rod with N unknowns: the relative angle is `φ(x, t) = Σ aₖ(t) ψₖ(x)`, a point of the link at
/// hub-frame `X = r + ∫₀ˣ cos φ`, `Y = ∫₀ˣ sin φ`. P points, S stations.
pub(super) struct Rod<const N: usize, const P: usize, const S: usize> {
    pub scene: Scene,
    carrier: Carrier,
    /// Masses at the stations, kg.
    pub masses: [f64; S],
    /// `ψₖ` at the points, and shape by shape; at the tip.
    pub shapes: [[f64; N]; P],
    by_shape: [[f64; P]; N],
    pub tip: [f64; N],
    /// Matrix R, which integrates values at the points from the clamp to each station, m: station
    /// by station, and the same point by point.
    pub by_station: [[f64; P]; S],
    by_point: [[f64; S]; P],
    /// The same to the tip.
    to_tip: [f64; P],
    /// `Σₛ mₛ Rₛₚ Rₛ_q`, kg m²: the inertia that the angles at the points p and q share, without
    /// the cosine of their difference.
    shared: [[f64; P]; P],
    /// Stiffness of link and joint, `∫EI ψᵢ'ψⱼ' dx + k ψᵢ(0)ψⱼ(0)`, N m.
    pub stiffness: SMatrix<f64, N, N>,
    /// The joint's own damping, `β_J k ψᵢ(0)ψⱼ(0)`, N m s, if it has any.
    pub joint: Option<SMatrix<f64, N, N>>,
}

/// The rod of a uniform link.
pub(super) type UniformRod<const N: usize> = Rod<N, POINTS, STATIONS>;
/// The rod of any other link.
pub(super) type VariedRod<const N: usize> = Rod<N, VARIED_POINTS, VARIED_STATIONS>;

/// Position and motion of the link in hub axes. Each quantity has its own array, so that the loops
/// over points and stations run through memory in order, several at a time.
pub(super) struct Configuration<const P: usize, const S: usize> {
    /// Cosine and sine of φ, point by point.
    cos: [f64; P],
    sin: [f64; P],
    /// X, Y (m), their rates (m/s) and the part of Ẍ, Ÿ that holds no ä (m/s²), station by station.
    pub stations: [[f64; S]; 6],
}

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    pub fn new(scene: &Scene) -> Self {
        let Basis { shapes, root, tip, bending, running, to_tip, masses } =
            Basis::<N, P, S>::new(scene);
        let length = scene.link.length;
        let by_station = running.map(|row| row.map(|weight| length * weight));
        let by_point = transposed(&by_station);
        let of = |p: usize, q: usize| -> f64 {
            (0..S).map(|s| masses[s] * by_point[p][s] * by_point[q][s]).sum()
        };
        let stiffness = scene.hub.stiffness.unwrap_or(0.0);
        let hinge = SMatrix::<f64, N, N>::from_fn(|i, j| stiffness * root[i] * root[j]);
        let joint = scene.damping.joint;
        Self {
            scene: *scene,
            carrier: Carrier::of(scene),
            masses,
            shapes,
            by_shape: transposed(&shapes),
            tip,
            by_station,
            by_point,
            to_tip: to_tip.map(|weight| length * weight),
            shared: std::array::from_fn(|p| std::array::from_fn(|q| of(p, q))),
            stiffness: bending * (scene.link.bending_stiffness / length) + hinge,
            joint: (joint > 0.0 && scene.hub.stiffness.is_some()).then(|| hinge * joint),
        }
    }

    /// Returns the configuration at unknowns `a` (rad) and rates `v` (rad/s).
    pub fn configuration(&self, a: &SVector<f64, N>, v: &SVector<f64, N>) -> Configuration<P, S> {
        let (angle, rate) = (self.at_points(a), self.at_points(v));
        let (mut cos, mut sin) = ([0.0; P], [0.0; P]);
        for p in 0..P {
            (sin[p], cos[p]) = angle[p].sin_cos();
        }
        // (cos φ)˙ = −φ̇ sin φ, (sin φ)˙ = φ̇ cos φ, and once more with φ̈ left out.
        let product =
            |x: &[f64; P], y: &[f64; P]| -> [f64; P] { std::array::from_fn(|p| x[p] * y[p]) };
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

    /// Returns hub-frame X and Y of the tip, m.
    pub fn tip(&self, at: &Configuration<P, S>) -> [f64; 2] {
        let to_tip = |f: &[f64; P]| -> f64 { (0..P).map(|p| f[p] * self.to_tip[p]).sum() };
        [to_tip(&at.cos) + self.scene.hub.radius, to_tip(&at.sin)]
    }

    /// Returns `Σ aₖ ψₖ` at the points.
    fn at_points(&self, a: &SVector<f64, N>) -> [f64; P] {
        let mut sum = [0.0; P];
        for k in 0..N {
            for p in 0..P {
                sum[p] += a[k] * self.by_shape[k][p];
            }
        }
        sum
    }

    /// Integrates `slope`, given at the points, from the clamp to each station.
    fn integral(&self, slope: &[f64; P]) -> [f64; S] {
        let mut sum = [0.0; S];
        for (q, slope) in slope.iter().enumerate() {
            for s in 0..S {
                sum[s] += slope * self.by_point[q][s];
            }
        }
        sum
    }

    /// Returns `M(a)`, kg m²: `Mᵢⱼ = Σ ψᵢ(p) ψⱼ(q) cos(φₚ − φ_q)` times the inertia that the points
    /// share.
    pub fn mass_matrix(&self, at: &Configuration<P, S>) -> SMatrix<f64, N, N> {
        let mut moved = [[0.0; P]; N];
        for q in 0..P {
            let (cos, sin) = (at.cos[q], at.sin[q]);
            let mut row = [0.0; P];
            for p in 0..P {
                row[p] = self.shared[q][p] * (cos * at.cos[p] + sin * at.sin[p]);
            }
            for j in 0..N {
                let shape = self.by_shape[j][q];
                for p in 0..P {
                    moved[j][p] += shape * row[p];
                }
            }
        }
        let (tip, twist) = (&self.tip, self.scene.payload.inertia);
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
    fn bias(&self, at: &Configuration<P, S>, s: usize, carrying: &Carrying) -> [f64; 2] {
        let [x, y, xd, yd, cx, cy] = at.stations.map(|quantity| quantity[s]);
        let Carrying { rate, acceleration, velocity, push, weight } = *carrying;
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
        at: &Configuration<P, S>,
        a: &SVector<f64, N>,
        v: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> SVector<f64, N> {
        match Cholesky::new(self.mass_matrix(at)) {
            Some(factor) => factor.solve(&self.force(at, a, v, hub)),
            None => SVector::repeat(f64::NAN),
        }
    }

    /// Returns `M(a) ä`, N m: everything but the part of the inertia forces that is due to ä.
    pub fn force(
        &self,
        at: &Configuration<P, S>,
        a: &SVector<f64, N>,
        v: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> SVector<f64, N> {
        let tip = &self.tip;
        let carrying = self.carrier.carrying(hub);
        let turning = self.turning(v, &carrying);
        let beta = self.scene.damping.beta;
        let bent = self.stiffness * (a + beta * v);
        let mut force = SVector::<f64, N>::from_fn(|k, _| {
            -bent[k] - self.scene.payload.inertia * tip[k] * turning
        });
        if let Some(joint) = &self.joint {
            force -= joint * v;
        }
        // What the stations outboard of a point weigh on its angle.
        let (mut along, mut across) = ([0.0; P], [0.0; P]);
        for s in 0..S {
            let [x, y] = self.bias(at, s, &carrying).map(|bias| self.masses[s] * bias);
            for p in 0..P {
                along[p] += self.by_station[s][p] * x;
                across[p] += self.by_station[s][p] * y;
            }
        }
        let moment: [f64; P] =
            std::array::from_fn(|p| at.cos[p] * across[p] - at.sin[p] * along[p]);
        for k in 0..N {
            force[k] -= dot(&self.by_shape[k], &moment);
        }
        force
    }

    /// Returns the largest factor of stiffness-proportional damping, s.
    pub fn loss(&self) -> f64 {
        let damping = self.scene.damping;
        damping.beta + self.joint.map_or(0.0, |_| damping.joint)
    }

    /// Returns `αΣψⱼ(L)ȧⱼ + θ̈ + αθ̇`: the payload's angular acceleration without the part due to
    /// ä, drag included.
    fn turning(&self, v: &SVector<f64, N>, carrying: &Carrying) -> f64 {
        let alpha = self.scene.damping.alpha;
        let spin: f64 = (0..N).map(|k| self.tip[k] * v[k]).sum();
        alpha * (spin + carrying.rate) + carrying.acceleration
    }

    /// Returns the hub torque and the bending moment at the clamp, N m. On a linear axis the first
    /// is the force on the carriage, N.
    ///
    /// Torque: `J_h θ̈` and the moment of all inertia forces, drag and weight about the axis, `∫(X
    /// a_Y − Y a_X) dm`. Moment: the same about the clamp at `(r, 0)`, without the hub's own.
    pub fn loads(
        &self,
        at: &Configuration<P, S>,
        v: &SVector<f64, N>,
        acceleration: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> [f64; 2] {
        let tip = &self.tip;
        let carrying = self.carrier.carrying(hub);
        let spin: f64 = (0..N).map(|k| tip[k] * acceleration[k]).sum();
        let mut moment = self.scene.payload.inertia * (spin + self.turning(v, &carrying));
        let mut shear = 0.0;
        let bent = self.at_points(acceleration);
        let along = self.integral(&std::array::from_fn(|p| -bent[p] * at.sin[p]));
        let across = self.integral(&std::array::from_fn(|p| bent[p] * at.cos[p]));
        for s in 0..S {
            let [ax, ay] = self.bias(at, s, &carrying);
            let (ax, ay) = (ax + along[s], ay + across[s]);
            let (x, y) = (at.stations[0][s], at.stations[1][s]);
            moment += self.masses[s] * ((x - self.scene.hub.radius) * ay - y * ax);
            shear += self.masses[s] * ay;
        }
        let own = self.scene.hub.inertia;
        let torque = if self.scene.mount.is_linear() {
            shear + own * (hub.acceleration + carrying.weight[1])
        } else {
            moment + self.scene.hub.radius * shear + own * hub.acceleration
        };
        [torque, moment]
    }
}

impl<const P: usize, const S: usize> Configuration<P, S> {
    /// Returns hub-frame X and Y of the payload's centre, m.
    pub fn payload(&self) -> [f64; 2] {
        [self.stations[0][S - 1], self.stations[1][S - 1]]
    }
}

/// Returns the sum of the products, in four partial sums that do not wait for each other.
fn dot<const P: usize>(x: &[f64; P], y: &[f64; P]) -> f64 {
    let mut sum = [0.0; 4];
    for p in 0..P {
        sum[p % 4] += x[p] * y[p];
    }
    (sum[0] + sum[1]) + (sum[2] + sum[3])
}

fn transposed<const R: usize, const C: usize>(rows: &[[f64; C]; R]) -> [[f64; R]; C] {
    std::array::from_fn(|c| std::array::from_fn(|r| rows[r][c]))
}
