//! Motions as people have them: samples, waypoints, joint trajectories, units, and no duration.

use std::fmt::Write;
use std::fs;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam_sim::compare::compare;
use stillbeam_sim::motion_file::{MotionFile, Options, Taking};
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::{Method, Scalar, Solver};
use stillbeam_sim::table::Row;
use stillbeam_sim::trajectory::Side;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_tests::{TRUTH_SCENES, assert_near};

const TICK: f64 = 0.01;
const ELASTICA: Solver = Solver { method: Method::Elastica, tick: TICK, ..Solver::PAPER };

/// The scene with the motion of a file instead of its own.
fn commanded(scene: &SceneFile, file: &str, text: &str, options: &Options) -> SceneFile {
    let folder = tempfile::tempdir().expect("folder");
    let path = folder.path().join(file);
    fs::write(&path, text).expect("a file");
    let motion = MotionFile::read(&path, options.joint.as_deref()).expect(text);
    motion.command(scene.clone(), options, TICK).expect(text).0
}

/// Angles of a scene's hub every `interval` s, changed by `by`, as CSV.
fn sampled(scene: &SceneFile, interval: f64, by: &mut dyn FnMut(f64) -> f64) -> String {
    let trajectory = scene.trajectory(TICK).expect("a motion");
    let mut text = "t_s,hub_angle_rad\n".to_owned();
    for t in truth::times(&trajectory, interval) {
        let angle = by(trajectory.at(t, Side::Left).angle.radians());
        writeln!(text, "{t},{angle}").expect("a string");
    }
    text
}

fn as_samples() -> Options {
    Options { taking: Some(Taking::Samples), ..Options::default() }
}

/// A cubic's acceleration jumps where the move begins and ends: the part between two rests is
/// fitted by itself, with any acceleration at its ends.
#[test]
fn samples_of_a_scene_command_it_again() {
    for name in TRUTH_SCENES {
        let scene = scenes::open(name).expect("embedded scene");
        let own = run(&scene, &ELASTICA).expect("run");
        for interval in [0.01, 0.001] {
            let text = sampled(&scene, interval, &mut |angle| angle);
            let again = commanded(&scene, "samples.csv", &text, &as_samples());
            let rows = run(&again, &ELASTICA).expect("run");
            let error = compare(&rows, &own, &scene).expect("comparison").tip_max;
            assert!(error < 2e-5, "{name}, {interval} s: {error:e} of L");
        }
    }
}

/// 1e-4 rad of noise, and steps of a 12-bit encoder: 2π/4096 = 1.5e-3 rad.
#[test]
fn noise_and_steps_of_an_encoder_hardly_reach_the_torque() {
    let scene = scenes::open("b-tip30").expect("embedded scene");
    let own = run(&scene, &ELASTICA).expect("run");
    let torque = |row: &Row| row.torque_nm;
    let peak = own.iter().map(|row| torque(row).abs()).fold(0.0, f64::max);
    let step = std::f64::consts::TAU / 4096.0;
    for interval in [0.01, 0.001] {
        let mut rng = StdRng::seed_from_u64(12);
        let mut noisy = |angle: f64| {
            // Twelve even numbers have a variance of one.
            let even: f64 = (0..12).map(|_| rng.random_range(-0.5..0.5)).sum();
            ((angle + 1e-4 * even) / step).round() * step
        };
        let text = sampled(&scene, interval, &mut noisy);
        let again = commanded(&scene, "samples.csv", &text, &as_samples());
        let rows = run(&again, &ELASTICA).expect("run");
        let off = rows.iter().zip(&own).map(|(a, b)| (torque(a) - torque(b)).abs());
        let off: Vec<f64> = off.collect();
        let most = off.iter().copied().fold(0.0, f64::max) / peak;
        let rms = (off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64).sqrt() / peak;
        let tip = compare(&rows, &own, &scene).expect("comparison").tip_max;
        // At 10 ms 0.003, 0.008 and 3.9e-4; at 1 ms less.
        assert!(rms < 0.005 && most < 0.015 && tip < 6e-4, "{interval}: {rms} {most} {tip}");
    }
}

const ARM: &str = "[link]\nlength = 0.4\nmass = 0.019\nbending_stiffness = 0.0427\n\
                   [payload]\nmass = 0.03\n";

fn parse(moves: &str) -> SceneFile {
    SceneFile::parse("test", moves).expect(moves)
}

fn scene(moves: &str) -> SceneFile {
    parse(&format!("{ARM}{moves}"))
}

