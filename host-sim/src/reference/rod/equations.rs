//! The equations of motion of the inextensible planar rod.

use nalgebra::{Cholesky, SMatrix, SVector};
use stillbeam::Scene;
use stillbeam::hub::HubState;

use super::super::carrying::Carrier;
use super::inertia::Inertia;
use super::legendre::{Basis, POINTS, STATIONS, VARIED_POINTS, VARIED_STATIONS};

/// A rod with N unknowns: the relative angle is `φ(x, t) = Σ aₖ(t) ψₖ(x)`, a point of the link at
/// hub-frame `X = r + ∫₀ˣ cos φ`, `Y = ∫₀ˣ sin φ`. P points of quadrature, at which the link turns;
/// S stations, at which it has its masses.
///
/// Each station is the sum of what the points inboard of it contribute, so that all sums over the
/// masses are sums over points: `Rₛₚ` integrates values at the points from the clamp to the
/// station.
pub(super) struct Rod<const N: usize, const P: usize, const S: usize> {
    pub scene: Scene,
    pub carrier: Carrier,
    /// `Σₛ mₛ`, link and payload, kg.
    pub mass: f64,
    /// `ψₖ` at the points, and shape by shape; at the tip.
    pub shapes: [[f64; N]; P],
    pub by_shape: [[f64; P]; N],
    pub tip: [f64; N],
    /// Row of R, m, that leads to the tip, and the one to the payload's centre.
    to_tip: [f64; P],
    to_payload: [f64; P],
    /// `Σₛ mₛ Rₛₚ`, kg m: what a point's angle moves of the masses outboard of it.
    pub outboard: [f64; P],
    /// `Σₛ mₛ Rₛₚ Rₛ_q`, kg m²: the inertia that the angles at the points p and q share, without
    /// the cosine of their difference.
    pub shared: [[f64; P]; P],
    /// Stiffness of link and joint, `∫EI ψᵢ'ψⱼ' dx + k ψᵢ(0)ψⱼ(0)`, N m.
    pub stiffness: SMatrix<f64, N, N>,
    /// The joint's own damping, `β_J k ψᵢ(0)ψⱼ(0)`, N m s, if it has any.
    pub joint: Option<SMatrix<f64, N, N>>,
}

/// The rod of a uniform link.
pub(super) type UniformRod<const N: usize> = Rod<N, POINTS, STATIONS>;
/// The rod of any other link.
pub(super) type VariedRod<const N: usize> = Rod<N, VARIED_POINTS, VARIED_STATIONS>;

