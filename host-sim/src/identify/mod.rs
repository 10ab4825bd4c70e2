//! From a measured log to an arm: frequencies, damping ratios and a scene that runs.
//!
//! A log without a hub's angle is a ring-down ([`ringdown`]): damped sines are fitted to free
//! vibration. One with it is forced ([`forced`]): the hub's angle drives the model, and the sensor
//! is compared with it. What was found is put into a scene ([`arm`], [`scene`]), reported in
//! numbers ([`report`]) and drawn ([`page`]). [`warning`] lists what a person should know.

pub mod arm;
mod clean;
mod covariance;
mod doubts;
pub mod forced;
pub mod log;
mod moving;
pub mod page;
mod panel;
pub mod report;
mod request;
pub mod ringdown;
pub mod scene;
mod separable;
pub mod spectrum;
pub mod warning;

use nalgebra::DVector;

pub use panel::Panel;
pub use request::{Identified, Request};

/// Returns `100 (1 − ‖y − ŷ‖/‖y − ȳ‖)`.
pub fn fit_percent(value: &DVector<f64>, residual: &DVector<f64>) -> f64 {
    100.0 * (1.0 - residual.norm() / value.add_scalar(-value.mean()).norm())
}
