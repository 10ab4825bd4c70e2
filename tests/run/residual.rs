//! One residual: the same number whatever the settle, the tick and the command.

use stillbeam_sim::compare::{Residual, compare, residual};
use stillbeam_sim::reference::rod;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
use stillbeam_sim::trajectory::Side;
use stillbeam_sim::truth;

const ARM: &str =
    "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n[payload]\nmass = 0.03\n";

fn parse(text: &str) -> SceneFile {
    SceneFile::parse("test", text).expect("a scene")
}

fn scene(settle: f64, extra: &str) -> SceneFile {
    parse(&format!(
        "{ARM}{extra}[move]\nprofile = \"cubic\"\nduration = 0.38\nto = 1.0\nsettle = {settle}\n"
    ))
}

fn left(scene: &SceneFile, method: Method, tick: f64) -> f64 {
    let solver = Solver { method, tick, ..Solver::default() };
    let rows = run(scene, &solver).expect("a run");
    residual(&rows, scene, tick).expect("a rest").value().expect("a residual")
}

/// Largest deflection over a first period, by samples a thousandth of it apart.
fn truth_of(scene: &SceneFile) -> f64 {
    let trajectory = scene.case(0.01).trajectory().expect("a motion");
    let end = trajectory.arrivals().last().expect("an arrival");
    let period = rod::first_period(&scene.arm).expect("a rod");
    let times: Vec<f64> = (0..=1000).map(|k| end + period * f64::from(k) / 1000.0).collect();
    let samples =
        rod::solve(&scene.arm, &trajectory, &times, &rod::Options::default()).expect("a rod");
    let rest = rod::rest_deflection(&scene.arm, trajectory.at(end, Side::Right).angle);
    let rest = rest.expect("a rest");
    let largest = samples.iter().map(|s| (s.deflection - rest).abs()).fold(0.0, f64::max);
    largest / scene.arm.link.length
}

#[test]
fn the_residual_does_not_depend_on_settle_or_tick() {
    let truth = truth_of(&scene(0.0, ""));
    assert!((truth * 400.0 - 11.49).abs() < 0.01, "{truth}");
    for settle in [0.0, 0.01, 0.1, 0.25, 0.3, 2.0] {
        for tick in [0.001, 0.002, 0.005, 0.01, 0.02] {
            let found = left(&scene(settle, ""), Method::Elastica, tick);
            assert!((found / truth - 1.0).abs() < 5e-3, "{settle} s, {tick} s: {found}, {truth}");
        }
    }
}

#[test]
fn gravity_shapers_and_queues_have_the_same_definition() {
    let gravity = scene(0.0, "[gravity]\nacceleration = 9.81\n");
    let shaped = scene(0.0, "[shaper]\nkind = \"zv\"\nfrequency = 3.0\n");
    let queue = parse(&format!(
        "{ARM}[[moves]]\nprofile = \"cubic\"\nduration = 0.3\nto = 0.6\nsettle = 0.07\n\
         [[moves]]\nprofile = \"quintic\"\nduration = 0.25\nto = 0.1\n[[moves]]\nprofile = \"dwell\"\n\
         duration = 0.05\n"
    ));
    for scene in [gravity, shaped, queue] {
        let truth = truth_of(&scene);
        let found = left(&scene, Method::Elastica, 0.01);
        assert!((found - truth).abs() < 0.01 * truth + 2e-5, "{found} {truth}");
    }
}

#[test]
fn a_table_that_ends_too_early_has_no_residual() {
    let scene = scene(0.5, "");
    let solver = Solver { method: Method::Elastica, ..Solver::default() };
    let rows = run(&scene, &solver).expect("a run");
    let short = &rows[..rows.len() - 40];
    let comparison = compare(short, &rows, &scene).expect("a comparison");
    assert!(
        matches!(comparison.residual, [Residual::Cut { .. }, Residual::Of(_)]),
        "{comparison:?}"
    );
}

#[test]
fn a_spinning_hub_leaves_none() {
    let text = format!("{ARM}[move]\nprofile = \"spin-up\"\nduration = 1.0\nrate = 2.0\n");
    let scene = parse(&text);
    let rows = run(&scene, &Solver::default()).expect("a run");
    assert_eq!(residual(&rows, &scene, 0.01), Ok(Residual::Turning));
    assert_eq!(rows.len(), 101);
    let text = text.replace("[move]", "[[moves]]")
        + "[[moves]]\nprofile = \"spin-up\"\nduration = 0.5\nrate = 0.0\n";
    assert!(left(&parse(&text), Method::Elastica, 0.01) > 0.0);
}

/// `run` and the rod's own table, with rows wherever they are.
#[test]
fn the_reference_gives_the_same_residual_at_any_interval() {
    let scene = scene(0.0, "");
    let trajectory = scene.trajectory(0.01).expect("a motion");
    let truth = truth_of(&scene);
    for every in [0.0005, 0.003, 0.01, 0.02] {
        let times = truth::times(&trajectory, every);
        let rows = truth::solve(truth::Reference::Rod, &scene, &trajectory, &times, &|_| ());
        let found = residual(&rows.expect("a run"), &scene, 0.01).expect("a rest");
        let found = found.value().expect("a residual");
        assert!((found / truth - 1.0).abs() < 5e-3, "{every}: {found} {truth}");
    }
}
