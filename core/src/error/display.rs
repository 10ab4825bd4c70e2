//! Errors as one line: the field, its value, what it must be, what would do.
//!
//! One function a kind of fault: of a value, of a move's motion, of a still move, of a request.

use core::fmt::{Display, Formatter, Result};

use super::Error;

impl Display for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::OutOfRange { .. }
            | Self::CannotCheck { .. }
            | Self::Tolerance { .. }
            | Self::Buckles { .. }
            | Self::DegreesOfFreedom { .. }
            | Self::NotPrepared { .. } => value(self, f),
            Self::PassiveJoint { .. }
            | Self::OpenLoop { .. }
            | Self::LeavesPin { .. }
            | Self::StraightLoop { .. }
            | Self::TickTooLong { .. } => mechanism(self, f),
            Self::LimitExceeded { .. }
            | Self::TooFast { .. }
            | Self::BendsTooFar { .. }
            | Self::NotAtRest { .. }
            | Self::Elsewhere { .. } => motion(self, f),
            Self::TooShort { .. } | Self::NotStill { .. } | Self::DeflectsTooFar { .. } => {
                still_move(self, f)
            }
            Self::QueueFull { .. }
            | Self::WrongMode { .. }
            | Self::Moving
            | Self::Stale
            | Self::Starved
            | Self::NoMove => request(self, f),
        }
    }
}

/// A number in the fewest digits that tell it from its neighbours: those of single precision, where
/// single precision holds it. 32.767 of a frame's format is not 32.766998291015625.
struct Shortest(f64);

impl Display for Shortest {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let single = self.0 as f32;
        if f64::from(single) == self.0 { single.fmt(f) } else { self.0.fmt(f) }
    }
}

/// A value of a scene, a limit, a tolerance or a type is not accepted.
fn value(error: &Error, f: &mut Formatter<'_>) -> Result {
    match *error {
        Error::OutOfRange { parameter, value, min, max, unit } => {
            write!(f, "{parameter} = {}: must be {}", Shortest(value), Shortest(min))?;
            if min != max {
                write!(f, " to {}", Shortest(max))?;
            }
            if unit.is_empty() { Ok(()) } else { write!(f, " {unit}") }
        }
        Error::CannotCheck { parameter, value, unit } => write!(
            f,
            "{parameter} = {value} {unit}: must be absent here, where the arm's peaks between \
             ticks are not known; give it to the planner of still moves or to the desktop's run"
        ),
        Error::Tolerance { parameter, tolerance, best } if !best.is_finite() => write!(
            f,
            "{parameter} = {tolerance}: no method follows this move at this tick; use a \
             longer move or a shorter tick"
        ),
        Error::Tolerance { parameter, tolerance, best } => write!(
            f,
            "{parameter} = {tolerance}: must be at least {best:.6} for this move at \
             this tick; a longer move or a shorter tick takes less"
        ),
        Error::Buckles { gravity } => write!(
            f,
            "gravity.acceleration = {gravity}: must be less, as the upright link buckles under its \
             own weight; use less gravity, a stiffer link or a lighter payload"
        ),
        Error::DegreesOfFreedom { given, needed } => write!(
            f,
            "elements: the model type has {given} degrees of freedom, must be {needed} for \
             this scene"
        ),
        Error::NotPrepared { parameter, found, needed } => write!(
            f,
            "{parameter} = {found:#010x}: must be {needed:#010x} in an arm prepared for this \
             program; export it anew"
        ),
        _ => Ok(()),
    }
}

