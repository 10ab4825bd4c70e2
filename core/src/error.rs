//! What can be wrong with a scene or a move: kinds of fault, each naming its parameter.

use core::fmt;

use crate::math::Scalar;

/// A scene or a move that is not accepted.
///
/// Each variant carries the parameter's full name as it stands in a scene file, the value that was
/// given and what is accepted; [`fmt::Display`] prints them in one line.
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
        /// What was asked for, fraction of L.
        tolerance: f64,
        /// The error to expect of the best, fraction of L; infinite where none follows.
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
                write!(f, "{parameter} = {value}: accepted is {min} to {max}")?;
                if unit.is_empty() { Ok(()) } else { write!(f, " {unit}") }
            }
            Self::LimitExceeded { parameter, limit, needed, unit } => write!(
                f,
                "{parameter} = {limit} {unit}: the move needs {needed:.6} {unit}; accepted is a \
                 longer move or a higher limit"
            ),
            Self::TooFast { rate, max } => write!(
                f,
                "move.duration: the move peaks at {rate:.6} rad/s; accepted is up to {max:.6} rad/s for \
                 this arm, method and tick (never more than one radian a tick)"
            ),
            Self::NotAtRest { rate } => write!(
                f,
                "move.profile: the hub turns at {rate} rad/s when this rest-to-rest move begins; \
                 accepted is a spin-up to rate = 0 before it"
            ),
            Self::BendsTooFar { bend, max } => write!(
                f,
                "move.duration: the tip is expected to turn {bend:.3} rad against the hub; accepted \
                 is up to {max:.3} rad, by a longer move, a stiffer link or a stepper set up for more"
            ),
            Self::Tolerance { tolerance, best } if !best.is_finite() => write!(
                f,
                "solver.tolerance = {tolerance}: no method follows this move at this tick; accepted \
                 is a longer move or a shorter tick"
            ),
            Self::Tolerance { tolerance, best } => write!(
                f,
                "solver.tolerance = {tolerance}: accepted is {best:.6} and more for this move at \
                 this tick; a longer move or a shorter tick takes less"
            ),
            Self::QueueFull { needed, free } => write!(
                f,
                "moves: this one takes {needed} segments of the queue; accepted is up to {free} now"
            ),
            Self::TooShort { duration, shortest } => write!(
                f,
                "move.duration = {duration}: too short for the arm to arrive at rest; accepted is \
                 from {shortest:.6} s, 0.9 first periods"
            ),
            Self::NotStill { duration, residual } if !residual.is_finite() => write!(
                f,
                "move.duration = {duration}: the arm would be bent out of all shape on its way; \
                 accepted is a longer move, or a smaller angle in rad"
            ),
            Self::NotStill { duration, residual } => write!(
                f,
                "move.duration = {duration}: the arm would ring with {:.3} % of its length; accepted \
                 is another duration",
                100.0 * residual
            ),
            Self::DeflectsTooFar { deflection, most } => write!(
                f,
                "move.duration: the tip would deflect by {deflection:.6} m; accepted is up to \
                 {most:.6} m, by a longer move or a stiffer link"
            ),
            Self::Elsewhere { hub, begins } => write!(
                f,
                "move.from = {begins} rad: the hub is at {hub} rad at that tick, or turns \
                 otherwise; accepted is a move planned from there"
            ),
            Self::Buckles { gravity } => write!(
                f,
                "gravity.acceleration = {gravity}: the upright link buckles under its own weight; \
                 accepted is less gravity, a stiffer link or a lighter payload"
            ),
            Self::DegreesOfFreedom { given, needed } => write!(
                f,
                "elements: the model type has {given} degrees of freedom; accepted is {needed} for \
                 this scene"
            ),
        }
    }
}

impl core::error::Error for Error {}
