//! Motions behind a shaper, whose delays put jumps anywhere inside a tick, against the rod.

use stillbeam_sim::compare::compare;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
use stillbeam_sim::table::Row;
use stillbeam_sim::truth::{self, Reference};

const PROFILES: [&str; 5] = ["cubic", "quintic", "cycloid", "trapezoid", "s-curve"];

/// Those of the program, pulses of any kind, and the shorter table with a negative pulse.
const SHAPERS: [&str; 7] = [
    "kind = \"zv\"",
    "kind = \"mzv\"",
    "kind = \"zvd\"",
    "kind = \"ei\"",
    "kind = \"2hump-ei\"",
    "pulses = [[0.3, 0.0], [0.5, 0.0133], [0.2, 0.0277]]",
    "pulses = [[1.0, 0.0], [-1.0, 0.0052], [1.0, 0.0104]]",
];

const TICKS: [f64; 3] = [0.002, 0.005, 0.01];

/// A first mode of 32 Hz: it turns by 2 rad in the longest tick, the second by 12.6.
fn scene(profile: &str, shaper: &str, tick: f64) -> SceneFile {
    let text = format!(
        "[link]\nlength = 0.25\nmass = 0.02\nbending_stiffness = 1.0219\n[move]\nprofile = \
         \"{profile}\"\nduration = 0.3\nto = 0.5\nsettle = 0.1\n[shaper]\n{shaper}\n[solver]\ntick \
         = {tick}\n"
    );
    SceneFile::parse("shaped", &text).expect("scene")
}

fn rod(scene: &SceneFile, tick: f64) -> Vec<Row> {
    let trajectory = scene.trajectory(tick).expect("trajectory");
    let times = truth::times(&trajectory, tick);
    truth::solve(Reference::Rod, scene, &trajectory, &times, &|_| {}).expect("rod")
}

/// Largest tip error, fraction of L, and torque error, fraction of the peak.
fn worst(profile: &str, shaper: &str, method: Method, truth: &[Row], tick: f64) -> (f64, f64) {
    let scene = scene(profile, shaper, tick);
    let solver = Solver { method, elements: 8, tick, ..Solver::default() };
    let rows = run(&scene, &solver).expect("run");
    let result = compare(&rows, truth, &scene).expect("comparison");
    assert!(result.common > 30, "only {} common times", result.common);
    (result.tip_max, result.torque)
}

/// Measured: tip 2e-7 to 6e-7 L; torque 0.01 % for what does not jump, 0.1 to 0.5 % for cubics, 0.2
/// to 1.0 % for trapezoids, which is that of the modes left out. Without the kinks: up to 2e-4 L
/// and 17 %.
#[test]
fn jumps_inside_a_tick_reach_modal_and_elastica() {
    for (k, profile) in PROFILES.into_iter().enumerate() {
        // Two of the shapers each, so that every one is met.
        for shaper in SHAPERS.into_iter().cycle().skip(3 * k).take(2) {
            let coarse = TICKS[2];
            let truth = rod(&scene(profile, shaper, coarse), coarse);
            for method in [Method::Modal, Method::Elastica] {
                for tick in TICKS {
                    let (tip, torque) = worst(profile, shaper, method, &truth, tick);
                    let case = format!("{profile}, {shaper}, {method:?}, {tick} s");
                    assert!(tip < 3e-6, "{case}: tip {tip:e}");
                    assert!(torque < 0.0105, "{case}: torque {torque}");
                }
            }
        }
    }
}
