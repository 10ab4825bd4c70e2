//! The commanded motion of the hub: what a user asks for ([`Move`]), checked against the drive's
//! [`Limits`] and cut into [`Segment`]s that cost a few multiplications a tick.

mod angle;
mod commanded;
mod curve;
mod demand;
mod limits;
mod plan;
mod profile;
mod remedy;
mod segment;
mod shaper;
pub mod still;

pub use angle::Angle;
pub use commanded::{Commanded, Moves, Stretch};
pub use curve::BULGE;
pub(crate) use demand::admit;
pub use limits::{Limits, Peaks};
pub(crate) use plan::MAX_ANGLE;
pub(crate) use plan::lay;
pub use plan::{MAX_SEGMENTS, Outline, Plan, Start};
pub use profile::{Move, Profile};
pub use remedy::Remedy;
pub use segment::{Braking, Hub, Segment};
pub(crate) use shaper::ORDERS;
pub use shaper::{Kink, MAX_PULSES, Pulse, Shaped, Shaper, ShaperKind};
pub use still::{Course, Manner, Origin, Still, StillMove, Survey};
