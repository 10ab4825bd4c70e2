//! Natural frequencies of a scene's arm.

pub mod natural;
