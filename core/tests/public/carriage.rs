//! An arm on a carriage: held against a hub whose radius goes to infinity, and against gravity.

use std::f64::consts::{FRAC_PI_2, PI};

use stillbeam::model::{EightElements, FourElements, Model, OneElement, Rod};
use stillbeam::planner::{Planner, Request};
use stillbeam::select::{Auto, Tolerance};
use stillbeam::stepper::{Elastica2, Modal2, Newmark, Newmark1, Newmark4, Quality, Rigid};
use stillbeam::{Generator, Hub, Link, Mount, Move, Payload, Profile, Scene, Setpoint, Stepper};

use crate::assert_near;

const TICK: f64 = 0.002;
const FAR: f64 = 1e3;
const LENGTH: f64 = 0.4;

/// The paper's member D with 10 g at its tip.
fn member_d() -> Scene {
    Scene {
        payload: Payload { mass: 0.01, ..Payload::default() },
        ..Scene::new(Link { length: LENGTH, mass: 0.0224, bending_stiffness: 0.46 })
    }
}

/// The arm on a carriage of 0.3 kg.
fn carried() -> Scene {
    Scene { hub: Hub { inertia: 0.3, ..Hub::default() }, mount: Mount::LINEAR, ..member_d() }
}

/// The arm on a hub so large that its rim is straight, with as much inertia.
fn on_a_large_hub() -> Scene {
    Scene { hub: Hub { radius: FAR, inertia: 0.3 * FAR * FAR, ..Hub::default() }, ..member_d() }
}

/// Setpoints of a motion from 0, and of a rest after it.
fn setpoints<S: Stepper<Scalar = f64>>(stepper: S, moves: &[Move]) -> Vec<Setpoint<f64>> {
    let tick = stepper.tick();
    let mut arm = Generator::<S, 16>::new(stepper, 0.0).expect("a generator");
    let mut ticks = 0;
    for motion in moves {
        ticks += arm.push(motion).expect("a move").ticks;
    }
    (0..ticks + (0.3 / tick) as u32).map(|_| arm.tick()).collect()
}

fn by(distance: f64) -> [Move; 1] {
    [Move::To { profile: Profile::Quintic, duration: 0.6, to: distance }]
}

/// Deflection within 2e-4 of L and force within 2e-3 of its peak of the large hub's.
fn as_on_a_large_hub<S: Stepper<Scalar = f64>>(name: &str, make: impl Fn(&Scene) -> S) {
    let on_carriage = setpoints(make(&carried()), &by(0.5));
    let on_hub = setpoints(make(&on_a_large_hub()), &by(0.5 / FAR));
    let peak = |of: &dyn Fn(&Setpoint<f64>) -> f64| {
        on_carriage.iter().map(|setpoint| of(setpoint).abs()).fold(0.0, f64::max)
    };
    let force = peak(&|setpoint| setpoint.torque);
    // The carriage's own share alone: 0.3 kg at 5.77 · 0.5 / 0.36 m/s².
    assert!(force > 2.4, "{name}: {force} N");
    assert!(name == "rigid" || peak(&|setpoint| setpoint.deflection()) > 0.004, "{name}");
    for (a, b) in on_carriage.iter().zip(&on_hub) {
        let [x, y] = [0, 1].map(|i| a.tip[i] - b.tip[i]);
        assert_near(name, y, 0.0, 2e-4 * LENGTH);
        assert_near(name, x + FAR, 0.0, 2e-4 * LENGTH);
        assert_near(name, a.torque, b.torque / FAR, 2e-3 * force);
        let [along, across] = a.global_tip_on(carried().mount.axis);
        assert_eq!((along, across), (a.tip[0], a.tip[1] + a.angle.radians()), "{name}");
    }
}

#[test]
fn every_method_moves_a_carriage_as_a_hub_of_infinite_radius() {
    as_on_a_large_hub("rigid", |scene| Rigid::new(scene, TICK).unwrap());
    as_on_a_large_hub("newmark", |scene| {
        Newmark4::new(&FourElements::consistent(scene).unwrap(), TICK).unwrap()
    });
    as_on_a_large_hub("newmark, one element", |scene| {
        Newmark1::new(&OneElement::consistent(scene).unwrap(), TICK).unwrap()
    });
    as_on_a_large_hub("newmark, lumped", |scene| {
        Newmark::<_, 4, 4>::new(&Model::lumped::<8>(scene).unwrap(), TICK).unwrap()
    });
    as_on_a_large_hub("modal", |scene| {
        Modal2::new(&EightElements::consistent(scene).unwrap(), TICK).unwrap()
    });
    as_on_a_large_hub("elastica", |scene| {
        Elastica2::new(&Rod::new(scene).unwrap(), TICK, Quality::Fast, 0.5).unwrap()
    });
    as_on_a_large_hub("elastica, fine", |scene| {
        Elastica2::new(&Rod::new(scene).unwrap(), TICK, Quality::Fine, 0.5).unwrap()
    });
}

