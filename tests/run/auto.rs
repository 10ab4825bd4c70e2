//! Choices of `auto`: the bounded part of the campaign behind `docs/auto.md`, and the order of
//! the ladder.

use std::cell::Cell;

use stillbeam::motion::Moves;
use stillbeam::select::{Choice, Rung, assess};
use stillbeam::stepper::{Quality, Rigid};
use stillbeam::{Damping, Hub, Link, Move, Payload, Scene};
use stillbeam_lab::choice::{Case, SEED as DOCUMENT, Summary, campaign};
use stillbeam_sim::compare::compare;
use stillbeam_sim::dispatch;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_tests::{instructions, root};

/// Another seed than the document's.
const SEED: u64 = 1;

const ARMS: u64 = 25;

#[test]
fn choices_keep_the_tolerance_and_are_cheap() {
    let verdicts = campaign(SEED, ARMS, &|| ()).expect("campaign");
    let summary = Summary::of(&verdicts);
    assert!(summary.choices() >= 12, "most arms get a stepper: {summary:?}");
    assert_eq!(summary.exceeded, 0, "{verdicts:#?}");
    assert!(summary.holds(), "{summary:?}");
    // A few dozen arms leave room for no more than one, and never for two rungs.
    assert_eq!(summary.needless, 0, "{summary:?}");
}

/// A trapezoid's four jumps make the modes ring that the trial does not follow, by twice as much as
/// the largest one alone: the choice was beyond its torque tolerance by 7 %.
#[test]
fn the_ringing_of_all_jumps_is_expected() {
    let verdict = Case::random(11, 81).and_then(|case| case.judge(81)).expect("verdict");
    assert!(!verdict.exceeds(), "{verdict:?}");
}

/// A smooth motion has no jump at its begin that would excuse its first ticks. This arm hangs there
/// under its weight with a larger error of the torque than at any later tick: the choice was beyond
/// its tolerance by 21 %.
#[test]
fn the_first_ticks_of_a_smooth_motion_are_compared() {
    let verdict = Case::random(DOCUMENT, 1805).and_then(|case| case.judge(1805)).expect("verdict");
    assert!(!verdict.exceeds(), "{verdict:?}");
}

/// Without damping an arm rings on in modes that the trial's steps damp away over a thousand ticks:
/// the choices were beyond their torque tolerances by 4 and 7 %.
#[test]
fn ringing_that_a_long_trial_loses_is_expected() {
    for arm in [2425, 2616] {
        let verdict = Case::random(DOCUMENT, arm).and_then(|case| case.judge(arm));
        let verdict = verdict.expect("verdict");
        assert!(!verdict.exceeds(), "{arm}: {verdict:?}");
    }
}

/// Instructions of the worst tick inside a cubic.
fn worst(rows: &str, rung: Rung, skip: &str) -> Option<u32> {
    let (method, size, quality) = match rung {
        Rung::Rigid => ("rigid", 0, ""),
        Rung::Modal(modes) => ("modal", modes, ""),
        Rung::Elastica(modes, Quality::Fast) => ("elastica", modes, "fast"),
        Rung::Elastica(modes, Quality::Fine) => ("elastica", modes, "fine"),
    };
    let key = [method, &size.to_string(), quality, skip].map(str::to_owned);
    instructions::ticks(rows).expect("the table").get(&key).copied()
}

/// The same; three modes, fast, have no row of their own as long as the bench does not count them:
/// the part of a fine tick that two modes' is.
fn cost(rows: &str, rung: Rung, skip: &str) -> u32 {
    let counted = |rung| worst(rows, rung, skip);
    counted(rung).unwrap_or_else(|| {
        assert_eq!(rung, Rung::Elastica(3, Quality::Fast), "{rung}, {skip}: no row");
        let row = |modes, quality| counted(Rung::Elastica(modes, quality)).expect("row");
        row(3, Quality::Fine) * row(2, Quality::Fast) / row(2, Quality::Fine)
    })
}

