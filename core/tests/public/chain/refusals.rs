//! Refusals of mechanisms that no chain has, and of motions that none makes.

use stillbeam::chain::{Chain, ChainGenerator};
use stillbeam::mechanism::{Closure, Joint, Link, Mechanism, Stiffness};
use stillbeam::{Error, Move, Profile};

use super::scenes;

const D: Link = Link::flexible(0.3, 0.0168, 0.46);

fn refused(change: impl Fn(&mut Mechanism)) -> String {
    let mut mechanism = Mechanism::new(&[D, D]).expect("links");
    change(&mut mechanism);
    mechanism.validate().expect_err("it is wrong").to_string()
}

#[test]
fn a_field_is_named_with_its_place() {
    for (error, begins) in [
        (refused(|m| m.links[1].length = -0.3), "links[1].length = -0.3: must be 0.001 to 1000 m"),
        (refused(|m| m.links[0].mass = f64::NAN), "links[0].mass = NaN: must be"),
        (refused(|m| m.joints[1].radius = -1.0), "joints[1].radius = -1: must be"),
        (refused(|m| m.damping.joint = 0.1), "damping.joint = 0.1: must be 0"),
        (refused(|m| m.closure = Some(Closure::at(-1.0))), "closure.from = -1: must be"),
        (
            refused(|m| {
                let mut closure = Closure::at(1.0);
                closure.release.push(4).expect("room");
                m.closure = Some(closure);
            }),
            "closure.release = 5: must be 1 to 2",
        ),
        (
            refused(|m| {
                m.joints[1] = Joint::passive(0.0);
                let mut closure = Closure::at(1.0);
                closure.release.push(1).expect("room");
                m.closure = Some(closure);
            }),
            "closure.release = 2: must be a driven joint",
        ),
        (
            refused(|m| {
                m.links[0] = Link::rigid(0.3, 0.1);
                m.links[1] = Link::rigid(0.3, 0.1);
                m.closure = Some(Closure::on_pin([0.3, 0.0]));
            }),
            "closure = 0: must be 2 to",
        ),
    ] {
        assert!(error.starts_with(begins), "{error}\nnot {begins}");
    }
}

#[test]
fn a_chain_has_a_link_and_no_more_than_there_is_room_for() {
    assert!(matches!(Mechanism::new(&[]), Err(Error::OutOfRange { parameter: "links", .. })));
    assert!(matches!(Mechanism::new(&[D; 9]), Err(Error::OutOfRange { parameter: "links", .. })));
    let two = Mechanism::new(&[D, D]).expect("links");
    assert!(matches!(
        Chain::<f32, 3, 3, 9, 3>::new(&two, 0.01),
        Err(Error::OutOfRange { parameter: "links", value: 2.0, .. })
    ));
}

