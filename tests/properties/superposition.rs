//! In the linear methods the answer to two motions together is the sum of the answers.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::hub::HubState;
use stillbeam::stepper::AnyMotion;
use stillbeam::{Angle, Move, Profile, Scene, Stepper};

use crate::arms::{TICK, Turn, level_arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{Numbers, arm, close, numbers, push, run};

#[derive(Debug)]
struct Two {
    scene: Scene,
    first: Turn,
    second: Turn,
    between: f64,
}

fn sum(a: &[Numbers], b: &[Numbers], reach: f64) -> Vec<Numbers> {
    let add = |(a, b): (&Numbers, &Numbers)| {
        let mut sum: Numbers = core::array::from_fn(|i| a[i] + b[i]);
        // Both shorten with their squares.
        sum[3] = reach;
        sum
    };
    a.iter().zip(b).map(add).collect()
}

/// A run's numbers without X.
fn level(run: &[Numbers], reach: f64) -> Vec<Numbers> {
    run.iter().map(|&[rate, a, torque, _, y]| [rate, a, torque, reach, y]).collect()
}

/// One move after the other, in one queue.
struct After(Two);

impl Property for After {
    fn holds<M: Method>(&self) -> TestCaseResult {
        if !M::LINEAR {
            return Ok(());
        }
        let Two { scene, first, second, between } = &self.0;
        let wait = |duration| Move::Dwell { duration };
        let of = |moves: &[Move]| -> Vec<Numbers> {
            run::<M, f64>(scene, 0.0, moves, 0).iter().map(numbers).collect()
        };
        let both = of(&[first.from(0.0), wait(*between), second.from(first.by)]);
        let alone = of(&[first.from(0.0), wait(between + second.duration)]);
        let other = of(&[wait(first.duration + between), second.from(0.0)]);
        let reach = scene.reach();
        close(M::NAME, reach, &level(&both, reach), &sum(&alone, &other, reach), 1e-9)
    }
}

/// Both at once: the hub's rates and accelerations added up, tick by tick.
struct Together(Two);

impl Property for Together {
    fn holds<M: Method>(&self) -> TestCaseResult {
        if !M::LINEAR {
            return Ok(());
        }
        let Two { scene, first, second, .. } = &self.0;
        let stepper = M::stepper::<f64>(scene, TICK).expect("an arm");
        // Accelerations that jump between two ticks have no place in a list of ticks.
        let smooth = |turn: &Turn| Turn { profile: Profile::Quintic, ..*turn };
        let [a, b] = [first, second].map(|turn| hubs::<M>(scene, &smooth(turn)));
        let together: Vec<HubState<f64>> = a
            .iter()
            .zip(&b)
            .map(|(a, b)| HubState {
                angle: a.angle.plus(b.angle.in_turns()),
                rate: a.rate + b.rate,
                acceleration: a.acceleration + b.acceleration,
                ..*a
            })
            .collect();
        let of = |hubs: &[HubState<f64>]| follow(&stepper, hubs);
        let reach = scene.reach();
        let both = level(&of(&together), reach);
        close(M::NAME, reach, &both, &sum(&of(&a), &of(&b), reach), 1e-9)
    }
}

/// The hub of a move, 400 ticks.
fn hubs<M: Method>(scene: &Scene, turn: &Turn) -> Vec<HubState<f64>> {
    let mut arm = arm::<M, f64>(scene, 0.0);
    push(&mut arm, &[turn.from(0.0)]);
    (0..400)
        .map(|_| {
            arm.tick();
            *arm.hub()
        })
        .collect()
}

/// Steps through the motion from rest.
fn follow<S: Stepper<Scalar = f64>>(stepper: &S, hubs: &[HubState<f64>]) -> Vec<Numbers> {
    let rest = HubState { angle: Angle::default(), rate: 0.0, acceleration: 0.0, ..hubs[0] };
    let mut state = stepper.equilibrium(&rest);
    let mut before = rest;
    hubs.iter()
        .map(|hub| {
            stepper.step::<AnyMotion>(&mut state, &before, hub);
            before = *hub;
            let answer = stepper.response::<AnyMotion>(&state, hub);
            [hub.rate, hub.acceleration, answer.torque, answer.tip[0], answer.tip[1]]
        })
        .collect()
}

fn two() -> impl Strategy<Value = Two> {
    (level_arms(), turns(), turns(), 0_u32..50).prop_map(|(scene, first, second, between)| Two {
        first: first.gentle(&scene),
        second: second.gentle(&scene),
        scene,
        between: f64::from(between.max(1)) * TICK,
    })
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn a_move_after_another_adds_up(two in two()) {
        all(&After(two))?;
    }

    #[test]
    fn motions_at_once_add_up(two in two()) {
        all(&Together(two))?;
    }
}
