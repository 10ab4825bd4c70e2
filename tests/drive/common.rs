//! Demands to encode.

use proptest::prelude::*;
use stillbeam::Angle;
use stillbeam::motor::Demand;

pub fn demand(turns: i32, part: f32, velocity: f32, torque: f32) -> Demand<f32> {
    Demand { position: Angle { turns, part }, velocity, torque }
}

/// Turns to ±`turns`, velocities to ±`velocity` turns/s, torques to ±`torque` N m.
pub fn demands(turns: i32, velocity: f32, torque: f32) -> impl Strategy<Value = Demand<f32>> {
    (-turns..=turns, -0.5f32..=0.5, -velocity..=velocity, -torque..=torque)
        .prop_map(|(n, part, v, t)| demand(n, part, v, t))
}

/// Numbers that no format may send.
pub const NOT_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// Every way to put one of them into a demand.
pub fn not_finite() -> impl Iterator<Item = Demand<f32>> {
    NOT_FINITE.into_iter().flat_map(|bad| {
        [demand(0, bad, 0.0, 0.0), demand(0, 0.0, bad, 0.0), demand(0, 0.0, 0.0, bad)]
    })
}
