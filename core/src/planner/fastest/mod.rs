//! The fastest moves that arrive still: limits bind, and the acceleration is piecewise linear.
//!
//! A small quadratic program finds the knots that turn the hub farthest in a given time, within
//! the limits and with the modes of the linear arm at rest. The exact arm is simulated along them,
//! and Broyden's method changes duration and targets until it arrives at rest too.
//!
//! Hub and arm begin and end at rest, and the arm looks the same backwards in time: no damping, no
//! gravity. Then half of the move is all of it. Every other request is the planner's own.

mod case;
mod fastest_move;
mod finish;
mod flight;
mod grid;
mod half;
mod point;
mod program;
mod response;
mod rigid;
mod rows;
mod search;
mod window;

pub use fastest_move::FastestMove;

use case::{Case, Least};
use finish::Finish;
use search::Search;
use window::Windows;

use super::{Kinematics, Objective, Planner, Request, StillMove, Target};
use crate::Error;
use crate::math::Scalar;
use crate::motion::{Limits, Move, Peaks, Waypoint};
use crate::planner::OUTER;

/// The shorter of two kinds of moves after which the arm is at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShortestMove<const N: usize> {
    /// Piecewise-linear acceleration: [`Generator::feed`](crate::Generator::feed) takes its
    /// waypoints.
    Fastest(FastestMove<N>),
    /// A quintic with a bulge, where the fastest is not to be had.
    Still(StillMove),
}

