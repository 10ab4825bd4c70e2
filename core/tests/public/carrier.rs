//! An arm on a carrier that turns: held against a hub that was spun up long before.

use stillbeam::model::{EightElements, FourElements, Model, OneElement, Rod};
use stillbeam::select::{Auto, Tolerance};
use stillbeam::stepper::{
    Elastica2, Modal2, Newmark, Newmark1, Newmark4, OnCarrier, Quality, Rigid,
};
use stillbeam::{
    Error, Generator, Hub, Link, Mount, Move, Payload, Profile, Scene, Setpoint, Stepper,
};

use crate::assert_near;

const TICK: f64 = 0.002;
const LENGTH: f64 = 0.4;

/// Rate of the carrier, rad/s.
const OMEGA: f64 = 6.0;

/// The paper's member D with 10 g at its tip and damping that ends a vibration within seconds.
fn resting() -> Scene {
    let mut scene = Scene {
        payload: Payload { mass: 0.01, ..Payload::default() },
        hub: Hub { radius: 0.05, ..Hub::default() },
        ..Scene::new(Link { length: LENGTH, mass: 0.0224, bending_stiffness: 0.46 })
    };
    scene.damping.beta = 2e-3;
    scene
}

fn carried() -> Scene {
    Scene { mount: Mount { carrier: OMEGA, ..Mount::ROTARY }, ..resting() }
}

/// Same shapes and same torque as of the same moves on top of a spin-up to Ω, long after it; the
/// hub's rate less by Ω. The spin-up is damped out before the move.
fn as_after_a_spin_up<S: Stepper<Scalar = f64>>(
    name: &str,
    make: impl Fn(&Scene) -> Result<S, Error>,
) {
    let on_carrier = OnCarrier::new(&carried(), &make).expect("a stepper");
    // Relative to the carrier: a spin-up by 2 rad/s, and back.
    let moves =
        |offset: f64| [offset + 2.0, offset].map(|rate| Move::SpinUp { duration: 0.4, rate });
    let mut arm = Generator::<_, 16>::new(on_carrier, 0.0).unwrap();
    let mut ticks = 0;
    for motion in moves(0.0) {
        ticks += arm.push(&motion).unwrap().ticks;
    }
    let mut hub = Generator::<_, 16>::new(make(&resting()).expect("a stepper"), 0.0).unwrap();
    hub.push(&Move::SpinUp { duration: 2.0, rate: OMEGA }).unwrap();
    hub.push(&Move::Dwell { duration: 6.0 }).unwrap();
    for motion in moves(OMEGA) {
        hub.push(&motion).unwrap();
    }
    for _ in 0..(8.0 / TICK + 0.5) as u32 {
        hub.tick();
    }
    let mut bent = 0.0_f64;
    for _ in 0..ticks + (0.3 / TICK) as u32 {
        let (setpoint, absolute) = (arm.tick(), hub.tick());
        assert_near(name, absolute.rate - OMEGA, setpoint.rate, 1e-9);
        for i in 0..2 {
            assert_near(name, absolute.tip[i], setpoint.tip[i], 1e-6 * LENGTH);
        }
        assert_near(name, absolute.torque, setpoint.torque, 1e-6);
        bent = bent.max(setpoint.deflection().abs());
    }
    assert!(name == "rigid" || bent > 5e-3 * LENGTH, "{name}: {bent} m");
    // A stepper that does not know of the carrier refuses it.
    assert!(make(&carried()).is_err(), "{name}");
}

#[test]
fn a_carrier_is_a_spin_up_long_before() {
    as_after_a_spin_up("rigid", |scene| Rigid::new(scene, TICK));
    as_after_a_spin_up("newmark", |scene| Newmark4::new(&FourElements::consistent(scene)?, TICK));
    as_after_a_spin_up("newmark, one element", |scene| {
        Newmark1::new(&OneElement::consistent(scene)?, TICK)
    });
    as_after_a_spin_up("newmark, lumped", |scene| {
        Newmark::<_, 4, 4>::new(&Model::lumped::<8>(scene)?, TICK)
    });
    as_after_a_spin_up("modal", |scene| Modal2::new(&EightElements::consistent(scene)?, TICK));
    as_after_a_spin_up("elastica", |scene| {
        Elastica2::new(&Rod::new(scene)?, TICK, Quality::Fine, 0.5)
    });
}

