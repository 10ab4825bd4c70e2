//! Scene files: what parses, and to what.

use stillbeam::Move;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::{Method, SolverKeys};
use stillbeam_tests::{TRUTH_SCENES, assert_near, truth};

fn parse(link: &str, rest: &str) -> SceneFile {
    let text =
        format!("[link]\n{link}\n{rest}\n[move]\nprofile = \"cubic\"\nduration = 1.0\nto = 1.0\n");
    SceneFile::parse("test", &text).expect("scene")
}

#[test]
fn truth_scenes_and_embedded_scenes_are_the_same() {
    for name in TRUTH_SCENES {
        let (file, _) = truth(name);
        let embedded = scenes::open(name).expect("embedded scene");
        assert_eq!(SceneFile { name: file.name.clone(), ..embedded }, file);
    }
}

#[test]
fn every_embedded_scene_is_valid() {
    assert!(scenes::list().count() >= 9);
    for (name, about) in scenes::list() {
        assert!(!about.is_empty());
        assert!(scenes::named(name).expect("listed").is_ok(), "{name}");
    }
}

#[test]
fn stiffness_comes_three_ways() {
    let direct = parse("length = 0.4\nmass = 0.00952\nbending_stiffness = 0.0213344", "");
    let section = parse(
        "length = 0.4\nmass = 0.00952\nyoungs_modulus = 3.2e9\nsecond_moment = 6.667e-12",
        "",
    );
    let strip = parse("length = 0.4\nmaterial = \"acrylic\"\nwidth = 0.01\nthickness = 0.002", "");
    let ei = direct.arm.link.bending_stiffness;
    assert_near("section", section.arm.link.bending_stiffness, ei, 1e-12);
    assert_near("strip", strip.arm.link.bending_stiffness, ei, 2e-6);
    assert_near("mass of the strip", strip.arm.link.mass, 0.00952, 1e-12);
}

#[test]
fn a_queue_of_moves_is_read_in_order() {
    let scene = scenes::open("pick-and-place").expect("embedded scene");
    let motions = scene.queue().expect("moves alone");
    assert_eq!(motions.len(), 6);
    assert!(matches!(motions[1], Move::Dwell { .. }));
    assert!(matches!(motions[2], Move::To { to: 0.7, .. }));
}

#[test]
fn command_line_over_file_over_defaults() {
    let file = SolverKeys { elements: Some(4), tick: Some(0.002), ..SolverKeys::default() };
    let typed = SolverKeys { elements: Some(2), ..SolverKeys::default() };
    let solver = typed.or(file).resolve().expect("solver");
    assert_eq!((solver.elements, solver.tick, solver.method), (2, 0.002, Method::Auto));
}

#[test]
fn the_solver_table_is_optional_and_its_keys_are_taken() {
    let link = "length = 0.4\nmass = 0.01\nbending_stiffness = 0.02";
    assert_eq!(parse(link, "").solver, SolverKeys::default());
    let scene = parse(link, "[solver]\nmethod = \"rigid\"\nspin = false\nscalar = \"f64\"");
    let solver = scene.solver.resolve().expect("solver");
    assert_eq!((solver.method, solver.spin), (Method::Rigid, false));
}
