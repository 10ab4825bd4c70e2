//! Still moves by the hundred, and in scene files.

use stillbeam_lab::fastest::interrupted;
use stillbeam_lab::still::campaign;
use stillbeam_sim::reference::rod;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
use stillbeam_sim::trajectory::Side;
use stillbeam_sim::{compare, run, truth};

const SCENE: &str = r#"
[link]
length = 0.4
mass = 0.0224
bending_stiffness = 0.46
[limits]
torque = 0.9
[[moves]]
profile = "still"
duration = 0.2
to = 2.0
settle = 0.2
[[moves]]
profile = "still"
to = 0.5
settle = 0.2
[[moves]]
profile = "still"
duration = 0.3
robust = 0.1
to = 1.5
settle = 0.2
"#;

#[test]
fn a_scene_file_plans_its_still_moves() {
    let scene = SceneFile::parse("test", SCENE).expect("a scene");
    let trajectory = scene.trajectory(0.01).expect("a motion");
    let times = truth::times(&trajectory, 0.01);
    let rows =
        truth::solve(truth::Reference::Rod, &scene, &trajectory, &times, &|_| ()).expect("a run");
    let left = compare::residual(&rows, &scene, 0.01).expect("a rest").value().expect("at rest");
    assert!(left < 0.02, "{left}");
    // After the first two, nothing is left: neither is robust.
    let first = trajectory.arrivals().next().expect("an arrival");
    let ringing = rows
        .iter()
        .filter(|row| row.t_s > first + 0.001 && row.t_s < first + 0.19)
        .map(|row| row.deflection_m.abs() / 0.4)
        .fold(0.0, f64::max);
    assert!(ringing < 0.001, "{ringing}");
    let solver = Solver { method: Method::Elastica, ..Solver::PAPER };
    let ours = run::run(&scene, &solver).expect("a run");
    assert_eq!(ours.len(), rows.len());
    for word in ["duration = 0.05", "robust = 0.9", "rate = 1.0"] {
        let text = SCENE.replacen("duration = 0.2", word, 1);
        let error = SceneFile::parse("test", &text).expect_err(word).to_string();
        assert!(error.contains("moves[0]") || error.contains("move."), "{error}");
    }
}

/// The fastest move, one that may leave a hundredth, and one of least effort, each from rest.
#[test]
fn a_scene_file_says_what_a_still_move_keeps_least() {
    let link = SCENE.split("[limits]").next().expect("a link");
    let moves = |words: &str| {
        format!(
            "{link}[limits]\nacceleration = 400\nrate = 25\n[[moves]]\nprofile = \"still\"\nto = 2.0\n{words}"
        )
    };
    let duration = |words: &str| {
        let scene = SceneFile::parse("test", &moves(words)).expect("a scene");
        scene.trajectory(0.001).expect("a motion").arrivals().next().expect("an arrival")
    };
    let still = duration("");
    let fastest = duration("least = \"time\"");
    assert!(fastest < 0.99 * still, "{fastest} {still}");
    // In whole ticks a residual need not save any.
    assert!(duration("within = 0.02") <= fastest);
    assert!((duration("least = \"effort\"\nduration = 0.25") - 0.25).abs() < 1e-9);
    let jump = |words: &str| {
        let scene = SceneFile::parse("test", &moves(words)).expect("a scene");
        scene.trajectory(0.001).expect("a motion").at(0.0, Side::Right).acceleration
    };
    assert!(jump("least = \"time\"") > 10.0);
    for words in ["least = \"time\"\neased = true", "within = 0.02\neased = true", "eased = true"] {
        assert!(jump(words).abs() < 1e-9, "{words}: {}", jump(words));
    }
    for (words, said) in [
        ("least = \"heat\"\nduration = 0.25", "heat"),
        ("least = \"time\"\nduration = 0.25", "move.duration = 0.25"),
        ("within = 0.3", "within = 0.3"),
        ("least = \"effort\"", "least"),
    ] {
        let error = SceneFile::parse("test", &moves(words)).expect_err(words).to_string();
        assert!(error.contains(said), "{error}");
    }
    for (words, key) in [("least = \"time\"", "move.least"), ("eased = true", "move.eased")] {
        let text = moves(words).replace("still", "cubic");
        let error = SceneFile::parse("test", &text).expect_err("a cubic").to_string();
        assert!(error.contains(key), "{error}");
    }
}

