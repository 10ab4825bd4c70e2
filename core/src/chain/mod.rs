//! Chains of links: exact kinematics of strips, all joint torques at once, in one tick.
//!
//! Each link that bends has the curvature `κ(s) = Σ a_k P_{k−1}(2s/L − 1)/L`, `P` Legendre's
//! polynomials, and so the slope `Σ a_k ψ_k(s)` against its clamp. Its joint's angle is one more
//! coordinate, known where a motor turns it. Accelerations run from the base to the tip, forces
//! back; the moment at every joint is its torque. A tick is one step of Radau IIA with two stages
//! and one Newton iteration.
//!
//! ```
//! use stillbeam::chain::{ChainGenerator, TwoLinks2};
//! use stillbeam::mechanism::{Link, Mechanism};
//! use stillbeam::{Move, Profile};
//!
//! let strip = Link::flexible(0.3, 0.0168, 0.46);
//! let mut mechanism = Mechanism::new(&[strip, strip])?;
//! mechanism.payload.mass = 0.02;
//! let chain = TwoLinks2::<f32>::new(&mechanism, 0.010)?;
//! let mut arm = ChainGenerator::<_, 2, 3, 6, 3>::new(chain, [0.0, 0.3])?;
//! arm.push(0, &Move::To { profile: Profile::Quintic, duration: 0.6, to: 1.0 })?;
//! arm.push(1, &Move::To { profile: Profile::Quintic, duration: 0.6, to: 1.3 })?;
//! for _ in 0..=60 {
//!     let setpoint = arm.tick();
//!     assert!(setpoint.joints.iter().all(|joint| joint.torque.abs() < 1.0));
//! }
//! # Ok::<(), stillbeam::Error>(())
//! ```
//!
//! # One link
//!
//! A chain of one is a single arm, but take [`Elastica2`](crate::stepper::Elastica2) for it. At
//! 10 ms its tip is within 2e-4 of the length of the truth on every scene, that of a chain with two
//! coordinates within 2.4e-4 to 2.6e-2 (with three 8e-6 to 1.6e-2), at two fifths of the
//! instructions or less: it advances the modes of vibration exactly, a chain steps them.

mod admit;
mod along;
mod body;
mod close;
mod dynamics;
mod energy;
mod equilibrium;
mod factors;
mod generator;
mod mass;
mod modes;
mod pin;
mod places;
mod pose;
mod quadrature;
mod queue;
mod rehearse;
mod solve;
mod stages;
mod state;
mod step;
mod still;
mod stop;
mod weights;

use admit::Bends;
use body::{Body, Load};
pub use energy::Energy;
pub use generator::{ChainGenerator, ChainSetpoint};
pub use modes::ChainModes;
pub use rehearse::Rehearsal;
pub use state::{ChainState, Command, JointState};
pub use still::{ChainPlan, ChainPlanner};

use crate::Error;
use crate::math::{Scalar, array};
use crate::mechanism::{Closing, Mechanism};
use factors::Values;
use weights::Weights;

/// Links, joints and payload as the tick needs them.
#[derive(Clone, Copy, Debug)]
struct Model<T, const LINKS: usize, const W: usize, const Q: usize> {
    links: [Body<T, W, Q>; LINKS],
    load: Load<T>,
    gravity: T,
    alpha: T,
    beta: T,
    /// 1/2π.
    turns: T,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Contribution of the stiffness to the diagonal of the stage equations.
    fn diagonal(&self, weights: &Weights<T>) -> Values<T, LINKS, W> {
        self.links.map(|body| body.stiffness.map(|own| weights.stiffness.scaled(own)))
    }
}

/// A chain of `LINKS` links with `W − 1` curvature coordinates each, advanced tick by tick.
///
/// `C` is `LINKS × W`, `Q` the Gauss points along a link: see [`TwoLinks2`] and its neighbours.
#[derive(Clone, Copy, Debug)]
pub struct Chain<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> {
    model: Model<T, LINKS, W, Q>,
    weights: Weights<T>,
    /// Coordinates that the tick solves for, while the chain is open and when it is closed.
    open: [bool; C],
    closed: [bool; C],
    /// True if a joint of the open chain is not driven.
    passive: bool,
    /// Contribution of the stiffness to the diagonal of the stage equations.
    diagonal: Values<T, LINKS, W>,
    /// Where the passive joints begin, rad.
    passive_angles: [T; LINKS],
    /// Place of the pin of a chain that is closed from the beginning.
    pin: Option<[T; 2]>,
    /// Tick at which the chain closes.
    closes: Option<u32>,
    bends: Bends<LINKS>,
    /// Sum of all lengths, m.
    length: f64,
    tick: f64,
}

