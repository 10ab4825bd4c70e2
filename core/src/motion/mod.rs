//! The commanded motion of the hub: what a user asks for ([`Move`]), checked against the drive's
//! [`Limits`] and cut into [`Segment`]s that cost a few multiplications a tick.

mod blend;
mod commanded;
mod cubics;
mod curve;
mod curve_peaks;
mod demand;
mod joiner;
mod limits;
mod moves;
pub mod optimal;
mod pass;
mod path;
mod piece;
mod plain;
mod plan;
mod plannable;
mod polynomial;
mod profile;
mod remedy;
pub(crate) mod segment;
mod shaper;
mod shapes;

pub use commanded::{Commanded, Moves, Stretch};
pub use curve::BULGE;
pub(crate) use curve_peaks::curve_peaks;
pub(crate) use demand::admit;
pub use limits::{Limits, Peaks};
pub use moves::Move;
pub(crate) use path::Stream;
pub use path::{Path, PathPiece, RowError, Spline, WINDOW, Waypoint};
pub use plain::PlainMove;
pub use plan::{MAX_SEGMENTS, MoveSummary, Plan};
pub use plannable::Plannable;
pub use profile::Profile;
pub use remedy::Remedy;
pub use segment::{Braking, Segment};
pub(crate) use shaper::ORDERS;
pub use shaper::{Kink, MAX_PULSES, Pulse, Shaped, Shaper, ShaperKind};
