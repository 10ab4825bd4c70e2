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
        /// What would keep the limit.
        remedy: Remedy,
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
        /// What would keep it.
        remedy: Remedy,
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

/// What would keep a limit that a move exceeds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Remedy {
    /// This duration, s: the shortest whole number of ticks that keeps every limit.
    Duration(f64),
    /// A longer duration; how long is not known to the layer that refuses.
    Longer,
    /// No duration: the acceleration jumps, so its jerk is infinite. Another profile does.
    Smoother,
    /// No duration: the move ends at this rate, rad/s, or begins with it.
    Slower(f64),
    /// No duration: holding the arm against its weight on the way takes this much, in the limit's
    /// unit.
    Weight(f64),
    /// No duration up to the longest that a move may have, s.
    Nearer(f64),
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Duration(duration) => write!(f, "a duration of {} s fits", Plain(duration)),
            Self::Longer => write!(f, "use a longer move or raise the limit"),
            Self::Smoother => write!(
                f,
                "the acceleration jumps, so no duration helps; use quintic, cycloid, s-curve or still"
            ),
            Self::Slower(rate) => {
                write!(f, "the hub turns at {} rad/s at an end, so no duration helps", Plain(rate))
            }
            Self::Weight(held) => write!(
                f,
                "holding the arm against its weight takes {held:.6} on the way, so no duration helps"
            ),
            Self::Nearer(longest) => {
                let longest = Plain(longest);
                write!(f, "no duration up to {longest} s helps; turn by less or raise the limit")
            }
        }
    }
}

/// A number without the digits that binary arithmetic adds: 0.71, not 0.7100000000000001. It is
/// displayed in the fewest decimals, nine at most, that are right to 1e-9 of it.
struct Plain(f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, mut power, mut decimals) = (self.0, 1.0, 0);
        while decimals < 9 && libm::fabs(libm::round(x * power) / power - x) > 1e-9 * libm::fabs(x)
        {
            power *= 10.0;
            decimals += 1;
        }
        write!(f, "{x:.decimals$}")
    }
}

impl Error {
    /// The same fault with another remedy, where it has one.
    pub(crate) fn with_remedy(mut self, by: Remedy) -> Self {
        if let Self::LimitExceeded { remedy, .. } | Self::TooFast { remedy, .. } = &mut self {
            *remedy = by;
        }
        self
    }

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
            Self::LimitExceeded { parameter, limit, needed, unit, remedy } => write!(
                f,
                "{parameter}: the move needs {needed:.6} {unit}, must be at most {limit} {unit}; {remedy}"
            ),
            Self::CannotCheck { parameter, value, unit } => write!(
                f,
                "{parameter} = {value} {unit}: must be absent here, where the arm's peaks between \
                 ticks are not known; give it to the planner of still moves or to the desktop's run"
            ),
            Self::TooFast { rate, max, remedy } => {
                write!(
                    f,
                    "move.duration: the move peaks at {rate:.6} rad/s, must be at most {max:.6} \
                     rad/s for this arm, method and tick (never more than one radian a tick); "
                )?;
                match remedy {
                    // No limit of the drive's, so none to raise.
                    Remedy::Longer => write!(f, "use a longer move"),
                    Remedy::Nearer(longest) => {
                        write!(f, "no duration up to {} s helps; turn by less", Plain(longest))
                    }
                    other => write!(f, "{other}"),
                }
            }
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