/// A chain of links is not accepted.
fn mechanism(error: &Error, f: &mut Formatter<'_>) -> Result {
    match *error {
        Error::PassiveJoint { parameter, joint } => write!(
            f,
            "{parameter} = {joint}: must be a driven joint, this one is passive or released \
             already; name another or give it a motor"
        ),
        Error::OpenLoop { gap } => write!(
            f,
            "closure.pin: the end of the chain stays {gap:.6} m from it, must reach it with the \
             links straight; move the pin or let the passive joints begin at other angles"
        ),
        Error::LeavesPin { gap, time } => write!(
            f,
            "closure: {time:.3} s from now the end of the chain would be {gap:.6} m off its pin, \
             must stay on it; the moves take the loop beyond its reach, use smaller ones"
        ),
        Error::StraightLoop { time } => write!(
            f,
            "closure: {time:.3} s from now the links lie in one line between joint 1 and the pin, \
             must be bent, as the pin could hold any force there; close at another place or use \
             smaller moves"
        ),
        Error::TickTooLong { tick, apart, time } => write!(
            f,
            "solver.tick = {tick}: {time:.3} s from now it would take the links {:.1} % of their \
             length away from where half of it takes them, must be at most 2 %; use a shorter \
             tick, longer moves or stiffer links",
            100.0 * apart
        ),
        _ => Ok(()),
    }
}

/// The hub's motion is more than a limit or a method takes, or does not begin where it must.
fn motion(error: &Error, f: &mut Formatter<'_>) -> Result {
    match *error {
        Error::LimitExceeded { parameter, limit, needed, unit } => write!(
            f,
            "{parameter}: the move needs {needed:.6} {unit}, must be at most {limit} {unit}; use a \
             longer move or raise the limit"
        ),
        Error::TooFast { rate, max } => write!(
            f,
            "move.duration: the move peaks at {rate:.6} rad/s, must be at most {max:.6} rad/s for \
             this arm, method and tick (never more than one radian a tick); use a longer move"
        ),
        Error::BendsTooFar { bend, max } => write!(
            f,
            "move.duration: the tip is expected to turn {bend:.3} rad against the hub, must \
             be at most {max:.3} rad; use a longer move, a stiffer link or a stepper set up for more"
        ),
        Error::NotAtRest { rate } => write!(
            f,
            "move.profile: the hub turns at {rate} rad/s when this rest-to-rest move begins, \
             must be at rest; put a spin-up to rate = 0 before it"
        ),
        Error::Elsewhere { hub, begins } => write!(
            f,
            "move.from = {begins} rad: the hub is at {hub} rad at that tick, or turns \
             otherwise; plan the move from there"
        ),
        _ => Ok(()),
    }
}

/// No move that arrives still was found.
fn still_move(error: &Error, f: &mut Formatter<'_>) -> Result {
    match *error {
        Error::TooShort { duration, shortest } => write!(
            f,
            "move.duration = {duration}: too short for the arm to arrive at rest; must be \
             at least {shortest:.6} s, 0.9 first periods"
        ),
        Error::NotStill { duration, residual } if !residual.is_finite() => write!(
            f,
            "move.duration = {duration}: the arm would be bent out of all shape on its way; \
             use a longer move, or a smaller angle in rad"
        ),
        Error::NotStill { duration, residual } => write!(
            f,
            "move.duration = {duration}: the arm would ring with {:.3} % of its length; use \
             another duration",
            100.0 * residual
        ),
        Error::DeflectsTooFar { deflection, most } => write!(
            f,
            "move.duration: the tip would deflect by {deflection:.6} m, must be at most \
             {most:.6} m; use a longer move or a stiffer link"
        ),
        _ => Ok(()),
    }
}