#[test]
fn the_ladder_is_in_the_order_of_measured_instructions() {
    let rows = std::fs::read_to_string(root().join("docs/instructions.csv")).expect("table");
    let plain = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.5 });
    let gravity = Scene { gravity: 9.81, ..plain };
    let damped =
        |scene: Scene| Scene { damping: Damping { alpha: 0.1, beta: 0.0, joint: 0.0 }, ..scene };
    for (scene, skip) in [
        (damped(gravity), ""),
        (damped(plain), "no-gravity"),
        (gravity, "no-damping"),
        (plain, "no-damping no-gravity"),
    ] {
        for pair in Rung::ladder(&scene).windows(2) {
            let [cheap, dear] = [pair[0], pair[1]].map(|rung| cost(&rows, rung, skip));
            assert!(
                cheap <= dear,
                "{skip:?}: {} takes {cheap}, {} takes {dear} instructions",
                pair[0],
                pair[1]
            );
        }
    }
}

/// The test above can fail.
#[test]
fn a_rung_out_of_order_would_be_found() {
    let rows = format!("{}\nrigid,0,,,200,,,,,,,\nmodal,1,,,160,,,,,,,\n", instructions::header());
    assert_eq!(worst(&rows, Rung::Rigid, ""), Some(200));
    assert!(cost(&rows, Rung::Rigid, "") > cost(&rows, Rung::Modal(1), ""));
    assert_eq!(worst(&rows, Rung::Modal(1), "no-gravity"), None);
}

/// A stiff steel bar with a payload: its tip moves by less than a thousandth of its length, and the
/// torque rings with its full size.
const BAR: &str = "[link]\nlength = 0.3\nmaterial = \"steel\"\nwidth = 0.025\nthickness = 0.012\n\
    [payload]\nmass = 0.2\n[move]\nprofile = \"cubic\"\nduration = 0.25\nto = 1.0\nsettle = 0.3\n";

fn chosen(scene: &SceneFile, solver: &Solver) -> Choice {
    dispatch::choose(scene, solver).expect("moves").expect("choice")
}

/// The reference rod at those intervals.
fn reference(scene: &SceneFile, every: f64) -> Vec<Row> {
    let tick = scene.solver.resolve().expect("solver").tick;
    let trajectory = scene.trajectory(tick).expect("moves");
    let times = truth::times(&trajectory, every);
    truth::solve(Reference::Rod, scene, &trajectory, &times, &|_| ()).expect("reference")
}

#[test]
fn the_torque_decides_where_the_tip_does_not() {
    let scene = SceneFile::parse("bar", BAR).expect("scene");
    let choice = chosen(&scene, &Solver::default());
    assert_ne!(choice.rung, Rung::Rigid);
    // By the tip alone the rigid arm would do.
    let tip_only = Solver { torque_tolerance: 1.0, ..Solver::default() };
    assert_eq!(chosen(&scene, &tip_only).rung, Rung::Rigid);
    let rows = run(&scene, &Solver::default()).expect("run");
    let truth = compare(&rows, &reference(&scene, 0.01), &scene).expect("comparison");
    assert!(truth.torque <= 0.01 && truth.tip_max <= 1e-3, "{truth:?}");
    // The peaks lie between the ticks.
    let fine = reference(&scene, 1e-4);
    let peak = fine.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
    let seen = choice.expected.peak_torque;
    assert!((seen / peak - 1.0).abs() < 0.01, "{seen} N m of {peak} N m");
    // Without a hub of its own, what the motor gives is what bends the link at the clamp.
    assert!((choice.expected.peak_moment / seen - 1.0).abs() < 1e-4, "{choice:?}");
}

