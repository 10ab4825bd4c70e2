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

/// A motion, and what is expected of it.
struct Case {
    /// As a scene file holds it.
    text: String,
    /// Angle at its end, rad, if it has one.
    to: Option<f64>,
    /// Farthest that the tips may be apart, fraction of the length.
    bound: f64,
}

fn motions() -> Vec<Case> {
    let mut all = Vec::new();
    // The acceleration of 25 rad/s² is reached in 125 to 0.4 ms. All of these end at a tick, from
    // the second on with a stretch that holds none.
    for jerk in ["200", "3000", "60000"] {
        let limits = format!("[limits]\nrate = 3.0\nacceleration = 25.0\njerk = {jerk}\n");
        let reach = format!("{limits}[move]\nprofile = \"reach\"\nto = 0.5\n");
        all.push(Case { text: reach, to: Some(0.5), bound: 4e-5 });
        let there = "[[moves]]\nprofile = \"ramp\"\nrate = 2.0\nsettle = 0.1\n";
        let back = "[[moves]]\nprofile = \"ramp\"\nrate = 0.0\n";
        all.push(Case { text: format!("{limits}{there}{back}"), to: None, bound: 2e-5 });
    }
    // Its pulses carry each of these stretches into another tick.
    let shaped = "[shaper]\nkind = \"zv\"\nfrequency = 3.0\n[limits]\nrate = 3.0\n\
                  acceleration = 25.0\njerk = 60000.0\n[move]\nprofile = \"reach\"\nto = 0.5\n";
    all.push(Case { text: shaped.into(), to: Some(0.5), bound: 1e-5 });
    // A ramp up whose second half begins at a tick, and whose first ends with a stretch of 2 ms.
    let limits = "[limits]\nacceleration = 25.0\njerk = 12500.0\n";
    let ramp = "profile = \"ramp\"\nrate = 0.25\nsettle = 0.1\n";
    let stop = "profile = \"ramp\"\nrate = 0.0\n";
    let text = format!("{limits}[[moves]]\n{ramp}[[moves]]\n{stop}");
    all.push(Case { text, to: None, bound: 1e-5 });
    for profile in ["trapezoid", "s-curve"] {
        for ticks in [1, 2, 5, 8] {
            let duration = 0.01 * f64::from(ticks);
            let to = 0.01 * f64::from(ticks * ticks);
            let plain = format!("profile = \"{profile}\"\nduration = {duration}\n");
            // 9.3e-4 was measured: a trapezoid of eight ticks, each stretch of which holds two or
            // three, turns by 0.64 rad in 80 ms.
            let bound = 1.1e-3;
            all.push(Case { text: format!("[move]\n{plain}to = {to}\n"), to: Some(to), bound });
            let blended = format!("[[moves]]\n{plain}to = {to}\nblend = true\n");
            let text = format!("{blended}[[moves]]\n{plain}to = {}\n", 2.0 * to);
            all.push(Case { text, to: Some(2.0 * to), bound });
        }
    }
    all.extend(paths());
    all
}

