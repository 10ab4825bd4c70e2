//! The rod on a hub that a torque drives, and its energy.
//!
//! The rod's equations are affine in the hub's acceleration, and the inertia by which the hub turns
//! the link is the one by which the link turns the hub: `M ä = f − c θ̈`, `τ = τ₀ + c·ä + J θ̈`.

use nalgebra::{Cholesky, SMatrix, SVector};
use stillbeam::Scene;
use stillbeam::hub::{Angle, HubState};

use super::equations::{Configuration, Rod, UniformRod, VariedRod, dot};
use super::march::choose;
use super::{Integrator, ReferenceError};

/// Most unknowns of a rod.
pub(crate) const UNKNOWNS: usize = 8;

/// Unknowns of a rod or their rates; those beyond its order are zero.
pub(crate) type Unknowns = SVector<f64, UNKNOWNS>;

/// Answer of the arm to its hub at one instant: `ä = free + per_acceleration · θ̈`, and the torque
/// into the hub, its own inertia included, `τ = bias + inertia · θ̈`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Response {
    /// ä of a hub that does not accelerate, rad/s².
    pub free: Unknowns,
    /// ∂ä/∂θ̈.
    pub per_acceleration: Unknowns,
    /// τ of a hub that does not accelerate, N m.
    pub bias: f64,
    /// Inertia that the hub feels, kg m².
    pub inertia: f64,
    /// Power that damping takes out of the arm, W.
    pub lost: f64,
}

/// An arm whose hub turns as torques make it, of any order.
pub(crate) trait Driven: Send + Sync {
    /// Returns the angular frequencies of the clamped arm, rad/s, lowest and highest.
    fn frequencies(&self) -> [f64; 2];
    /// Returns the integrator that suits the arm's damping.
    fn integrator(&self) -> Integrator;
    /// Returns the unknowns at rest under gravity at the hub angle `angle`, rad, if that is stable.
    fn equilibrium(&self, angle: f64) -> Option<Unknowns>;
    /// Returns the answer at unknowns `a` (rad), rates `v` (rad/s) and the hub's angle (rad) and
    /// rate (rad/s).
    fn respond(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> Response;
    /// Returns kinetic and potential energy, the hub's own included, J.
    fn energy(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> f64;
    /// Returns hub-frame X and Y of the tip, m.
    fn tip(&self, a: &Unknowns) -> [f64; 2];
}

/// Creates the arm of a validated scene with `order` polynomials, 5 to 8.
pub(crate) fn driven(scene: &Scene, order: usize) -> Result<Box<dyn Driven>, ReferenceError> {
    with_rod!(scene, order, |rod| Ok(Box::new(rod) as Box<dyn Driven>))
}

impl<const N: usize, const P: usize, const S: usize> Driven for Rod<N, P, S> {
    fn frequencies(&self) -> [f64; 2] {
        let all = Rod::frequencies(self);
        [all[0], all[N - 1]]
    }

    fn integrator(&self) -> Integrator {
        choose(Rod::frequencies(self)[N - 1], self.loss())
    }

    fn equilibrium(&self, angle: f64) -> Option<Unknowns> {
        Rod::equilibrium(self, &hub(angle, 0.0)).map(|a| widened(&a))
    }

    fn respond(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> Response {
        let (a, v) = (narrowed::<N>(a), narrowed::<N>(v));
        let at = self.configuration(&a, &v);
        let mass = self.mass_matrix(&at);
        let Some(factor) = Cholesky::new(mass) else {
            return Response::not_finite();
        };
        let even = self.inertia(&at, &v, &SVector::zeros(), &hub(angle, rate));
        let free = factor.solve(&self.force(&a, &v, &even));
        let turning = Turning::of(self, &at);
        let per_acceleration = -factor.solve(&turning.coupling);
        Response {
            free: widened(&free),
            per_acceleration: widened(&per_acceleration),
            bias: self.about_axis(&even) + turning.coupling.dot(&free),
            inertia: turning.inertia
                + self.scene.hub.inertia
                + turning.coupling.dot(&per_acceleration),
            lost: self.lost_power(&v, || turning.motion(&mass, &v, rate)),
        }
    }

    fn energy(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> f64 {
        let (a, v) = (narrowed::<N>(a), narrowed::<N>(v));
        let at = self.configuration(&a, &v);
        let gravity = self.scene.in_plane_gravity();
        let (sin, cos) = self.scene.gravity_direction().seen_from(&hub(angle, rate));
        // First moments of the mass, kg m: the mean height times the mass.
        let along = self.mass * self.scene.hub.radius + dot(&self.outboard, &at.cos);
        let across = dot(&self.outboard, &at.sin);
        gravity * (along * sin + across * cos)
            + 0.5 * Turning::of(self, &at).motion(&self.mass_matrix(&at), &v, rate)
            + 0.5 * self.scene.hub.inertia * rate * rate
            + 0.5 * a.dot(&(self.stiffness * a))
    }

    fn tip(&self, a: &Unknowns) -> [f64; 2] {
        let a = narrowed::<N>(a);
        Rod::tip(self, &self.configuration(&a, &a.map(|_| 0.0)))
    }
}

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    /// Returns the power that damping takes out of the arm, W. `motion` is twice its kinetic
    /// energy, J.
    fn lost_power(&self, v: &SVector<f64, N>, motion: impl FnOnce() -> f64) -> f64 {
        let damping = self.scene.damping;
        let mut power = damping.beta * v.dot(&(self.stiffness * v));
        if let Some(joint) = &self.joint {
            power += v.dot(&(joint * v));
        }
        if damping.alpha > 0.0 { power + damping.alpha * motion() } else { power }
    }
}

/// The inertia of the whole arm's turn about its hub.
struct Turning<const N: usize> {
    /// The part that the unknowns feel, c, kg m².
    coupling: SVector<f64, N>,
    /// The part about the hub's axis, without the hub's own, kg m².
    inertia: f64,
}

impl<const N: usize> Turning<N> {
    fn of<const P: usize, const S: usize>(rod: &Rod<N, P, S>, at: &Configuration<P>) -> Self {
        let inertia = rod.inertia_of_turn(at);
        Self { coupling: rod.projected(&inertia), inertia: rod.about_axis(&inertia) }
    }

    /// Returns twice the kinetic energy of link and payload, J, on a hub that turns at `rate`
    /// rad/s.
    fn motion(&self, mass: &SMatrix<f64, N, N>, v: &SVector<f64, N>, rate: f64) -> f64 {
        v.dot(&(mass * v)) + rate * (2.0 * self.coupling.dot(v) + self.inertia * rate)
    }
}

impl Response {
    /// The answer of a state that is not finite.
    fn not_finite() -> Self {
        let none = Unknowns::repeat(f64::NAN);
        Self { free: none, per_acceleration: none, bias: f64::NAN, inertia: 1.0, lost: f64::NAN }
    }
}

/// The hub at `angle`, rad, and `rate`, rad/s, without acceleration.
fn hub(angle: f64, rate: f64) -> HubState<f64> {
    let (sin, cos) = angle.sin_cos();
    HubState { angle: Angle::from_radians(angle), rate, acceleration: 0.0, sin, cos }
}

fn narrowed<const N: usize>(all: &Unknowns) -> SVector<f64, N> {
    SVector::from_fn(|k, _| all[k])
}

fn widened<const N: usize>(own: &SVector<f64, N>) -> Unknowns {
    Unknowns::from_fn(|k, _| if k < N { own[k] } else { 0.0 })
}