/// A few of the moves that `docs/still.md` counts by the ten thousand.
#[test]
fn random_arms_arrive_still() {
    let rests = campaign::rests(7, 60, 20, &|| ()).expect("a campaign");
    let mut planned = 0;
    for rest in &rests {
        match rest.residual {
            Ok((still, linear)) => {
                planned += 1;
                assert!(still <= linear + 1e-4, "{rest:?}");
                let bound = if rest.ratio < 1.6 { 0.02 } else { 0.003 };
                assert!(still < bound, "{rest:?}");
            }
            Err(kind) => assert!(["bends too far", "rings on"].contains(&kind), "{kind}"),
        }
    }
    assert!(planned >= 54, "{planned}");
}

#[test]
fn random_interruptions_keep_limits_and_arrive_still() {
    let all = campaign::interruptions(11, 12, 20, &|| ()).expect("a campaign");
    let outcomes: Vec<_> = all.iter().filter_map(|one| one.outcome.ok()).collect();
    assert_eq!(outcomes.len(), all.len(), "{all:?}");
    for outcome in outcomes {
        assert!(outcome.excess < 1e-4, "{outcome:?}");
        assert!(outcome.residual < outcome.stated + 1e-3, "{outcome:?}");
    }
}

#[test]
fn random_interruptions_of_fastest_moves_keep_limits_and_arrive_still() {
    let all = interrupted::interruptions(5, 8, 12, &|| ()).expect("a campaign");
    let outcomes: Vec<_> = all.iter().filter_map(|one| one.ok()).collect();
    assert!(outcomes.len() * 10 >= all.len() * 9, "{all:?}");
    for outcome in outcomes {
        assert!(outcome.before < 1e-4 && outcome.behind < 1e-4, "{outcome:?}");
        assert!(outcome.residual < outcome.stated + 1e-3, "{outcome:?}");
    }
}

/// A shaper in a scene file: `run` and the rod agree on it, and what it leaves.
#[test]
fn a_scene_file_shapes_its_moves() {
    let moves = "[[moves]]\nprofile = \"quintic\"\nduration = 0.2\nto = 1.0\nsettle = 0.3\n";
    let link = SCENE.split("[limits]").next().expect("a link");
    let run_of = |shaper: &str| {
        let scene = SceneFile::parse("test", &format!("{link}{shaper}{moves}")).expect("a scene");
        let trajectory = scene.trajectory(0.01).expect("a motion");
        let times = truth::times(&trajectory, 0.01);
        let rod = truth::solve(truth::Reference::Rod, &scene, &trajectory, &times, &|_| ());
        let solver = Solver { method: Method::Elastica, ..Solver::PAPER };
        let ours = run::run(&scene, &solver).expect("a run");
        let apart = compare::compare(&ours, &rod.expect("a run"), &scene).expect("one scene");
        assert!(apart.tip_max < 1e-3, "{shaper}: {apart:?}");
        (trajectory.duration(), apart.residual[1].value().expect("at rest"))
    };
    let (duration, rings) = run_of("");
    for (shaper, periods) in
        [("zv", 0.5), ("mzv", 0.75), ("zvd", 1.0), ("ei", 1.0), ("2hump-ei", 1.5)]
    {
        let (longer, left) = run_of(&format!("[shaper]\nkind = \"{shaper}\"\n"));
        let delay = longer - duration;
        assert!((delay - periods * 0.09976).abs() < 0.011, "{shaper}: {delay}");
        assert!(left < 0.6 * rings, "{shaper}: {left} {rings}");
    }
    run_of("[shaper]\npulses = [[1.0, 0.0], [1.0, 0.0437]]\n");
    for wrong in [
        "kind = \"zz\"",
        "",
        "pulses = []",
        "kind = \"zv\"\nfrequency = 0.0",
        "pulses = [[1.0, 0.0]]\ndamping = 0.1",
    ] {
        let text = format!("{link}[shaper]\n{wrong}\n{moves}");
        let error = SceneFile::parse("test", &text).expect_err(wrong).to_string();
        assert!(error.contains("shaper"), "{error}");
    }
}

/// The rod's own period, which ratios are counted in, is the planner's.
#[test]
fn first_periods_agree() {
    let scene = SceneFile::parse("test", SCENE).expect("a scene").arm;
    let planner = stillbeam::planner::Planner::<f64, 2>::new(&scene, 0.01).expect("planner");
    let period = rod::first_period(&scene).expect("a rod");
    assert!((planner.first_period() / period - 1.0).abs() < 1e-4);
}