#[test]
fn a_loop_that_cannot_close_is_refused() {
    let mut scene = scenes::four_bar();
    scene.mechanism.closure = Some(Closure::on_pin([0.9, 0.0]));
    let chain = Chain::<f64, 3, 3, 9, 3>::new(&scene.mechanism, 0.01).expect("a chain");
    match chain.at_rest(&scene.from) {
        Err(Error::OpenLoop { gap }) => assert!(gap > 0.01, "{gap}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn joints_without_a_motor_and_joints_that_do_not_exist_take_no_move() {
    let mut loop_ = scenes::generator::<f32, 3, 3, 9, 3>(&scenes::four_bar(), 0.01);
    let motion = Move::To { profile: Profile::Quintic, duration: 1.0, to: 0.0 };
    assert!(matches!(loop_.push(1, &motion), Err(Error::PassiveJoint { joint: 2, .. })));
    let error = loop_.push(3, &motion).expect_err("there are three joints");
    assert!(error.to_string().starts_with("moves.joint = 4: must be 1 to 3"), "{error}");
    let mut latch = scenes::generator::<f32, 3, 3, 9, 3>(&scenes::latch(), 0.01);
    for _ in 0..=180 {
        latch.tick();
    }
    assert!(matches!(latch.push(2, &motion), Err(Error::PassiveJoint { joint: 3, .. })));
}

/// A move that would bend a link by more than the tick follows is refused, and nothing changes.
#[test]
fn a_move_that_bends_too_far_is_refused() {
    let chain = Chain::<f32, 2, 3, 6, 3>::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let mut arm = ChainGenerator::<f32, 2, 3, 6, 3>::new(chain, [0.0; 2]).expect("a generator");
    let hard = Move::To { profile: Profile::Quintic, duration: 0.1, to: 1.5 };
    assert!(matches!(arm.push(0, &hard), Err(Error::BendsTooFar { max: 2.0, .. })));
    assert!(arm.is_holding());
    // The other joint's acceleration counts as well.
    let motion = Move::To { profile: Profile::Quintic, duration: 0.15, to: 1.5 };
    arm.push(0, &motion).expect("alone it is within");
    assert!(matches!(arm.push(1, &motion), Err(Error::BendsTooFar { .. })));
}

/// With rigid links the latch's crank asks for a place beyond the reach of the two links behind it.
#[test]
fn a_loop_that_leaves_its_pin_is_refused() {
    let mut scene = scenes::latch();
    scenes::generator::<f32, 3, 3, 9, 3>(&scene, 0.01).rehearse(300).expect("strips give way");
    for link in &mut scene.mechanism.links {
        link.stiffness = Stiffness::Rigid;
    }
    let rigid = scenes::generator::<f32, 3, 3, 9, 3>(&scene, 0.01);
    match rigid.rehearse(300) {
        Err(Error::LeavesPin { gap, time }) => {
            assert!(gap > 1e-4 && (1.8..2.6).contains(&time), "{gap} m at {time} s");
        }
        other => panic!("{other:?}"),
    }
    // Less far the same loop keeps its pin.
    scene.turns[3].to = 1.7;
    let torque = scenes::generator::<f32, 3, 3, 9, 3>(&scene, 0.01).rehearse(300).expect("a way");
    assert!(torque.torque.iter().all(|torque| *torque < 1.0), "{torque:?}");
}

/// A strip that swings in three ticks is not resolved; with a tenth of the tick it is.
#[test]
fn a_tick_that_is_too_long_is_refused() {
    let mut scene = scenes::arm_dd();
    for turn in &mut scene.turns {
        turn.duration = 0.4;
    }
    let found = scenes::generator::<f32, 2, 3, 6, 3>(&scene, 0.01).rehearse(120).expect("fine");
    let exact = scenes::generator::<f32, 2, 3, 6, 3>(&scene, 0.001).rehearse(1200).expect("fine");
    assert!(exact.apart < 0.01 * found.apart, "{exact:?}, {found:?}");
    let coarse = scenes::generator::<f32, 2, 3, 6, 3>(&scene, 0.05).rehearse(24);
    assert!(
        matches!(coarse, Err(Error::TickTooLong { tick: 0.05, apart, .. }) if apart > 0.02),
        "{coarse:?}"
    );
}

/// A straight strip between two pins cannot give way along itself.
#[test]
fn a_loop_in_one_line_is_refused() {
    let mut mechanism = Mechanism::new(&[D, D]).expect("links");
    mechanism.joints[1] = Joint::passive(0.0);
    let mut closure = Closure::at(0.1);
    closure.release.push(0).expect("room");
    mechanism.closure = Some(closure);
    let chain = Chain::<f32, 2, 3, 6, 3>::new(&mechanism, 0.01).expect("a chain");
    let arm = ChainGenerator::<f32, 2, 3, 6, 3>::new(chain, [0.4, 0.0]).expect("a generator");
    arm.rehearse(10).expect("it is open");
    let found = arm.rehearse(20);
    assert!(matches!(found, Err(Error::StraightLoop { time }) if time < 0.2), "{found:?}");
}
