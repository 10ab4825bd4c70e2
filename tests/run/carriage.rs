//! Arms on a linear axis: the two references and the methods against each other, tables and
//! refusals in metres.

use stillbeam_lab::reference::truth::{Apart, difference};
use stillbeam_sim::compare::{Comparison, compare};
use stillbeam_sim::reference::{fem, rod};
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Quality, Scalar, Solver};
use stillbeam_sim::table;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_tests::features::featured;

/// Member D on a carriage that moves by 0.5 m in 0.6 s, and what is put before and after that.
fn scene(head: &str, motion: &str) -> SceneFile {
    SceneFile::parse("carriage", &text(head, motion)).expect("a scene")
}

pub(super) fn text(head: &str, motion: &str) -> String {
    let motion = if motion.is_empty() {
        "profile = \"cubic\"\nduration = 0.6\nto = 0.5\nsettle = 0.2\n"
    } else {
        motion
    };
    format!(
        "axis = \"linear\"\nhub.mass = 0.3\n{head}\n[link]\nlength = 0.4\nmass = 0.0224\n\
         bending_stiffness = 0.46\n[move]\n{motion}"
    )
}

const HEAVY: &str = "payload = { mass = 0.03, inertia = 1e-5 }\n";
const LIFTED: &str = "gravity.acceleration = 9.81\npayload.mass = 0.03\n";
const HANGING: &str = "gravity = { acceleration = 9.81, direction = 1.2 }\npayload.mass = 0.03\n";

/// Largest distance of the tips, of L, and difference of the forces, of the peak.
pub(super) fn against_rod(scene: &SceneFile, solver: &Solver) -> Comparison {
    let rows = run(scene, solver).expect("a run");
    let trajectory = scene.trajectory(solver.tick).expect("a motion");
    let times = truth::times(&trajectory, solver.tick);
    let rod = truth::solve(Reference::Rod, scene, &trajectory, &times, &|_| ()).expect("the rod");
    compare(&rows, &rod, scene).expect("common times")
}

/// Differences of the two references every `interval` s.
pub(super) fn references(scene: &SceneFile, interval: f64) -> Apart {
    let trajectory = scene.trajectory(0.01).expect("a motion");
    let times = truth::times(&trajectory, interval);
    let rod = rod::solve(&scene.arm, &trajectory, &times, &rod::Options::default());
    let fem = fem::solve(&scene.arm, &trajectory, &times, &fem::Options::default());
    let (rod, fem) = (rod.expect("the rod"), fem.expect("the elements"));
    difference(&scene.arm, &trajectory, &fem, &rod)
}

/// Residual of a still move in two periods, of L, by the rod.
pub(super) fn left_of_a_still_move(scene: impl Fn(&str) -> SceneFile, to: f64) -> f64 {
    let duration = 2.0 * rod::first_period(&scene("").arm).expect("a period");
    let motion = format!("profile = \"still\"\nduration = {duration}\nto = {to}\nsettle = 0.2\n");
    let scene = scene(&motion);
    let trajectory = scene.trajectory(0.01).expect("a motion");
    let times = truth::times(&trajectory, 0.002);
    let rows = truth::solve(Reference::Rod, &scene, &trajectory, &times, &|_| ()).expect("the rod");
    let left = stillbeam_sim::compare::residual(&rows, &scene, 0.01).expect("a rest");
    left.value().expect("at rest")
}

/// Elastica with two modes, as exact as it is.
pub(super) const FINE: Solver = Solver {
    method: Method::Elastica,
    modes: 2,
    quality: Quality::Fine,
    scalar: Scalar::F32,
    ..Solver::PAPER
};

/// The two references share no method: the one follows shapes in the frame of the carriage, the
/// other nodes in the global frame.
#[test]
fn both_references_agree_on_a_carriage() {
    for head in [HEAVY, HANGING] {
        let apart = references(&scene(head, ""), 0.02);
        assert!(apart.tip < 2e-4 && apart.torque < 0.01, "{head}: {apart:?}");
    }
}

