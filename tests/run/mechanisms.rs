//! Mechanisms: the references and the core against the truth of `tests/truth/mechanisms`, and what
//! must hold of any solution.

use stillbeam_lab::mechanisms::{NAMES, Solver, Truth};
use stillbeam_sim::mechanism::compare::Comparison;
use stillbeam_sim::mechanism::{MechanismScene, is_mechanism, run, scenes};
use stillbeam_sim::reference::mechanism::{fem, rod};
use stillbeam_sim::truth::Reference;
use stillbeam_tests::root;

/// Asserts that places are within a fraction of the total length, torques within one of the peak.
#[track_caller]
fn within(name: &str, error: &Comparison, place: f64, torque: f64) {
    println!("{name}: places {:.1e}, torques {:.1e}", error.place, error.torque);
    assert!(error.common > 50, "{name}: only {} common times", error.common);
    assert!(error.place <= place, "{name}: places {}", error.place);
    assert!(error.torque <= torque, "{name}: torques {}", error.torque);
}

fn rod_against_truth(name: &str) {
    let truth = Truth::read(name).expect("truth");
    let error = truth.error(Solver::Reference(Reference::Rod)).expect("a solution");
    within(name, &error, 2e-7, 1e-5);
}

#[test]
fn the_rod_of_open_chains_is_the_truth() {
    for name in ["arm-bc-sag", "rigid-forearm"] {
        rod_against_truth(name);
    }
}

#[test]
fn the_rod_of_a_loop_is_the_truth() {
    rod_against_truth("four-bar");
}

#[test]
fn the_rod_of_a_chain_that_closes_is_the_truth() {
    rod_against_truth("latch");
}

/// In longer steps than the default, which `cargo lab mechanisms` takes.
fn elements_against_truth(name: &str, step: f64) {
    let truth = Truth::read(name).expect("truth");
    let scene = &truth.scene;
    let drives = scene.drives(0.01).expect("drives");
    let options = fem::Options { step, ..fem::Options::default() };
    let rows = fem::solve(&scene.mechanism, &drives, &truth.times(), &options, &|_| ());
    within(name, &truth.compare(&rows.expect("a solution")).expect("rows"), 1e-4, 0.01);
}

#[test]
fn elements_agree_on_an_open_chain() {
    elements_against_truth("arm-dd", 2e-4);
}

#[test]
fn elements_agree_on_a_loop() {
    elements_against_truth("four-bar", 2e-4);
}

#[test]
fn elements_agree_on_a_chain_that_closes() {
    elements_against_truth("latch", 2e-4);
}

/// One link is a chain of one: both rods of it are the same.
#[test]
fn one_link_is_a_chain_of_one() {
    let arm = stillbeam_sim::scenes::open("b-tip30-damped-hub").expect("embedded scene");
    let trajectory = arm.trajectory(0.01).expect("trajectory");
    let one = stillbeam_sim::truth::solve(
        Reference::Rod,
        &arm,
        &trajectory,
        &stillbeam_sim::truth::times(&trajectory, 0.05),
        &|_| (),
    )
    .expect("a solution");
    let chain = MechanismScene::parse("one", ONE_LINK).expect("a scene");
    let drives = chain.drives(0.01).expect("drives");
    let times: Vec<f64> =
        one.iter().map(|row| row.t_s).filter(|&t| t <= drives.duration()).collect();
    let options = rod::Options { order: 7, ..rod::Options::default() };
    let rows = rod::solve(&chain.mechanism, &drives, &times, &options, &|_| ()).expect("rows");
    let length = chain.mechanism.total_length();
    // The first row of an arm holds the torque behind the jump, that of a mechanism before it.
    for (a, b) in one.iter().zip(&rows).skip(1) {
        let apart = (a.tip_x_m - b.tip()[0]).hypot(a.tip_y_m - b.tip()[1]) / length;
        assert!(apart < 1e-7, "{}: {apart}", b.t);
        assert!((a.deflection_m - b.deflections[0]).abs() < 1e-7, "{}", b.t);
        assert!((a.torque_nm - b.torques[0]).abs() < 1e-6, "{}", b.t);
    }
}

/// `b-tip30-damped-hub` as a chain.
const ONE_LINK: &str = "
[[links]]
length = 0.4
mass = 0.01904
bending_stiffness = 0.042656
[[joints]]
radius = 0.04
[payload]
mass = 0.03
[damping]
alpha = 0.15
beta = 0.002
[[moves]]
joint = 1
profile = \"cubic\"
duration = 2.0
from = 0.0
to = 3.141592653589793
[run]
duration = 4.0
";

#[test]
fn embedded_mechanisms_are_the_scenes_of_the_truth() {
    for (name, truth) in [
        ("two-links", "arm-dd"),
        ("forearm", "rigid-forearm"),
        ("four-bar", "four-bar"),
        ("latch", "latch"),
    ] {
        let embedded = scenes::open(name).expect("scene").expect("a mechanism");
        let truth = Truth::read(truth).expect("truth").scene;
        assert_eq!(embedded, MechanismScene { name: name.to_owned(), ..truth });
    }
    assert_eq!(scenes::list().count(), 4);
    assert!(scenes::open("d-fast").expect("an arm").is_none());
    assert!(!is_mechanism("[link]\n# [[links]]\n"));
}

/// The core keeps what is promised of its ticks, at 10 ms in f32, through the scene files.
#[test]
fn the_core_runs_every_scene() {
    for name in NAMES {
        let truth = Truth::read(name).expect("truth");
        within(name, &truth.error(Solver::Core(2, 0.01)).expect("a run"), 1.5e-3, 0.025);
        within(name, &truth.error(Solver::Core(3, 0.005)).expect("a run"), 2.5e-4, 0.005);
        let rows = run::run(&truth.scene, &truth.scene.solver().expect("keys")).expect("rows");
        assert_eq!(rows.len(), truth.rows.len(), "{name}");
    }
}

/// The file that the page shows is one.
#[test]
fn the_page_shows_a_scene_that_is_accepted() {
    let page = std::fs::read_to_string(root().join("docs/mechanisms.md")).expect("the page");
    let (_, rest) = page.split_once("```toml\n").expect("an example");
    let (example, _) = rest.split_once("```").expect("its end");
    assert!(is_mechanism(example));
    let scene = MechanismScene::parse("example", example).expect("a scene");
    assert_eq!(scene.mechanism.links.len(), 2);
}

/// The table of the page, which a campaign writes, keeps what is promised of the references.
#[test]
fn the_page_gives_references_that_are_good_enough() {
    let page = std::fs::read_to_string(root().join("docs/mechanisms.md")).expect("the page");
    for name in NAMES {
        let start = format!("| {name} |");
        let row = page.lines().find(|line| line.starts_with(&start)).expect("a row");
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        for (cell, place, torque) in [(cells[2], 2e-6, 0.1), (cells[3], 1e-4, 1.0)] {
            let (places, torques) = cell.split_once(" / ").expect("two figures");
            let percent = torques.trim_start_matches("< ").trim_end_matches(" %");
            assert!(places.parse::<f64>().expect("places") <= place, "{row}");
            assert!(percent.parse::<f64>().expect("torques") <= torque, "{row}");
        }
    }
}
