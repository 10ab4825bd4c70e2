//! The core by its public names alone: what a user of the crate may rely on. What needs other
//! crates, such as the reference solvers, stands in the workspace's `tests/`.

mod arms;
mod carriage;
mod carrier;
mod chain;
mod change;
mod exact;
mod fastest;
mod follow;
mod generator;
mod known;
mod motor;
mod optimal;
mod pass;
mod path;
mod peaks;
mod plan;
mod pointwise;
mod prepared;
mod remedy;
mod sequence;
mod shapers;
mod statics;
mod turning;

/// Asserts `|value − expected| ≤ tolerance` and says by how much it fails.
#[track_caller]
fn assert_near(what: &str, value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{what}: {value} is not {expected} within {tolerance}"
    );
}
