//! The motor side, and demands as the bytes of drives.

mod cia402;
mod common;
mod moteus;
mod motor;
mod odrive;
mod sequence;