/// On a vertical axis, behind an input shaper.
const SHAPED: &str = "gravity.acceleration = 9.81\npayload.mass = 0.03\nshaper.kind = \"zv\"\n";

/// Measured: at most 1.7e-5 of L, and 1.0e-2 of the force, which is that of the modes left out:
/// the cubic's acceleration jumps.
#[test]
fn elastica_follows_the_rod_on_a_carriage() {
    for head in [HEAVY, LIFTED, HANGING, SHAPED] {
        let found = against_rod(&scene(head, ""), &FINE);
        println!("{head:?}: {:.1e} of L, {:.1e} of the force", found.tip_max, found.torque);
        assert!(found.tip_max < 4e-5, "{head}: {} of L", found.tip_max);
        assert!(found.torque < 0.012, "{head}: {} of the force", found.torque);
    }
}

#[test]
fn small_deflections_follow_the_rod_on_a_carriage() {
    for head in ["", HANGING] {
        for (method, tip) in [(Method::Newmark, 0.02), (Method::Modal, 0.01)] {
            let solver = Solver { method, elements: 4, tick: 0.002, ..Solver::PAPER };
            let found = against_rod(&scene(head, ""), &solver);
            println!("{head:?} {method:?}: {:.1e} of L, {:.1e}", found.tip_max, found.torque);
            assert!(found.tip_max < tip, "{head} {method:?}: {} of L", found.tip_max);
        }
    }
}

/// A still move on a carriage, judged by the rod: 0.02 % of L. The bare arm rings in its second
/// mode, by 0.042 % of L; on a hub that turns the same arm leaves 0.034 %.
#[test]
fn a_still_move_on_a_carriage_arrives_still() {
    for head in ["", HEAVY, LIFTED, HANGING] {
        let left = left_of_a_still_move(|motion| scene(head, motion), 0.3);
        println!("{head:?}: {:.5} % of L", 100.0 * left);
        let bound = if head.is_empty() { 5e-4 } else { 2e-4 };
        assert!(left < bound, "{head}: {left} of L");
    }
}

/// A hub so large that its rim is nearly a straight line carries the arm as a carriage does. Its
/// rim strays from the line by 0.5²/2r, and the spin pulls at the arm by v²/r.
#[test]
fn a_carriage_is_the_rim_of_a_hub_that_grows() {
    let carriage = scene(HEAVY, "");
    let deflections = |scene: &SceneFile| {
        let trajectory = scene.trajectory(0.01).expect("a motion");
        let times = truth::times(&trajectory, 0.01);
        let rod = rod::solve(&scene.arm, &trajectory, &times, &rod::Options::default());
        rod.expect("the rod").iter().map(|sample| sample.deflection).collect::<Vec<_>>()
    };
    let straight = deflections(&carriage);
    let mut last = f64::INFINITY;
    for radius in [10.0, 100.0, 1000.0] {
        let head = format!("hub.radius = {radius}\n{HEAVY}");
        let motion =
            format!("profile = \"cubic\"\nduration = 0.6\nto = {}\nsettle = 0.2\n", 0.5 / radius);
        let text = text(&head, &motion).replace("axis = \"linear\"\nhub.mass = 0.3\n", "");
        let turning = deflections(&SceneFile::parse("rim", &text).expect("a scene"));
        let apart = straight.iter().zip(&turning).map(|(a, b)| (a - b).abs() / 0.4);
        let apart = apart.fold(0.0, f64::max);
        println!("r = {radius} m: {apart:.1e} of L");
        assert!(apart < 0.2 * last, "r = {radius} m: {apart} of L after {last}");
        last = apart;
    }
    assert!(last < 2e-4, "{last} of L");
}

