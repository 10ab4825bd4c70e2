//! Moves after which the arm is at rest.
//!
//! The hub follows a quintic with a bulge, `θ = quintic + (1 − u²)³ Σ bₖuᵏ`. Which bulge leaves a
//! linear first mode with given amplitudes, and makes the least peak of acceleration of all that
//! do, is a small linear system. An arm that bends far does not arrive where it says: it is flown
//! through the move in its exact kinematics, what it misses is aimed off by, and a few such rounds
//! leave nothing.
//!
//! ```
//! use stillbeam::planner::Still;
//! use stillbeam::{Link, Scene};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! let planner = Still::<f32, 2>::new(&scene, 0.010)?;
//! let plan = planner.plan(0.0, 1.57, 0.2)?;
//! assert!(plan.residual < 5e-4);
//! # Ok::<(), stillbeam::Error>(())
//! ```

mod aiming;
mod course;
mod effort;
mod flight;
mod loads;
mod path;
mod plan;
mod redirect;
mod second;
mod shortest;
mod survey;

pub use course::Course;
pub use effort::Manner;
pub(crate) use path::Path;
pub use plan::StillMove;
pub use survey::Survey;

use flight::{Arm, Stride};

use crate::Error;
use crate::math::Scalar;
use crate::model::{Chain, Rod};
use crate::motion::Limits;
use crate::scene::Scene;
use crate::stepper::Flex;

/// Most arms that one move is planned for.
const MAX_ARMS: usize = 3;

/// Where the outer arms of a robust planner lie, of its spread: nearly a Chebyshev point.
const OUTER: f64 = 0.8;

/// Angles that the highest and the first mode may turn by in a step of a flight, in a move of at
/// least [`LONG`] first periods.
const COARSE: [f64; 2] = [2.0, 0.4];

/// In a shorter one the arm bends by most of its length, and what couples its modes changes faster
/// than they do: 0.1 % of L came from longer steps.
const FINE: [f64; 2] = [0.5, 0.1];

/// First periods.
const LONG: f64 = 1.4;

/// Plans moves after which an arm is at rest. Set-up takes its time; a plan runs in the tick's
/// scalar, allocates nothing and ends after a bounded number of flights.
///
/// A robust planner takes the move for three arms at once, with frequencies at `1 − 0.8 δ`, 1 and
/// `1 + 0.8 δ` of the scene's. The outer two arrive at rest; the scene's own too where that costs
/// less than twice the peak, else it keeps as much vibration as that price leaves, or, where no such
/// move is found, what the outer two leave it.
#[derive(Clone, Debug)]
pub struct Still<T, const K: usize> {
    chain: Chain<T, K>,
    coarse: Stride<T, K>,
    fine: Stride<T, K>,
    robust: bool,
    scene: Scene,
    tick: f64,
    /// Torque and moment that every move keeps.
    loads: Limits,
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
        let (spread, robust) = (OUTER * spread, spread > 0.0);
        Ok(Self {
            chain: Chain::new(&rod),
            coarse: Stride::new(&rod, tick, spread, COARSE)?,
            fine: Stride::new(&rod, tick, spread, FINE)?,
            robust,
            scene: *scene,
            tick,
            loads: Limits::default(),
        })
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        self.coarse.arms[0].first_period()
    }

    /// Whether a move run backwards is a move.
    fn is_reversible(&self) -> bool {
        let damping = self.scene.damping;
        self.scene.gravity == 0.0 && damping.alpha == 0.0 && damping.beta == 0.0
    }

    /// The arms that a move is planned for.
    fn arms<'a>(&self, stride: &'a Stride<T, K>) -> &'a [Arm<T, K>] {
        if self.robust { &stride.arms } else { &stride.arms[..1] }
    }

    /// For a move of that many seconds.
    fn stride(&self, duration: f64) -> &Stride<T, K> {
        if duration < LONG * self.first_period() { &self.fine } else { &self.coarse }
    }
}
