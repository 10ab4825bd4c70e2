//! The one error of the crate: kinds of fault, each naming its parameter.

mod display;
mod mode;

pub use mode::Mode;

use crate::math::Scalar;

/// The reason why a scene, a move or a request is refused. Whatever refused it is unchanged.
///
/// A variant is a kind of fault. It carries the parameter's full name as it stands in a scene file,
/// the value that was given and what it must be. [`Display`](core::fmt::Display) prints them in one
/// line, with what would do instead.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Error {
    /// Infinite, NaN, or outside `min..=max`.
    OutOfRange {
        /// The field, e.g. `link.length`.
        parameter: &'static str,
        /// Value that was given.
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
        /// Value that the move needs.
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
        /// Tolerance that was asked for.
        tolerance: f64,
        /// Expected error of the best stepper, the same fraction. Infinite if none can follow.
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
    /// A motor is asked for at a joint that has none, or no longer.
    PassiveJoint {
        /// The field that names the joint, e.g. `moves.joint`.
        parameter: &'static str,
        /// The joint, counted from 1.
        joint: usize,
    },
    /// The end of a chain does not reach the pin that is to close it.
    OpenLoop {
        /// Distance that is left between end and pin, m.
        gap: f64,
    },
    /// The moves take a loop to where its end does not stay on the pin.
    LeavesPin {
        /// Distance of the end from the pin, m.
        gap: f64,
        /// Time from the latest tick, s.
        time: f64,
    },
    /// The links of a loop lie in one line: its pin could hold any force along it.
    StraightLoop {
        /// Time from the latest tick, s.
        time: f64,
    },
    /// The tick is too long for what a chain is to do.
    TickTooLong {
        /// The tick, s.
        tick: f64,
        /// Distance of a link's end from where half the tick takes it, of all lengths.
        apart: f64,
        /// Time from the latest tick, s.
        time: f64,
    },
    /// The axis takes no such request in its mode.
    WrongMode {
        /// The mode that it is in.
        mode: Mode,
    },
    /// The hub turns or moves wait, and the request is for an axis at rest.
    Moving,
    /// The hub's motion has changed since the move was planned, for example by a stop.
    Stale,
    /// A path's next row came too late: the hub has begun to stop behind the last one.
    Starved,
    /// No move is under way whose duration could be changed.
    NoMove,
    /// The words that a stepper is loaded from are not those of a prepared stepper of its type and
    /// version, or have changed: see [`Prepared`](crate::prepared::Prepared).
    NotPrepared {
        /// The field that differs: `arm.magic`, `arm.format`, `arm.method`, `arm.sizes`,
        /// `arm.layout`, `arm.length`, `arm.bytes`, `arm.checksum` or `arm.words`.
        parameter: &'static str,
        /// Word that was found.
        found: u32,
        /// Word that must be there.
        needed: u32,
    },
}

/// Longest move, ticks: counts up to here are exact in an f32.
pub(crate) const MAX_TICKS: u32 = 1 << 24;

impl Error {
    /// Returns `value` if it lies in `min..=max`, compared in its own precision, else the error
    /// that names `parameter`.
    ///
    /// # Errors
    /// [`Self::OutOfRange`], for what is no number too.
    pub fn check<T: Scalar>(
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

impl core::error::Error for Error {}
