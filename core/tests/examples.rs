//! Each example runs to its end: it asserts what it shows.

// Interpreted, they would take minutes.
#![cfg(not(miri))]

#[path = "../examples/03_arrive_still.rs"]
mod arrive_still;
#[path = "../examples/06_choose_method.rs"]
mod choose_method;
#[path = "../examples/08_follow.rs"]
mod follow;
#[path = "../examples/04_input_shaper.rs"]
mod input_shaper;
#[path = "../examples/05_motor_and_drive.rs"]
mod motor_and_drive;
#[path = "../examples/01_one_move.rs"]
mod one_move;
#[path = "../examples/02_queue_and_limits.rs"]
mod queue_and_limits;
#[path = "../examples/07_waypoints.rs"]
mod waypoints;

#[test]
fn one_move_rings() {
    one_move::main().unwrap();
}

#[test]
fn a_refused_move_has_a_remedy() {
    queue_and_limits::main().unwrap();
}

#[test]
fn a_still_move_leaves_no_ringing() {
    arrive_still::main().unwrap();
}

#[test]
fn a_shaper_cancels_the_first_mode() {
    input_shaper::main().unwrap();
}

#[test]
fn a_demand_survives_the_drives_bytes() {
    motor_and_drive::main().unwrap();
}

#[test]
fn a_faster_move_takes_a_higher_rung() {
    choose_method::main().unwrap();
}

#[test]
fn a_path_passes_its_waypoints() {
    waypoints::main().unwrap();
}

#[test]
fn an_axis_follows_stops_and_tracks() {
    follow::main().unwrap();
}
