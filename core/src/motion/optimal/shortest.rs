//! The pieces of the shortest motion, made from the phases of a [`Problem`].

use heapless::Vec;

use super::trajectory::{MAX_PIECES, Piece, rates};
use super::{Bounds, Problem, Rate};
use crate::Error;
use crate::hub::{HubState, MAX_ANGLE};

/// End of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    /// Angle to turn by, rad; `None` if any will do.
    pub distance: Option<f64>,
    pub rate: Rate,
}

/// Rate below which a hub does not turn back, in parts of the bound of the rate: rounding.
pub(super) const STILL: f64 = 1e-12;

/// The pieces of the shortest motion.
///
/// Acceleration and deceleration change places with the sign of the rate. A motion planned for a
/// hub that turns forward holds if it does.
pub(super) fn shortest(
    start: &HubState<f64>,
    goal: Goal,
    bounds: &Bounds,
) -> Result<Vec<Piece, MAX_PIECES>, Error> {
    Error::check("hub.rate", start.rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
    Error::check("hub.acceleration", start.acceleration, -1e12, 1e12, "rad/s^2")?;
    bounds.check()?;
    goal.check(bounds)?;
    let still = STILL * bounds.rate;
    let forward = planned(start, goal, bounds, 1.0);
    if bounds.acceleration == bounds.deceleration || rates(&forward)[0] >= -still {
        return Ok(forward);
    }
    let backward = planned(start, goal, bounds, -1.0);
    if rates(&backward)[1] <= still {
        return Ok(backward);
    }
    let least = bounds.acceleration.min(bounds.deceleration);
    let both = Bounds { acceleration: least, deceleration: least, ..*bounds };
    goal.check(&both)?;
    Ok(planned(start, goal, &both, 1.0))
}

/// The pieces of the shortest motion of a hub that turns in the direction of `sign`.
fn planned(
    start: &HubState<f64>,
    goal: Goal,
    bounds: &Bounds,
    sign: f64,
) -> Vec<Piece, MAX_PIECES> {
    let signed = |rate: Rate| rate.map(|x| sign * x);
    let from = [start.rate, start.acceleration];
    let mut problem = Problem::forward(signed(from), signed(goal.rate), bounds);
    let mut pieces = Pieces { pieces: Vec::new(), turned: 0.0, rate: problem.from[0], sign };
    let mut acceleration = problem.from[1];
    for [duration, jerk] in problem.brake() {
        if bounds.jerk.is_infinite() {
            acceleration = if pieces.rate > 0.0 { -problem.lower } else { problem.upper };
        }
        pieces.push([duration, acceleration, jerk]);
        acceleration += jerk * duration;
    }
    let jumps = bounds.jerk.is_infinite();
    problem.from = [pieces.rate, if jumps { 0.0 } else { acceleration }];
    let phases = match goal.distance {
        Some(distance) => problem.solve(sign * distance - pieces.turned),
        None => problem.ramp().phases,
    };
    for piece in phases.pieces(problem.from[1], problem.jerk) {
        pieces.push(piece);
    }
    pieces.pieces
}

/// Pieces under construction.
struct Pieces {
    pieces: Vec<Piece, MAX_PIECES>,
    /// Angle turned and rate so far, in the direction of `sign`.
    turned: f64,
    rate: f64,
    sign: f64,
}

impl Pieces {
    /// Adds a piece by its duration, first acceleration and jerk, if it takes any time.
    fn push(&mut self, [duration, acceleration, jerk]: [f64; 3]) {
        if duration <= 0.0 {
            return;
        }
        let piece = Piece { duration, turned: self.turned, rate: self.rate, acceleration, jerk };
        [self.turned, self.rate, _] = piece.after(duration);
        let signed = |x: f64| self.sign * x;
        // There are no more than nine.
        let _ = self.pieces.push(Piece {
            duration,
            turned: signed(piece.turned),
            rate: signed(piece.rate),
            acceleration: signed(acceleration),
            jerk: signed(jerk),
        });
    }
}

impl Goal {
    /// Refuses an end outside of the bounds. Just before one with acceleration a the rate was
    /// further against a, by at least `a²/2j`.
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let [rate, acceleration] = self.rate;
        Error::check("move.rate", rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
        Error::check("move.acceleration", acceleration, -1e12, 1e12, "rad/s^2")?;
        let jerk = bounds.jerk;
        let acceleration = if jerk.is_infinite() { 0.0 } else { acceleration };
        let needed = libm::fabs(rate - 0.5 * acceleration * libm::fabs(acceleration) / jerk);
        // At rate zero it has slowed down until then.
        let slows = rate * acceleration <= 0.0;
        let (parameter, limit) = if slows {
            ("limits.deceleration", bounds.deceleration)
        } else {
            ("limits.acceleration", bounds.acceleration)
        };
        for (parameter, limit, needed, unit) in [
            ("limits.rate", bounds.rate, libm::fabs(rate).max(needed), "rad/s"),
            (parameter, limit, libm::fabs(acceleration), "rad/s^2"),
        ] {
            if needed > limit * (1.0 + 1e-9) {
                return Err(Error::LimitExceeded { parameter, limit, needed, unit });
            }
        }
        Ok(())
    }
}