/// Directions of the link in hub axes, point by point. Each quantity has its own array, so that the
/// loops over points run through memory in order, several at a time.
pub(super) struct Configuration<const P: usize> {
    /// Cosine and sine of φ.
    pub cos: [f64; P],
    pub sin: [f64; P],
    /// φ̇, rad/s.
    pub rate: [f64; P],
}

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    pub fn new(scene: &Scene) -> Self {
        let Basis { shapes, root, tip, bending, running, to_tip, masses } =
            Basis::<N, P, S>::new(scene);
        let length = scene.link.length;
        let by_station = running.map(|row| row.map(|weight| length * weight));
        let of = |p: usize, q: usize| -> f64 {
            (0..S).map(|s| masses[s] * by_station[s][p] * by_station[s][q]).sum()
        };
        let outboard = |p: usize| (0..S).map(|s| masses[s] * by_station[s][p]).sum();
        let stiffness = scene.hub.stiffness.unwrap_or(0.0);
        let hinge = SMatrix::<f64, N, N>::from_fn(|i, j| stiffness * root[i] * root[j]);
        let joint = scene.damping.joint;
        Self {
            scene: *scene,
            carrier: Carrier::of(scene),
            mass: masses.iter().sum(),
            shapes,
            by_shape: std::array::from_fn(|k| std::array::from_fn(|p| shapes[p][k])),
            tip,
            to_tip: to_tip.map(|weight| length * weight),
            to_payload: by_station[S - 1],
            outboard: std::array::from_fn(outboard),
            shared: std::array::from_fn(|p| std::array::from_fn(|q| of(p, q))),
            stiffness: bending * (scene.link.bending_stiffness / length) + hinge,
            joint: (joint > 0.0 && scene.hub.stiffness.is_some()).then(|| hinge * joint),
        }
    }

    /// Returns the configuration at unknowns `a` (rad) and rates `v` (rad/s).
    pub fn configuration(&self, a: &SVector<f64, N>, v: &SVector<f64, N>) -> Configuration<P> {
        let (mut cos, mut sin) = ([0.0; P], [0.0; P]);
        for (p, angle) in self.at_points(a).into_iter().enumerate() {
            (sin[p], cos[p]) = angle.sin_cos();
        }
        Configuration { cos, sin, rate: self.at_points(v) }
    }

    /// Returns hub-frame X and Y of the tip, m.
    pub fn tip(&self, at: &Configuration<P>) -> [f64; 2] {
        self.place(at, &self.to_tip)
    }

    /// Returns hub-frame X and Y of the payload's centre, m.
    pub fn payload(&self, at: &Configuration<P>) -> [f64; 2] {
        self.place(at, &self.to_payload)
    }

    fn place(&self, at: &Configuration<P>, row: &[f64; P]) -> [f64; 2] {
        [dot(&at.cos, row) + self.scene.hub.radius, dot(&at.sin, row)]
    }

    /// Returns `Σ aₖ ψₖ` at the points.
    pub fn at_points(&self, a: &SVector<f64, N>) -> [f64; P] {
        let mut sum = [0.0; P];
        for k in 0..N {
            for p in 0..P {
                sum[p] += a[k] * self.by_shape[k][p];
            }
        }
        sum
    }

    /// Returns `Σ aₖ ψₖ` at the tip.
    pub fn at_tip(&self, a: &SVector<f64, N>) -> f64 {
        (0..N).map(|k| self.tip[k] * a[k]).sum()
    }

    /// Returns `M(a)`, kg m²: `Mᵢⱼ = Σ ψᵢ(p) ψⱼ(q) cos(φₚ − φ_q)` times the inertia that the points
    /// share.
    pub fn mass_matrix(&self, at: &Configuration<P>) -> SMatrix<f64, N, N> {
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

    /// Returns `ä` (rad/s²) from `∫ρA Aᵢ·a dx + m_p Aᵢ·a(L) + J_p ψᵢ(L)(…) + EI-terms = 0`. The
    /// result is not a number if the state is not.
    pub fn acceleration(
        &self,
        at: &Configuration<P>,
        a: &SVector<f64, N>,
        v: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> SVector<f64, N> {
        match Cholesky::new(self.mass_matrix(at)) {
            Some(factor) => {
                factor.solve(&self.force(a, v, &self.inertia(at, v, &SVector::zeros(), hub)))
            }
            None => SVector::repeat(f64::NAN),
        }
    }

    /// Returns `M(a) ä`, N m, of an `inertia` without ä: what bends back, what damps, and the
    /// inertia.
    pub fn force(
        &self,
        a: &SVector<f64, N>,
        v: &SVector<f64, N>,
        inertia: &Inertia<P>,
    ) -> SVector<f64, N> {
        let bent = self.stiffness * (a + self.scene.damping.beta * v);
        let force = -bent - self.projected(inertia);
        match &self.joint {
            Some(joint) => force - joint * v,
            None => force,
        }
    }

    /// Returns the largest factor of stiffness-proportional damping, s.
    pub fn loss(&self) -> f64 {
        let damping = self.scene.damping;
        damping.beta + self.joint.map_or(0.0, |_| damping.joint)
    }

    /// Returns the hub torque and the bending moment at the clamp, N m. On a linear axis the first
    /// is the force on the carriage, N.
    ///
    /// Torque: `J_h θ̈` and the moment of all inertia forces, drag and weight about the axis, `∫(X
    /// a_Y − Y a_X) dm`. Moment: the same about the clamp at `(r, 0)`, without the hub's own.
    pub fn loads(
        &self,
        at: &Configuration<P>,
        v: &SVector<f64, N>,
        acceleration: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> [f64; 2] {
        let inertia = self.inertia(at, v, acceleration, hub);
        let own = self.scene.hub.inertia;
        let torque = if self.scene.mount.is_linear() {
            inertia.shear + own * (hub.acceleration + self.carrier.carrying(hub).weight[1])
        } else {
            self.about_axis(&inertia) + own * hub.acceleration
        };
        [torque, inertia.about_clamp()]
    }
}

/// Returns the sum of the products, in four partial sums that do not wait for each other.
pub(super) fn dot<const P: usize>(x: &[f64; P], y: &[f64; P]) -> f64 {
    let mut sum = [0.0; 4];
    for p in 0..P {
        sum[p % 4] += x[p] * y[p];
    }
    (sum[0] + sum[1]) + (sum[2] + sum[3])
}
