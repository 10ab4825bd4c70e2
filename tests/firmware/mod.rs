//! The firmware as far as it needs no target: the policy of an axis, the command
//! protocol.

mod common;
mod pace;
mod policy;
mod protocol;
mod script;
mod slcan;
mod still;
mod stop;