/// The same motion from a scene file, a CSV, and JSON and YAML of ROS 2.
#[test]
fn one_path_in_four_files() {
    let listed = scene("[move]\nwaypoints = [[0.5, 0.2, 0.5], [1.25, 0.6, 0.0]]\n");
    let csv = "# measured\nhub_rate_rad_s,t_s,tip_x_m,hub_angle_rad\n0,10,1,0\n0.5,10.5,1,0.2\n0,11.25,1,0.6\n";
    let points = [(0, 0, 0.0, 0.0), (0, 500_000_000, 0.2, 0.5), (1, 250_000_000, 0.6, 0.0)];
    let json: Vec<String> = points
        .iter()
        .map(|(sec, nanosec, angle, rate)| {
            format!(
                "{{\"positions\": [9, {angle}], \"velocities\": [9, {rate}], \"effort\": [], \
                 \"time_from_start\": {{\"sec\": {sec}, \"nanosec\": {nanosec}}}}}"
            )
        })
        .collect();
    let json = format!("{{\"joint_names\": [\"a\", \"b\"], \"points\": [{}]}}", json.join(", "));
    let mut yaml = "trajectory:\n  header:\n    stamp: {sec: 0, nanosec: 0}\n    frame_id: ''\n  joint_names:\n  - a\n  - b\n  points:\n".to_owned();
    for (sec, nanosec, angle, rate) in points {
        let effort = "    effort: []\n";
        write!(
            yaml,
            "  - positions:\n    - 9.0\n    - {angle}\n    velocities: [9.0, {rate}]\n{effort}    \
             time_from_start:\n      sec: {sec}\n      nanosec: {nanosec}\n"
        )
        .expect("a string");
    }
    yaml += "---\n";
    let own = run(&listed, &ELASTICA).expect("run");
    for (file, text) in [("m.csv", csv), ("m.json", &json), ("m.yaml", &yaml)] {
        let joint = (file != "m.csv").then(|| "b".to_owned());
        let read = commanded(&listed, file, text, &Options { joint, ..Options::default() });
        assert_eq!(run(&read, &ELASTICA).expect("run"), own, "{file}");
    }
    // The rows are passed, and the end is kept.
    let at = |t: f64| own.iter().find(|row| (row.t_s - t).abs() < 1e-9).expect("a row");
    assert_near("angle at the first row", at(0.5).hub_angle_rad, 0.2, 1e-6);
    assert_near("rate at the first row", at(0.5).hub_rate_rad_s, 0.5, 1e-6);
    assert_near("angle at the end", at(1.25).hub_angle_rad, 0.6, 1e-6);
}

/// Rod, finite elements and elastica agree on a path whose rows lie inside ticks and within one.
#[test]
fn every_solver_takes_a_path() {
    let moves = "[[moves]]\nwaypoints = [[0.3171, 0.1], [0.5, 0.25], [0.5023, 0.2525], [0.9003, 0.5]]\n\
                 profile = \"quintic\"\nsettle = 0.1\n\
                 [[moves]]\nprofile = \"quintic\"\nduration = 0.5\nto = 0.2\n";
    let scene = scene(moves);
    let solver = Solver { scalar: Scalar::F64, ..ELASTICA };
    let rows = run(&scene, &solver).expect("run");
    let trajectory = scene.trajectory(TICK).expect("a motion");
    let times = truth::times(&trajectory, TICK);
    for reference in [Reference::Rod, Reference::Fem] {
        let truth = truth::solve(reference, &scene, &trajectory, &times, &|_| ()).expect("rows");
        let error = compare(&rows, &truth, &scene).expect("comparison").tip_max;
        // 1.2e-6 against either.
        assert!(error < 5e-6, "{reference:?}: {error:e}");
    }
    let auto = Solver { method: Method::Auto, ..ELASTICA };
    let error = compare(&run(&scene, &auto).expect("run"), &rows, &scene).expect("comparison");
    assert!(error.tip_max < 1e-2, "{error:?}");
}

