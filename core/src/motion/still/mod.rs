//! Moves after which the arm is at rest.
//!
//! The hub follows a quintic with a bulge, `θ = quintic + (1 − u²)³ Σ bₖuᵏ`. Where the linear first
//! mode is to end with given amplitudes, the bulge that does it with the least peak of acceleration
//! is a matter of a small linear system ([`effort`]). An arm that bends far does not arrive there: it is flown
//! through the move in its exact kinematics ([`flight`]), what it misses is aimed off by, and a few
//! such rounds leave nothing ([`aiming`]).

mod aiming;
mod effort;
mod flight;
mod path;

pub use path::Departure;
pub(crate) use path::{Path, peaks};

use core::f64::consts::TAU;

use effort::{Linear, MAX_AIMS};
use flight::Arm;

use super::{Move, Peaks};
use crate::Error;
use crate::beam::Rod;
use crate::math::{Scalar, cast, sqrt};
use crate::motion::{Angle, BULGE};
use crate::scene::Scene;
use crate::stepper::ElasticaState;

/// Most arms that one move is planned for.
const MAX_ARMS: usize = 3;

/// Plans moves after which an arm is at rest. Set-up takes its time; a plan runs in the tick's
/// scalar and allocates nothing.
///
/// A robust planner takes the move for three arms at once, with frequencies at `1 − 0.87 δ`, 1 and
/// `1 + 0.87 δ` of the scene's: all of them arrive at rest, and what lies between nearly so.
#[derive(Clone, Debug)]
pub struct Still<T, const K: usize> {
    arms: [Arm<T, K>; MAX_ARMS],
    /// How many of them count.
    count: usize,
    scene: Scene,
    tick: f64,
}

/// A still move and what is expected of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillMove {
    /// To be pushed.
    pub motion: Move,
    /// Greatest magnitudes of the motion.
    pub peaks: Peaks,
    /// Residual vibration by the planner's model: amplitude of the tip's angle, rad, the greatest of the arms.
    pub residual: f64,
    /// Flights through the move it took.
    pub evaluations: u32,
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// For setpoints every `tick` s and tip angles up to `bend` rad against the hub; f64 inside.
    pub fn new(scene: &Scene, tick: f64, bend: f64) -> Result<Self, Error> {
        Self::build(scene, tick, bend, 0.0)
    }

    /// For an arm whose frequencies are known to `± spread` of themselves, 0.01 to 0.3.
    pub fn robust(scene: &Scene, tick: f64, bend: f64, spread: f64) -> Result<Self, Error> {
        let spread = Error::check("robust", spread, 0.01, 0.3, "")?;
        Self::build(scene, tick, bend, spread)
    }

    fn build(scene: &Scene, tick: f64, bend: f64, spread: f64) -> Result<Self, Error> {
        let arm = |factor: f64| {
            let mut scene = *scene;
            scene.link.bending_stiffness *= factor * factor;
            Arm::new(&Rod::new(&scene)?, tick, bend)
        };
        let nominal = arm(1.0)?;
        let (arms, count) = if spread == 0.0 {
            ([nominal, nominal, nominal], 1)
        } else {
            let aside = OUTER * spread;
            ([nominal, arm(1.0 - aside)?, arm(1.0 + aside)?], 3)
        };
        Ok(Self { arms, count, scene: *scene, tick })
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        self.arms[0].first_period()
    }

    /// From rest at `from` rad to rest at `to` rad in `duration` s.
    pub fn plan(&self, from: f64, to: f64, duration: f64) -> Result<StillMove, Error> {
        let from = Departure::at_rest(Angle::from_radians(from));
        self.plan_from(from, None, to, duration)
    }

    fn plan_from(
        &self,
        from: Departure,
        state: Option<&ElasticaState<T, K>>,
        to: f64,
        duration: f64,
    ) -> Result<StillMove, Error> {
        let ticks = Move::Dwell { duration }.ticks(self.tick)?;
        let path = Path { from, to, ticks, tick: self.tick };
        let duration = path.duration();
        let shortest = SHORTEST * self.first_period();
        if duration < shortest {
            return Err(Error::TooShort { duration, shortest });
        }
        let c: [T; 5] = cast(&path.quintic());
        let arms = &self.arms[..self.count];
        // Odd about the middle and reversible in time: at rest at the end if straight in the middle.
        let resting = from.rate == 0.0 && from.acceleration == 0.0 && state.is_none();
        let half = resting && ticks % 2 == 0 && self.is_reversible();
        let mut linear = Linear::new();
        for arm in arms {
            let begin = [T::ZERO; 2];
            linear.add(&arm.oscillation, &c, begin, duration, half);
        }
        let effort = linear.least_effort(&c);
        let segment = path.segment(&[0.0; BULGE]).cast::<T>();
        let each = if half { 1 } else { 2 };
        let found = aiming::find(
            linear.aims,
            T::from_f64(ENOUGH * ENOUGH),
            MOST,
            |aim| {
                let curve = segment.bulged(&effort.bulge(aim));
                let mut miss = [T::ZERO; MAX_AIMS];
                for (n, arm) in arms.iter().enumerate() {
                    let left = if half {
                        [arm.in_the_middle(&curve, ticks), T::ZERO]
                    } else {
                        arm.at_the_end(&curve, ticks, state)
                    };
                    for i in 0..each {
                        miss[each * n + i] = left[i];
                    }
                }
                miss
            },
        );
        let d = effort.bulge(&found.aim);
        let motion = Move::Still { duration, to, bulge: d.map(|x| TAU * x.to_f64()) };
        Ok(StillMove {
            motion,
            peaks: peaks(&c, &d, duration),
            residual: sqrt(found.miss.to_f64()) * if half { 2.0 } else { 1.0 },
            evaluations: found.evaluations,
        })
    }

    /// Whether a move run backwards is a move.
    fn is_reversible(&self) -> bool {
        let damping = self.scene.damping;
        self.scene.gravity == 0.0 && damping.alpha == 0.0 && damping.beta == 0.0
    }
}

/// Shortest move in first periods: below it the search converges to nothing real.
const SHORTEST: f64 = 0.9;

/// Where the outer arms of a robust planner lie, of its spread: nearly a Chebyshev point.
const OUTER: f64 = 0.87;

/// Residual that needs no further search, rad of the tip's angle.
const ENOUGH: f64 = 1e-5;

/// Most flights of all arms in a search.
const MOST: u32 = 12;
