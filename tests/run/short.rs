//! Motions with stretches that hold no tick: what is planned, ticked and integrated is one motion.

use stillbeam_sim::compare::compare;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Quality, Scalar, Solver};
use stillbeam_sim::trajectory::{Side, Trajectory};
use stillbeam_sim::truth;
use stillbeam_tests::assert_near;

const TICK: f64 = 0.01;

const ARM: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n";

/// Motions as scene files hold them, and the angle at which each ends, rad.
fn motions() -> Vec<(String, f64)> {
    let mut all = Vec::new();
    // The acceleration of 25 rad/s² is reached in 125 to 0.4 ms. All of these end at a tick, from
    // the second on with a stretch that holds none.
    for jerk in ["200", "3000", "60000"] {
        let limits = format!("[limits]\nrate = 3.0\nacceleration = 25.0\njerk = {jerk}\n");
        all.push((format!("{limits}[move]\nprofile = \"reach\"\nto = 0.5\n"), 0.5));
        let there = "[[moves]]\nprofile = \"ramp\"\nrate = 2.0\nsettle = 0.1\n";
        let back = "[[moves]]\nprofile = \"ramp\"\nrate = 0.0\n";
        all.push((format!("{limits}{there}{back}"), f64::NAN));
    }
    for profile in ["trapezoid", "s-curve"] {
        for ticks in [1, 2, 5, 8] {
            let duration = 0.01 * f64::from(ticks);
            let to = 0.01 * f64::from(ticks * ticks);
            let plain = format!("profile = \"{profile}\"\nduration = {duration}\n");
            all.push((format!("[move]\n{plain}to = {to}\n"), to));
            let blended = format!("[[moves]]\n{plain}to = {to}\nblend = true\n");
            let last = format!("[[moves]]\n{plain}to = {}\n", 2.0 * to);
            all.push((format!("{blended}{last}"), 2.0 * to));
        }
    }
    // The last row lies at a tick and the row before it inside the tick before.
    for rows in ["[0.3, 0.2], [0.397, 0.25], [0.4, 0.25]", "[0.2, 0.1], [0.3997, 0.2], [0.4, 0.2]"]
    {
        let to = if rows.contains("0.25") { 0.25 } else { 0.2 };
        all.push((format!("[move]\nwaypoints = [{rows}]\n"), to));
    }
    all
}

fn scene(text: &str) -> SceneFile {
    let settled = text.trim_end();
    SceneFile::parse("test", &format!("{ARM}{settled}\nsettle = 0.2\n"))
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Angle and rate go on where one formula ends and the next begins, and between.
fn assert_goes_on(along: &Trajectory, text: &str) {
    for t in along.breaks() {
        let [left, right] = [Side::Left, Side::Right].map(|side| along.at(t, side));
        let turned = right.angle.since(left.angle);
        assert!(turned.abs() < 1e-9, "{text}: jumps by {turned} turns at {t} s");
        assert_near(text, right.rate, left.rate, 1e-7);
    }
}

#[test]
fn a_motion_has_no_gap_where_no_tick_is() {
    for (text, to) in motions() {
        let along = scene(&text).trajectory(TICK).expect("a motion");
        assert_goes_on(&along, &text);
        let end = along.arrivals().last().expect("an arrival");
        let hub = along.at(end, Side::Left);
        assert_near(&text, hub.rate, 0.0, 1e-9);
        if to.is_finite() {
            assert_near(&text, hub.angle.radians(), to, 1e-9);
        }
    }
}

/// The arm of the tick and that of the integrator are driven by the same motion. Without the moment
/// of the borders within the last tick an S-curve in one tick errs by 1.2e-2 of the length, and the
/// fastest reach by 2.5e-4. The row of an arrival shows the motion's own acceleration.
#[test]
fn an_arm_follows_what_no_tick_holds() {
    let solver = Solver {
        method: Method::Elastica,
        modes: 3,
        quality: Quality::Fine,
        scalar: Scalar::F64,
        ..Solver::PAPER
    };
    for (text, _) in motions() {
        let scene = scene(&text);
        let along = scene.trajectory(TICK).expect("a motion");
        let times = truth::times(&along, TICK);
        let rod = truth::solve(truth::Reference::Rod, &scene, &along, &times, &|_| ());
        let ours = run(&scene, &solver).expect("a run");
        let apart = compare(&ours, &rod.expect("a rod"), &scene).expect("the same times");
        // 3.4e-5 with limits and 9.3e-4 without were measured: a trapezoid of eight ticks, each
        // stretch of which holds two or three, turns by 0.64 rad in 80 ms.
        let bound = if text.starts_with("[limits]") { 4e-5 } else { 1.1e-3 };
        assert!(apart.tip_max <= bound, "{text}: {:e} of the length", apart.tip_max);
        for end in along.arrivals() {
            let row = &ours[(end / TICK).round() as usize];
            let hub = along.at(end, Side::Left);
            assert_near(&text, row.hub_accel_rad_s2, hub.acceleration, 1e-6);
        }
    }
}