/// One link with two curvature coordinates.
pub type OneLink2<T> = Chain<T, 1, 3, 3, 3>;
/// Two links with two curvature coordinates each.
pub type TwoLinks2<T> = Chain<T, 2, 3, 6, 3>;
/// Three links with two curvature coordinates each.
pub type ThreeLinks2<T> = Chain<T, 3, 3, 9, 3>;
/// One link with three curvature coordinates.
pub type OneLink3<T> = Chain<T, 1, 4, 4, 5>;
/// Two links with three curvature coordinates each.
pub type TwoLinks3<T> = Chain<T, 2, 4, 8, 5>;
/// Three links with three curvature coordinates each.
pub type ThreeLinks3<T> = Chain<T, 3, 4, 12, 5>;

impl<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> Chain<T, LINKS, W, C, Q>
where
    T: Scalar,
{
    /// The chain for steps of `tick` s. Computed in f64.
    ///
    /// # Errors
    /// A mechanism that [`Mechanism::validate`] refuses, another number of links, or a tick out of
    /// range.
    pub fn new(mechanism: &Mechanism, tick: f64) -> Result<Self, Error> {
        const { assert!(C == LINKS * W, "a coordinate a joint and curvature") }
        const { assert!(W >= 3 && W <= 4, "two or three curvature coordinates") }
        mechanism.validate()?;
        let (given, links) = (mechanism.links.len() as f64, LINKS as f64);
        Error::check("links", given, links, links, "links of this type of chain")?;
        let tick = Error::check("solver.tick", tick, 1e-6, 1.0, "s")?;
        let f = T::from_f64;
        let mut outer = mechanism.payload.mass;
        let mut bodies = [None; LINKS];
        for j in (0..LINKS).rev() {
            let body = Body::new(mechanism, j, outer);
            outer = body.mass_beyond;
            bodies[j] = Some(body);
        }
        let links = bodies.map(|body| body.unwrap_or_else(|| Body::new(mechanism, 0, 0.0)).cast());
        let payload = &mechanism.payload;
        let bends = |j: usize| mechanism.links[j].bends();
        let unknown = |closed: bool| {
            array(|i| match i % W {
                0 if closed => mechanism.is_free_when_closed(i / W),
                0 => !mechanism.is_driven(i / W),
                _ => bends(i / W),
            })
        };
        let model = Model {
            links,
            load: Load {
                mass: f(payload.mass),
                inertia: f(payload.inertia),
                offset: f(payload.offset),
            },
            gravity: f(mechanism.gravity),
            alpha: f(mechanism.damping.alpha),
            beta: f(mechanism.damping.beta),
            turns: f(1.0 / core::f64::consts::TAU),
        };
        let weights = Weights::new(tick, &mechanism.damping);
        Ok(Self {
            diagonal: model.diagonal(&weights),
            passive: (0..LINKS).any(|j| !mechanism.is_driven(j)),
            bends: Bends::new::<W, C, Q>(&model.precise()),
            model,
            weights,
            open: unknown(false),
            closed: unknown(true),
            passive_angles: array(|j| f(mechanism.joints[j].angle)),
            pin: mechanism.closure.as_ref().and_then(|closure| match closure.begins {
                Closing::OnPin(pin) => Some(pin.map(f)),
                Closing::At(_) => None,
            }),
            closes: mechanism.closure.as_ref().and_then(|closure| match closure.begins {
                Closing::OnPin(_) => None,
                Closing::At(time) => Some(libm::round(time / tick) as u32),
            }),
            length: mechanism.total_length(),
            tick,
        })
    }

    /// Tick length, s.
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// Ticks a second.
    #[inline(always)]
    fn per_tick(&self) -> T {
        self.weights.per_tick
    }
}
