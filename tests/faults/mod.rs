//! Faults around an axis: a part of the campaigns of `cargo lab faults` and `cargo lab
//! plant`, and the cases that they have found.

mod campaign;
mod found;
mod plant;
