//! Arms from logs: synthetic ones whose truth is known, and measured ones.

mod campaign;
#[path = "../../host-sim/examples/09_from_log_to_arm.rs"]
mod circle;
mod fitted;
mod measured;
mod spectrum;

/// A log of a sensor on an arm that is 5 % softer than the handbook's, and a still move with it.
#[test]
fn an_identified_arm_comes_to_rest_where_the_handbooks_rings() {
    circle::main().expect("the example");
}
