//! What is tried by the million, a bounded part of it; and what it has found.

mod energy;
mod found;
mod long;
mod scenes;