/// A queue or an axis does not take the request now.
fn request(error: &Error, f: &mut Formatter<'_>) -> Result {
    match *error {
        Error::QueueFull { needed, free } => write!(
            f,
            "moves: this one takes {needed} segments of the queue, must be at most {free} now; wait for \
             a move to end"
        ),
        Error::WrongMode { mode } => write!(f, "mode = {mode:?}: {}", mode.way_out()),
        Error::Moving => write!(
            f,
            "hub = turning: must be at rest with no move waiting; wait for the moves to end or stop \
             the axis"
        ),
        Error::Stale => write!(
            f,
            "move = planned before the hub's motion changed: plan it again from a new context"
        ),
        Error::Starved => write!(
            f,
            "waypoint.time = past: the row came after the hub had begun to stop at the one before; \
             offer rows earlier, or begin a new path at rest"
        ),
        Error::NoMove => write!(
            f,
            "duration = given while no move is under way: take a move first, or give a target"
        ),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use core::fmt::Write;

    use super::Error;
    use crate::error::Mode;

    /// One error of every kind. The match is there to fail to compile when a kind is added.
    fn every_kind() -> [Error; 25] {
        let (parameter, unit) = ("link.length", "m");
        let all = [
            Error::OutOfRange { parameter, value: -1.0, min: 1e-3, max: 1e3, unit },
            Error::LimitExceeded {
                parameter: "limits.rate",
                limit: 4.0,
                needed: 7.5,
                unit: "rad/s",
            },
            Error::CannotCheck { parameter: "limits.torque", value: 2.0, unit: "N m" },
            Error::TooFast { rate: 200.0, max: 100.0 },
            Error::NotAtRest { rate: 3.0 },
            Error::BendsTooFar { bend: 2.5, max: 2.0 },
            Error::Tolerance { parameter: "solver.tolerance", tolerance: 1e-6, best: 1e-4 },
            Error::QueueFull { needed: 7, free: 1 },
            Error::TooShort { duration: 0.1, shortest: 0.24 },
            Error::NotStill { duration: 0.3, residual: 0.02 },
            Error::DeflectsTooFar { deflection: 0.4, most: 0.28 },
            Error::Elsewhere { hub: 0.1, begins: 0.0 },
            Error::Buckles { gravity: 100.0 },
            Error::DegreesOfFreedom { given: 2, needed: 4 },
            Error::PassiveJoint { parameter: "moves.joint", joint: 2 },
            Error::OpenLoop { gap: 0.12 },
            Error::LeavesPin { gap: 0.12, time: 0.7 },
            Error::StraightLoop { time: 0.7 },
            Error::TickTooLong { tick: 0.01, apart: 0.2, time: 0.7 },
            Error::WrongMode { mode: Mode::Stopped },
            Error::Moving,
            Error::Stale,
            Error::Starved,
            Error::NoMove,
            Error::NotPrepared { parameter: "arm.format", found: 2, needed: 1 },
        ];
        for error in &all {
            match error {
                Error::OutOfRange { .. }
                | Error::LimitExceeded { .. }
                | Error::CannotCheck { .. } => {}
                Error::TooFast { .. } | Error::NotAtRest { .. } | Error::BendsTooFar { .. } => {}
                Error::Tolerance { .. } | Error::QueueFull { .. } | Error::TooShort { .. } => {}
                Error::NotStill { .. } | Error::DeflectsTooFar { .. } => {}
                Error::Elsewhere { .. } | Error::Buckles { .. } => {}
                Error::DegreesOfFreedom { .. } | Error::WrongMode { .. } => {}
                Error::PassiveJoint { .. } | Error::OpenLoop { .. } => {}
                Error::LeavesPin { .. } | Error::StraightLoop { .. } => {}
                Error::TickTooLong { .. } => {}
                Error::Moving | Error::Stale | Error::Starved | Error::NoMove => {}
                Error::NotPrepared { .. } => {}
            }
        }
        all
    }

    #[test]
    fn every_kind_is_one_line_that_begins_with_a_field() {
        for error in every_kind() {
            let mut text = heapless::String::<256>::new();
            write!(text, "{error}").unwrap();
            let (field, rest) = text.split_once(": ").unwrap_or_default();
            let name = field.split(" = ").next().unwrap_or_default();
            let plain = |c: char| c.is_ascii_lowercase() || "._".contains(c);
            assert!(!name.is_empty() && name.chars().all(plain), "{error:?}: {text}");
            assert!(rest.len() > 15 && !rest.contains('\n'), "{error:?}: {text}");
        }
    }
}