/// One lumped element gives way at 1.5 ω₁ of turning: refused by what carrier and hub turn
/// together, and told by what each turns alone.
#[test]
fn a_carrier_and_a_hub_are_too_fast_together() {
    let lumped = |carrier: f64| {
        let mut scene = resting();
        (scene.hub.radius, scene.mount.carrier) = (0.0, carrier);
        OnCarrier::new(&scene, |scene| Newmark::<f64, 1, 1>::new(&Model::lumped::<2>(scene)?, TICK))
    };
    let Err(Error::OutOfRange { parameter: "carrier.rate", value: 900.0, min, max, .. }) =
        lumped(900.0)
    else {
        panic!("a carrier that is too fast");
    };
    assert_eq!(min, -max);
    let carrier = 0.5 * max;
    let mut arm = Generator::<_, 8>::new(lumped(carrier).expect("a stepper"), 0.0).unwrap();
    let mut spin = |rate: f64| arm.push(&Move::SpinUp { duration: 1.0, rate });
    let Err(Error::TooFast { rate, max: most }) = spin(0.6 * max) else {
        panic!("too fast together");
    };
    assert_near("rate", rate, 0.6 * max, 1e-9);
    assert_near("most", most, 0.5 * max, 0.02 * max);
    assert!(spin(0.4 * max).is_ok());
}

/// A rate that elastica may hold for ever is too fast on a carrier that turns the same way.
#[test]
fn rates_that_are_held_are_told_relative_to_the_carrier() {
    let arm = OnCarrier::new(&carried(), |scene| Ok(elastica(scene))).expect("a stepper");
    let mut arm = Generator::<_, 8>::new(arm, 0.0).unwrap();
    let held = 0.1 / TICK;
    let mut spin = |rate: f64| arm.push(&Move::SpinUp { duration: 4.0, rate });
    let Err(Error::OutOfRange { parameter: "move.rate", value, min, max, .. }) = spin(held - 5.0)
    else {
        panic!("held too fast together");
    };
    assert_near("rate", value, held - 5.0, 1e-9);
    assert_near("least", min, -held - OMEGA, 1e-9);
    assert_near("most", max, held - OMEGA, 1e-9);
    assert!(spin(held - 7.0).is_ok());
}

/// Elastica of an arm for small moves.
fn elastica(scene: &Scene) -> Elastica2<f64> {
    Elastica2::new(&Rod::new(scene).unwrap(), TICK, Quality::Fine, 0.5).unwrap()
}

/// A method that is chosen on a carrier follows within its tolerance of the finest, and is finer
/// than on one that rests where the carrier bends the arm more.
#[test]
fn a_method_is_chosen_on_a_carrier() {
    let scene = carried();
    let tolerance = Tolerance { tip: 1e-3, torque: 0.05 };
    let moves = [Move::To { profile: Profile::Quintic, duration: 0.6, to: 0.5 }];
    let run = |arm: OnCarrier<Auto<f64>>| -> Vec<Setpoint<f64>> {
        let mut arm = Generator::<_, 16>::new(arm, 0.0).unwrap();
        let ticks = arm.push(&moves[0]).unwrap().ticks;
        (0..ticks + 30).map(|_| arm.tick()).collect()
    };
    let (auto, choice) =
        OnCarrier::<Auto<f64>>::choose(&scene, 0.01, 0.0, &moves, &tolerance).expect("a choice");
    assert!(choice.expected.tip <= 1e-3, "{choice:?}");
    let finest = stillbeam::select::Rung::FINEST;
    let finest = OnCarrier::<Auto<f64>>::of_rung(&scene, 0.01, finest, choice.bend).unwrap();
    for (chosen, fine) in run(auto).iter().zip(&run(finest)) {
        assert_near("tip", chosen.deflection(), fine.deflection(), 2e-3 * LENGTH);
    }
    // The choice for an arm that does not turn says so of one that does.
    let error = Auto::<f64>::choose(&scene, 0.01, 0.0, &moves, &tolerance).map(|_| ()).unwrap_err();
    assert!(matches!(error, Error::OutOfRange { .. }), "{error:?}");
}
