//! Time-optimal motions of the hub: from any rate and acceleration to any other, in the shortest
//! time that limits of rate, acceleration, deceleration and jerk allow.
//!
//! [`TimeOptimal::ramp`] changes the rate, [`TimeOptimal::reach`] arrives at an angle too. Both
//! give at most [`MAX_PIECES`] pieces of constant jerk. They run in f64, outside the tick.
//!
//! # Method
//!
//! For a fixed time T the motions that keep the limits form a convex set, and the angle turned is
//! linear in them. So the angles within reach in time T are an interval. Its upper end is turned by
//! jerk + − + with the acceleration held where it reaches a limit, and the rate where it does. Its
//! lower end is turned by the mirror image, − + −.
//!
//! In the shortest time in which the rate can be changed (`Problem::ramp`) the interval is a
//! single angle. It widens from there, and the first T at which it takes the angle asked for in is
//! the answer: by its upper end if the angle asked for lies above that single angle, else by its
//! lower. The shape is thereby known before anything is solved, and one equation in one unknown is
//! left. Its monotone parts are known too (`passage`, `strict`), so each is solved in a
//! bracket, and none is missed.
//!
//! There is one gap. A hub that begins and ends with accelerations of the same sign cannot waste
//! any time without a detour through acceleration zero, so the interval closes, and opens again at
//! the detour.

mod admit;
mod bounds;
mod brake;
mod lay;
mod leg;
mod passage;
mod phases;
mod problem;
mod root;
mod shortest;
mod solve;
mod strict;
mod trajectory;

pub use bounds::Bounds;
use phases::Phases;
use problem::{Problem, Rate};
pub use trajectory::{MAX_PIECES, Piece, TimeOptimal};
