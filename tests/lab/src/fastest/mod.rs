//! Durations of motions within the same limits, and what they leave of vibration: profiles behind
//! input shapers, the still move, the fastest move.

pub mod cases;
pub mod eased;
pub mod gentle;
pub mod interrupted;
pub mod motions;
pub mod page;
