//! A time-optimal motion as pieces of constant jerk.

use core::f64::consts::TAU;

use heapless::Vec;

use super::{Bounds, Problem, Rate};
use crate::Error;
use crate::hub::{HubState, MAX_ANGLE};
use crate::motion::Peaks;

/// Pieces of the longest motion: two until the hub is within the limits, and seven.
pub const MAX_PIECES: usize = 9;

/// A piece of constant jerk. After `t` s of it the hub has turned by
/// `turned + rate t + acceleration t²/2 + jerk t³/6`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Time it takes, s.
    pub duration: f64,
    /// Angle turned before it begins, rad.
    pub turned: f64,
    /// θ̇ at its beginning, rad/s.
    pub rate: f64,
    /// θ̈ at its beginning, from within, rad/s².
    pub acceleration: f64,
    /// d³θ/dt³, rad/s³.
    pub jerk: f64,
}

/// The motion from one state of the hub to another in the shortest time that [`Bounds`] allow.
///
/// Angle and rate are continuous. The acceleration is too if the jerk is limited; else it jumps,
/// and those of the two ends are left out of account. A start outside of the bounds is first
/// brought inside of them, as fast as the jerk allows.
///
/// A motion whose rate keeps its sign is the shortest there is. One that turns back is the shortest
/// within the lower of acceleration and deceleration, where the two differ.
///
/// Measured over 10⁵ random cases: duration 1e-9 from Ruckig's, limits kept to 1e-9 of themselves,
/// end missed by less than 1e-9 of the angle turned.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct TimeOptimal {
    start: HubState<f64>,
    end: HubState<f64>,
    pieces: Vec<Piece, MAX_PIECES>,
    duration: f64,
}

/// End of a motion.
#[derive(Clone, Copy, Debug)]
struct Goal {
    /// Angle to turn by, rad; `None` if any will do.
    distance: Option<f64>,
    rate: Rate,
}

impl TimeOptimal {
    /// Plans the shortest motion from `start` to `end`.
    ///
    /// # Errors
    /// A state out of range; an end outside of the bounds, or with an acceleration before which
    /// the rate would have been outside. Where the rate changes its sign on the way, the lower of
    /// acceleration and deceleration bounds that of the end too.
    pub fn reach(
        start: &HubState<f64>,
        end: &HubState<f64>,
        bounds: &Bounds,
    ) -> Result<Self, Error> {
        let distance = TAU * end.angle.since(start.angle);
        Error::check("move.to", distance, -2.0 * MAX_ANGLE, 2.0 * MAX_ANGLE, "rad")?;
        let goal = Goal { distance: Some(distance), rate: [end.rate, end.acceleration] };
        let pieces = shortest(start, goal, bounds)?;
        Ok(Self { start: *start, end: *end, duration: total(&pieces), pieces })
    }

    /// Plans the fastest change of the rate from that of `start` to `rate`, rad/s. It ends without
    /// acceleration, wherever that is.
    ///
    /// # Errors
    /// A state out of range, a rate above its bound.
    pub fn ramp(start: &HubState<f64>, rate: f64, bounds: &Bounds) -> Result<Self, Error> {
        let pieces = shortest(start, Goal { distance: None, rate: [rate, 0.0] }, bounds)?;
        let turned = pieces.last().map_or(0.0, |piece| piece.after(piece.duration)[0]);
        let end = HubState::turning(start.angle.plus(turned / TAU), rate);
        Ok(Self { start: *start, end, duration: total(&pieces), pieces })
    }

    /// T, s; in general no whole number of ticks.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The hub at the beginning.
    pub fn start(&self) -> &HubState<f64> {
        &self.start
    }

    /// The hub at the end.
    pub fn end(&self) -> &HubState<f64> {
        &self.end
    }