/// Paths with rows inside a tick, and rows at ticks behind them.
fn paths() -> Vec<Case> {
    // Samples of a smooth turn, as a recorder that counts 20 µrad has them.
    let noisy = |every: f64| {
        let rows = (1..=(0.6 / every).round() as u32).map(|k| {
            let part = every * f64::from(k) / 0.6;
            let angle = 0.3 * part * part * (3.0 - 2.0 * part);
            format!("[{}, {}]", every * f64::from(k), (angle / 2e-5).round() * 2e-5)
        });
        rows.collect::<Vec<_>>().join(", ")
    };
    // Rows of a quintic behind a shaper: two of them 1 ms apart, rounded to 7 digits.
    let quintic = [0.2, 0.303, 0.304, 0.4, 0.6].map(|time: f64| {
        let s = time / 0.6;
        let angle = 0.3 * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
        let rate = 0.3 / 0.6 * 30.0 * s * s * (1.0 - s) * (1.0 - s);
        let acceleration = 0.3 / 0.36 * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s);
        format!("[{time}, {angle:.7}, {rate:.7}, {acceleration:.7}]")
    });
    let at_the_end = "[0.3, 0.2], [0.397, 0.25], [0.4, 0.25]";
    let within = "[0.397, 0.25], [0.4, 0.25], [0.6, 0.3]";
    [
        (at_the_end.into(), 0.25, 1e-5),
        (within.into(), 0.3, 3e-5),
        (noisy(0.0025), 0.3, 5e-5),
        (noisy(0.002), 0.3, 5e-5),
    ]
    .map(|(rows, to, bound): (String, f64, f64)| Case {
        text: format!("[move]\nwaypoints = [{rows}]\n"),
        to: Some(to),
        bound,
    })
    .into_iter()
    .chain([Case {
        text: format!(
            "[shaper]\nkind = \"zv\"\nfrequency = 6.0\n[move]\nwaypoints = [{}]\n",
            quintic.join(", ")
        ),
        to: Some(0.3),
        bound: 5e-6,
    }])
    .collect()
}

fn scene(text: &str) -> SceneFile {
    let settled = text.trim_end();
    SceneFile::parse("test", &format!("{ARM}{settled}\nsettle = 0.2\n"))
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// What the core has planned at its own jerk is not refused for it, late in a run and in stretches
/// of a few microseconds too.
#[test]
fn a_jerk_that_is_kept_is_not_refused() {
    for jerk in ["10628.1", "3e5", "1e6", "1e8"] {
        for rate in ["0.2", "0.5", "1.3"] {
            let limits = format!("[limits]\nrate = 3.0\nacceleration = 25.0\njerk = {jerk}\n");
            let ramp = format!("[[moves]]\nprofile = \"ramp\"\nrate = {rate}\n");
            scene(&format!("{limits}{ramp}[[moves]]\nprofile = \"reach\"\nto = 0.9\n"))
                .trajectory(TICK)
                .expect("a motion");
        }
    }
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
    for Case { text, to, .. } in motions() {
        let along = scene(&text).trajectory(TICK).expect("a motion");
        assert_goes_on(&along, &text);
        let end = along.arrivals().last().expect("an arrival");
        let hub = along.at(end, Side::Left);
        assert_near(&text, hub.rate, 0.0, 1e-9);
        if let Some(to) = to {
            assert_near(&text, hub.angle.radians(), to, 1e-9);
        }
    }
}

/// The arm of the tick and that of the integrator are driven by the same motion. Without the moment
/// of the borders within the last tick an S-curve in one tick errs by 1.2e-2 of the length, the
/// fastest reach by 2.5e-4, and samples every 2 ms by 4.7e-3. The row of an arrival shows the
/// motion's own acceleration.
#[test]
fn an_arm_follows_what_no_tick_holds() {
    let solver = Solver {
        method: Method::Elastica,
        modes: 3,
        quality: Quality::Fine,
        scalar: Scalar::F64,
        ..Solver::PAPER
    };
    for Case { text, bound, .. } in motions() {
        let scene = scene(&text);
        let along = scene.trajectory(TICK).expect("a motion");
        let times = truth::times(&along, TICK);
        let rod = truth::solve(truth::Reference::Rod, &scene, &along, &times, &|_| ());
        let ours = run(&scene, &solver).expect("a run");
        let apart = compare(&ours, &rod.expect("a rod"), &scene).expect("the same times");
        assert!(apart.tip_max <= bound, "{text}: {:e} of the length", apart.tip_max);
        for end in along.arrivals() {
            let row = &ours[(end / TICK).round() as usize];
            let hub = along.at(end, Side::Left);
            assert_near(&text, row.hub_accel_rad_s2, hub.acceleration, 1e-6);
        }
    }
}