#[test]
fn rounds_follow_each_other() {
    let there_and_back = "waypoints = [[0.5, 0.3], [1.0, 0.0, 0.0]]\n";
    let once = scene(&format!("[[moves]]\n{there_and_back}[[moves]]\n{there_and_back}"));
    let twice = scene(&format!("[move]\n{there_and_back}repeat = 2\n"));
    assert_eq!(
        run(&once, &ELASTICA).expect("run").len(),
        run(&twice, &ELASTICA).expect("run").len()
    );
    let [a, b] = [once, twice].map(|scene| scene.trajectory(TICK).expect("a motion"));
    for k in 0..200 {
        let t = f64::from(k) * TICK;
        let [a, b] = [&a, &b].map(|motion| motion.at(t, Side::Right));
        assert_near("angle", a.angle.radians(), b.angle.radians(), 1e-12);
        assert_near("rate", a.rate, b.rate, 1e-12);
    }
    // A round that ends elsewhere moves the next one on.
    let on = scene("[move]\nwaypoints = [[1.0, 0.25]]\nrepeat = 4\n");
    let end = on.trajectory(TICK).expect("a motion").at(4.0, Side::Left);
    assert_near("four steps", end.angle.radians(), 1.0, 1e-12);
}

#[test]
fn degrees_and_turns_are_units_too() {
    let moves = |factor: f64| {
        format!(
            "{ARM}[limits]\nrate = {}\nacceleration = {}\n[[moves]]\nprofile = \"cubic\"\nduration = \
             1.0\nfrom = {}\nto = {}\n[[moves]]\nwaypoints = [[1.0, {}, {}], [2.0, 0.0]]\n",
            180.0 * factor,
            1440.0 * factor,
            -45.0 * factor,
            45.0 * factor,
            90.0 * factor,
            30.0 * factor
        )
    };
    let degrees = parse(&format!("unit = \"deg\"\n{}", moves(1.0)));
    let turns = parse(&format!("unit = \"turn\"\n{}", moves(1.0 / 360.0)));
    let radians = parse(&moves(1f64.to_radians()));
    assert_eq!(degrees.remarks, Vec::<String>::new());
    assert_near("rate", degrees.limits.rate.expect("a limit"), std::f64::consts::PI, 1e-15);
    assert_near("from", degrees.from, -std::f64::consts::FRAC_PI_4, 1e-15);
    for other in [&degrees, &turns] {
        let [a, b] = [other, &radians].map(|scene| scene.trajectory(TICK).expect("a motion"));
        for k in 0..300 {
            let [a, b] = [&a, &b].map(|motion| motion.at(f64::from(k) * TICK, Side::Right));
            assert_near("angle", a.angle.radians(), b.angle.radians(), 1e-14);
        }
    }
    let fast = format!("unit = \"deg\"\n{}", moves(1.0)).replace("rate = 180", "rate = 90");
    let error = SceneFile::parse("test", &fast).unwrap_err().to_string();
    assert!(error.contains("angles are in rad in this line, in deg in the file"), "{error}");
    let error = SceneFile::parse("test", &format!("unit = \"grad\"\n{}", moves(1.0))).unwrap_err();
    assert!(
        error.to_string().contains("unit = \"grad\": must be one of rad, deg, turn"),
        "{error}"
    );
}

/// Moves without a duration take the shortest within limits of the motion, of the loads, and of a
/// hub that turns on.
#[test]
fn a_duration_may_be_left_out() {
    let limits = "[limits]\nrate = 2.0\nacceleration = 6.0\ntorque = 0.04\n";
    let moves = "[[moves]]\nprofile = \"quintic\"\nto = 0.8\n\
                 [[moves]]\nprofile = \"s-curve\"\nto = 1.4\nrate = 0.5\n\
                 [[moves]]\nprofile = \"quintic\"\nto = 2.0\nsettle = 0.5\n";
    let found = scene(&format!("{limits}{moves}"));
    run(&found, &ELASTICA).expect("the limits are kept");
    let notes = found.roundings(TICK).expect("notes");
    assert!(notes[0].contains("the shortest within the limits"), "{notes:?}");
    // Typed, each is taken; much shorter, none.
    for share in [1.0, 0.85] {
        let typed = found.moves.iter().zip(moves.split("[[moves]]").skip(1)).map(|(step, text)| {
            format!("[[moves]]\nduration = {}{text}", share * step.motion.duration())
        });
        let typed = format!("{ARM}{limits}{}", typed.collect::<String>());
        let taken = SceneFile::parse("test", &typed).and_then(|scene| run(&scene, &ELASTICA));
        assert_eq!(taken.is_ok(), share == 1.0, "{share}: {:?}", taken.err());
    }
    let text = format!("{ARM}[move]\nprofile = \"quintic\"\nto = 0.8\n");
    let error = SceneFile::parse("test", &text).unwrap_err().to_string();
    assert!(
        error.contains("move.duration: missing; must be a number in s, or [limits]"),
        "{error}"
    );
}
