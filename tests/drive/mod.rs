//! Demands as the bytes of drives, read by other people's crates.

mod cia402;
mod common;
mod moteus;
mod odrive;
mod power;
mod reports;
