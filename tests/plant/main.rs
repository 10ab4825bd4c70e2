//! The machine that the setpoints are for: against the reference rod, its energy, and in the loop
//! with its drive.

mod energy;
mod ideal;
mod lost;
mod machine_files;
mod open_loop;
mod trials;
