//! The forced case: the hub's angle goes in, the sensor comes out.

mod filter;
mod fit;
mod mode;
mod model;
mod verdict;

pub use filter::Lowpass;
pub use fit::{Asked, Forced, identify};
pub use model::Record;
