//! Arms on a carrier that turns: the two references and every method against each other, and what
//! is refused.

use stillbeam_sim::arm::describe;
use stillbeam_sim::compare::compare;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Mass, Method, Scalar, Solver};

use super::carriage::{FINE, against_rod, left_of_a_still_move, references, text};

/// A carrier that turns: the link feels the sum of both turns, and is straight before the move. The
/// rods of both references judge it, the one in the hub frame, the other from outside.
fn on_carrier(head: &str, motion: &str) -> SceneFile {
    carried("8.0", "0.05", head, motion)
}

fn carried(rate: &str, radius: &str, head: &str, motion: &str) -> SceneFile {
    let mount = format!("carrier.rate = {rate}\nhub.radius = {radius}\n");
    let text = text(head, motion).replace("axis = \"linear\"\nhub.mass = 0.3\n", &mount);
    SceneFile::parse("carrier", &text).expect("a scene")
}

#[test]
fn both_references_and_elastica_agree_on_a_carrier_that_turns() {
    let motion = "profile = \"quintic\"\nduration = 0.4\nto = 1.0\nsettle = 0.1\n";
    let scene = on_carrier("payload.mass = 0.02\n", motion);
    let apart = references(&scene, 0.02);
    assert!(apart.tip < 2e-4 && apart.torque < 0.01, "{apart:?}");
    let resting = SceneFile { arm: resting(&scene), ..scene.clone() };
    let found = against_rod(&scene, &FINE);
    println!("{:.1e} of L, {:.1e} of the torque", found.tip_max, found.torque);
    assert!(found.tip_max < 2e-4 && found.torque < 0.01, "{found:?}");
    let modal = Solver { method: Method::Modal, modes: 2, elements: 8, ..FINE };
    let found = against_rod(&scene, &modal);
    assert!(found.tip_max < 0.02, "{found:?}");
    // What the carrier does is far more than these errors.
    let without = run(&resting, &FINE).expect("a run");
    let with = run(&scene, &FINE).expect("a run");
    let change = compare(&with, &without, &scene).expect("common times");
    assert!(change.tip_max > 5e-3, "{change:?}");
}

/// Newmark's rule, the rate of hub and carrier in its spin terms: four elements and eight err by at
/// most 3.6e-4 of L and 0.5 % of the torque, as on a carrier that rests (3.6e-4, 0.4 %). A coarse
/// mesh errs where the carrier bends the second mode: 2.9e-3 and 3.5 %.
#[test]
fn newmark_follows_the_rod_on_a_carrier_that_turns() {
    let motion = "profile = \"quintic\"\nduration = 0.4\nto = 1.0\nsettle = 0.1\n";
    let payload = "payload = { mass = 0.02, inertia = 1e-5 }\n";
    for (rate, radius) in [("8.0", "0.05"), ("-8.0", "0.05"), ("20.0", "0.2")] {
        let scene = carried(rate, radius, payload, motion);
        for (elements, mass, tip, torque) in [
            (1, Mass::Consistent, 3.2e-3, 0.038),
            (4, Mass::Consistent, 4e-4, 0.006),
            (8, Mass::Consistent, 4e-4, 0.006),
            (8, Mass::Lumped, 3.2e-3, 0.038),
        ] {
            let (method, scalar) = (Method::Newmark, Scalar::F32);
            let solver = Solver { method, elements, mass, tick: 0.001, scalar, ..Solver::PAPER };
            let found = against_rod(&scene, &solver);
            println!("{rate} rad/s, {elements} {mass:?}: {found:?}");
            assert!(found.tip_max < tip, "{rate} rad/s, {elements} {mass:?}: {found:?}");
            assert!(found.torque < torque, "{rate} rad/s, {elements} {mass:?}: {found:?}");
        }
        // What the carrier does is more than these errors, against the hub's turn too (1.1e-3).
        let resting = SceneFile { arm: resting(&scene), ..scene.clone() };
        let fine = Solver { tick: 0.004, ..FINE };
        let [with, without] = [&scene, &resting].map(|scene| run(scene, &fine).expect("a run"));
        let change = compare(&with, &without, &scene).expect("common times");
        assert!(change.tip_max > 1e-3, "{change:?}");
    }
}

/// `auto` chooses on a carrier, keeps its tolerances by the rod, and `arm` says so.
#[test]
fn auto_chooses_on_a_carrier_that_turns() {
    let motion = "profile = \"quintic\"\nduration = 0.4\nto = 1.0\nsettle = 0.1\n";
    for (to, rate) in [("1.0", "8.0"), ("0.1", "8.0"), ("1.0", "-20.0")] {
        let motion = motion.replace("to = 1.0", &format!("to = {to}"));
        let scene = carried(rate, "0.05", "payload.mass = 0.02\n", &motion);
        let auto = Solver { method: Method::Auto, ..Solver::PAPER };
        let found = against_rod(&scene, &auto);
        println!("{to} rad at {rate} rad/s: {:.1e} of L, {:.1e}", found.tip_max, found.torque);
        assert!(found.tip_max < auto.tolerance, "{found:?}");
        assert!(found.torque < auto.torque_tolerance, "{found:?}");
        let method = describe(&scene).expect("a report").method.expect("a method");
        println!("{}: {}", method.name, method.why);
        assert!(method.tip_error <= auto.tolerance, "{method:?}");
    }
}

/// Any mesh of small deflections, and none without the spin's terms, which are all that a carrier
/// is felt through.
#[test]
fn small_deflections_without_spin_are_refused_on_a_carrier_that_turns() {
    let motion = "profile = \"quintic\"\nduration = 0.4\nto = 1.0\n";
    let scene = carried("8.0", "0.05", "", motion);
    for method in [Method::Newmark, Method::Modal] {
        let solver = Solver { method, elements: 2, mass: Mass::Lumped, modes: 1, ..Solver::PAPER };
        run(&scene, &solver).expect("a run");
        let error =
            run(&scene, &Solver { spin: false, ..solver }).expect_err("no spin").to_string();
        assert!(
            error.contains("solver.spin = false") && error.contains("carrier.rate = 8"),
            "{error}"
        );
    }
}

fn resting(scene: &SceneFile) -> stillbeam::Scene {
    let mount = stillbeam::Mount { carrier: 0.0, ..scene.arm.mount };
    stillbeam::Scene { mount, ..scene.arm }
}

#[test]
fn a_still_move_on_a_carrier_that_turns_arrives_still() {
    let left = left_of_a_still_move(|motion| on_carrier("payload.mass = 0.02\n", motion), 1.0);
    assert!(left < 2e-4, "{left} of L");
}

#[test]
fn a_carrier_is_refused_with_what_it_has_no_equilibrium_with() {
    let moving = "profile = \"cubic\"\nduration = 0.6\nto = 0.5\n";
    for (head, words) in [
        ("gravity.acceleration = 9.81", ["gravity.acceleration", "carrier"]),
        ("damping.alpha = 0.1", ["damping.alpha = 0.1", "carrier"]),
    ] {
        let text = text(head, moving)
            .replace("axis = \"linear\"\nhub.mass = 0.3\n", "carrier.rate = 8.0\n");
        let error = SceneFile::parse("carrier", &text).expect_err(head).to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
    let text = text("carrier.rate = 8.0", moving);
    let error = SceneFile::parse("carrier", &text).expect_err("no turn").to_string();
    assert!(error.contains("carrier.rate = 8") && error.contains("linear"), "{error}");
}
