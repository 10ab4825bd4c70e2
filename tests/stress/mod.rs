//! A bounded part of the campaigns that try scenes by the million, and the cases that they found.

mod energy;
mod found;
mod long;
mod scenes;
