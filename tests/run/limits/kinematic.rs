//! Limits of rate, acceleration and jerk.

use stillbeam_sim::limits::{Quantity, kinematic};
use stillbeam_sim::reference::rod;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::trajectory::Side;
use stillbeam_tests::assert_near;

use super::{LINK, PAYLOAD, number_after, parse};

/// By hand: −36 of the move's own ramp and −60 of the second pulse at 0.08 s.
#[test]
fn a_shaper_of_negative_pulses_asks_for_more_than_its_move() {
    let scene = format!(
        "{LINK}{PAYLOAD}[limits]\nrate = 1.6\nacceleration = 60.0\n[move]\nprofile = \"cubic\"\n\
         duration = 0.1\nto = 0.1\nsettle = 0.3\n[shaper]\npulses = [[1.0, 0.0], [-1.0, 0.08], [1.0, 0.16]]\n"
    );
    for tick in ["0.001", "0.01", "0.02"] {
        let error = parse(&format!("{scene}[solver]\ntick = {tick}\n")).expect_err("too fast");
        assert_near("needs", number_after(&error, "needs "), 96.0, 1e-9);
        assert_near("time", number_after(&error, " at "), 0.08, 1e-9);
    }
}

#[test]
fn a_shaper_spares_what_its_move_alone_exceeds() {
    let scene = |limit: f64| {
        format!(
            "{LINK}{PAYLOAD}[limits]\nrate = 4.0\nacceleration = {limit}\n[move]\nprofile = \"cubic\"\n\
             duration = 0.4\nto = 1.0\nsettle = 0.3\n[shaper]\nkind = \"zv\"\n"
        )
    };
    assert!(parse(&scene(30.0)).is_ok());
    let error = parse(&scene(25.0)).expect_err("too fast");
    // By hand, as the second pulse comes at d: 18.75 (2 − 2d/0.4).
    let delay = 0.5 * rod::first_period(&parse(&scene(30.0)).expect("a scene").arm).expect("a rod");
    let needed = 18.75 * (2.0 - 2.0 * delay / 0.4);
    assert_near("needs", number_after(&error, "needs ") / needed, 1.0, 1e-6);
}

/// The densest look at a trajectory that is affordable, both sides of its breaks included.
fn dense(scene: &SceneFile, tick: f64) -> [f64; 3] {
    let trajectory = scene.case(tick).trajectory().expect("a motion");
    let end = trajectory.duration();
    let mut most = [0.0_f64; 3];
    let mut borders = vec![0.0];
    borders.extend(trajectory.breaks());
    borders.push(end);
    for pair in borders.windows(2) {
        let points = 4000;
        let step = (pair[1] - pair[0]) / f64::from(points);
        if step <= 0.0 {
            continue;
        }
        for k in 0..=points {
            let (side, beside) =
                if k == points { (Side::Left, -1e-2 * step) } else { (Side::Right, 1e-2 * step) };
            let t = pair[0] + f64::from(k) * step;
            let hub = trajectory.at(t, side);
            let slope = (trajectory.at(t + beside, side).acceleration - hub.acceleration) / beside;
            most[0] = most[0].max(hub.rate.abs());
            most[1] = most[1].max(hub.acceleration.abs());
            most[2] = most[2].max(slope.abs());
        }
    }
    most
}