/// Expected errors are those that the reference rod finds, behind a shaper too, whose pulses fall
/// inside the ticks. Newmark's rule takes the rates only, so that it needs no care there.
#[test]
fn a_shaped_motion_is_judged_as_it_is_commanded() {
    let text = "[link]\nlength = 0.25\nmass = 0.02\nbending_stiffness = 1.0219\n[move]\n\
        profile = \"trapezoid\"\nduration = 0.3\nto = 0.5\nsettle = 0.3\n[shaper]\nkind = \"zv\"\n\
        frequency = 32.0\ndamping = 0.0\n";
    let scene = SceneFile::parse("shaped", text).expect("scene");
    let solver = Solver::PAPER;
    let expected = dispatch::assess(&scene, &solver).expect("assessment");
    let rows = run(&scene, &solver).expect("run");
    let truth = compare(&rows, &reference(&scene, 0.01), &scene).expect("comparison");
    for (expected, truth) in [(expected.tip, truth.tip_max), (expected.torque, truth.torque)] {
        assert!(truth <= expected && expected < 1.1 * truth + 1e-5, "{expected}, {truth}");
    }
    // The shaper keeps the arm from ringing: rigid is nearer than it is without.
    let rigid = Solver { method: Method::Rigid, ..solver };
    let shaped = dispatch::assess(&scene, &rigid).expect("assessment").tip;
    let plain = SceneFile { shaper: None, ..scene };
    let ringing = dispatch::assess(&plain, &rigid).expect("assessment").tip;
    assert!(shaped < 0.9 * ringing, "{shaped} behind the shaper, {ringing} without");
}

/// Held level, the motor carries the first moment about the axis, the clamp that about itself.
#[test]
fn torque_and_moment_of_a_level_arm_are_its_weight_s() {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.3, bending_stiffness: 4000.0 });
    scene.hub = Hub { radius: 0.1, inertia: 0.01, stiffness: None };
    scene.payload = Payload { mass: 0.2, inertia: 0.0, offset: 0.0 };
    scene.gravity = 9.81;
    let hold = [Move::Dwell { duration: 0.2 }];
    let motion = Moves::new(0.0, &hold, 0.01).expect("motion");
    let rigid = Rigid::<f32>::new(&scene, 0.01).expect("rigid");
    let seen = assess(&scene, rigid, &motion, &mut |_| ()).expect("assessment");
    let torque = 9.81 * (0.3 * 0.3 + 0.2 * 0.5);
    let moment = 9.81 * (0.3 * 0.2 + 0.2 * 0.4);
    assert!((seen.peak_torque / torque - 1.0).abs() < 1e-3, "{seen:?}, {torque}");
    assert!((seen.peak_moment / moment - 1.0).abs() < 1e-3, "{seen:?}, {moment}");
    assert!(seen.torque < 1e-3 && seen.tip < 1e-3, "{seen:?}");
}

/// The exact rod's steps are bounded for many moves, for stiff arms and for long rests.
#[test]
fn a_choice_takes_a_bounded_number_of_steps() {
    let turn = |to, duration| {
        format!("[[moves]]\nprofile = \"quintic\"\nduration = {duration}\nto = {to}.0\n")
    };
    let rest = |duration| format!("[[moves]]\nprofile = \"dwell\"\nduration = {duration}\n");
    let soft = "[link]\nlength = 0.4\nmass = 0.02\nbending_stiffness = 0.46\n";
    let stiff = "[link]\nlength = 0.2\nmass = 0.6\nbending_stiffness = 3000.0\n";
    let damped = format!("{soft}[damping]\nalpha = 0.5\nbeta = 0.002\n");
    let many: String = (0..40).map(|k| turn(1 - k % 2, 0.7) + &rest(0.3)).collect();
    let cases = [
        ("forty moves", soft, many, 2 * 61_000),
        ("a stiff arm", stiff, turn(1, 100.0), 2 * 330_000),
        ("a long rest", &damped, turn(1, 0.5) + &rest(1000.0), 2 * 61_000),
    ];
    for (what, arm, moves, most) in cases {
        let scene = SceneFile::parse(what, &format!("{arm}{moves}")).expect("scene");
        let solver = scene.solver.resolve().expect("solver");
        let done = Cell::new(0.0);
        let choice = dispatch::choose_with(&scene, &solver, &|part| {
            assert!(part >= done.get() && part <= 1.0, "{what}: {part} after {}", done.get());
            done.set(part);
        });
        let steps = choice.expect("moves").expect("choice").expected.steps;
        assert!(steps <= most, "{what}: {steps} steps");
        assert!(done.get() > 0.4, "{what}: {}", done.get());
    }
}

#[test]
fn a_scene_that_names_no_method_gets_auto() {
    let solver = SolverKeys::default().resolve().expect("solver");
    assert_eq!((solver, solver.method), (Solver::default(), Method::Auto));
}
