//! The ring-down: free vibration after a tap or a move, the hub held.

mod amplitude;
mod combine;
mod excerpt;
mod fit;
mod lines;
mod modes;
mod search;
mod windows;

pub use combine::{combine, quantile};
pub use excerpt::Excerpt;
pub use fit::{Asked, Estimate, Ringdown, identify};
pub use lines::{Line, Lines};
