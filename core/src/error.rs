//! What can be wrong with a scene or a move: kinds of fault, each naming its parameter.

use core::fmt;

use crate::math::Scalar;

/// A scene or a move that is not accepted.
///
/// Each variant carries the parameter's full name as it stands in a scene file, the value that was
/// given and what it must be; [`fmt::Display`] prints them in one line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Error {
    /// Infinite, NaN, or outside `min..=max`.
    OutOfRange {
        /// The field, e.g. `link.length`.
        parameter: &'static str,
        /// What was given.
        value: f64,
        /// Least accepted value.
        min: f64,
        /// Greatest accepted value.
        max: f64,
        /// Unit of all three, e.g. `m`.
        unit: &'static str,
    },
    /// The move needs more than the drive may give.
    LimitExceeded {
        /// The limit's field, e.g. `limits.rate`.
        parameter: &'static str,
        /// The limit.
        limit: f64,
        /// What the move needs.
        needed: f64,
        /// Unit of both.
        unit: &'static str,
    },
    /// A limit that the layer it is given to has no means to check.
    CannotCheck {
        /// The limit's field, `limits.torque` or `limits.moment`.
        parameter: &'static str,
        /// The limit.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The hub would turn more than a radian a tick, or than the stepper carries.
    TooFast {
        /// Peak rate of the move, rad/s.
        rate: f64,
        /// Largest that is accepted, rad/s.
        max: f64,
    },
    /// A rest-to-rest move behind one that leaves the hub turning.
    NotAtRest {
        /// Rate at which the queue ends, rad/s.
        rate: f64,
    },
    /// The move would bend the link further than the stepper was set up for.
    BendsTooFar {
        /// Tip angle to expect relative to the hub, rad.
        bend: f64,
        /// Tip angle that the stepper was set up for, rad.
        max: f64,
    },
    /// No stepper is as good as asked for.
    Tolerance {
        /// The tolerance that is not kept: `solver.tolerance` of the tip, a fraction of L, or
        /// `solver.torque_tolerance`, a fraction of the torque's peak.
        parameter: &'static str,
        /// What was asked for.
        tolerance: f64,
        /// The error to expect of the best, the same fraction; infinite where none follows.
        best: f64,
    },
    /// The queue has not enough free segments for the move.
    QueueFull {
        /// Segments that the move takes.
        needed: usize,
        /// Segments that are free.
        free: usize,
    },
    /// Too short for the arm to arrive at rest.
    TooShort {
        /// Duration that was asked for, s.
        duration: f64,
        /// 0.9 first periods, s.
        shortest: f64,
    },
    /// The search for a still move has left vibration.
    NotStill {
        /// Duration that was asked for, s.
        duration: f64,
        /// Amplitude that is left, of L.
        residual: f64,
    },
    /// The arm would bend too far.
    DeflectsTooFar {
        /// Deflection of the tip, m.
        deflection: f64,
        /// Largest that is accepted, m.
        most: f64,
    },
    /// A move does not begin where the hub is at that tick.
    Elsewhere {
        /// The hub's angle, rad.
        hub: f64,
        /// The move's, rad.
        begins: f64,
    },
    /// Gravity exceeds the buckling load of the upright link.
    Buckles {
        /// The gravity that was given, m/s².
        gravity: f64,
    },
    /// The model's degrees of freedom do not fit the scene.
    DegreesOfFreedom {
        /// Degrees of freedom of the type.
        given: usize,
        /// Degrees of freedom that the scene needs.
        needed: usize,
    },
}

/// Longest move, ticks: counts up to here are exact in an f32.
pub(crate) const MAX_TICKS: u32 = 1 << 24;

impl Error {
    /// `value` if it lies in `min..=max`, compared in its own precision, else the error that names
    /// `parameter`.
    pub(crate) fn check<T: Scalar>(
        parameter: &'static str,
        value: T,
        min: f64,
        max: f64,
        unit: &'static str,
    ) -> Result<T, Self> {
        if (T::from_f64(min)..=T::from_f64(max)).contains(&value) {
            Ok(value)
        } else {
            Err(Self::OutOfRange { parameter, value: value.to_f64(), min, max, unit })
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OutOfRange { parameter, value, min, max, unit } => {
                write!(f, "{parameter} = {value}: must be {min}")?;
                if min != max {
                    write!(f, " to {max}")?;
                }
                if unit.is_empty() { Ok(()) } else { write!(f, " {unit}") }
            }
            Self::LimitExceeded { parameter, limit, needed, unit } => write!(
                f,
                "{parameter}: the move needs {needed:.6} {unit}, must be at most {limit} {unit}; use a \
                 longer move or raise the limit"
            ),
            Self::CannotCheck { parameter, value, unit } => write!(
                f,
                "{parameter} = {value} {unit}: must be absent here, where the arm's peaks between \
                 ticks are not known; give it to the planner of still moves or to the desktop's run"
            ),
            Self::TooFast { rate, max } => write!(
                f,
                "move.duration: the move peaks at {rate:.6} rad/s, must be at most {max:.6} rad/s for \
                 this arm, method and tick (never more than one radian a tick); use a longer move"
            ),
            Self::NotAtRest { rate } => write!(
                f,
                "move.profile: the hub turns at {rate} rad/s when this rest-to-rest move begins, \
                 must be at rest; put a spin-up to rate = 0 before it"
            ),
            Self::BendsTooFar { bend, max } => write!(
                f,
                "move.duration: the tip is expected to turn {bend:.3} rad against the hub, must \
                 be at most {max:.3} rad; use a longer move, a stiffer link or a stepper set up for more"
            ),
            Self::Tolerance { parameter, tolerance, best } if !best.is_finite() => write!(
                f,
                "{parameter} = {tolerance}: no method follows this move at this tick; use a \
                 longer move or a shorter tick"
            ),
            Self::Tolerance { parameter, tolerance, best } => write!(
                f,
                "{parameter} = {tolerance}: must be at least {best:.6} for this move at \
                 this tick; a longer move or a shorter tick takes less"
            ),
            Self::QueueFull { needed, free } => write!(
                f,
                "moves: this one takes {needed} segments of the queue, must be at most {free} now; wait for \
                 a move to end"
            ),
            Self::TooShort { duration, shortest } => write!(
                f,
                "move.duration = {duration}: too short for the arm to arrive at rest; must be \
                 at least {shortest:.6} s, 0.9 first periods"
            ),
            Self::NotStill { duration, residual } if !residual.is_finite() => write!(
                f,
                "move.duration = {duration}: the arm would be bent out of all shape on its way; \
                 use a longer move, or a smaller angle in rad"
            ),
            Self::NotStill { duration, residual } => write!(
                f,
                "move.duration = {duration}: the arm would ring with {:.3} % of its length; use \
                 another duration",
                100.0 * residual
            ),
            Self::DeflectsTooFar { deflection, most } => write!(
                f,
                "move.duration: the tip would deflect by {deflection:.6} m, must be at most \
                 {most:.6} m; use a longer move or a stiffer link"
            ),
            Self::Elsewhere { hub, begins } => write!(
                f,
                "move.from = {begins} rad: the hub is at {hub} rad at that tick, or turns \
                 otherwise; plan the move from there"
            ),
            Self::Buckles { gravity } => write!(
                f,
                "gravity.acceleration = {gravity}: must be less, as the upright link buckles under its \
                 own weight; use less gravity, a stiffer link or a lighter payload"
            ),
            Self::DegreesOfFreedom { given, needed } => write!(
                f,
                "elements: the model type has {given} degrees of freedom, must be {needed} for \
                 this scene"
            ),
        }
    }
}

impl core::error::Error for Error {}
