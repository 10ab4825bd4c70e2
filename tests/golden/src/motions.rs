//! Motions that no scene has: a path of thousands of waypoints through a queue of eight, a hub that
//! is followed, and targets that change while it turns.

use stillbeam::motion::{Spline, Waypoint};
use stillbeam::{Angle, Error, Generator, HubState, Setpoint};

use crate::methods::{Method, Newmark1Nodal};
use crate::scenes::Run;

/// Names of the motions, in the order in which they run.
pub const MOTIONS: [&str; 3] = ["path", "follow", "change"];

/// Waypoints of the path.
pub const WAYPOINTS: u32 = 10_000;

/// The same where floats are computed in software.
pub(crate) const FEW_WAYPOINTS: u32 = 1_000;

/// Time from one waypoint to the next, s: two and a half ticks.
const SPAN: f64 = 0.025;

/// Runs a motion with the arm of a scene, the path with so many waypoints.
pub(crate) fn one(
    motion: &str,
    waypoints: u32,
    run: &Run,
    sink: &mut impl FnMut(u32, &Setpoint<f32>),
) -> Result<(), Error> {
    let stepper = Newmark1Nodal::stepper(&run.scene, run.tick)?;
    let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    match motion {
        "path" => path(&mut arm, waypoints, sink),
        "follow" => {
            for k in 0..300 {
                sink(k, &arm.follow(&swing(f64::from(k) * run.tick)));
            }
            Ok(())
        }
        _ => change(&mut arm, sink),
    }
}

type Arm = Generator<<Newmark1Nodal as Method>::Stepper, 8>;

fn path(
    arm: &mut Arm,
    waypoints: u32,
    sink: &mut impl FnMut(u32, &Setpoint<f32>),
) -> Result<(), Error> {
    let mut path = arm.path(Spline::Quintic)?;
    let mut rows = (1..=waypoints).map(|i| {
        let time = SPAN * f64::from(i);
        let (sin, cos) = Angle::from_radians(0.9 * time).sin_cos();
        Waypoint::at(time, 0.8 * sin + 0.2 * sin * cos)
    });
    let mut k = 0;
    while !(path.is_done() && arm.is_holding()) {
        arm.feed(&mut path, &mut rows).map_err(|refused| refused.error)?;
        sink(k, &arm.tick());
        k += 1;
    }
    Ok(())
}

/// `θ = 0.5(1 − cos 3t)`: begins at rest.
fn swing(time: f64) -> HubState<f32> {
    let (sin, cos) = Angle::from_radians(3.0 * time).sin_cos();
    let angle = Angle::from_radians(0.5 * (1.0 - cos));
    HubState {
        acceleration: (4.5 * cos) as f32,
        ..HubState::turning(angle.cast(), (1.5 * sin) as f32)
    }
}

/// A target that swings, told every third tick.
fn change(arm: &mut Arm, sink: &mut impl FnMut(u32, &Setpoint<f32>)) -> Result<(), Error> {
    for k in 0..300 {
        if k % 3 == 0 {
            let target = swing(0.01 * f64::from(k) + 0.2);
            arm.retarget(target.angle, target.rate, 0.2)?;
        }
        sink(k, &arm.tick());
    }
    Ok(())
}
