//! Moves of a scene file: in the shortest time, passing into each other, and with accelerations at
//! the ends of a path.

use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
use stillbeam_sim::trajectory::{Side, Trajectory};
use stillbeam_tests::assert_near;

const TICK: f64 = 0.01;
const RIGID: Solver = Solver { method: Method::Rigid, tick: TICK, ..Solver::PAPER };

const ARM: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n";

fn scene(text: &str) -> SceneFile {
    SceneFile::parse("test", &format!("{ARM}{text}")).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str) -> String {
    SceneFile::parse("test", &format!("{ARM}{text}")).expect_err(text).to_string()
}

fn motion(scene: &SceneFile) -> Trajectory {
    scene.trajectory(TICK).expect("a motion")
}

fn notes(scene: &SceneFile) -> String {
    scene.roundings(TICK).expect("a motion").join("\n")
}

/// Rate 25, acceleration 4, jerk 3: `25/4 + 4/3 = 7.58 s` of ramp, which turn by `½ 25 · 7.583 =
/// 94.8 rad`. What is left of 100 rad is turned at 25 rad/s.
#[test]
fn a_reach_meets_its_angle_at_a_rate() {
    let limits = "[limits]\nrate = 25.0\nacceleration = 4.0\njerk = 3.0\n";
    let text = format!("{limits}[move]\nprofile = \"reach\"\nto = 100.0\nrate = 25.0\n");
    let scene = scene(&text);
    let along = motion(&scene);
    let ramp = 25.0 / 4.0 + 4.0 / 3.0;
    let all = ramp + (100.0 - 0.5 * 25.0 * ramp) / 25.0;
    let [before, after, there] = [ramp - 0.01, ramp + 1e-3, all].map(|t| along.at(t, Side::Left));
    assert!(before.rate < 25.0 - 1e-5 && (after.rate - 25.0).abs() < 1e-9, "{after:?}");
    assert!(along.at(ramp, Side::Left).angle.radians() < 94.8);
    assert_near("angle", there.angle.radians(), 100.0, 1e-9);
    assert_near("rate", there.rate, 25.0, 1e-12);
    let text = notes(&scene);
    assert!(text.contains("move.duration = 7.791666667 s, the shortest"), "{text}");
    let rows = run(&scene, &RIGID).expect("run");
    let end = rows.last().expect("a row");
    assert_near("the run's rate", end.hub_rate_rad_s, 25.0, 1e-5);
    // With an acceleration that may jump, and none to reach: rest to rest.
    let text = "[limits]\nrate = 2.0\nacceleration = 4.0\n[move]\nprofile = \"reach\"\nto = 3.0\n";
    assert_near("rest to rest", motion_end(text), 2.0, 1e-9);
}

/// Time of the last arrival, s.
fn motion_end(text: &str) -> f64 {
    motion(&scene(text)).arrivals().last().expect("an arrival")
}

#[test]
fn a_ramp_reaches_its_rate_and_comes_back() {
    let text = "[limits]\nacceleration = 4.0\ndeceleration = 8.0\njerk = 40.0\n\
                [[moves]]\nprofile = \"ramp\"\nrate = -3.0\nsettle = 0.5\n\
                [[moves]]\nprofile = \"ramp\"\nrate = 0.0\n";
    let scene = scene(text);
    let along = motion(&scene);
    let up = 3.0 / 4.0 + 4.0 / 40.0;
    assert_near("rate", along.at(up, Side::Left).rate, -3.0, 1e-9);
    let ends: Vec<f64> = along.arrivals().collect();
    let down = 3.0 / 8.0 + 8.0 / 40.0;
    // The way down begins at a tick, half a second behind the one in which the way up ends.
    let begun = ends[0] + 0.5;
    assert!((along.at(begun + down, Side::Left).rate).abs() < 1e-9);
    assert!((along.at(begun + down - 0.02, Side::Left).rate).abs() > 1e-3);
    let turned = 0.5 * 3.0 * (up + down) + 3.0 * (begun - up);
    assert_near("turned", -along.at(10.0, Side::Left).angle.radians(), turned, 1e-9);
    let text = notes(&scene);
    assert!(text.contains("moves[0]: duration = 0.85 s, the shortest"), "{text}");
    assert!(text.contains("moves[1]: duration = 0.575 s, the shortest"), "{text}");
}

