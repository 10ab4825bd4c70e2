//! An axis that follows what another program commands, and a change of mind.
//!
//! A planner of the user's own, or a machine's, gives angle, rate and acceleration of the hub tick
//! by tick. The axis answers with torque and tip. If no state comes it goes on for as many ticks as
//! its policy allows, and then stops along the path. Enabled again it is given a target that moves.
//!
//! `cargo run -p stillbeam --example 08_follow`

use stillbeam::axis::{Axis, Cause, Change, Mode, Policy, StopLimits};
use stillbeam::model::EightElements;
use stillbeam::stepper::Modal2;
use stillbeam::{Angle, Error, HubState, Limits, Link, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// The other program: a swing of ±0.6 rad that begins at rest, `θ = 0.6(1 − cos ωt)`.
fn swing(k: u32) -> HubState<f32> {
    let (omega, t) = (4.0, TICK * f64::from(k));
    let angle = Angle::from_radians(0.6 * (1.0 - (omega * t).cos()));
    HubState {
        acceleration: (0.6 * omega * omega * (omega * t).cos()) as f32,
        ..HubState::turning(angle.cast(), (0.6 * omega * (omega * t).sin()) as f32)
    }
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let scene = Scene::new(Link { length: 0.5, mass: 0.054, bending_stiffness: 0.93 });
    let stepper = Modal2::<f32>::new(&EightElements::consistent(&scene)?, TICK)?;
    let limits = Limits { rate: Some(5.0), acceleration: Some(40.0), ..Limits::default() };
    let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 0.0, missed: 2 };
    let mut axis = Axis::<_, 8>::new(stepper, Angle::default(), policy)?;
    axis.enable(Angle::default())?;

    let mut torque = 0.0f32;
    for k in 0..100 {
        let tick = axis.follow(Some(&swing(k)));
        torque = torque.max(tick.setpoint.torque.abs());
    }
    println!("followed for 1 s: {torque:.3} N m at most");

    // The other program falls silent.
    let mut silent = 0;
    while axis.mode() != Mode::Stopped {
        axis.follow(None);
        silent += 1;
    }
    let held = axis.generator().hub().angle;
    println!("silent: at rest at {:.3} rad, {silent} ticks later", held.radians());
    assert_eq!(axis.cause(), Some(Cause::FollowLost));

    // A target that turns at 0.5 rad/s, told thirty times a second.
    axis.enable(held)?;
    let target = |k: u32| 0.8 + 0.5 * TICK * f64::from(k);
    let mut lag = 0.0f64;
    for k in 0..200 {
        if k % 3 == 0 {
            let angle = Angle::from_radians(target(k)).cast();
            let duration = if k < 60 { 0.6 } else { 0.2 };
            axis.change(&Change::Target { angle, rate: 0.5, duration })?;
        }
        let angle = axis.tick().setpoint.angle.radians();
        if k > 150 {
            lag = lag.max((angle - target(k + 1)).abs());
        }
    }
    println!("tracked: {lag:.1e} rad behind the target at most");
    assert!(lag < 1e-4);
    axis.change(&Change::Hold)?;
    for _ in 0..50 {
        axis.tick();
    }
    assert!(axis.rests());
    Ok(())
}
