//! The shortest duration of a move keeps every limit, and a tick less does not.

use stillbeam::{Limits, Move, Profile};
use stillbeam_sim::limits::{kinematic, load, shortest};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::step::Step;
use stillbeam_tests::assert_near;

const SCENE: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n\
                     [payload]\nmass = 0.03\n[move]\nprofile = \"dwell\"\nduration = 0.1\n";
const TICK: f64 = 0.005;

fn scene(shaper: &str) -> SceneFile {
    SceneFile::parse("test", &format!("{SCENE}{shaper}")).expect("a scene")
}

fn turn(profile: Profile) -> Step {
    Step { motion: Move::To { profile, duration: 1e3, to: 1.2 }.into(), settle: 0.0 }
}

/// True if the last of the moves keeps the limits in that duration.
fn keeps(scene: &SceneFile, steps: &[Step], limits: &Limits, duration: f64) -> bool {
    let mut steps = steps.to_vec();
    let last = steps.last_mut().expect("a move");
    last.motion = last.motion.lasting(duration);
    let case = scene.case(TICK);
    let case = case.with(&steps);
    let trajectory = case.trajectory().expect("a motion");
    kinematic::excess(&case, &trajectory, limits).is_none()
        && load::excess(&case, &trajectory, limits, &|_| ()).expect("a flight").is_none()
}

#[track_caller]
fn assert_shortest(scene: &SceneFile, steps: &[Step], limits: &Limits) -> f64 {
    let case = scene.case(TICK);
    let duration = shortest(&case.with(steps), limits, &|_| ()).expect("a duration");
    assert!(keeps(scene, steps, limits, duration), "{duration} s does not keep the limits");
    assert!(!keeps(scene, steps, limits, duration - TICK), "a tick less than {duration} s does");
    duration
}

/// By hand: 10/√3 of an acceleration of 1.2/T², and 1.875 of a rate of 1.2/T.
#[test]
fn of_the_motion_alone_it_is_the_closed_form() {
    let scene = scene("");
    let limits = Limits { rate: Some(4.0), acceleration: Some(20.0), ..Limits::default() };
    let duration = assert_shortest(&scene, &[turn(Profile::Quintic)], &limits);
    let exact = (10.0 / 3f64.sqrt() * 1.2 / 20.0).sqrt().max(1.875 * 1.2 / 4.0);
    assert_near("duration", duration, (exact / TICK).ceil() * TICK, 1e-9);
    let gentle = Limits { deceleration: Some(5.0), ..limits };
    let duration = assert_shortest(&scene, &[turn(Profile::Quintic)], &gentle);
    let exact = (10.0 / 3f64.sqrt() * 1.2 / 5.0).sqrt();
    assert_near("duration", duration, (exact / TICK).ceil() * TICK, 1e-9);
}

/// Torque and clamp moment of the rod, vibration of the move before it included.
#[test]
fn torque_and_clamp_moment_are_kept() {
    let scene = scene("");
    let before = Step { motion: turn(Profile::Quintic).motion.lasting(0.5), settle: 0.0 };
    let back = Step {
        motion: Move::To { profile: Profile::Quintic, duration: 1.0, to: 0.0 }.into(),
        settle: 0.0,
    };
    let torque = Limits { torque: Some(0.12), ..Limits::default() };
    let alone = assert_shortest(&scene, &[turn(Profile::Quintic)], &torque);
    let moment = Limits { moment: Some(0.6), rate: Some(12.0), ..Limits::default() };
    let behind = assert_shortest(&scene, &[before, back], &moment);
    // The rigid arm has an inertia of 0.006 kg m².
    let rigid = |torque: f64| (10.0 / 3f64.sqrt() * 1.2 * 0.006 / torque).sqrt();
    assert!(alone > 0.9 * rigid(0.12) && alone < 2.0 * rigid(0.12), "{alone}");
    assert!(behind > 0.7 * rigid(0.6) && behind < 2.0 * rigid(0.6), "{behind}");
}

/// Behind a shaper the motion itself may be shorter than its formulas allow.
#[test]
fn a_shaper_shortens_it() {
    let limits = Limits { rate: Some(10.0), acceleration: Some(20.0), ..Limits::default() };
    let plain = assert_shortest(&scene(""), &[turn(Profile::Quintic)], &limits);
    let shaped = scene("[shaper]\nkind = \"zv\"\n");
    let behind = assert_shortest(&shaped, &[turn(Profile::Quintic)], &limits);
    assert!(behind < 0.95 * plain, "{behind} {plain}");
}

#[test]
fn what_no_duration_keeps_is_refused() {
    let scene = scene("");
    let refused = |step: Step, limits: Limits| {
        shortest(&scene.case(TICK).with(&[step]), &limits, &|_| ()).unwrap_err().to_string()
    };
    let error = refused(turn(Profile::Quintic), Limits::default());
    assert!(error.starts_with("move.duration: missing"), "{error}");
    let jerk = Limits { jerk: Some(100.0), ..Limits::default() };
    let error = refused(turn(Profile::Cubic), jerk);
    assert!(error.contains("limits.jerk"), "{error}");
    let rate = Limits { rate: Some(1.0), acceleration: Some(5.0), ..Limits::default() };
    let spin = Step { motion: Move::SpinUp { duration: 1.0, rate: 2.0 }.into(), settle: 0.0 };
    let error = refused(spin, rate);
    assert!(error.contains("limits.rate"), "{error}");
}