#[test]
fn moves_in_the_shortest_time_are_refused_by_key() {
    let limits = "[limits]\nacceleration = 4.0\n";
    for (moves, words) in [
        ("[move]\nprofile = \"reach\"\nto = 1.0\n", "[limits] must hold acceleration or jerk"),
        (
            "[limits]\nrate = 4.0\n[move]\nprofile = \"ramp\"\nrate = 1.0\n",
            "must hold acceleration",
        ),
    ] {
        let error = refused(moves);
        assert!(error.contains("move.profile = ") && error.contains(words), "{error}");
    }
    for (keys, words) in [
        ("profile = \"reach\"\nto = 1.0\nduration = 1.0", "move.duration = 1: must be absent"),
        ("profile = \"reach\"\nto = 1.0\nrobust = 0.1", "move.robust = 0.1: must be absent"),
        ("profile = \"reach\"\nrate = 1.0", "move.to: missing"),
        ("profile = \"reach\"\nto = nan", "move.to = NaN"),
        ("profile = \"ramp\"\nto = 1.0\nrate = 1.0", "move.to = 1: must be absent"),
        ("profile = \"ramp\"", "move.rate: missing"),
        ("profile = \"reach\"\nto = 1.0\nblend = true", "move.blend = true"),
        ("profile = \"rump\"", "still, reach, ramp, spin-up or dwell"),
    ] {
        let error = refused(&format!("{limits}[move]\n{keys}\n"));
        assert!(error.contains(words), "{keys}: {error}");
    }
    let fast = "[limits]\nrate = 2.0\nacceleration = 4.0\n";
    let error = refused(&format!("{fast}[move]\nprofile = \"reach\"\nto = 3.0\nrate = 2.5\n"));
    assert!(error.contains("2.5") && error.contains("2 rad/s"), "{error}");
    // A torque that the bounds do not know of.
    let weak =
        "[limits]\nacceleration = 40.0\ntorque = 0.01\n[move]\nprofile = \"reach\"\nto = 1.0\n";
    let error = run(&scene(weak), &RIGID).expect_err("a torque").to_string();
    assert!(
        error.contains("limits.torque = 0.01") && error.contains("lower one of them"),
        "{error}"
    );
}

/// The corner between turns of 0.2 rad in 0.3 s each is passed at their mean rate, and angle and
/// rate go on there.
#[test]
fn blended_moves_do_not_stop_between() {
    let one = |to: f64, blend: bool| {
        format!("[[moves]]\nprofile = \"quintic\"\nduration = 0.3\nto = {to}\nblend = {blend}\n")
    };
    let text = [(0.2, true), (0.4, true), (0.6, true), (0.8, false)].map(|(to, b)| one(to, b));
    let scene = scene(&text.concat());
    let along = motion(&scene);
    for (k, to) in [(1.0, 0.2), (2.0, 0.4), (3.0, 0.6)] {
        for side in [Side::Left, Side::Right] {
            let hub = along.at(0.3 * k, side);
            assert_near("angle", hub.angle.radians(), to, 1e-12);
            assert_near("rate", hub.rate, 2.0 / 3.0, 1e-12);
        }
    }
    assert_near("end", along.at(1.2, Side::Left).rate, 0.0, 1e-12);
    let found = notes(&scene);
    let words = "moves[0], moves[1] and 1 more: blend = true, passes its end at 0.666667 rad/s";
    assert!(found.contains(words), "{found}");
    // Where the way turns back it stops.
    let text = [(0.2, true), (0.4, true), (0.1, false)].map(|(to, b)| one(to, b)).concat();
    let scene = self::scene(&text);
    assert_near("a stop", motion(&scene).at(0.6, Side::Left).rate, 0.0, 1e-12);
    assert!(notes(&scene).contains("moves[1]: blend = true, but the hub stops"));
    // A corner passed at speed ends in less time: without durations both are the shortest.
    let limits = "[limits]\nrate = 2.0\nacceleration = 8.0\n";
    let without = |blend: bool| {
        let first = format!("[[moves]]\nprofile = \"quintic\"\nto = 0.4\nblend = {blend}\n");
        format!("{limits}{first}[[moves]]\nprofile = \"quintic\"\nto = 0.8\n")
    };
    let [stops, passes] = [false, true].map(|blend| motion_end(&without(blend)));
    assert!(passes < stops - 0.05, "{passes} {stops}");
}

