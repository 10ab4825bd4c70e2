//! Requests and reports.

use serde::{Deserialize, Serialize};
use stillbeam::axis::{Cause, Mode, Policy, Tick};
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::motor::{Direction, Joint};
use stillbeam::{Angle, Payload, PlainMove, UniformScene};

use crate::{Change, Refusal};

/// A request from the host.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Chosen by the host; comes back in the answer.
    pub sequence: u16,
    /// Number of the axis, from 0.
    pub axis: u8,
    /// Command to carry out.
    pub command: Command,
}

/// Commands to an axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Nothing. Any request, to any axis, shows all of them that the host is alive.
    Heartbeat,
    /// Begin at the measured angle; after a stop, take moves again.
    Enable,
    /// Stop, then off.
    Disable,
    /// Brake along the path, then hold.
    Stop,
    /// One more move behind the others.
    Move(PlainMove),
    /// One more move behind the others, after which the arm is at rest; planned on the target.
    Still {
        /// Angle at the end, rad.
        to: f64,
        /// s; the shortest within the limits if none.
        duration: Option<f64>,
    },
    /// The payload is another; at rest only.
    Payload(Payload),
    /// The angle where the arm stands, rad, is this one from now on; disabled only.
    Home(f64),
    /// Say what the axis is.
    Describe,
    /// Say how it is.
    Status,
    /// The drive's errors are to be cleared; disabled only. The drive stays off.
    Clear,
    /// Begin a recording of the axis, or with `false` end it.
    Record(bool),
    /// Change the motion from the next tick on, at any tick, with the hub turning or not.
    Change(Change),
    /// Begin a path of any length at the end of the moves; its rows follow one by one. A path
    /// whose rows stay away ends at rest.
    Path(Spline),
    /// One more row of the path that was begun. Refused with [`Refusal::Queue`] while there is no
    /// room: it is to be sent again then.
    Waypoint {
        /// Time, angle and what else is given.
        row: Waypoint,
        /// True of the path's last row.
        last: bool,
    },
}

/// A report from the firmware.
// There is no heap to keep the largest, the description, apart on.
#[expect(clippy::large_enum_variant)]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Report<'a> {
    /// The request is carried out, between two ticks. A move begins with this tick, or behind the
    /// moves before it.
    Accepted {
        /// The request's.
        sequence: u16,
        /// Number of the tick after it.
        tick: u32,
    },
    /// The request changes nothing.
    Refused {
        /// The request's.
        sequence: u16,
        /// Reason for the refusal.
        #[serde(borrow)]
        refusal: Refusal<'a>,
    },
    /// Answer to [`Command::Describe`].
    Description {
        /// The request's.
        sequence: u16,
        /// Description of the axis.
        #[serde(borrow)]
        description: Description<'a>,
    },
    /// Answer to [`Command::Status`].
    Status {
        /// The request's.
        sequence: u16,
        /// State of the axis and the firmware.
        status: Status,
    },
    /// A setpoint, as it goes to the drive.
    Tick {
        /// Number of the axis.
        axis: u8,
        /// Number, mode, setpoint.
        tick: Tick<f32>,
        /// Reason for which the axis stopped, if it did.
        cause: Option<Cause>,
    },
    /// Answer to [`Command::Record`] with `true`: a [`Report::Sample`] of every tick follows.
    Recording {
        /// The request's.
        sequence: u16,
        /// Number of the tick after it, which is the first that is recorded.
        tick: u32,
        /// Quantity of the sensor with its unit at the end, the column of a log:
        /// `tip_deflection_m`.
        column: &'a str,
    },
    /// A tick of a recording.
    Sample {
        /// Number of the axis.
        axis: u8,
        /// Time, hub angle and sensor.
        sample: Sample,
    },
    /// Answer to [`Command::Record`] with `false`, behind the last sample.
    Recorded {
        /// The request's.
        sequence: u16,
        /// Number of samples that were sent.
        samples: u32,
        /// Number of samples that the line was too slow for, or that found no hub angle.
        lost: u32,
    },
}

/// A row of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Time since the recording's first tick, µs, modulo 2³² (71 minutes). Missed ticks and the
    /// lateness of this one are in it.
    pub time: u32,
    /// Angle of the hub by the drive's latest report.
    pub hub: Angle<f32>,
    /// Reading of the sensor, in the unit of its column.
    pub value: f32,
}

/// All that a host needs to run the same axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description<'a> {
    /// Number of axes.
    pub axes: u8,
    /// The method by its name in `stillbeam-methods`, e.g. `Newmark1Nodal`.
    pub method: &'a str,
    /// h, s.
    pub tick: f64,
    /// The arm as it is now.
    pub scene: UniformScene,
    /// Limits and patience.
    pub policy: Policy,
    /// Gear and motor.
    pub joint: Joint<f64>,
    /// Sense of rotation of the motor against the hub.
    pub direction: Direction,
    /// The shaft's angle where the hub's is 0.
    pub zero: Angle<f32>,
    /// The drive's node id.
    pub node: u8,
}

/// State of an axis and of the firmware.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Status {
    /// The axis' mode.
    pub mode: Mode,
    /// Reason for which it stopped, if it did.
    pub cause: Option<Cause>,
    /// Number of the next tick.
    pub clock: u32,
    /// Angle of the shaft as the drive reports it.
    pub measured: Angle<f32>,
    /// Cost of the latest tick of all axes, in the board's counts (instructions or cycles).
    pub cost: u32,
    /// Cost of the worst tick.
    pub worst: u32,
    /// Latest start of a tick after its time, µs.
    pub late: u32,
    /// Ticks that did not take place.
    pub missed: u32,
    /// Ticks that came before they were due, and were not made.
    pub early: u32,
    /// Ticks that were not over when the next was due.
    pub overruns: u32,
    /// Setpoints that the drive or the host was too slow for.
    pub dropped: u32,
    /// Frames that came in garbled.
    pub garbled: u32,
    /// Values that did not fit the drive's format.
    pub saturated: u32,
    /// Deepest stack so far, bytes.
    pub stack: u32,
}
