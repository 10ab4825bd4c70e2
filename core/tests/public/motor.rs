//! Gear, friction and rotor; link to motor turns and back.

use std::f64::consts::TAU;

use crate::assert_near;
use proptest::prelude::*;
use stillbeam::motor::{Direction, Drivetrain, Joint, Mapping, Ratio};
use stillbeam::{Angle, Setpoint};

const JOINT: Joint<f64> = Joint {
    ratio: Ratio { motor: 50, link: 1 },
    efficiency: 0.8,
    rotor_inertia: 2e-5,
    coulomb: 0.3,
    viscous: 0.1,
    torque_constant: 0.05,
};

/// τ = 4 N m at 2 rad/s: load 4 + 0.3 + 0.2 = 4.5 N m, /(50 · 0.8) = 0.1125 N m.
#[test]
fn driving_a_load_pays_for_the_gear() {
    let motor = JOINT.motor(4.0, 2.0, 0.0);
    assert_near("torque", motor.torque, 0.1125, 1e-15);
    assert_near("current", motor.current, 2.25, 1e-13);
}

/// τ = −4 N m at 2 rad/s: load −3.5 N m, 0.8 · −3.5/50 = −0.056 N m.
#[test]
fn a_load_that_drives_pays_for_the_gear_too() {
    assert_near("torque", JOINT.motor(-4.0, 2.0, 0.0).torque, -0.056, 1e-15);
}

/// At rest friction may point either way and efficiency says nothing: τ_l/n.
#[test]
fn at_rest_there_is_neither_friction_nor_loss() {
    assert_near("torque", JOINT.motor(4.0, 0.0, 0.0).torque, 0.08, 1e-15);
}

/// 2e-5 · 50 · 100 = 0.1 N m for the rotor alone; friction at ω < 0 points the other way.
#[test]
fn the_rotor_turns_n_times_as_fast() {
    let motor = JOINT.motor(0.3, -1e-9, 100.0);
    assert_near("torque", motor.torque, 0.1, 1e-10);
}

#[test]
fn power_into_the_motor_covers_load_and_losses() {
    proptest!(|(torque in -10.0..10.0, rate in -10.0..10.0)| {
        let load = torque + 0.3 * f64::signum(rate) + 0.1 * rate;
        let shaft = JOINT.motor(torque, rate, 0.0).torque * 50.0 * rate;
        let expected = if load * rate > 0.0 { load * rate / 0.8 } else { load * rate * 0.8 };
        prop_assert!((shaft - expected).abs() <= 1e-12 * (1.0 + expected.abs()));
    });
}

#[test]
fn drives_count_motor_turns() {
    let ratio = Ratio { motor: 50, link: 1 };
    let mapping = Mapping::<f32>::new(ratio, Direction::Opposite, 0.25).unwrap();
    let shaft = mapping.to_motor(Angle { turns: 1, part: 0.125 });
    assert_eq!(shaft.in_turns(), -56.0, "0.25 − 50 · 1.125");
    assert_eq!(mapping.to_link(shaft).in_turns(), 1.125);
    assert_near("velocity", mapping.velocity(1.0).into(), -50.0 / TAU, 1e-6);
}

fn round_trip(ratio: Ratio, direction: Direction, zero: f64, hub: Angle<f32>) -> f64 {
    let mapping = Mapping::<f32>::new(ratio, direction, zero).unwrap();
    mapping.to_link(mapping.to_motor(hub)).in_turns() - hub.in_turns()
}

/// Days of rotation: two million turns of the hub, gears up and down, odd teeth.
#[test]
fn the_round_trip_is_exact_to_the_last_bits_however_far_the_hub_has_turned() {
    proptest!(|(
        motor in 1u16..2000,
        link in 1u16..2000,
        opposite in any::<bool>(),
        zero in -1000.0..1000.0,
        turns in -1_000_000i32..1_000_000,
        part in -0.5f32..=0.5,
    )| {
        let n = f64::from(motor) / f64::from(link);
        let direction = if opposite { Direction::Opposite } else { Direction::Same };
        // Where the shaft's whole turns fit an i32.
        prop_assume!(f64::from(turns.abs() + 1) * n < 2e9);
        let error = round_trip(Ratio { motor, link }, direction, zero, Angle { turns, part });
        let bound = 1.8e-7 + 1.8e-7 / n;
        prop_assert!(error.abs() <= bound, "{error} turns, n = {n}, bound {bound}");
    });
}