/// A limit of torque that blended moves would exceed makes the hub stop between them: moves of
/// half a period each leave vibrations that cancel behind a stop and add up behind a corner.
#[test]
fn a_limit_may_make_blended_moves_stop() {
    let elastica = Solver { method: Method::Elastica, tick: TICK, ..Solver::PAPER };
    for (profile, [first, second], [to, then]) in
        [("cubic", [0.15, 0.10], [0.35, 0.74]), ("quintic", [0.18, 0.09], [0.2, 0.45])]
    {
        let text = |blend: bool, limits: &str| {
            let table = |duration: f64, to: f64| {
                format!("[[moves]]\nprofile = \"{profile}\"\nduration = {duration}\nto = {to}\n")
            };
            let [own, next] = [table(first, to), table(second, then)];
            format!("[payload]\nmass = 0.03\n{limits}{own}blend = {blend}\n{next}")
        };
        let [stops, passes] = [false, true].map(|blend| {
            let rows = run(&scene(&text(blend, "")), &elastica).expect("run");
            rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max)
        });
        println!("{profile}: {stops} N m with a stop, {passes} N m without");
        assert!(passes > 1.15 * stops, "{profile}: {stops} {passes}");
        let rate = |limit: f64| {
            let scene = scene(&text(true, &format!("[limits]\ntorque = {limit}\n")));
            motion(&scene).at(first, Side::Left).rate
        };
        assert!(rate(1.1 * passes) > 1.0, "{profile}: it keeps the limit");
        assert_near(profile, rate(0.5 * (passes + stops)), 0.0, 1e-12);
    }
}

/// Accelerations in a path's first and last rows are commanded, and go over into the path behind
/// it.
#[test]
fn a_path_begins_and_ends_with_its_accelerations() {
    let moves = "[[moves]]\nwaypoints = [[0.0, 0.0, 0.0, 5.0], [0.2, 0.3, 2.0, 7.0]]\n\
                 [[moves]]\nwaypoints = [[0.3, 0.7, 0.0, 0.0]]\n";
    let scene = scene(moves);
    let along = motion(&scene);
    let acceleration = |t: f64, side: Side| along.at(t, side).acceleration;
    assert_near("at 0", acceleration(0.0, Side::Right), 5.0, 1e-10);
    assert_near("before the border", acceleration(0.2, Side::Left), 7.0, 1e-10);
    assert_near("behind the border", acceleration(0.2, Side::Right), 7.0, 1e-10);
    let rows = run(&scene, &RIGID).expect("run");
    assert_near("in the run", rows[0].hub_accel_rad_s2, 5.0, 1e-5);
    assert_near("in the run", rows[20].hub_accel_rad_s2, 7.0, 1e-5);
    let error = refused(&format!("[limits]\njerk = 1e4\n{moves}"));
    assert!(error.contains("limits.jerk") && error.contains("at 0 s"), "{error}");
    let cubic = moves.replace(
        "[[moves]]\nwaypoints = [[0.0",
        "[[moves]]\nprofile = \"cubic\"\nwaypoints = [[0.0",
    );
    let error = refused(&cubic.replace(", 2.0, 7.0]", ", 2.0]"));
    assert!(error.contains("moves[0]") && error.contains("acceleration = 5"), "{error}");
}
