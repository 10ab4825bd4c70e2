//! The joints of one mechanism as axes under one policy.

use stillbeam::axis::{Cause, MechanismAxes, Mode, Policy, Timing};
use stillbeam::chain::Chain;
use stillbeam::drive::odrive;
use stillbeam::motor::{Direction, Drivetrain, Joint, Ratio};
use stillbeam::{Angle, Error, Limits, Move, Profile};

use super::scenes;

type Axes = MechanismAxes<f32, 2, 3, 6, 3>;

fn policy(patience: f64) -> Policy {
    let limits = Limits { acceleration: Some(30.0), ..Limits::default() };
    Policy { limits, patience, missed: 2 }
}

fn measured() -> [Angle<f32>; 2] {
    [0.1, 0.3].map(|angle| Angle::from_radians(angle).cast())
}

/// Enabled axes with a move of each joint.
fn moving(patience: f64) -> Axes {
    let chain = Chain::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let policies = [policy(0.0), policy(patience)];
    let mut axes = Axes::new(chain, [0.0; 2], &policies).expect("axes");
    axes.enable(&measured()).expect("disabled before");
    for (joint, to) in [(0, 1.1), (1, 1.3)] {
        axes.push(joint, &to_angle(to)).expect("a move");
    }
    axes
}

fn to_angle(to: f64) -> Move {
    Move::To { profile: Profile::Quintic, duration: 0.6, to }
}

#[test]
fn axes_begin_where_they_were_measured_and_take_moves_when_enabled() {
    let chain = Chain::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let mut axes = Axes::new(chain, [0.0; 2], &[policy(0.0); 2]).expect("axes");
    assert_eq!(axes.tick().mode, Mode::Disabled);
    let off = Err(Error::WrongMode { mode: Mode::Disabled });
    assert_eq!(axes.push(0, &to_angle(1.0)).map(|_| ()), off);
    axes.enable(&measured()).expect("disabled before");
    let tick = axes.tick();
    assert_eq!((tick.number, tick.mode), (1, Mode::Enabled));
    assert_eq!(tick.setpoint.joints.map(|joint| joint.angle), measured());
    assert!(tick.setpoint.joints.iter().all(|joint| joint.rate == 0.0));
    axes.push(0, &to_angle(1.0)).expect("a move");
}

/// A host that falls silent stops both joints; each keeps its share of the path.
#[test]
fn a_silent_host_stops_all_joints_along_their_path() {
    let mut axes = moving(0.2);
    let mut free = moving(0.0);
    for _ in 0..20 {
        assert_eq!(axes.tick().setpoint, free.tick().setpoint);
    }
    let stopping = axes.tick();
    assert_eq!((stopping.mode, axes.cause()), (Mode::Stopping, Some(Cause::LinkLost)));
    let share = |setpoints: &[stillbeam::Setpoint<f32>; 2]| {
        let turned = |j: usize| setpoints[j].angle.precise().radians();
        (turned(1) - 0.3) / (turned(0) - 0.1)
    };
    let mut last = stopping;
    while axes.mode() == Mode::Stopping {
        last = axes.tick();
        assert!((share(&last.setpoint.joints) - 1.0).abs() < 1e-4, "{last:?}");
        assert!(last.number < 60);
    }
    assert_eq!(last.mode, Mode::Stopped);
    assert!(last.setpoint.joints.iter().all(|joint| joint.rate == 0.0), "{last:?}");
    assert!(last.setpoint.joints[0].angle.precise().radians() < 1.0, "it stopped on the way");
    // It goes on where it holds.
    axes.enable(&measured()).expect("stopped before");
    assert_eq!(axes.tick().setpoint.joints[0].angle, last.setpoint.joints[0].angle);
}

#[test]
fn axes_switch_off_after_a_stop_and_count_missed_ticks() {
    let mut axes = moving(0.0);
    for _ in 0..20 {
        axes.tick();
    }
    axes.disable();
    assert_eq!(axes.mode(), Mode::Stopping);
    assert_eq!(axes.enable(&measured()), Err(Error::WrongMode { mode: Mode::Stopping }));
    while axes.mode() == Mode::Stopping {
        axes.tick();
    }
    assert_eq!(axes.mode(), Mode::Disabled);
    let mut axes = moving(0.0);
    let timing = |due, missed| Timing { due, early: 0, late: 0, missed };
    assert_eq!(axes.tick_if_due(&timing(false, 0)), None);
    assert_eq!(axes.tick_if_due(&timing(true, 2)).expect("due").mode, Mode::Enabled);
    for _ in 0..10 {
        axes.tick();
    }
    assert_eq!(axes.tick_if_due(&timing(true, 3)).expect("due").mode, Mode::Stopping);
    assert_eq!(axes.cause(), Some(Cause::MissedTicks));
}

#[test]
fn axes_without_what_a_stop_needs_are_refused() {
    let chain = Chain::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let unlimited = Policy { limits: Limits::default(), ..policy(0.0) };
    let refused = Axes::new(chain, [0.0; 2], &[policy(0.0), unlimited]).map(|_| ());
    assert!(
        matches!(
            refused,
            Err(Error::OutOfRange { parameter: "joints[1].limits.acceleration", .. })
        ),
        "{refused:?}"
    );
}

/// A drive is told of a joint what it is told of a hub: the relative angle, rate and torque.
#[test]
fn a_drive_takes_a_joint_as_it_takes_a_hub() {
    let mut axes = moving(0.0);
    let joint = Joint { ratio: Ratio { motor: 9, link: 1 }, ..Joint::direct(0.05) };
    let train = Drivetrain::<f32>::new(&joint, Direction::Same, 0.0).expect("a drivetrain");
    for _ in 0..30 {
        for setpoint in &axes.tick().setpoint.joints {
            let demand = train.demand(setpoint);
            let told = odrive::encode(&demand).expect("finite").payload;
            let heard = odrive::decode(&told).expect("finite");
            let turns = heard.position.precise().in_turns() / 9.0;
            let angle = setpoint.angle.precise().in_turns();
            assert!((turns - angle).abs() < 1e-6, "{turns} {angle}");
        }
    }
}
