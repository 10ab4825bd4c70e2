//! What goes wrong around an axis: a part of the campaign of `stillbeam-sim faults`, and the cases that
//! it has found.

mod campaign;
mod found;
