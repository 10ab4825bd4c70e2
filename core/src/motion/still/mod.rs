//! Moves after which the arm is at rest.
//!
//! The hub follows a quintic with a bulge, `θ = quintic + (1 − u²)³ Σ bₖuᵏ`. Which bulge leaves a
//! linear first mode with given amplitudes, and makes the least peak of acceleration of all that
//! do, is a small linear system. An arm that bends far does not arrive where it says: it is flown
//! through the move in its exact kinematics, what it misses is aimed off by, and a few such rounds
//! leave nothing.
//!
//! ```
//! use stillbeam::motion::Still;
//! use stillbeam::{Link, Scene};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! let planner = Still::<f32, 2>::new(&scene, 0.010)?;
//! let plan = planner.plan(0.0, 1.57, 0.2)?;
//! assert!(plan.residual < 1e-4);
//! # Ok::<(), stillbeam::Error>(())
//! ```

mod aiming;
mod effort;
mod flight;
mod path;
mod plan;
mod shortest;
mod survey;

pub use effort::Manner;
pub use path::Departure;
pub(crate) use path::{Path, peaks};
pub use plan::StillMove;
pub use survey::Survey;

use flight::{Arm, Pace};

use crate::Error;
use crate::beam::{Chain, Rod};
use crate::math::Scalar;
use crate::scene::Scene;
use crate::stepper::Flex;

/// Most arms that one move is planned for.
const MAX_ARMS: usize = 3;

/// Where the outer arms of a robust planner lie, of its spread: nearly a Chebyshev point.
const OUTER: f64 = 0.8;

/// Angle that the highest mode may turn by in a step of a flight.
const RADIANS_A_STEP: f64 = 1.0;

/// Plans moves after which an arm is at rest. Set-up takes its time; a plan runs in the tick's
/// scalar, allocates nothing and ends after a bounded number of flights.
///
/// A robust planner takes the move for three arms at once, with frequencies at `1 − 0.8 δ`, 1 and
/// `1 + 0.8 δ` of the scene's. The outer two arrive at rest; the scene's own too where that costs
/// less than twice the peak, else it keeps as much vibration as that price leaves.
#[derive(Clone, Debug)]
pub struct Still<T, const K: usize> {
    chain: Chain<T, K>,
    /// The scene's own, the outer ones.
    arms: [Arm<T, K>; MAX_ARMS],
    robust: bool,
    scene: Scene,
    tick: f64,
    /// Steps of a flight in a tick.
    steps: u32,
    pace: Pace<T>,
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// For setpoints every `tick` s; f64 inside. `K` modes: 1 to 3.
    pub fn new(scene: &Scene, tick: f64) -> Result<Self, Error> {
        Self::build(scene, tick, 0.0)
    }

    /// For an arm whose frequencies are known to `± spread` of themselves, 0.01 to 0.3.
    pub fn robust(scene: &Scene, tick: f64, spread: f64) -> Result<Self, Error> {
        let spread = Error::check("robust", spread, 0.01, 0.3, "")?;
        Self::build(scene, tick, spread)
    }

    fn build(scene: &Scene, tick: f64, spread: f64) -> Result<Self, Error> {
        let tick = Error::check("solver.tick", tick, 1e-6, 1.0, "s")?;
        let rod = Rod::new(scene)?;
        let aside = OUTER * spread;
        let highest = rod.frequency()[K - 1] * (1.0 + aside);
        let steps = libm::ceil(highest * tick / RADIANS_A_STEP).clamp(1.0, 1024.0);
        let step = tick / steps;
        let arm = |factor: f64| {
            let mut scene = *scene;
            scene.link.bending_stiffness *= factor * factor;
            Arm::new(&Rod::new(&scene)?, step)
        };
        let nominal = arm(1.0)?;
        let robust = spread > 0.0;
        let arms = if robust {
            [nominal, arm(1.0 - aside)?, arm(1.0 + aside)?]
        } else {
            [nominal; MAX_ARMS]
        };
        Ok(Self {
            chain: Chain::new(&rod),
            arms,
            robust,
            scene: *scene,
            tick,
            steps: steps as u32,
            pace: Pace {
                per_step: T::from_f64(1.0 / step),
                alpha: T::from_f64(scene.damping.alpha),
            },
        })
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        self.arms[0].first_period()
    }

    /// Whether a move run backwards is a move.
    fn is_reversible(&self) -> bool {
        let damping = self.scene.damping;
        self.scene.gravity == 0.0 && damping.alpha == 0.0 && damping.beta == 0.0
    }

    /// The arms that a move is planned for.
    fn arms(&self) -> &[Arm<T, K>] {
        if self.robust { &self.arms } else { &self.arms[..1] }
    }
}
