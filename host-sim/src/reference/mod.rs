//! Reference solutions that judge the core. The two solvers share no method with it, nor with each
//! other. Only the scene and the commanded motion are common.
//!
//! | | [`rod`] | [`fem`] |
//! |---|---|---|
//! | link | inextensible, geometrically exact | stretches a little, corotational elements |
//! | unknowns | relative angle, a few polynomials | nodal displacements in the global frame |
//! | in time | Runge-Kutta of order 8 or 5, error-controlled | Newmark with equilibrium iterations |
//! | torque | moment of the inertia forces about the axis | reaction at the clamp carried to the axis |

use std::fmt;

pub(crate) mod advance;
mod carrying;
pub mod fem;
pub(crate) mod integrators;
pub mod mechanism;
mod option;
pub mod rod;
mod schedule;

/// The arm at one time of a reference solution.
///
/// At a jump of the commanded acceleration, `acceleration` and `torque` are the right-hand values.
/// At the end of a move they are the left-hand ones, the values that the move itself commands last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// θ with its whole turns, rad; on a linear axis the position, m.
    pub angle: f64,
    /// θ̇, rad/s, or m/s.
    pub rate: f64,
    /// θ̈, rad/s², or m/s².
    pub acceleration: f64,
    /// The tip in the global frame, origin at the motor axis or where the carriage's position is 0,
    /// m.
    pub tip: [f64; 2],
    /// The payload's centre in the global frame, m: the tip, where the payload has no offset.
    pub payload: [f64; 2],
    /// The tip's Y in the hub frame, m.
    pub deflection: f64,
    /// τ at the hub, J_h θ̈ included, N m; positive drives θ forward. On a linear axis the force
    /// on the carriage, its own mass included, N.
    pub torque: f64,
}

/// Reason why there is no reference solution.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceError {
    /// The scene itself is not accepted.
    Scene(stillbeam::Error),
    /// A time is not finite, not in ascending order or outside the run.
    Time {
        /// The given time, s.
        time: f64,
        /// Length of the run, s.
        duration: f64,
    },
    /// A solver's option is out of range.
    Options {
        /// Field and value.
        given: String,
        /// The accepted values.
        wanted: &'static str,
    },
    /// The arm has no stable equilibrium under gravity at the first angle: the link buckles.
    NoEquilibrium {
        /// The first angle, rad.
        angle: f64,
    },
    /// The loop of a mechanism cannot be closed at its pin.
    OpenLoop {
        /// The pin, m.
        pin: [f64; 2],
    },
    /// The integrator cannot go on.
    Integration {
        /// Time at which it stops, s.
        time: f64,
        /// Its reason.
        reason: String,
    },
}

impl fmt::Display for ReferenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Time { time, duration } => write!(
                f,
                "times: {time} s; must be ascending times from 0 to {duration} s, the run's \
                 length"
            ),
            Self::Options { given, wanted } => write!(f, "{given}: must be {wanted}"),
            Self::NoEquilibrium { angle } => write!(
                f,
                "move.from = {angle} rad: the link has no stable equilibrium under gravity there; \
                 use less gravity, a stiffer link or a lighter payload"
            ),
            Self::OpenLoop { pin: [x, y] } => write!(
                f,
                "closure.pin = [{x}, {y}]: the chain cannot close there with its driven joints at \
                 their first angles; must be within reach of the last passive joints"
            ),
            Self::Integration { time, reason } => {
                write!(f, "the reference solver stopped at t = {time} s: {reason}")
            }
        }
    }
}

impl std::error::Error for ReferenceError {}

impl From<stillbeam::Error> for ReferenceError {
    fn from(error: stillbeam::Error) -> Self {
        Self::Scene(error)
    }
}
