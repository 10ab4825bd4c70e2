//! Moves of all joints of an open chain after which its links do not vibrate.
//!
//! Each joint turns by a quintic that bulges by `(1 − u²)³ (b₀ + b₁u + b₂u²)`. The bulges leave the
//! first modes, one a link that bends, at rest at the final pose, place and rate, with the least
//! `∫Σ(J_j b̈_j)² dt`, `J_j` the inertia that joint j turns. What a bulge does is found by flights,
//! runs of the chain itself; the derivative is renewed where progress stalls.

mod flight;
mod linear;
mod search;

use super::Chain;
use crate::Error;
use crate::math::Scalar;
use crate::mechanism::{Mechanism, of_joint};
use crate::motion::{Limits, Move};
use search::Search;

/// Coefficients of a joint's bulge.
const TERMS: usize = 3;
/// Flights are made in steps of a tick over this.
const FINER: u32 = 4;
/// Durations, over that which is asked for, through which a search goes that fails at once. The
/// bulges of each are where the next one begins.
const DETOUR: [f64; 5] = [1.4, 1.25, 1.12, 1.05, 1.0];

/// A planned move of all joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPlan<const LINKS: usize> {
    /// The move of each joint; they take equally long.
    pub moves: [Move; LINKS],
    /// Largest deviation of a joint or the tip from its final place in the first period after the
    /// end, over the sum of the lengths.
    pub residual: f64,
    /// Largest torque of each joint's motor on the way, N m.
    pub torque: [f64; LINKS],
    /// Flights that the search took.
    pub flights: u32,
}

/// Plans moves of an open chain between two poses at rest.
#[derive(Clone, Copy, Debug)]
pub struct ChainPlanner<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize> {
    /// The chain in the steps of flights.
    chain: Chain<T, LINKS, W, C, Q>,
    tick: f64,
    limits: [Limits; LINKS],
}

/// Bulges of all joints.
type Bulges<const LINKS: usize> = [[f64; TERMS]; LINKS];
/// Residual of each mode: tip deflection by its place and by its rate over its frequency, m.
type Left<const LINKS: usize> = [[f64; 2]; LINKS];

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    ChainPlanner<T, LINKS, W, C, Q>
{
    /// For setpoints every `tick` s. Computes in `T` where it flies, in f64 elsewhere.
    ///
    /// # Errors
    /// Those of [`Chain::new`]; a passive joint or a loop, which nothing brings to rest.
    pub fn new(mechanism: &Mechanism, tick: f64) -> Result<Self, Error> {
        let chain = Chain::new(mechanism, tick / f64::from(FINER))?;
        for j in 0..LINKS {
            if !chain.is_driven(j, false) || mechanism.closure.is_some() {
                return Err(Error::PassiveJoint { parameter: "joints", joint: j + 1 });
            }
        }
        Ok(Self { chain, tick, limits: [Limits::default(); LINKS] })
    }

    /// With limits for each joint, of its motion and of its motor's torque.
    ///
    /// # Errors
    /// A limit that is no number, or one of a clamp's moment, which a chain does not tell.
    pub fn with_limits(self, limits: [Limits; LINKS]) -> Result<Self, Error> {
        for (j, limits) in limits.iter().enumerate() {
            let limits = limits.validate().map_err(|error| of_joint(error, j))?;
            if let Some(value) = limits.moment {
                let (parameter, unit) = ("limits.moment", "N m");
                return Err(of_joint(Error::CannotCheck { parameter, value, unit }, j));
            }
        }
        Ok(Self { limits, ..self })
    }

    /// First period at the pose `angles`, rad; s. Moves from 1.5 of them on arrive still.
    ///
    /// # Errors
    /// Those of [`Chain::modes`].
    pub fn period(&self, angles: &[f64; LINKS]) -> Result<f64, Error> {
        self.chain.modes(angles).map(|modes| modes.period())
    }

    /// Plans the move of all joints from rest at `from` to rest at `to`, rad, in `duration` s.
    /// Takes 20 to 90 flights of the move's length, up to five times as many where the first search
    /// fails; to be run where nothing is urgent.
    ///
    /// # Errors
    /// [`Error::TooShort`] below 0.9 first periods, [`Error::NotStill`] if no bulge is found that
    /// leaves less than 0.04 % of the length, a limit of a joint, those of [`Chain::at_rest`].
    pub fn plan(
        &self,
        from: &[f64; LINKS],
        to: &[f64; LINKS],
        duration: f64,
    ) -> Result<ChainPlan<LINKS>, Error> {
        let modes = self.chain.modes(to)?;
        let duration = self.whole(duration)?;
        let shortest = 0.9 * modes.period();
        if duration < shortest {
            return Err(Error::TooShort { duration, shortest });
        }
        let mut search = Search {
            planner: self,
            begin: self.chain.at_rest(from)?,
            end: self.chain.at_rest(to)?,
            modes,
            to: *to,
            duration,
            flights: 0,
            most: 0,
        };
        let none = [[0.0; TERMS]; LINKS];
        let first = search.run(&none, duration).and_then(|bulges| search.finish(from, &bulges));
        if !matches!(first, Err(Error::NotStill { .. } | Error::BendsTooFar { .. })) {
            return first;
        }
        let mut bulges = none;
        for stretch in DETOUR {
            bulges = search.run(&bulges, self.whole(stretch * duration)?)?;
        }
        search.finish(from, &bulges)
    }

    /// The duration in whole ticks, s.
    fn whole(&self, duration: f64) -> Result<f64, Error> {
        Ok(f64::from(Move::Dwell { duration }.ticks(self.tick)?) * self.tick)
    }
}
