//! What goes wrong around an axis: a part of the campaign of `cargo lab faults`, and the cases that
//! it has found.

mod campaign;
mod found;