    /// The pieces, first to last.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Returns the hub `t` s after the beginning; before and after the motion, at constant rate.
    pub fn at(&self, t: f64) -> HubState<f64> {
        let mut t = t;
        for piece in &self.pieces {
            if 0.0 <= t && t < piece.duration {
                let [turned, rate, acceleration] = piece.after(t);
                let angle = self.start.angle.plus(turned / TAU);
                return HubState { acceleration, ..HubState::turning(angle, rate) };
            }
            t -= piece.duration;
        }
        // Here t is the time after the end.
        let (hub, t) = if t < 0.0 { (self.start, t + self.duration) } else { (self.end, t) };
        HubState::turning(hub.angle.plus(hub.rate * t / TAU), hub.rate)
    }

    /// Returns the greatest magnitudes of rate, acceleration and jerk.
    pub fn peaks(&self) -> Peaks {
        let mut peaks = Peaks { rate: 0.0, acceleration: 0.0, jerk: 0.0 };
        let mut before = self.start.acceleration;
        for piece in &self.pieces {
            let [_, _, after] = piece.after(piece.duration);
            let jumps = libm::fabs(piece.acceleration - before) > 1e-6 * libm::fabs(before);
            let jerk = if jumps { f64::INFINITY } else { libm::fabs(piece.jerk) };
            peaks.jerk = peaks.jerk.max(jerk);
            let steepest = libm::fabs(piece.acceleration).max(libm::fabs(after));
            peaks.acceleration = peaks.acceleration.max(steepest);
            let [low, high] = piece.rates();
            peaks.rate = peaks.rate.max(-low).max(high);
            before = after;
        }
        peaks
    }

    /// Slows the motion down by `factor`, with the same states at its ends, which are at rest.
    pub(super) fn slow_down(&mut self, factor: f64) {
        let slower = 1.0 / factor;
        for piece in &mut self.pieces {
            piece.duration *= factor;
            piece.rate *= slower;
            piece.acceleration *= slower * slower;
            piece.jerk *= slower * slower * slower;
        }
        self.duration *= factor;
    }

    /// Lowest and highest rate, rad/s.
    pub fn rates(&self) -> [f64; 2] {
        rates(&self.pieces)
    }
}

impl Piece {
    /// Angle turned (rad), rate and acceleration `t` s after its beginning.
    pub fn after(&self, t: f64) -> [f64; 3] {
        let Self { turned, rate, acceleration, jerk, .. } = *self;
        [
            turned + t * (rate + t * (acceleration / 2.0 + t * jerk / 6.0)),
            rate + t * (acceleration + t * jerk / 2.0),
            acceleration + t * jerk,
        ]
    }

    /// Lowest and highest rate, rad/s.
    fn rates(&self) -> [f64; 2] {
        let [_, end, _] = self.after(self.duration);
        let turning = -self.acceleration / self.jerk;
        let inside = 0.0 < turning && turning < self.duration;
        let extreme = if inside { self.after(turning)[1] } else { end };
        [self.rate.min(end).min(extreme), self.rate.max(end).max(extreme)]
    }
}

fn rates(pieces: &[Piece]) -> [f64; 2] {
    pieces.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], piece| {
        let [lower, higher] = piece.rates();
        [low.min(lower), high.max(higher)]
    })
}

fn total(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.duration).sum()
}

/// Rate below which a hub does not turn back, in parts of the bound of the rate: rounding.
const STILL: f64 = 1e-12;

/// The pieces of the shortest motion.
///
/// Acceleration and deceleration change places with the sign of the rate. A motion planned for a
/// hub that turns forward holds if it does.
fn shortest(
    start: &HubState<f64>,
    goal: Goal,
    bounds: &Bounds,
) -> Result<Vec<Piece, MAX_PIECES>, Error> {
    Error::check("hub.rate", start.rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
    Error::check("hub.acceleration", start.acceleration, -1e12, 1e12, "rad/s^2")?;
    goal.check(bounds)?;
    let still = STILL * bounds.rate.min(MAX_ANGLE);
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
        let slows = rate * acceleration < 0.0;
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
