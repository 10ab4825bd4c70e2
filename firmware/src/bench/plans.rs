//! Cost of planning a still move, outside the tick. Set-up is the planner's.

use core::fmt::Write;
use core::hint::black_box;

use stillbeam::planner::{Request, StillMove, Target};
use stillbeam::scene::Uniform;
use stillbeam::stepper::ArmState;
use stillbeam::{Angle, Damping, Error, Hub, HubState, Link, Payload, UniformScene};
use stillbeam_firmware::counter::{Counter, Stopwatch};

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

type Plan = fn(&Planner) -> Result<StillMove, Error>;

/// Plans to be counted: name, arm, spread of its frequency, plan.
const PLANS: [(&str, &UniformScene, f64, Plan); 6] = [
    ("d-fast", &D, 0.0, |planner| planner.plan(&half_turn(0.2))),
    ("a-tip30", &A, 0.0, |planner| planner.plan(&half_turn(2.0))),
    ("damped", &B, 0.0, |planner| planner.plan(&half_turn(2.0))),
    ("gravity", &UniformScene { gravity: 0.5, ..B }, 0.0, |planner| planner.plan(&half_turn(2.0))),
    ("redirected", &D, 0.0, |planner| {
        // In the middle of a move, the arm bent and moving.
        let from = HubState {
            acceleration: 90.0,
            ..HubState::turning(Angle { turns: 0, part: 0.1 }, 8.0)
        };
        let flex = ArmState { coordinate: [-0.003, 0.0], rate: [0.1, 0.0] };
        let request = Request::from_hub(from, Target::Angle(1.0)).arm(flex).duration(0.2);
        planner.plan(&request.any_deflection())
    }),
    ("robust", &A, 0.2, |planner| planner.plan(&half_turn(2.26))),
];

/// Prints a line a plan, in the form of a tick's.
pub fn print<C: Counter>(watch: &Stopwatch<C>, output: &mut impl Write) {
    for (name, scene, spread, plan) in PLANS {
        let (planner, setup) = watch.count(|| set_up(black_box(scene), black_box(spread)));
        let planner = planner.expect("the bench's scenes are accepted");
        let (found, count) = watch.count(|| plan(black_box(&planner)));
        found.expect("the bench's moves are accepted");
        writeln!(output, "tick,Still2,plan,2,{name},,{count},{count},{setup}")
            .expect("the host takes the lines");
    }
}

#[inline(never)]
fn set_up(scene: &UniformScene, spread: f64) -> Result<Planner, Error> {
    if spread == 0.0 { Planner::new(scene, TICK) } else { Planner::robust(scene, TICK, spread) }
}
