//! Cost of planning a still move, outside the tick. Set-up is the planner's.

use core::fmt::Write;
use core::hint::black_box;

use stillbeam::planner::{Request, Target};
use stillbeam::scene::Uniform;
use stillbeam::stepper::ArmState;
use stillbeam::{
    Angle, Damping, Error, Hub, HubState, Limits, Link, Payload, Profile, UniformScene,
};

use crate::stopwatch::{Counter, Stopwatch};

const TICK: f64 = 0.010;
const TURN: f64 = core::f64::consts::PI;

/// Member D bare, as in `d-fast`.
const D: UniformScene =
    UniformScene::uniform(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });

/// Member A with 30 g, as in `a-tip30`.
const A: UniformScene = UniformScene {
    payload: Payload { mass: 0.03, inertia: 0.0, offset: 0.0 },
    ..UniformScene::uniform(Link { length: 0.4, mass: 0.00952, bending_stiffness: 0.0213344 })
};

/// Member B with 30 g, damped, on a hub, as in `b-tip30-damped-hub`.
const B: UniformScene = UniformScene {
    link: Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 },
    shape: Uniform,
    hub: Hub { radius: 0.04, inertia: 1e-4, stiffness: None },
    damping: Damping { alpha: 0.15, beta: 0.002, joint: 0.0 },
    ..A
};

type Planner = stillbeam::planner::Planner<f32, 2>;
/// A move by `TURN` in `duration` s, searched for but not simulated once more for its deflection.
fn half_turn(duration: f64) -> Request<f32, 2> {
    Request::from_rest(0.0, TURN).duration(duration).any_deflection()
}

/// Knots of the acceleration in half of a fastest move.
const KNOTS: usize = 12;

/// Plans by the request and keeps what was planned from being left out.
fn still(planner: &Planner, request: &Request<f32, 2>) -> Result<(), Error> {
    black_box(planner.plan(request)?);
    Ok(())
}

/// The fastest move by half a turn within limits; an error where there is none.
fn fastest(planner: &Planner, limits: Limits) -> Result<(), Error> {
    let request = Request::from_rest(0.0, TURN).limits(limits).any_deflection();
    let plan = planner.fastest::<KNOTS>(&request)?.ok_or(Error::NotAtRest { rate: 0.0 })?;
    black_box(plan);
    Ok(())
}

/// Limits that a cubic of three first periods just keeps.
fn of_a_cubic(planner: &Planner) -> Limits {
    let peaks = Profile::Cubic.peaks(TURN, 3.0 * planner.first_period());
    Limits { acceleration: Some(peaks.acceleration), ..Limits::default() }
}

/// Limits that an S-curve of two first periods just keeps.
fn of_an_s_curve(planner: &Planner) -> Limits {
    let peaks = Profile::SCurve.peaks(TURN, 2.0 * planner.first_period());
    let [rate, acceleration, jerk] = [peaks.rate, peaks.acceleration, peaks.jerk].map(Some);
    Limits { rate, acceleration, jerk, ..Limits::default() }
}

/// Rate and torque of a rigid arm that turns in two first periods, a third of the time speeding up.
fn of_a_rigid_arm(planner: &Planner) -> Limits {
    let duration = 2.0 * planner.first_period();
    let rigid = Profile::Trapezoid.peaks(TURN, duration);
    let inertia = (A.link.mass / 3.0 + A.payload.mass) * A.link.length * A.link.length;
    Limits {
        rate: Some(rigid.rate),
        acceleration: Some(12.0 * TURN / (duration * duration)),
        torque: Some(inertia * rigid.acceleration),
        ..Limits::default()
    }
}

/// A rate a tenth above the mean of a move of ten first periods: the hub cruises.
fn of_a_cruise(planner: &Planner) -> Limits {
    let rate = 1.1 * TURN / (10.0 * planner.first_period());
    Limits { rate: Some(rate), ..Limits::default() }
}

type Plan = fn(&Planner) -> Result<(), Error>;

/// Plans to be counted: method, name, arm, spread of its frequency, plan.
const PLANS: [(&str, &str, &UniformScene, f64, Plan); 12] = [
    (STILL, "d-fast", &D, 0.0, |planner| still(planner, &half_turn(0.2))),
    (STILL, "a-tip30", &A, 0.0, |planner| still(planner, &half_turn(2.0))),
    (STILL, "damped", &B, 0.0, |planner| still(planner, &half_turn(2.0))),
    (STILL, "gravity", &UniformScene { gravity: 0.5, ..B }, 0.0, |planner| {
        still(planner, &half_turn(2.0))
    }),
    (STILL, "redirected", &D, 0.0, |planner| {
        // In the middle of a move, the arm bent and moving.
        let from = HubState {
            acceleration: 90.0,
            ..HubState::turning(Angle { turns: 0, part: 0.1 }, 8.0)
        };
        let flex = ArmState { coordinate: [-0.003, 0.0], rate: [0.1, 0.0] };
        let request = Request::from_hub(from, Target::Angle(1.0)).arm(flex).duration(0.2);
        still(planner, &request.any_deflection())
    }),
    (STILL, "robust", &A, 0.2, |planner| still(planner, &half_turn(2.26))),
    (STILL, "shortest within an S-curve's limits", &A, 0.0, |planner| {
        let request = Request::from_rest(0.0, TURN).limits(of_an_s_curve(planner));
        still(planner, &request.any_deflection())
    }),
    (FASTEST, "fastest within an S-curve's limits", &A, 0.0, |planner| {
        fastest(planner, of_an_s_curve(planner))
    }),
    (FASTEST, "fastest within a cubic's acceleration", &A, 0.0, |planner| {
        fastest(planner, of_a_cubic(planner))
    }),
    (FASTEST, "fastest within torque and rate", &A, 0.0, |planner| {
        fastest(planner, of_a_rigid_arm(planner))
    }),
    (FASTEST, "fastest with a cruise", &A, 0.0, |planner| fastest(planner, of_a_cruise(planner))),
    (FASTEST, "fastest in one period", &D, 0.0, |planner| {
        let peaks = Profile::SCurve.peaks(TURN, planner.first_period());
        let [rate, acceleration, jerk] = [peaks.rate, peaks.acceleration, peaks.jerk].map(Some);
        fastest(planner, Limits { rate, acceleration, jerk, ..Limits::default() })
    }),
];

/// Names of the minimal images with a plan of that kind.
const STILL: &str = "Still2";
const FASTEST: &str = "Fastest2";

/// Prints a line a plan, in the form of a tick's.
pub fn print<C: Counter>(watch: &Stopwatch<C>, output: &mut impl Write) {
    for (id, name, scene, spread, plan) in PLANS {
        let (planner, setup) = watch.count(|| set_up(black_box(scene), black_box(spread)));
        let planner = planner.expect("the bench's scenes are accepted");
        let (found, count) = watch.count(|| plan(black_box(&planner)));
        found.expect("the bench's moves are accepted");
        writeln!(output, "tick,{id},plan,2,{name},,{count},{count},{setup}")
            .expect("the host takes the lines");
    }
}

#[inline(never)]
fn set_up(scene: &UniformScene, spread: f64) -> Result<Planner, Error> {
    if spread == 0.0 { Planner::new(scene, TICK) } else { Planner::robust(scene, TICK, spread) }
}
