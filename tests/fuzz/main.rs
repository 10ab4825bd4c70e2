//! The bodies on the stable toolchain.

mod changed;
mod replay;
