//! The queue, under Miri too.

use super::Generator;
use crate::motion::{Move, Profile, Spline, Waypoint};
use crate::scene::Scene;
use crate::stepper::Rigid;
use crate::{Angle, Error, Link};

const TICK: f64 = 0.01;

fn rigid() -> Generator<Rigid<f32>, 4> {
    let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    Generator::new(Rigid::new(&scene, TICK).expect("a stepper"), 0.0).expect("a generator")
}

fn to(to: f64) -> Move {
    Move::To { profile: Profile::Quintic, duration: 0.1, to }
}

/// Runs `ticks` ticks and returns the angle of the last, rad.
fn run(arm: &mut Generator<Rigid<f32>, 4>, ticks: usize) -> f64 {
    for _ in 0..ticks {
        arm.tick();
    }
    arm.setpoint().angle.radians()
}

/// Every way in which a queue is filled, given back, wrapped around and replaced. The arm is
/// rigid, so that it takes a second under Miri, which looks into the queue's own crate.
#[test]
fn a_queue_is_filled_given_back_and_replaced() {
    let mut arm = rigid();
    for k in 1..=4 {
        arm.push(&to(0.1 * f64::from(k))).expect("room");
    }
    assert_eq!(arm.push(&to(1.0)), Err(Error::QueueFull { needed: 1, free: 0 }));
    // The first tick is the one at which it begins.
    assert!((run(&mut arm, 26) - 0.25).abs() < 1e-6);
    // Behind the wrap of the ring. Of three segments two find room, and are given back.
    arm.push(&to(0.6)).expect("room");
    let trapezoid = Move::To { profile: Profile::Trapezoid, duration: 0.3, to: 1.0 };
    assert_eq!(arm.push(&trapezoid), Err(Error::QueueFull { needed: 3, free: 2 }));
    assert_eq!(arm.queue.len(), 2);
    arm.retarget(Angle::from_radians(-0.5).cast(), 0.0, 0.3).expect("a target");
    assert!(arm.queue.is_empty());
    arm.push(&to(0.2)).expect("room");
    assert!((run(&mut arm, 40) - 0.2).abs() < 1e-6);
}

/// Rows come faster than they are ridden: the path takes what there is room for.
#[test]
fn a_path_is_fed_as_the_queue_empties() {
    let mut arm = rigid();
    let mut path = arm.path(Spline::Cubic).expect("a path");
    let mut rows = (1..=12).map(|k| Waypoint::at(0.1 * f64::from(k), 0.05 * f64::from(k)));
    let mut ticks = 0;
    while !arm.feed(&mut path, &mut rows).expect("rows in order") {
        run(&mut arm, 1);
        ticks += 1;
    }
    assert!((run(&mut arm, 121 - ticks) - 0.6).abs() < 1e-6, "{ticks} ticks");
}
