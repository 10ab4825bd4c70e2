//! Still moves by the hundred, and in scene files.

use stillbeam_sim::plan::campaign;
use stillbeam_sim::reference::rod;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
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
    let left = compare::residual(&rows, &scene).expect("a rest").expect("at rest");
    assert!(left < 0.02, "{left}");
    // After the first two, nothing is left: neither is robust.
    let first = trajectory.arrivals().next().expect("an arrival");
    let ringing = rows
        .iter()
        .filter(|row| row.t_s > first + 0.001 && row.t_s < first + 0.19)
        .map(|row| row.deflection_m.abs() / 0.4)
        .fold(0.0, f64::max);
    assert!(ringing < 0.001, "{ringing}");
    let solver = Solver { method: Method::Elastica, ..Solver::default() };
    let ours = run::run(&scene, &solver).expect("a run");
    assert_eq!(ours.len(), rows.len());
    for word in ["duration = 0.05", "robust = 0.9", "rate = 1.0"] {
        let text = SCENE.replacen("duration = 0.2", word, 1);
        let error = SceneFile::parse("test", &text).expect_err(word).to_string();
        assert!(error.contains("moves[0]") || error.contains("move."), "{error}");
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
    assert!(outcomes.len() * 100 >= all.len() * 95, "{} of {}", outcomes.len(), all.len());
    for outcome in outcomes {
        assert!(outcome.excess < 1e-4, "{outcome:?}");
        assert!(outcome.residual < outcome.stated + 1e-3, "{outcome:?}");
    }
}

/// The rod's own period, which ratios are counted in, is the planner's.
#[test]
fn first_periods_agree() {
    let scene = SceneFile::parse("test", SCENE).expect("a scene").arm;
    let planner = stillbeam::motion::Still::<f64, 2>::new(&scene, 0.01).expect("planner");
    let period = rod::first_period(&scene).expect("a rod");
    assert!((planner.first_period() / period - 1.0).abs() < 1e-4);
}
