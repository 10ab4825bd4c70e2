//! Moves after which the arm is at rest.
//!
//! The hub follows a quintic with a bulge, `θ = quintic + (1 − u²)³ Σ bₖuᵏ`. For a linear arm a
//! small linear system gives the bulge that leaves the first mode at rest with the least peak of
//! acceleration. A strongly bent arm misses that. The planner simulates it in its exact kinematics,
//! corrects the linear target by the miss, and repeats.
//!
//! A [`Request`] says what is asked, [`Planner::plan`] answers with a [`StillMove`], and
//! [`Planner::predict`] gives the arm's [`Prediction`] for it.
//!
//! Where the shortest duration within limits is wanted, [`Planner::plan_fastest`] comes closer to
//! the optimum: its moves have a piecewise-linear acceleration and are followed as a path.
//!
//! ```
//! use stillbeam::planner::{Planner, Request};
//! use stillbeam::{Link, Scene};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! let planner = Planner::<f32, 2>::new(&scene, 0.010)?;
//! let plan = planner.plan(&Request::from_rest(0.0, 1.57).duration(0.2))?;
//! assert!(plan.residual < 5e-4);
//! # Ok::<(), stillbeam::Error>(())
//! ```

mod curve;
mod fastest;
mod least_effort;
mod linear;
mod loads;
mod objective;
mod path;
mod prediction;
mod prepared;
mod problem;
mod redirect;
mod request;
mod search;
mod second_mode;
mod shortest;
mod simulate;
mod solve;
mod still_move;
mod stop;

pub use fastest::{FastestMove, ShortestMove};
pub use objective::Objective;
pub(crate) use path::Path;
pub use prediction::Prediction;
pub use request::{Kinematics, Request, Target};
pub use still_move::StillMove;
pub use stop::StopThenMove;

use simulate::{Arm, Resolution};

use crate::Error;
use crate::math::{Scalar, words};
use crate::model::{Rod, RodPoints};
use crate::motion::{Limits, Move};
use crate::scene::{LinkShape, Scene, Uniform};
use crate::stepper::ArmState;

/// Most arms that one move is planned for.
const MAX_ARMS: usize = 3;

/// Position of the outer arms of a robust planner, of its spread: nearly a Chebyshev point.
const OUTER: f64 = 0.8;

/// Angles that the highest and the first mode may turn by in a step of a simulation, rad, in a move
/// of at least [`LONG`] first periods.
const COARSE: [f64; 2] = [2.0, 0.4];

/// In a shorter move the arm bends by most of its length, and the coupling of its modes changes
/// faster than they do. Longer steps left an error of 0.1 % of L.
const FINE: [f64; 2] = [0.5, 0.1];

/// Duration from which on the coarse steps do, in first periods.
const LONG: f64 = 1.4;

/// Plans moves after which an arm is at rest. Set-up runs in f64. A plan runs in the tick's scalar,
/// allocates nothing and ends after a bounded number of simulations.
///
/// A robust planner takes the move for three arms at once, with frequencies at `1 − 0.8 δ`, 1 and
/// `1 + 0.8 δ` of the scene's. The outer two arrive at rest; the scene's own too where that costs
/// less than twice the peak, else it keeps as much vibration as that price leaves, or, where no
/// such move is found, what the outer two leave it.
#[derive(Clone, Debug)]
pub struct Planner<T, const K: usize> {
    points: RodPoints<T, K>,
    coarse: Resolution<T, K>,
    fine: Resolution<T, K>,
    robust: bool,
    scene: Scene<f64, Uniform>,
    tick: f64,
    /// Limits of torque and moment that every move keeps.
    loads: Limits,
}

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Sets a planner up for setpoints every `tick` s, with `K` modes, 1 to 3.
    pub fn new<S: LinkShape>(scene: &Scene<f64, S>, tick: f64) -> Result<Self, Error> {
        Self::build(scene, tick, 0.0)
    }

    /// Sets a planner up for an arm whose natural frequencies are known to `± spread` of
    /// themselves, 0.01 to 0.3.
    pub fn robust<S: LinkShape>(
        scene: &Scene<f64, S>,
        tick: f64,
        spread: f64,
    ) -> Result<Self, Error> {
        let spread = Error::check("robust", spread, 0.01, 0.3, "")?;
        Self::build(scene, tick, spread)
    }

    fn build<S: LinkShape>(scene: &Scene<f64, S>, tick: f64, spread: f64) -> Result<Self, Error> {
        let tick = Error::check("solver.tick", tick, 1e-6, 1.0, "s")?;
        let rod = Rod::new(scene)?;
        let (spread, robust) = (OUTER * spread, spread > 0.0);
        Ok(Self {
            points: RodPoints::new(scene, &rod),
            coarse: Resolution::new(scene, &rod, tick, spread, COARSE)?,
            fine: Resolution::new(scene, &rod, tick, spread, FINE)?,
            robust,
            scene: *rod.scene(),
            tick,
            loads: Limits::default(),
        })
    }

    /// Plans a move.
    ///
    /// With a duration, the second mode is left ringing, and another objective is tried, if a limit
    /// asks for it. Without one, the shortest duration is found to a whole tick; that takes up to
    /// 90 searches. Call [`Self::predict`] for the loads and the residual of what is planned.
    ///
    /// # Errors
    /// A number out of range, a duration below 0.9 first periods, an arm that rings on, or a limit
    /// that is exceeded, each with its value. [`Self::remedy`] explains a limit.
    #[inline]
    pub fn plan(&self, request: &Request<T, K>) -> Result<StillMove, Error> {
        let limits = self.with_own(&request.limits)?;
        if let Some(most) = request.deflection {
            Error::check("request.deflection", most, 1e-3, Prediction::MAX_DEFLECTION, "")?;
        }
        if request.target == Target::Stop {
            Error::check("request.rate", request.rate, 0.0, 0.0, "rad/s")?;
        }
        let request = &Request { limits, ..*request };
        let ticks = match request.duration {
            Some(duration) => Some(Move::Dwell { duration }.ticks(self.tick)?),
            None => None,
        };
        match (request.target, ticks) {
            (Target::Angle(to), Some(ticks)) => {
                self.within(request, &self.path(request, to, ticks)?)
            }
            (Target::Angle(to), None) => self.shortest(request, to),
            (Target::Stop, ticks) => self.stop(request, ticks),
        }
    }

    /// First natural period of the arm `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        self.coarse.arms[0].first_period()
    }

    /// True if a move that is run backwards is a move too.
    fn is_reversible(&self) -> bool {
        self.scene.in_plane_gravity() == 0.0 && self.scene.damping.is_zero()
    }

    /// The arms that a move is planned for.
    fn arms<'a>(&self, resolution: &'a Resolution<T, K>) -> &'a [Arm<T, K>] {
        if self.robust { &resolution.arms } else { &resolution.arms[..1] }
    }

    /// The resolution for a move of `duration` s.
    fn resolution(&self, duration: f64) -> &Resolution<T, K> {
        if duration < LONG * self.first_period() { &self.fine } else { &self.coarse }
    }
}

words! {
    [T: Scalar, const K: usize] Planner<T, K>: points, coarse, fine, robust, scene, tick, loads;
}
