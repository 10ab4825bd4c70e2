//! Command line of the desktop simulation.

fn main() {}
