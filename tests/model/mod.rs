//! The beam's models against each other and against the scenes' published periods.

mod arms;
mod modes;
mod sag;