/// The shaft follows the hub without a step where a whole turn or a tooth comes round.
#[test]
fn the_shaft_is_where_the_teeth_put_it() {
    proptest!(|(motor in 1u16..500, link in 1u16..500, turns in -100_000i32..100_000, part in -0.5f32..=0.5)| {
        let mapping = Mapping::<f32>::new(Ratio { motor, link }, Direction::Same, 0.0).unwrap();
        let hub = Angle { turns, part };
        let exact = hub.in_turns() * f64::from(motor) / f64::from(link);
        let n = f64::from(motor) / f64::from(link);
        let error = mapping.to_motor(hub).in_turns() - exact;
        prop_assert!(error.abs() <= 1.3e-7 * (1.0 + n), "{error}");
    });
}

/// Re-homing renames the hub's angle; the shaft's count does not move.
#[test]
fn homing_moves_no_demand() {
    proptest!(|(turns in -50i32..50, part in -0.5f32..=0.5, name in -3.0f64..3.0)| {
        let mut train = Drivetrain::<f32>::new(&JOINT, Direction::Opposite, 0.4).unwrap();
        let shaft = train.mapping().to_motor(Angle { turns, part });
        let hub = Angle::<f64>::from_radians(name).cast();
        train.home(shaft, hub);
        let again = train.mapping().to_motor(hub);
        prop_assert!((again.in_turns() - shaft.in_turns()).abs() <= 1.2e-7);
    });
}

#[test]
fn a_demand_carries_angle_rate_and_torque_to_the_shaft() {
    let train = Drivetrain::<f32>::new(&JOINT, Direction::Opposite, 0.0).unwrap();
    let setpoint = Setpoint {
        angle: Angle { turns: 0, part: 0.25 },
        rate: 2.0,
        acceleration: 0.0,
        torque: 4.0,
        tip: [0.0; 2],
    };
    let demand = train.demand(&setpoint);
    assert_eq!(demand.position.in_turns(), -12.5);
    assert_near("velocity", demand.velocity.into(), -100.0 / TAU, 1e-5);
    assert_near("torque", demand.torque.into(), -0.1125, 1e-8);
}

#[test]
fn constants_out_of_range_are_named() {
    let bad = Joint { efficiency: 1.2, ..JOINT };
    let error = Drivetrain::<f32>::new(&bad, Direction::Same, 0.0).unwrap_err().to_string();
    assert_eq!(error, "motor.efficiency = 1.2: must be 0.01 to 1");
    let bad = Joint { ratio: Ratio { motor: 0, link: 1 }, ..JOINT };
    let error = Drivetrain::<f32>::new(&bad, Direction::Same, 0.0).unwrap_err().to_string();
    assert_eq!(error, "motor.ratio.motor = 0: must be 1 to 65535 turns");
}

/// A carriage on a screw of 5 mm: half a metre is a hundred turns, and the work of the motor is
/// that of the force.
#[test]
fn a_screw_turns_metres_into_turns() {
    let ratio = Ratio::of_lead(0.005).expect("a lead");
    let joint = Joint { ratio, ..Joint::direct(0.1) };
    let train = Drivetrain::<f64>::new(&joint, Direction::Same, 0.0).expect("a drivetrain");
    let setpoint = Setpoint {
        angle: Angle::from_radians(0.5),
        rate: 0.2,
        acceleration: 0.0,
        torque: 30.0,
        tip: [0.4, 0.0],
    };
    let demand = train.demand(&setpoint);
    assert_near("turns", demand.position.in_turns(), 100.0, 1e-4);
    assert_near("turns/s", demand.velocity, 40.0, 4e-5);
    assert_near("N m", demand.torque, 30.0 * 0.005 / TAU, 1e-7);
    let power = demand.torque * demand.velocity * TAU;
    assert_near("W", power, 30.0 * 0.2, 1e-12);
}
