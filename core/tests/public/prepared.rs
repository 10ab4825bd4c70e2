//! Steppers that were set up elsewhere and are loaded from words.

use stillbeam::model::{EightElements, FourElements, OneElement, Rod};
use stillbeam::planner::{Planner, Request};
use stillbeam::prepared::{Prepare, Prepared};
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::{Elastica, Modal, Newmark, OnCarrier, Quality, Rigid};
use stillbeam::{Damping, Error, Generator, Hub, Link, Move, Profile, Scene, Stepper};

const TICK: f64 = 0.010;

/// An arm with every term: hub, payload, damping, gravity.
fn scene() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.030;
    scene.hub = Hub { radius: 0.03, inertia: 1e-4, stiffness: Some(40.0) };
    scene.damping = Damping { alpha: 0.1, beta: 1e-4, joint: 1e-3 };
    scene.gravity = 9.81;
    scene
}

fn words(stepper: &impl Prepare) -> Vec<u32> {
    let mut words = Vec::new();
    stepper.prepare(&mut |word| words.push(word));
    words
}

fn elastica() -> Elastica<f32, 2> {
    Elastica::new(&Rod::new(&scene()).unwrap(), TICK, Quality::Fast, 1.0).unwrap()
}

/// Every setpoint of a move and of the ringing after it, as bits.
fn run<S: Stepper<Scalar = f32>>(stepper: S) -> Vec<[u32; 5]> {
    let mut arm = Generator::<_, 8>::new(stepper, 0.2).unwrap();
    arm.push(&Move::To { profile: Profile::Cycloid, duration: 0.8, to: 1.2 }).unwrap();
    let mut ticks = Vec::new();
    for _ in 0..160 {
        let now = arm.tick();
        let all = [now.rate, now.acceleration, now.torque, now.tip[0], now.tip[1]];
        ticks.push(all.map(f32::to_bits));
    }
    ticks
}

#[track_caller]
fn comes_back<S: Prepared + Stepper<Scalar = f32> + std::fmt::Debug + Copy>(stepper: S) {
    let words = words(&stepper);
    let again = S::load(&words, TICK).expect("its own words");
    // Every number, -0 and all: two floats of different bits are written differently.
    assert_eq!(format!("{again:?}"), format!("{stepper:?}"));
    assert_eq!(run(again), run(stepper));
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let again = S::load_bytes(&bytes, TICK).expect("its own bytes");
    assert_eq!(format!("{again:?}"), format!("{stepper:?}"));
}

#[test]
fn every_method_comes_back_to_the_bit() {
    let arm = scene();
    comes_back(Rigid::<f32>::new(&arm, TICK).unwrap());
    let one = OneElement::consistent(&arm).unwrap();
    comes_back(Newmark::<f32, 2, 2>::new(&one, TICK).unwrap());
    comes_back(Newmark::<f32, 2, 2, false>::nodal(&one, TICK).unwrap());
    comes_back(Newmark::<f32, 8, 4>::new(&FourElements::consistent(&arm).unwrap(), TICK).unwrap());
    comes_back(Modal::<f32, 3>::new(&EightElements::consistent(&arm).unwrap(), TICK).unwrap());
    comes_back(elastica());
    let rod = Rod::<3>::new(&arm).unwrap();
    comes_back(Elastica::<f32, 3>::new(&rod, TICK, Quality::Fine, 1.0).unwrap());
    let mut carried = Scene::new(arm.link);
    carried.mount.carrier = 2.0;
    let build = |arm: &Scene| Elastica::<f32, 1>::new(&Rod::new(arm)?, TICK, Quality::Fast, 1.0);
    let stepper = OnCarrier::new(&carried, build).unwrap();
    let again = OnCarrier::<Elastica<f32, 1>>::load(&words(&stepper), TICK).unwrap();
    assert_eq!(run(again), run(stepper));
}

/// A loaded planner plans the same curve, to the bit.
#[test]
fn a_planner_comes_back_to_the_bit() {
    let mut counts = Vec::new();
    for planner in [Planner::new(&scene(), TICK), Planner::robust(&scene(), TICK, 0.1)] {
        let planner = planner.unwrap().with_load_limits(Some(50.0), None).unwrap();
        let words = words(&planner);
        let again = Planner::<f32, 2>::load(&words, TICK).expect("its own words");
        assert_eq!(format!("{again:?}"), format!("{planner:?}"));
        let duration = 1.5 * planner.first_period();
        let request = Request::from_rest(0.2, 0.9).duration(duration);
        assert_eq!(again.plan(&request), planner.plan(&request));
        assert!(planner.plan(&request).is_ok(), "{:?}", planner.plan(&request));
        let refused = Elastica::<f32, 2>::load(&words, TICK);
        assert!(matches!(refused, Err(Error::NotPrepared { parameter: "arm.method", .. })));
        counts.push(words.len());
    }
    // One arm in two resolutions, or three of them.
    assert!(2 * counts[0] < counts[1], "{counts:?}");
}

/// The choice of auto is loaded by the type of the stepper that it stands for.
#[test]
fn an_automatic_choice_is_prepared_as_the_stepper_itself() {
    let auto = Auto::<f32>::new(&scene(), TICK, Rung::Elastica(2, Quality::Fast), 1.0).unwrap();
    assert_eq!(words(&auto), words(&elastica()));
}

/// A change of any bit of any word is noticed, and words that are missing or too many.
#[test]
fn damaged_words_are_refused() {
    let words = words(&elastica());
    for i in 0..words.len() {
        for bit in [0, 13, 31] {
            let mut damaged = words.clone();
            damaged[i] ^= 1 << bit;
            let refused = Elastica::<f32, 2>::load(&damaged, TICK);
            assert!(matches!(refused, Err(Error::NotPrepared { .. })), "word {i}: {refused:?}");
        }
        assert!(Elastica::<f32, 2>::load(&words[..i], TICK).is_err(), "{i} words");
    }
    let longer = [&words[..], &[0]].concat();
    let refused = Elastica::<f32, 2>::load(&longer, TICK).expect_err("one word too many");
    assert!(matches!(refused, Error::NotPrepared { parameter: "arm.length", .. }));
}

#[test]
fn what_is_for_another_program_is_refused() {
    let words = words(&elastica());
    let parameter = |error: Error| match error {
        Error::NotPrepared { parameter, .. } | Error::OutOfRange { parameter, .. } => parameter,
        other => panic!("{other:?}"),
    };
    let refused = Modal::<f32, 2>::load(&words, TICK).expect_err("another method");
    assert_eq!(parameter(refused), "arm.method");
    let refused = Elastica::<f32, 3>::load(&words, TICK).expect_err("other sizes");
    assert_eq!(parameter(refused), "arm.sizes");
    let refused = Elastica::<f64, 2>::load(&words, TICK).expect_err("another scalar");
    assert_eq!(parameter(refused), "arm.sizes");
    let refused = Elastica::<f32, 2>::load(&words, 0.005).expect_err("another tick");
    assert_eq!(refused.to_string(), "arm.tick = 0.01: must be 0.005 s");
    let refused = Elastica::<f32, 2>::load_bytes(b"no arm at all", TICK).expect_err("other bytes");
    assert!(matches!(refused, Error::NotPrepared { parameter: "arm.bytes", .. }));
    let refused = Elastica::<f32, 2>::load_bytes(b"no arm but words", TICK).expect_err("bytes");
    assert_eq!(
        refused.to_string(),
        "arm.magic = 0x61206f6e: must be 0x41504253 in an arm prepared for this program; export it \
         anew"
    );
}
