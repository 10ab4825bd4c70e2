//! The queue, under Miri too.

use super::{Arrival, Branch, Generator};
use crate::motion::{Move, Profile, Segment, Spline, Waypoint};
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

/// Ticks of the S-curve below, whose last stretch holds none.
const SHORT: u32 = 5;

/// An arm with a short S-curve and a quintic behind it, and the moment of the S-curve's last tick.
fn with_a_short_move() -> (Generator<Rigid<f32>, 8>, f32) {
    let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    let stepper = Rigid::new(&scene, TICK).expect("a stepper");
    let mut arm = Generator::<_, 8>::new(stepper, 0.0).expect("a generator");
    let duration = f64::from(SHORT) * TICK;
    arm.push(&Move::To { profile: Profile::SCurve, duration, to: 0.1 }).expect("room");
    let moment: f32 = arm.tail.kink_moment();
    assert!(moment.abs() > 1.0, "{moment}");
    arm.push(&to(0.2)).expect("room");
    assert_eq!(arm.queue.back().expect("the quintic").kink_moment(), moment);
    assert_eq!(arm.tail.kink_moment(), 0.0);
    (arm, moment)
}

/// What the arm feels of an arrival goes to whatever comes behind, once.
#[test]
fn the_moment_of_an_arrival_goes_where_the_hub_goes_on() {
    let (arm, moment) = with_a_short_move();
    let quintic = *arm.queue.back().expect("the quintic");
    let mut ended = arm.clone();
    let there = quintic.hub(0).precise();
    ended.end_with(Arrival { ticks: SHORT, end: there });
    assert_eq!(ended.tail.kink_moment(), moment);
    let mut last = ended.clone();
    last.end_with(Arrival { ticks: SHORT, end: there });
    assert_eq!(last.tail.kink_moment(), moment);
    let tail = ended.tail;
    for (mut arm, behind) in [(arm, quintic), (ended, tail)] {
        let from = behind.hub(0).precise();
        let (segment, peaks) = Segment::from_hub(&from, 0.05, 0.0, 10, TICK);
        let to = from.angle.radians() + 0.05 * core::f64::consts::TAU;
        let branch = Branch { from, segment, peaks, to, rate: 0.0 };
        arm.branch(SHORT, &branch).expect("room");
        assert_eq!(arm.queue.back().expect("the branch").kink_moment(), moment);
    }
}

/// A move that is replaced leaves nothing to what follows it.
#[test]
fn a_replaced_move_takes_its_moment_with_it() {
    let (mut arm, _) = with_a_short_move();
    arm.tick();
    arm.tick();
    let aim = Angle::from_radians(0.1).cast();
    arm.replace_motion(aim, 0.0, 0.1, super::Replaced::Move(SHORT - 1)).expect("a target");
    assert_eq!(arm.queue.len(), 1);
    assert_eq!(arm.queue.front().expect("the quintic").kink_moment(), 0.0);
}

/// A path that ends inside a tick, its last two rows within one: the hold behind has the moment of
/// that tick, by angles and rates at both of its ends.
#[test]
fn a_path_that_ends_inside_a_tick_has_its_moment() {
    let mut arm = rigid();
    let mut path = arm.path(Spline::Cubic).expect("a path");
    let rate = Some(1.5);
    let mut rows = [(0.1337, 0.1), (0.2533, 0.3), (0.2563, 0.304)]
        .map(|(time, angle)| Waypoint { rate, ..Waypoint::at(time, angle) })
        .into_iter();
    while !arm.feed(&mut path, &mut rows).expect("rows in order") {
        run(&mut arm, 1);
    }
    let moment = f64::from(arm.tail.kink_moment());
    let last = arm.queue.back().unwrap_or(arm.current.segment());
    let (before, ends) = (last.hub(last.count() - 1), f64::from(last.end_acceleration()));
    let after = arm.tail.hub(0);
    let turned = core::f64::consts::TAU * f64::from(after.angle.since(before.angle)) / TICK;
    let [from, to] = [before.rate, after.rate].map(f64::from);
    let expected =
        (turned - 0.5 * (from + to)) / TICK + (ends - f64::from(before.acceleration)) / 12.0;
    assert!((moment / expected - 1.0).abs() < 1e-2 && moment.abs() > 1.0, "{moment} {expected}");
}