/// Every profile behind every shaper at several ticks: 0.2 % below the densest look's peak is
/// refused, 0.2 % above it accepted, and the duration that the refusal names is accepted.
#[test]
fn kinematic_limits_are_right_to_a_thousandth() {
    let shapers = [
        "",
        "kind = \"zv\"",
        "kind = \"ei\"",
        "pulses = [[1.0, 0.0], [-1.0, 0.0611], [1.0, 0.1222]]",
    ];
    let mut turn = 1u32;
    for profile in ["cubic", "quintic", "cycloid", "trapezoid", "s-curve", "still"] {
        for shaper in shapers {
            for tick in [0.002, 0.005, 0.01] {
                turn = turn.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let share = f64::from(turn >> 8) / f64::from(1 << 24);
                let duration = ((0.27 + 0.4 * share) / tick).round() * tick;
                let scene = |limits: &str, duration: f64| {
                    let shaper = if shaper.is_empty() {
                        String::new()
                    } else {
                        format!("[shaper]\n{shaper}\n")
                    };
                    parse(&format!(
                        "{LINK}{PAYLOAD}{shaper}[limits]\n{limits}\n[move]\nprofile = \"{profile}\"\n\
                         duration = {duration}\nto = {}\n[solver]\ntick = {tick}\n",
                        0.4 + share
                    ))
                };
                let free = scene("", duration).expect("a scene without limits");
                let peaks = dense(&free, tick);
                for (name, peak) in ["rate", "acceleration", "jerk"].into_iter().zip(peaks) {
                    let what = format!("{profile}, {shaper}, {tick} s, {duration} s, {name}");
                    let jumps = matches!(profile, "cubic" | "trapezoid") && name == "jerk";
                    let limited = |factor: f64, duration: f64| {
                        scene(&format!("{name} = {}", factor * peak), duration)
                    };
                    if jumps {
                        let error = scene("jerk = 1e9", duration).expect_err(&what);
                        assert!(error.contains("no duration helps"), "{what}: {error}");
                        continue;
                    }
                    // A planner may find another still move within the limit, or none.
                    if profile != "still" {
                        let error = limited(0.998, duration).expect_err(&what);
                        let way = number_after(&error, "a duration of ");
                        assert!(way > duration, "{what}: {error}");
                        limited(0.998, way).unwrap_or_else(|error| panic!("{what}: {error}"));
                        if shaper.is_empty() {
                            let shorter = way - tick;
                            assert!(limited(0.998, shorter).is_err(), "{what}: {shorter} fits too");
                        }
                    }
                    let above = limited(1.002, duration);
                    above.unwrap_or_else(|error| panic!("{what}: {error}"));
                }
            }
        }
    }
}

#[test]
fn the_refusal_names_the_move_during_which_it_happens() {
    let moves = "[[moves]]\nprofile = \"quintic\"\nduration = 1.0\nto = 1.5\nsettle = 0.05\n\
                 [[moves]]\nprofile = \"quintic\"\nduration = 0.5\nto = 0.0\nsettle = 0.05\n";
    let scene = format!("{LINK}[limits]\nrate = 4.0\n{moves}");
    let error = parse(&scene).expect_err("too fast");
    assert!(error.contains("moves[1] (move 2 of 2) needs 5.625"), "{error}");
    assert_near("way", number_after(&error, "a duration of "), 0.71, 1e-12);
    assert_near("time", number_after(&error, " at "), 1.3, 1e-6);
}

#[test]
fn a_spin_beyond_the_rate_has_no_duration_that_helps() {
    let scene = format!(
        "{LINK}[limits]\nrate = 4.0\n[move]\nprofile = \"spin-up\"\nduration = 2.0\nrate = 5.0\n"
    );
    let error = parse(&scene).expect_err("too fast");
    assert!(error.contains("no duration helps"), "{error}");
}

#[test]
fn peaks_of_a_window_are_those_of_its_profile() {
    for profile in stillbeam::Profile::ALL {
        let text =
            format!("{LINK}[move]\nprofile = \"{}\"\nduration = 0.7\nto = -1.3\n", profile.name());
        let trajectory = parse(&text).expect("a scene").case(0.01).trajectory().expect("a motion");
        let peaks = kinematic::peaks(&trajectory, 0.0, trajectory.duration());
        let exact = profile.peaks(1.3, 0.7);
        for (quantity, exact) in [
            (Quantity::Rate, exact.rate),
            (Quantity::Acceleration, exact.acceleration),
            (Quantity::Jerk, exact.jerk),
        ] {
            let peak = peaks.of(quantity, &stillbeam::Limits::default()).expect("a peak").value;
            if exact.is_infinite() {
                assert!(peak.is_infinite(), "{profile:?} {quantity:?}");
            } else {
                assert_near("peak", peak / exact, 1.0, 1e-6);
            }
        }
    }
}
