//! Arms with joints that give, payloads beyond the tip and links of sections: the two references
//! against each other, and the methods of the tick against the rod.

use std::f64::consts::PI;
use std::sync::OnceLock;

use stillbeam::planner::{Planner, Request};
use stillbeam::{Link, Payload, Scene};
use stillbeam_lab::reference::truth::difference;
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::reference::{Sample, fem, rod};
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::{Method, Quality, Scalar, Solver, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_tests::features::featured;

const TICK: f64 = 0.01;

fn with(file: &SceneFile, arm: Scene) -> SceneFile {
    SceneFile { arm, ..file.clone() }
}

fn times(file: &SceneFile) -> Vec<f64> {
    let ticks = file.trajectory(TICK).expect("a motion").ticks();
    (0..=ticks).map(|k| k as f64 * TICK).collect()
}

fn by_rod(file: &SceneFile) -> Vec<Sample> {
    let trajectory = file.trajectory(TICK).expect("a motion");
    // A hundredth of every bound here.
    let options = rod::Options { order: 6, tolerance: 1e-8, integrator: None };
    rod::solve(&file.arm, &trajectory, &times(file), &options).expect("a run")
}

/// The rows of a method in double precision.
fn by_method(file: &SceneFile, keys: SolverKeys) -> Vec<Row> {
    let solver = SolverKeys { scalar: Some(Scalar::F64), ..keys }.resolve().expect("a solver");
    run(file, &solver).expect("a run")
}

/// A scene whose arm has a feature, and what the rod makes of it.
struct Featured {
    scene: &'static str,
    feature: &'static str,
    file: SceneFile,
    truth: Vec<Sample>,
}

/// Features that a slow arm under a heavy payload shows beside those of the other scenes.
const SLOW: [&str; 3] = ["offset", "all", "all, damped joint"];

/// The scenes with every feature. They are solved once for all tests.
fn every_feature() -> &'static [Featured] {
    static SOLVED: OnceLock<Vec<Featured>> = OnceLock::new();
    SOLVED.get_or_init(|| {
        let of = |scene| {
            let file = scenes::open(scene).expect("a scene");
            let shown =
                move |(feature, _): &(&str, Scene)| scene != "a-tip30" || SLOW.contains(feature);
            featured(&file.arm).into_iter().filter(shown).map(move |(feature, arm)| {
                let file = with(&file, arm);
                let truth = by_rod(&file);
                Featured { scene, feature, file, truth }
            })
        };
        ["d-fast", "a-tip30", "s-gravity"].into_iter().flat_map(of).collect()
    })
}

/// The two solvers share nothing but the scene: a term that one lacks shows.
#[test]
fn rod_and_elements_agree_on_every_feature() {
    for Featured { scene, feature, file, truth } in every_feature() {
        let options = match *scene {
            "d-fast" => fem::Options { elements: 16, ..Default::default() },
            _ => fem::Options { elements: 16, step: Some(2e-3), ..Default::default() },
        };
        let trajectory = file.trajectory(TICK).expect("a motion");
        let elements = fem::solve(&file.arm, &trajectory, &times(file), &options).expect("a run");
        let apart = difference(&file.arm, &trajectory, &elements, truth);
        println!("{scene}, {feature}: {apart:?}");
        assert!(apart.tip < 2e-4 && apart.torque < 0.01, "{scene}, {feature}: {apart:?}");
    }
}

/// The payload's centre is `d` beyond the tip in both.
#[test]
fn the_payload_comes_out() {
    let file = scenes::open("s-gravity").expect("a scene");
    let arm = featured(&file.arm)[2].1;
    let file = with(&file, arm);
    let rows =
        by_method(&file, SolverKeys { method: Some(Method::Elastica), ..Default::default() });
    for (row, sample) in rows.iter().zip(&by_rod(&file)) {
        let [x, y] = [row.payload_x_m, row.payload_y_m].map(|x| x.expect("a column"));
        let apart = (x - sample.payload[0]).hypot(y - sample.payload[1]);
        assert!(apart < 2e-4, "{} s: {apart} m", row.t_s);
    }
    let trajectory = file.trajectory(TICK).expect("a motion");
    let options = fem::Options { elements: 8, step: Some(2e-3), ..Default::default() };
    let elements = fem::solve(&arm, &trajectory, &times(&file), &options).expect("a run");
    for (a, b) in elements.iter().zip(&by_rod(&file)) {
        let apart = (a.payload[0] - b.payload[0]).hypot(a.payload[1] - b.payload[1]);
        assert!(apart < 2e-4, "{} s: {apart} m", a.t);
        let ahead = (b.payload[0] - b.tip[0]).hypot(b.payload[1] - b.tip[1]);
        assert!((ahead - arm.payload.offset).abs() < 1e-6, "{ahead} m");
    }
}