impl<const N: usize> ShortestMove<N> {
    /// Duration T, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        match self {
            Self::Fastest(fastest) => fastest.duration(),
            Self::Still(still) => still.duration(),
        }
    }

    /// Duration in whole ticks.
    #[must_use]
    pub fn ticks(&self) -> u32 {
        match self {
            Self::Fastest(fastest) => fastest.ticks,
            Self::Still(still) => still.ticks,
        }
    }

    /// Greatest magnitudes of the hub's motion.
    #[must_use]
    pub fn peaks(&self) -> Peaks {
        match self {
            Self::Fastest(fastest) => fastest.peaks,
            Self::Still(still) => still.peaks,
        }
    }

    /// Number of simulations that the search took: of half of the move for the fastest, of the move
    /// or its half for a still one.
    #[must_use]
    pub fn simulations(&self) -> u32 {
        match self {
            Self::Fastest(fastest) => fastest.simulations,
            Self::Still(still) => still.simulations,
        }
    }

    /// Returns the rows of the fastest move; none of a still move, which is a move of the queue.
    pub fn waypoints(&self) -> impl Iterator<Item = Waypoint> + '_ {
        let fastest = match self {
            Self::Fastest(fastest) => Some(fastest),
            Self::Still(_) => None,
        };
        fastest.into_iter().flat_map(FastestMove::waypoints)
    }
}

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Plans the fastest move within the request's limits, to a whole tick: with `N` knots of the
    /// acceleration, 12 on a target, 24 on a desktop.
    ///
    /// [`Self::plan`] answers where that is not to be had: from another state than rest, with
    /// damping, gravity or a limit of the clamp moment, with a duration, for several arms without a
    /// residual that they may keep, or where the search does not converge.
    ///
    /// # Errors
    /// Those of [`Self::plan`].
    pub fn plan_fastest<const N: usize>(
        &self,
        request: &Request<T, K>,
    ) -> Result<ShortestMove<N>, Error> {
        match self.fastest(request)? {
            Some(fastest) => Ok(ShortestMove::Fastest(fastest)),
            None => self.plan(request).map(ShortestMove::Still),
        }
    }

    /// Plans the fastest move with a piecewise-linear acceleration; `None` where the request is
    /// not of its kind or the search does not converge.
    ///
    /// # Errors
    /// A number out of range.
    pub fn fastest<const N: usize>(
        &self,
        request: &Request<T, K>,
    ) -> Result<Option<FastestMove<N>>, Error> {
        if request.duration.is_some() {
            return Ok(None);
        }
        let found = self.piecewise(request, None)?;
        if request.residual == 0.0 || self.robust {
            return Ok(found);
        }
        // What may be left need not be: nothing is gained by it in some moves.
        let still: Option<FastestMove<N>> = self.piecewise(&request.residual(0.0), None)?;
        let most = request.residual * self.scene.link.length;
        let still = still.filter(|still| still.prediction.residual <= most);
        Ok(match (found, still) {
            (Some(found), Some(still)) if still.ticks <= found.ticks => Some(still),
            (found, still) => found.or(still),
        })
    }

    /// Plans a move of the request's duration with a piecewise-linear acceleration, both modes
    /// brought to rest: of all such moves within the limits, the one with the least peak of the
    /// acceleration, or with [`Objective::Effort`] the least integral of the squared torque.
    ///
    /// `None` where [`Self::plan_fastest`] would turn to [`Self::plan`], without a duration or in
    /// one below 0.9 first periods, with another objective, or where no move keeps the limits.
    ///
    /// # Errors
    /// A number out of range.
    pub fn gentlest<const N: usize>(
        &self,
        request: &Request<T, K>,
    ) -> Result<Option<FastestMove<N>>, Error> {
        let least = match request.objective {
            Objective::Acceleration => Least::Acceleration,
            Objective::Effort => Least::Effort,
            _ => return Ok(None),
        };
        let Some(duration) = request.duration else { return Ok(None) };
        let ticks = Move::Dwell { duration }.ticks(self.tick)?;
        let duration = f64::from(ticks) * self.tick;
        if duration < search::SHORTEST * self.first_period() {
            return Ok(None);
        }
        self.piecewise(request, Some((duration, least)))
    }

    fn piecewise<const N: usize>(
        &self,
        request: &Request<T, K>,
        lasting: Option<(f64, Least)>,
    ) -> Result<Option<FastestMove<N>>, Error> {
        let limits = self.with_own(&request.limits)?;
        let Target::Angle(to) = request.target else { return Ok(None) };
        let to = Error::check("move.to", to, -1e6, 1e6, "rad")?;
        let residual = Error::check("request.residual", request.residual, 0.0, 0.2, "")?;
        let from = request.from.angle.radians();
        let angle = to - from;
        let own = request.begins_at_rest()
            && request.rate == 0.0
            && request.kinematics == Kinematics::Exact
            && self.is_reversible()
            && (!self.robust || residual > 0.0)
            && limits.moment.is_none()
            && angle != 0.0;
        if !own {
            return Ok(None);
        }
        let limits = slower(&limits);
        let length = self.scene.link.length;
        let arm = &self.fine.arms[0];
        let measures = [angle.abs(), length];
        // Whatever bounds the given duration is not asked for by its limits.
        let bounded = match lasting {
            Some(_) => Limits { acceleration: limits.acceleration.or(Some(1.0)), ..limits },
            None => limits,
        };
        let Some(mut case) = Case::new(arm, &self.points, measures, &bounded) else {
            return Ok(None);
        };
        if let Some((duration, least)) = lasting {
            case.limits = limits;
            case = case.lasting(duration, least);
        }
        case.smooth |= request.eased;
        if residual > 0.0 {
            case.windows = Some(Windows::new(residual, self.spread()));
        }
        if !case.has_room::<N>() {
            return Ok(None);
        }
        let finish = Finish { limits, tick: self.tick };
        let Some(fastest) = finish.run(case, [from, to]) else { return Ok(None) };
        let most = request.deflection.unwrap_or(f64::INFINITY) * length;
        Ok((fastest.prediction.deflection <= most).then_some(fastest))
    }

    /// Fraction to which the frequencies are known; 0 for the scene's own.
    fn spread(&self) -> f64 {
        if !self.robust {
            return 0.0;
        }
        let [own, outer] = [0, 2].map(|n| self.fine.arms[n].first_period());
        (own / outer - 1.0) / OUTER
    }
}

/// The limits of a hub that speeds up and slows down alike.
fn slower(limits: &Limits) -> Limits {
    let acceleration = match (limits.acceleration, limits.deceleration) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    };
    Limits { acceleration, deceleration: None, ..*limits }
}
