use stillbeam::hub::HubState;
use stillbeam::model::{EightElements, OneElement, Rod};
use stillbeam::stepper::{Elastica, Modal, Newmark, Quality, Stepper};
use stillbeam::{Generator, Link, Move, Profile, Scene, Setpoint};

fn scene() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.03;
    scene
}

const MOVES: [Move; 4] = [
    Move::To { profile: Profile::Quintic, duration: 0.3, to: 1.0 },
    Move::Dwell { duration: 0.1 },
    Move::SpinUp { duration: 0.3, rate: 2.0 },
    Move::Pass { profile: Profile::Quintic, duration: 0.4, to: 1.5, rate: 0.0 },
];

/// Follows the hub of a queue's run and compares every bit of every setpoint.
fn same_bits<S: Stepper<Scalar = f32> + Clone>(stepper: S, moves: &[Move], linear: bool) {
    let tick = stepper.tick();
    let [ticks, border] = [1.3, 0.1].map(|time| (time / tick + 0.5) as u32);
    let mut queue = Generator::<_, 16>::new(stepper.clone(), 0.2).expect("generator");
    let mut follower = Generator::<_, 1>::new(stepper, 0.2).expect("generator");
    for motion in moves {
        queue.push(motion).expect("a move");
    }
    for k in 0..ticks {
        let expected: Setpoint<f32> = queue.tick();
        let before = queue.setpoint_before().acceleration;
        let followed = if linear {
            // The first tick of a segment takes no fast path.
            follower.follow_exactly(queue.hub(), before, k % border != 0)
        } else {
            follower.follow(queue.hub())
        };
        assert_eq!(followed, expected, "tick {k} of {tick} s");
        assert_eq!(follower.setpoint_before(), queue.setpoint_before(), "tick {k}");
    }
}

/// Followed states have the bits of the queue's run, in every method and at every tick length.
#[test]
fn a_followed_hub_has_the_bits_of_the_queue() {
    for gravity in [0.0, 9.81] {
        let mut scene = scene();
        scene.gravity = gravity;
        for tick in [0.01, 0.001, 0.000_25] {
            let one = OneElement::consistent(&scene).expect("model");
            same_bits(Newmark::<f32, 2, 2>::new(&one, tick).expect("stepper"), &MOVES, false);
            let eight = EightElements::consistent(&scene).expect("model");
            same_bits(Modal::<f32, 2>::new(&eight, tick).expect("stepper"), &MOVES, false);
            let rod = Rod::<2>::new(&scene).expect("rod");
            let stepper = Elastica::<f32, 2>::new(&rod, tick, Quality::Fast, rod.bend(100.0));
            same_bits(stepper.expect("stepper"), &MOVES, false);
        }
    }
}

/// Jumps of the acceleration and straight lines too, if they are told.
#[test]
fn a_followed_jump_has_the_bits_of_the_queue() {
    let moves = [
        Move::To { profile: Profile::Cubic, duration: 0.1, to: 0.25 },
        Move::To { profile: Profile::Cubic, duration: 0.1, to: 0.1 },
        Move::To { profile: Profile::Trapezoid, duration: 0.3, to: 0.4 },
    ];
    for tick in [0.01, 0.001, 0.000_25] {
        let eight = EightElements::consistent(&scene()).expect("model");
        same_bits(Modal::<f32, 2>::new(&eight, tick).expect("stepper"), &moves, true);
    }
}

/// A tick without a state goes on at the last one's rate, and a move begins from there.
#[test]
fn a_hub_that_is_no_longer_followed_goes_on() {
    let one = OneElement::consistent(&scene()).expect("model");
    let stepper = Newmark::<f32, 2, 2>::new(&one, 0.01).expect("stepper");
    let mut arm = Generator::<_, 4>::new(stepper, 0.0).expect("generator");
    let (mut angle, mut rate) = (0.0f64, 0.0f64);
    for k in 1..=100 {
        // 2 rad/s² for half a second.
        let acceleration = if k <= 50 { 2.0 } else { 0.0 };
        angle += 0.01 * rate + 0.5 * acceleration * 1e-4;
        rate += 0.01 * acceleration;
        let hub = HubState { acceleration, ..HubState::turning(turns(angle), rate) };
        let hub = HubState::<f32> {
            acceleration: acceleration as f32,
            ..HubState::turning(hub.angle.cast(), rate as f32)
        };
        arm.follow(&hub);
    }
    let last = arm.setpoint();
    assert!(arm.is_holding());
    for k in 1..=1000 {
        let now = arm.tick();
        let expected = angle + 0.01 * f64::from(k) * f64::from(last.rate);
        // The rate itself is rounded: 2e-7 of what it has turned by.
        let bound = 1e-6 + 2e-7 * (expected - angle);
        assert!((now.angle.radians() - expected).abs() < bound, "{k}: {now:?}");
        assert_eq!(now.rate, last.rate);
    }
    let pass = Move::Pass { profile: Profile::Quintic, duration: 0.5, to: 12.0, rate: 0.0 };
    arm.push(&pass).expect("a move behind a turning hub");
    let first = arm.tick();
    assert_eq!(first.rate, last.rate);
    for _ in 0..50 {
        arm.tick();
    }
    assert!((arm.setpoint().angle.radians() - 12.0).abs() < 1e-6);
    assert_eq!(arm.setpoint().rate, 0.0);
}

fn turns(radians: f64) -> stillbeam::Angle<f64> {
    stillbeam::Angle::from_radians(radians)
}
