//! Faults that the campaign has found, each as a case of its own.

use stillbeam::axis::Mode;
use stillbeam::model::OneElement;
use stillbeam::planner::{Planner, Request};
use stillbeam::stepper::Newmark;
use stillbeam::{Error, Generator, Move, Payload, PlainMove, Profile, UniformScene};
use stillbeam_board::machine::{CONFIGURATIONS, TICK};
use stillbeam_board::{Board, Drive, PERIOD};
use stillbeam_protocol::Command;

type Arm = Generator<Newmark<f32, 2, 2>, 8>;

fn scene() -> UniformScene {
    CONFIGURATIONS[0].scene
}

fn arm() -> Arm {
    let model = OneElement::consistent(&scene()).expect("a model");
    let mut arm: Arm =
        Generator::new(Newmark::new(&model, TICK).expect("a stepper"), 0.0).expect("an angle");
    arm.limit(CONFIGURATIONS[0].policy.limits).expect("limits");
    arm
}

/// As a board plans what came over its line.
fn plan(motion: &Move) -> Result<(), Error> {
    arm().plan_context().plan::<f32>(motion).map(drop)
}

fn planned_still() -> Move {
    Planner::<f32, 2>::new(&scene(), TICK)
        .and_then(|s| s.plan(&Request::from_rest(0.0, 0.4).duration(2.0)))
        .expect("a plan")
        .motion()
}

#[test]
fn a_still_move_as_planned_is_taken() {
    assert_eq!(plan(&planned_still()), Ok(()));
}

/// A still move's peaks were taken on trust: any bulge passed the limits, and one that is no number
/// went out as setpoints. Between the ticks too: of a move of one tick all that is violent lies
/// there.
#[test]
fn a_still_move_is_judged_by_its_own_curve() {
    let Move::Still { duration, to, bulge } = planned_still() else { unreachable!() };
    let violent = [
        Move::Still { duration, to, bulge: [f64::NAN; 6] },
        Move::Still { duration, to, bulge: [f64::INFINITY; 6] },
        Move::Still { duration, to, bulge: bulge.map(|b| b + 5.0) },
        Move::Still { duration: 0.1 * duration, to, bulge },
        Move::Still { duration: TICK, to, bulge },
    ];
    for motion in violent {
        assert!(plan(&motion).is_err(), "{motion:?}");
        assert!(arm().push(&motion).is_err(), "{motion:?}");
    }
}

/// The angle of a move of many turns is known as a part of them: it went in steps.
#[test]
fn a_move_of_more_turns_than_a_float_resolves_is_refused() {
    let far = |to| Move::To { profile: Profile::Quintic, duration: 1e5, to };
    assert_eq!(plan(&far(800.0)), Ok(()));
    let error = plan(&far(1e5)).expect_err("16,000 turns");
    assert_eq!(error.to_string(), "move: turns = 15915.494309189535: must be -128 to 128 turns");
}

/// Of a payload that turns hard and weighs little, an f32 along principal axes kept a mass matrix
/// with a negative direction: from the first tick on nothing was finite.
#[test]
fn a_payload_that_hides_the_arm_from_a_float_is_refused() {
    for configuration in &CONFIGURATIONS {
        let UniformScene { link, .. } = configuration.scene;
        for mass in [0.0, 1e-30, 1e-3, 0.05] {
            let most = 100.0 * (link.mass + mass) * link.length * link.length;
            let with = |inertia| UniformScene {
                payload: Payload { mass, inertia, offset: 0.0 },
                ..configuration.scene
            };
            let error = with(1.001 * most).validate().expect_err("beyond ten lengths");
            assert!(error.to_string().starts_with("payload.inertia = "), "{error}");
            let model = OneElement::consistent(&with(most)).expect("a model");
            let stepper = Newmark::<f32, 2, 2>::new(&model, TICK).expect("a stepper");
            let mut arm = Generator::<_, 8>::new(stepper, 0.3).expect("an angle");
            arm.push(&Move::SpinUp { duration: 1.0, rate: 2.0 }).expect("a move");
            for _ in 0..2_000 {
                let setpoint = arm.tick();
                assert!(setpoint.torque.is_finite() && setpoint.tip[1].abs() < 5.0);
            }
        }
    }
}

/// Where a stop ends no shorter than the move does, the move is finished; one of less than an
/// angle's resolution was, whatever it lasted.
#[test]
fn a_stop_does_not_wait_for_a_move_that_goes_nowhere() {
    for to in [1e-12, 1e-9, 1e-7, 1e-5] {
        let mut board = Board::new(&CONFIGURATIONS[0], 0).expect("a board");
        let drive = Drive::at(0.125);
        board.hear_drive(&drive.report(board.node()));
        board.ask(Command::Home(0.0));
        board.ask(Command::Enable);
        board.ask(Command::Move(PlainMove::To { profile: Profile::Cubic, duration: 1e5, to }));
        assert!(board.answers.iter().all(Result::is_ok), "{:?}", board.answers);
        for k in 1..40 {
            if k == 20 {
                board.ask(Command::Stop);
            }
            board.tick(k * PERIOD);
        }
        assert_eq!(board.axis().mode(), Mode::Stopped, "{to}");
    }
}
