//! A machine whose state is lost.

use stillbeam_sim::plant::{Effort, Options, Parts, Plant};
use stillbeam_sim::scenes;

/// A torque that is no number ended no step and began none: the integrator went on for ever.
#[test]
fn a_torque_that_is_no_number_is_an_error() {
    let scene = scenes::open("d-tip30").expect("an embedded scene");
    for tolerance in [1e-9, 1e-6] {
        for torque in [f64::NAN, f64::INFINITY] {
            let options = Options { order: 5, tolerance };
            let mut plant =
                Plant::at_rest(&scene.arm, &Parts::default(), 0.0, &options).expect("a plant");
            plant.advance(0.01, &Effort::Held(0.1)).expect("a step");
            let error = plant.advance(0.02, &Effort::Held(torque)).expect_err("no number");
            let said = error.to_string();
            assert!(said.contains("stopped at t = 0.01"), "{torque}, {tolerance}: {said}");
        }
    }
}
