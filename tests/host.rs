//! Tests across crates that run on this machine. One program: seven would each be linked, and their
//! long tests would run one after the other.

mod drive;
mod faults;
mod firmware;
mod identify;
mod lab_pages;
mod model;
mod motion;
mod moving;
mod packages;
mod pages;
mod pictures;
mod playground;
mod run;
mod starter;
mod stress;