/// Elastica of an arm for small moves.
fn elastica(scene: &Scene) -> Elastica2<f64> {
    Elastica2::new(&Rod::new(scene).unwrap(), TICK, Quality::Fine, 0.5).unwrap()
}

/// Gravity along the axis: the sag of a level arm, and the weight of all that moves.
#[test]
fn a_carriage_on_a_vertical_axis_carries_its_whole_weight() {
    let lifted = Scene { gravity: 9.81, ..carried() };
    let level = Scene { gravity: 9.81, ..member_d() };
    let still = [Move::Dwell { duration: 0.1 }];
    let on_carriage = setpoints(elastica(&lifted), &still)[0];
    let on_hub = setpoints(elastica(&level), &still)[0];
    assert!(on_hub.deflection() < -0.004, "{}", on_hub.deflection());
    assert_near("sag", on_carriage.deflection(), on_hub.deflection(), 1e-8);
    let force = on_carriage.torque;
    assert_near("force", force, 9.81 * (0.3 + 0.0224 + 0.01), 1e-9);
    // Wherever the carriage is: its position turns nothing.
    let mut elsewhere = Generator::<_, 8>::new(elastica(&lifted), PI).unwrap();
    let there = elsewhere.tick();
    assert_eq!((there.tip, there.torque), (on_carriage.tip, on_carriage.torque));
}

/// Gravity along the link stiffens one that hangs and softens one that stands, and puts no force on
/// the axis of a straight link.
#[test]
fn a_link_hangs_from_its_carriage_or_stands_on_it() {
    let along = |direction| Scene {
        gravity: 9.81,
        mount: Mount { direction, ..Mount::LINEAR },
        ..carried()
    };
    // The hub of infinite radius again, gravity turned along its radius.
    let far = |direction| Scene {
        gravity: 9.81,
        mount: Mount { direction, ..Mount::ROTARY },
        ..on_a_large_hub()
    };
    let mut shapes = Vec::new();
    for direction in [FRAC_PI_2, -FRAC_PI_2] {
        let on_carriage = setpoints(elastica(&along(direction)), &by(0.5));
        let on_hub = setpoints(elastica(&far(direction)), &by(0.5 / FAR));
        assert_near("at rest", on_carriage[0].torque, 0.0, 1e-12);
        for (a, b) in on_carriage.iter().zip(&on_hub) {
            assert_near("deflection", a.deflection(), b.deflection(), 3e-4 * LENGTH);
        }
        let modal = Modal2::new(&EightElements::consistent(&along(direction)).unwrap(), TICK);
        let linear = setpoints(modal.unwrap(), &by(0.5));
        for (a, b) in on_carriage.iter().zip(&linear) {
            assert_near("linear", a.deflection(), b.deflection(), 2e-3 * LENGTH);
        }
        shapes.push(on_carriage);
    }
    let apart = shapes[0].iter().zip(&shapes[1]).map(|(a, b)| (a.tip[1] - b.tip[1]).abs());
    assert!(apart.fold(0.0, f64::max) > 2e-3 * LENGTH, "gravity does nothing");
}

/// A link that buckles where it stands is refused there, and not where it hangs.
#[test]
fn only_a_standing_link_buckles() {
    let at = |direction| {
        let link = Link { length: 1.0, mass: 1.0, bending_stiffness: 1.0 };
        let mount = Mount { direction, ..Mount::LINEAR };
        EightElements::consistent(&Scene { gravity: 9.81, mount, ..Scene::new(link) })
    };
    assert!(at(FRAC_PI_2).is_ok());
    assert!(at(-FRAC_PI_2).is_err());
}

/// A plane that leans by an angle from the vertical feels `g cos`.
#[test]
fn a_tilted_plane_is_weaker_gravity_to_the_bit() {
    let tilted = Scene { gravity: 9.81, mount: Mount { tilt: 1.0, ..Mount::ROTARY }, ..member_d() };
    let weaker = tilted.in_plane_gravity();
    assert_near("g cos", weaker, 9.81 * 1.0_f64.cos(), 1e-14);
    let upright = Scene { gravity: weaker, ..member_d() };
    assert_eq!(setpoints(elastica(&tilted), &by(0.5)), setpoints(elastica(&upright), &by(0.5)));
    let level = Scene { mount: Mount { tilt: FRAC_PI_2, ..Mount::ROTARY }, ..tilted };
    assert_eq!(level.in_plane_gravity(), 0.0);
}

