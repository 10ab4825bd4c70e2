//! The rod on a hub that a torque drives, and its energy.
//!
//! The rod's equations are affine in the hub's acceleration. Solved for an acceleration of 0 and
//! of 1 with the same factors, they say what inertia the hub feels and how the link answers to it.

use nalgebra::{Cholesky, SVector};
use stillbeam::Scene;
use stillbeam::hub::{Angle, HubState};

use super::equations::{Configuration, Rod, UniformRod, VariedRod};
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
        Rod::equilibrium(self, &hub(angle, 0.0, 0.0)).map(|a| widened(&a))
    }

    fn respond(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> Response {
        let (a, v) = (narrowed::<N>(a), narrowed::<N>(v));
        let at = self.configuration(&a, &v);
        let (even, pushed) = (hub(angle, rate, 0.0), hub(angle, rate, 1.0));
        let Some(factor) = Cholesky::new(self.mass_matrix(&at)) else {
            let none = Unknowns::repeat(f64::NAN);
            return Response {
                free: none,
                per_acceleration: none,
                bias: f64::NAN,
                inertia: 1.0,
                lost: f64::NAN,
            };
        };
        let free = factor.solve(&self.force(&at, &a, &v, &even));
        let with = factor.solve(&self.force(&at, &a, &v, &pushed));
        let bias = self.loads(&at, &v, &free, &even)[0];
        let inertia = self.loads(&at, &v, &with, &pushed)[0] - bias;
        Response {
            free: widened(&free),
            per_acceleration: widened(&(with - free)),
            bias,
            inertia,
            lost: self.lost_power(&at, &v, rate),
        }
    }

    fn energy(&self, a: &Unknowns, v: &Unknowns, angle: f64, rate: f64) -> f64 {
        let (a, v) = (narrowed::<N>(a), narrowed::<N>(v));
        let at = self.configuration(&a, &v);
        let gravity = self.scene.in_plane_gravity();
        let (sin, cos) = self.scene.gravity_direction().seen_from(&hub(angle, rate, 0.0));
        let [x, y] = [&at.stations[0], &at.stations[1]];
        let height = |s: usize| x[s] * sin + y[s] * cos;
        let of =
            |s: usize| self.masses[s] * (0.5 * speed_squared(&at, s, rate) + gravity * height(s));
        let turning = self.tip_rate(&v) + rate;
        (0..S).map(of).sum::<f64>()
            + 0.5 * self.scene.payload.inertia * turning * turning
            + 0.5 * self.scene.hub.inertia * rate * rate
            + 0.5 * a.dot(&(self.stiffness * a))
    }

    fn tip(&self, a: &Unknowns) -> [f64; 2] {
        let a = narrowed::<N>(a);
        Rod::tip(self, &self.configuration(&a, &a.map(|_| 0.0)))
    }
}

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    /// Returns the power that damping takes out of the arm on a hub that turns at `rate` rad/s, W.
    fn lost_power(&self, at: &Configuration<P, S>, v: &SVector<f64, N>, rate: f64) -> f64 {
        let damping = self.scene.damping;
        let mut power = damping.beta * v.dot(&(self.stiffness * v));
        if let Some(joint) = &self.joint {
            power += v.dot(&(joint * v));
        }
        if damping.alpha > 0.0 {
            let moving: f64 = (0..S).map(|s| self.masses[s] * speed_squared(at, s, rate)).sum();
            let turning = self.tip_rate(v) + rate;
            power += damping.alpha * (moving + self.scene.payload.inertia * turning * turning);
        }
        power
    }

    /// Returns the rate of the tip's angle relative to the hub, rad/s.
    fn tip_rate(&self, v: &SVector<f64, N>) -> f64 {
        (0..N).map(|k| self.tip[k] * v[k]).sum()
    }
}

/// Returns the square of a station's speed, m²/s², on a hub that turns at `rate` rad/s.
fn speed_squared<const P: usize, const S: usize>(
    at: &Configuration<P, S>,
    s: usize,
    rate: f64,
) -> f64 {
    let [x, y, xd, yd] = [0, 1, 2, 3].map(|quantity| at.stations[quantity][s]);
    let (along, across) = (xd - rate * y, yd + rate * x);
    along * along + across * across
}

fn hub(angle: f64, rate: f64, acceleration: f64) -> HubState<f64> {
    let (sin, cos) = angle.sin_cos();
    HubState { angle: Angle::from_radians(angle), rate, acceleration, sin, cos }
}

fn narrowed<const N: usize>(all: &Unknowns) -> SVector<f64, N> {
    SVector::from_fn(|k, _| all[k])
}

fn widened<const N: usize>(own: &SVector<f64, N>) -> Unknowns {
    Unknowns::from_fn(|k, _| if k < N { own[k] } else { 0.0 })
}