/// Largest distance of the tip from the rod's, fraction of L, of two modes in ticks of 10 ms in
/// f32.
fn error(file: &SceneFile, truth: &[Sample]) -> f64 {
    let solver = Solver {
        method: Method::Elastica,
        modes: 2,
        quality: Quality::Fast,
        tick: TICK,
        scalar: Scalar::F32,
        ..Solver::PAPER
    };
    let rows = run(file, &solver).expect("a run");
    let apart = |(row, sample): (&Row, &Sample)| {
        (row.tip_x_m - sample.tip[0]).hypot(row.tip_y_m - sample.tip[1])
    };
    rows.iter().zip(truth).map(apart).fold(0.0, f64::max) / file.arm.link.length
}

/// Two modes do not hold the angle of a root that a joint's own damping keeps back.
#[test]
fn ticks_follow_every_feature_as_they_do_the_plain_arm() {
    let mut failed = Vec::new();
    // Most features leave the payload as it is, and are compared with the same plain arm.
    let mut known: Vec<(Scene, f64)> = Vec::new();
    for Featured { scene, feature, file, truth } in every_feature() {
        let error_with = error(file, truth);
        // The same arm but for the feature: a payload of the same mass at the tip itself.
        let mut arm = scenes::open(scene).expect("a scene").arm;
        arm.payload = Payload { offset: 0.0, ..file.arm.payload };
        let found = known.iter().find(|(known, _)| *known == arm).map(|(_, error)| *error);
        let plain = found.unwrap_or_else(|| {
            let file = with(file, arm);
            let plain = error(&file, &by_rod(&file));
            known.push((arm, plain));
            plain
        });
        println!("{scene}, {feature}: {error_with:.1e}, plain {plain:.1e}");
        // An offset of 0.1 L makes up to 2.9 times the error, which a third mode takes away
        // (2.2e-5 in place of 8.4e-5 in a-tip30); sections up to 2.3 times, which half-steps take
        // away (2.0e-5 in place of 5.9e-5). Several features at once half the stiffness and less.
        let bound = match *feature {
            _ if file.arm.damping.joint > 0.0 => 1.4e-3,
            "all" => 1.2e-3,
            _ => 3.0 * plain,
        };
        if error_with > bound {
            failed.push((scene, feature, error_with, bound));
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// A half turn in two periods leaves the arm within 0.01 % of L.
#[test]
fn still_moves_are_still_behind_a_joint_and_with_a_payload_beyond_the_tip() {
    let mut machine = Scene::new(Link { length: 0.44, mass: 0.27646, bending_stiffness: 94.74 });
    machine.payload.mass = 0.95;
    machine.hub.stiffness = Some(7.1e3);
    // An aluminium strip of 0.5 m × 40 × 4 mm.
    let mut gripper = Scene::new(Link { length: 0.5, mass: 0.224, bending_stiffness: 14.72 });
    gripper.payload = Payload { mass: 0.5, inertia: 4e-4, offset: 0.05 };
    let file = scenes::open("a-tip30").expect("a scene");
    let mut arms = vec![("machine", machine), ("gripper", gripper)];
    arms.extend(featured(&file.arm));
    let mut failed = Vec::new();
    for (name, arm) in arms {
        let planner = Planner::<f32, 2>::new(&arm, TICK).expect("a planner");
        let duration = 2.0 * planner.first_period();
        let request = Request::from_rest(0.0, PI).duration(duration).any_deflection();
        let plan = planner.plan(&request).expect("a plan");
        let motion = Motion::of(0.0, plan.motion(), plan.tick);
        let left = motion.judge(&arm, 0.0).expect("a run").residual;
        println!("{name}: {left:.1e}");
        // The planner's six points see less of the kinks of sections.
        let bound = if arm.shape.is_uniform() { 1e-4 } else { 3e-4 };
        if left > bound {
            failed.push((name, left));
        }
    }
    assert!(failed.is_empty(), "{failed:?}");
}

/// Behind a joint of 10⁸ EI/L every method ends where it does behind a clamp, to 1e-6 of L.
#[test]
fn a_joint_that_hardly_gives_is_a_clamp() {
    let file = scenes::open("a-tip30").expect("a scene");
    let mut arm = file.arm;
    arm.hub.stiffness = Some(1e8 * arm.link.bending_stiffness / arm.link.length);
    let runs = |arm: &Scene| {
        let file = with(&file, *arm);
        let keys = |method| SolverKeys { method: Some(method), ..Default::default() };
        [
            SolverKeys { elements: Some(4), ..keys(Method::Newmark) },
            keys(Method::Modal),
            SolverKeys { quality: Some(Quality::Fast), ..keys(Method::Elastica) },
        ]
        .map(|keys| by_method(&file, keys))
    };
    for (stiff, clamped) in runs(&arm).iter().zip(&runs(&file.arm)) {
        for (a, b) in stiff.iter().zip(clamped) {
            let apart = (a.tip_x_m - b.tip_x_m).hypot(a.tip_y_m - b.tip_y_m);
            assert!(apart < 1e-6 * arm.link.length, "{} s: {apart} m", a.t_s);
        }
    }
    let apart = |a: &[Sample], b: &[Sample]| {
        let each = |(a, b): (&Sample, &Sample)| (a.deflection - b.deflection).abs();
        a.iter().zip(b).map(each).fold(0.0, f64::max)
    };
    assert!(apart(&by_rod(&with(&file, arm)), &by_rod(&file)) < 1e-6 * arm.link.length);
}