/// To turn gravity one way is to turn the hub the other way.
#[test]
fn turned_gravity_is_a_turned_hub() {
    let plain = Scene { gravity: 9.81, ..member_d() };
    let turned = Scene { mount: Mount { direction: 0.7, ..Mount::ROTARY }, ..plain };
    let run = |scene: &Scene, from: f64| {
        let mut arm = Generator::<_, 8>::new(elastica(scene), from).unwrap();
        arm.push(&Move::To { profile: Profile::Quintic, duration: 0.6, to: from + 0.5 }).unwrap();
        (0..400).map(|_| arm.tick()).collect::<Vec<_>>()
    };
    for (a, b) in run(&plain, -0.2).iter().zip(&run(&turned, 0.5)) {
        assert_near("deflection", b.deflection(), a.deflection(), 1e-12);
        assert_near("torque", b.torque, a.torque, 1e-12);
    }
}

/// A still move leaves nothing: neither a vibration nor work of the force.
#[test]
fn a_still_move_on_a_carriage_leaves_nothing() {
    for scene in [carried(), Scene { gravity: 9.81, ..carried() }] {
        let planner = Planner::<f64, 2>::new(&scene, TICK).unwrap();
        let duration = 2.0 * planner.first_period();
        let plan = planner.plan(&Request::from_rest(0.0, 0.3).duration(duration)).unwrap();
        assert!(plan.residual < 1e-4, "{}", plan.residual);
        let bend = Rod::<2>::new(&scene).unwrap().bend(plan.peaks.acceleration);
        let rod = Rod::new(&scene).unwrap();
        let stepper = Elastica2::<f64>::new(&rod, TICK, Quality::Fine, bend).unwrap();
        let run = setpoints(stepper, &[plan.motion()]);
        let moving = plan.ticks as usize;
        let rest = run[0].deflection();
        for setpoint in &run[moving..] {
            assert_near("residual", setpoint.deflection(), rest, 2e-4 * LENGTH);
        }
        let weight = run[0].torque;
        let work: f64 = run[..=moving].iter().map(|s| (s.torque - weight) * s.rate * TICK).sum();
        let peak = run.iter().map(|s| s.rate.abs()).fold(0.0, f64::max);
        assert_near("work", work, 0.0, 1e-4 * 0.5 * 0.33 * peak * peak);
    }
}

/// A method that is chosen follows the carriage within its tolerance of the finest.
#[test]
fn a_method_is_chosen_for_a_carriage() {
    let scene = carried();
    let tolerance = Tolerance { tip: 1e-3, torque: 0.05 };
    let (auto, choice) =
        Auto::<f64>::choose(&scene, 0.01, 0.0, &by(0.5), &tolerance).expect("a choice");
    assert!(choice.expected.tip <= 1e-3);
    let chosen = setpoints(auto, &by(0.5));
    let fine = setpoints(elastica(&scene), &by(0.5));
    for (k, setpoint) in chosen.iter().enumerate() {
        let exact = &fine[5 * k];
        assert_near("tip", setpoint.deflection(), exact.deflection(), 2e-3 * LENGTH);
    }
}

/// A link cannot tell an even velocity from rest: what a fast run-up leaves rings on as it would on
/// a carriage that rests, whatever the velocity.
#[test]
fn an_even_velocity_does_nothing_to_the_link() {
    for velocity in [1.0, 8.0] {
        let run_up = [
            Move::SpinUp { duration: 0.13 * velocity + 0.05, rate: velocity },
            Move::Dwell { duration: 2.0 },
        ];
        let rod = Rod::new(&carried()).unwrap();
        let bend = rod.bend(16.0);
        let exact = Elastica2::<f64>::new(&rod, TICK, Quality::Fine, bend).unwrap();
        let model = EightElements::consistent(&carried()).unwrap();
        let linear = Modal2::<f64>::new(&model, TICK).unwrap();
        let [exact, linear] = [setpoints(exact, &run_up), setpoints(linear, &run_up)];
        let most = |run: &[Setpoint<f64>], from: usize| {
            run[from..from + 250].iter().map(|s| s.deflection().abs()).fold(0.0, f64::max)
        };
        let arrival = (run_up[0].ticks(TICK).unwrap()) as usize;
        let (first, last) = (most(&exact, arrival), most(&exact, arrival + 750));
        assert!(last < 1.02 * first + 1e-6, "{velocity} m/s: {first} m, then {last} m");
        let expected = most(&linear, arrival + 750);
        assert_near("amplitude", last, expected, 0.1 * expected + 1e-4 * LENGTH);
    }
}
