//! Cost of a change of the motion beside the tick, and of a followed tick, with a rigid arm.

use core::fmt::Write;
use core::hint::black_box;

use stillbeam::motion::optimal::Bounds;
use stillbeam::motion::{Path, Spline, Waypoint};
use stillbeam::stepper::Rigid;
use stillbeam::{Angle, Error, Generator, HubState, Link, Move, Profile, Scene};

use crate::stopwatch::{Counter, Stopwatch};

const TICK: f64 = 0.010;

/// Rows that the queue of eight takes: behind them is a stop.
const TAKEN: u32 = 7;

type Arm = Generator<Rigid<f32>, 8>;

/// Requests to an arm on its way.
type Change = fn(&mut Arm) -> Result<(), Error>;

/// Changes to be counted, each of a hub that turns: name, change.
const CHANGES: [(&str, Change); 4] = [
    ("new target", |arm| {
        let angle = Angle { turns: 0, part: 0.12 };
        arm.retarget(black_box(angle), black_box(0.5), black_box(0.4)).map(drop)
    }),
    ("move in f64", |arm| {
        let profile = Profile::Quintic;
        arm.push(&black_box(Move::Pass { profile, duration: 0.4, to: 1.5, rate: 0.5 })).map(drop)
    }),
    ("shortest move in f64", |arm| {
        let bounds = Bounds { rate: 6.0, acceleration: 40.0, deceleration: 40.0, jerk: 800.0 };
        arm.push(&black_box(Move::Reach { to: 3.0, rate: 0.5, bounds })).map(drop)
    }),
    ("followed tick", |arm| {
        let hub = HubState { acceleration: 1.0, ..*arm.hub() };
        black_box(arm.follow(&black_box(hub)));
        Ok(())
    }),
];

/// Prints a line a change, in the form of a tick's.
pub fn print<C: Counter>(watch: &Stopwatch<C>, output: &mut impl Write) {
    let mut line = |name: &str, count: u32| {
        writeln!(output, "tick,RigidArm,change,0,{name},,{count},{count},0")
            .expect("the host takes the lines");
    };
    for (name, change) in CHANGES {
        let mut arm = turning().expect("the bench's arm is accepted");
        let (changed, count) = watch.count(|| change(&mut arm));
        changed.expect("the bench's changes are accepted");
        line(name, count);
    }
    for (name, rated) in [("row with a rate", true), ("row without a rate", false)] {
        let mut arm = turning().expect("the bench's arm is accepted");
        let mut path = arm.path(Spline::Cubic).expect("a path");
        let (taken, count) = watch.count(|| rows(&mut arm, &mut path, black_box(rated)));
        taken.expect("the bench's rows are accepted");
        line(name, count / TAKEN);
    }
}

/// An arm in the middle of a move.
fn turning() -> Result<Arm, Error> {
    let scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.05 });
    let mut arm = Arm::new(Rigid::new(&scene, TICK)?, 0.0)?;
    arm.push(&Move::To { profile: Profile::Quintic, duration: 0.5, to: 1.0 })?;
    for _ in 0..20 {
        arm.tick();
    }
    Ok(arm)
}

/// Takes as many rows as there is room for, and looks ahead as far as a path does.
#[inline(never)]
fn rows(arm: &mut Arm, path: &mut Path, rated: bool) -> Result<(), Error> {
    let mut rows = (1..=24u32).map(|i| {
        let sign = if i % 2 == 0 { -0.2 } else { 0.2 };
        let row = Waypoint::at(0.2 * f64::from(i), 1.0 + sign);
        if rated { row.turning(0.5 * sign) } else { row }
    });
    arm.feed(path, &mut rows).map(drop).map_err(|refused| refused.error)
}