#[test]
fn a_carriage_writes_metres_and_newtons() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("carriage.csv");
    let scene = scene("", "");
    let rows = run(&scene, &Solver::PAPER).expect("a run");
    table::write(&path, scene.arm.mount.axis, &rows).expect("a table");
    let header = std::fs::read_to_string(&path).expect("the table");
    assert_eq!(
        header.lines().next(),
        Some(
            "t_s,hub_position_m,hub_velocity_m_s,hub_acceleration_m_s2,tip_x_m,tip_y_m,\
             deflection_m,force_n"
        )
    );
    let back = table::read(&path).expect("a table");
    assert_eq!(back.len(), rows.len());
    let end = back.last().expect("rows").hub_angle_rad;
    assert!((end - 0.5).abs() < 1e-7, "{end} m, in single precision");
}

/// Every refusal names its key and speaks of metres and newtons.
#[test]
fn refusals_of_a_carriage_are_in_its_units() {
    let moving = "profile = \"cubic\"\nduration = 0.6\nto = 0.5\n";
    let far = "profile = \"cubic\"\nduration = 0.6\nto = 1e9\n";
    let fast = "profile = \"cubic\"\nduration = 0.6\nto = 200.0\n";
    for (head, motion, words) in [
        ("limits.rate = 0.5", moving, ["limits.rate = 0.5", "1.250000 m/s"]),
        ("limits.acceleration = 2.0", moving, ["limits.acceleration = 2", "m/s^2"]),
        ("", far, ["move.to", "1000000 m"]),
        ("", fast, ["500", "one metre a tick"]),
        ("hub.inertia = 0.1", moving, ["hub.inertia = 0.1", "hub.mass"]),
        ("gravity.tilt = 0.2", moving, ["gravity.tilt = 0.2", "gravity.acceleration"]),
        (
            "gravity = { acceleration = 9.81, tilt = 2.0 }",
            moving,
            ["gravity.tilt = 2", "0 to 1.57"],
        ),
    ] {
        let error = SceneFile::parse("carriage", &text(head, motion)).expect_err(head).to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{head}: {error}");
        assert!(!error.contains("rad/s") && !error.contains('\n'), "{head}: {error}");
    }
    let parsed = |head: &str| SceneFile::parse("axis", &text("", "").replace("\"linear\"", head));
    let error = parsed("\"sideways\"").expect_err("no such axis").to_string();
    assert!(error.contains("axis = \"sideways\": must be rotary or linear"), "{error}");
    let error = parsed("\"rotary\"").expect_err("a hub has no mass").to_string();
    assert!(error.contains("hub.mass = 0.3") && error.contains("hub.inertia"), "{error}");
    let scene = scene("limits.torque = 0.4", moving);
    let error = run(&scene, &Solver::PAPER).expect_err("too weak a drive").to_string();
    assert!(error.contains("limits.torque = 0.4") && error.contains(" N at "), "{error}");
}

#[test]
fn a_carriage_is_described_by_the_mass_that_it_moves() {
    let report = stillbeam_sim::arm::describe(&scene(LIFTED, "")).expect("a report");
    assert_eq!((report.axis, report.inertia_kgm2), ("linear", None));
    let moved = report.moved_mass_kg.expect("a mass");
    assert!((moved - 0.3524).abs() < 1e-12, "{moved} kg");
    assert_eq!(report.sag_m, report.sag_at_start_m);
}

/// Joints that give, payloads beyond the tip, sections and masses ride on a carriage too: the first
/// alone, and all at once, where any that is left out shows.
#[test]
fn every_link_rides_on_a_carriage() {
    let plain = scene(LIFTED, "");
    let all = featured(&plain.arm);
    for (feature, arm) in [&all[0], &all[all.len() - 1]] {
        let found = against_rod(&SceneFile { arm: *arm, ..plain.clone() }, &FINE);
        println!("{feature}: {:.1e} of L, {:.1e} of the force", found.tip_max, found.torque);
        assert!(found.tip_max < 4e-4, "{feature}: {} of L", found.tip_max);
        assert!(found.torque < 0.015, "{feature}: {} of the force", found.torque);
    }
    let (feature, arm) = all[all.len() - 1];
    let apart = references(&SceneFile { arm, ..plain.clone() }, 0.05);
    assert!(apart.tip < 2e-4, "{feature}: {apart:?}");
}
