//! Limits of torque and clamp moment.

use std::cell::RefCell;

use stillbeam_sim::limits::load;
use stillbeam_sim::reference::rod;
use stillbeam_sim::run::{admit_loads, run};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};
use stillbeam_tests::assert_near;

use super::{LINK, PAYLOAD, elastica, number_after, parse};

/// The rod's own peak, sampled at a twentieth of a millisecond: no code of the check's but the rod.
fn sampled_torque(scene: &SceneFile, tick: f64) -> f64 {
    let trajectory = scene.case(tick).trajectory().expect("a motion");
    let count = (trajectory.duration() / 5e-5) as u32;
    let times: Vec<f64> = (0..=count).map(|k| f64::from(k) * 5e-5).collect();
    let options = rod::Options { order: 6, tolerance: 1e-8, integrator: None };
    let samples = rod::solve(&scene.arm, &trajectory, &times, &options).expect("a rod");
    samples.iter().map(|sample| sample.torque.abs()).fold(0.0, f64::max)
}

#[test]
fn torque_is_what_the_arm_takes_whatever_the_method() {
    let rest = "[move]\nprofile = \"cubic\"\nduration = 0.25\nto = 1.0\nsettle = 0.05\n";
    let bar = "[link]\nlength = 0.3\nmaterial = \"steel\"\nwidth = 0.025\nthickness = 0.012\n\
               [payload]\nmass = 0.2\n";
    let soft = format!("{LINK}{PAYLOAD}[hub]\nradius = 0.03\ninertia = 1e-4\n");
    for (arm, tick) in [(bar, 0.01), (soft.as_str(), 0.005)] {
        let free = parse(&format!("{arm}{rest}")).expect("a scene");
        let peak = sampled_torque(&free, tick);
        let limited = |factor: f64, method| {
            let limits = format!("[limits]\ntorque = {}\n", factor * peak);
            let scene = parse(&format!("{arm}{limits}{rest}")).expect("a scene");
            run(&scene, &Solver { method, ..elastica(tick) }).map_err(|error| error.to_string())
        };
        for method in [Method::Rigid, Method::Elastica] {
            let error = limited(0.998, method).expect_err("above the limit");
            assert_near("needs", number_after(&error, "needs ") / peak, 1.0, 1e-3);
        }
        limited(1.002, Method::Elastica).expect("within the limit");
    }
}

#[test]
fn a_method_that_commands_more_than_the_limit_is_refused() {
    let text = |limits: &str, duration: f64| {
        format!(
            "{LINK}{PAYLOAD}{limits}[move]\nprofile = \"cubic\"\nduration = {duration}\nto = 0.3\n"
        )
    };
    let commanded_by = |duration: f64, method| {
        let free = parse(&text("", duration)).expect("a scene");
        let solver = Solver { tick: 0.01, method, ..Solver::default() };
        let rows = run(&free, &solver).expect("a run");
        let commanded = rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
        (duration, solver, commanded, sampled_torque(&free, 0.01))
    };
    // Where the arm yields to the jump at the beginning, a rigid one takes more.
    let (duration, solver, commanded, arm) = [0.1, 0.14, 0.2, 0.25]
        .into_iter()
        .flat_map(|duration| [Method::Rigid, Method::Newmark].map(|m| commanded_by(duration, m)))
        .find(|&(.., commanded, arm)| commanded > 1.05 * arm)
        .expect("a method that commands too much");
    let limit = 0.5 * (commanded + arm);
    let scene = parse(&text(&format!("[limits]\ntorque = {limit}\n"), duration)).expect("a scene");
    let error = run(&scene, &solver).expect_err("commands too much").to_string();
    assert!(error.contains("method") && error.contains("another method"), "{error}");
    if commanded > 1.1 * arm {
        run(&scene, &elastica(0.01)).expect("within the limit");
    }
}

#[test]
fn the_clamp_moment_is_limited_and_is_not_the_hub_torque() {
    let text = |moment: f64, duration: f64| {
        parse(&format!(
            "{LINK}{PAYLOAD}[limits]\nmoment = {moment}\n[move]\nprofile = \"cubic\"\n\
             duration = {duration}\nto = 1.0\nsettle = 0.3\n"
        ))
        .expect("a scene")
    };
    for method in [Method::Rigid, Method::Auto] {
        let solver = Solver { method, ..elastica(0.01) };
        let error = run(&text(0.1, 0.4), &solver).expect_err("above the limit").to_string();
        assert!(error.contains("limits.moment = 0.1: move needs 0.32"), "{error}");
        let way = number_after(&error, "a duration of ");
        run(&text(0.1, way), &solver).expect("the duration that the refusal names");
    }
    // At rest and level: g (m L/2 + m_p L) at the clamp, r further in at the axis.
    let arm = parse(
        "[link]\nlength = 0.9\nmass = 0.6\nbending_stiffness = 1.8e7\n[hub]\nradius = 0.05\n\
         [payload]\nmass = 1.5\n[gravity]\nacceleration = 9.81\n[move]\nprofile = \"cubic\"\n\
         duration = 1.0\nto = 1.0\n",
    )
    .expect("a scene")
    .arm;
    let [torque, moment] =
        rod::rest_loads(&arm, stillbeam::Angle::from_radians(0.0)).expect("rest");
    assert_near("torque", torque, 9.81 * (0.6 * 0.5 + 1.5 * 0.95), 1e-6);
    assert_near("moment", moment, 9.81 * (0.6 * 0.45 + 1.5 * 0.9), 1e-6);
}

/// The search takes seconds where arms are slow: it says what it tries, up to what it then names.
#[test]
fn the_search_for_a_duration_says_what_it_tries() {
    let scene = parse(&format!(
        "{LINK}{PAYLOAD}[limits]\nmoment = 0.1\n[move]\nprofile = \"cubic\"\nduration = 0.4\n\
         to = 1.0\nsettle = 0.3\n"
    ))
    .expect("a scene");
    let (checked, tried) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
    let error = admit_loads(&scene, 0.01, &|_| true, &|at| match at {
        load::Progress::Checked(done) => checked.borrow_mut().push(done),
        load::Progress::Tried(duration) => tried.borrow_mut().push(duration),
    });
    let error = error.expect_err("above the limit").to_string();
    let (checked, tried) = (checked.into_inner(), tried.into_inner());
    assert!(checked.iter().all(|done| (0.0..=1.0).contains(done)) && !checked.is_empty());
    assert!(tried.iter().all(|&duration| duration > 0.4), "{tried:?}");
    // More often than once a trial: a flight alone may take long.
    let mut trials = tried.clone();
    trials.dedup();
    assert!(trials.len() >= 3 && tried.len() > 10 * trials.len(), "{} {trials:?}", tried.len());
    let way = number_after(&error, "a duration of ");
    assert!((tried.last().expect("a trial") - way).abs() < 1e-9, "{way}: {trials:?}");
}

/// A limit a million times too low: the duration that keeps it would be flown many times.
#[test]
fn a_search_that_could_not_end_is_not_begun() {
    let scene = parse(&format!(
        "{LINK}{PAYLOAD}[limits]\nmoment = 1e-6\n[move]\nprofile = \"cubic\"\nduration = 0.4\n\
         to = 1.0\nsettle = 0.3\n"
    ))
    .expect("a scene");
    let tried = RefCell::new(Vec::new());
    let error = admit_loads(&scene, 0.01, &|_| true, &|at| {
        if let load::Progress::Tried(duration) = at {
            tried.borrow_mut().push(duration);
        }
    });
    let error = error.expect_err("above the limit").to_string();
    assert!(error.contains("; use a longer move or raise the limit"), "{error}");
    assert!(tried.borrow().is_empty(), "{tried:?}");
}

const HEAVY: &str = "[link]\nlength = 0.9\nmass = 0.6\nbending_stiffness = 180.0\n[hub]\n\
                     radius = 0.05\n[payload]\nmass = 1.5\n[gravity]\nacceleration = 9.81\n";

#[test]
fn a_weight_is_told_from_a_motion_that_is_too_fast() {
    for profile in ["still", "quintic"] {
        let moves = format!(
            "[limits]\ntorque = 15.0\nrate = 2.0\n[move]\nprofile = \"{profile}\"\nto = 1.5708\n\
             settle = 0.5\n"
        );
        let moves =
            if profile == "still" { moves } else { moves.replace("to =", "duration = 3.0\nto =") };
        let run_of = |text: &str| {
            let scene = parse(text)?;
            run(&scene, &elastica(0.01)).map_err(|error| error.to_string())
        };
        let error = run_of(&format!("{HEAVY}{moves}")).expect_err("too heavy");
        assert!(error.contains("16.92") && error.contains("no duration helps"), "{error}");
    }
}

/// A still move within a torque limit: the rod keeps it, and a twentieth less time does not.
#[test]
fn still_moves_keep_loads_in_truth() {
    let cases = [
        (LINK.to_owned(), "torque = 0.2\nacceleration = 60.0", String::new()),
        (HEAVY.to_owned(), "torque = 22.0", String::new()),
        // Begins while the arm still rings.
        (
            format!("{LINK}{PAYLOAD}"),
            "torque = 0.4",
            "[[moves]]\nprofile = \"cubic\"\nduration = 0.6\nto = -1.0\nsettle = 0.02\n".to_owned(),
        ),
        (format!("{LINK}{PAYLOAD}[hub]\nradius = 0.05\n"), "moment = 0.3", String::new()),
    ];
    // A minute one after the other.
    std::thread::scope(|threads| {
        for (arm, limits, first) in &cases {
            threads.spawn(move || a_still_move_keeps_its_load(arm, limits, first));
        }
    });
}

fn a_still_move_keeps_its_load(arm: &str, limits: &str, first: &str) {
    let second = "[[moves]]\nprofile = \"still\"\nto = 0.0\nsettle = 0.3\n";
    let text = format!("{arm}[limits]\n{limits}\n{first}{second}")
        .replace("to = 0.0", if first.is_empty() { "to = 1.2" } else { "to = 0.0" });
    let scene = parse(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    run(&scene, &elastica(0.01)).unwrap_or_else(|error| panic!("{error}: {text}"));
    let case = scene.case(0.01);
    let trajectory = case.trajectory().expect("a motion");
    if let Some(torque) = scene.limits.torque {
        let peak = sampled_torque(&scene, 0.01);
        assert!(peak < 1.001 * torque, "{peak}: {text}");
    }
    let found = load::excess(&case, &trajectory, &scene.limits, &|_| ()).expect("a rod");
    assert!(found.is_none(), "{found:?}: {text}");
    let duration = scene.moves.last().expect("a move").motion.duration();
    let shorter = format!("profile = \"still\"\nduration = {}", 0.95 * duration);
    let error = parse(&text.replace("profile = \"still\"", &shorter)).expect_err(&text);
    assert!(error.contains("limits."), "{error}");
    let way = number_after(&error, "a duration of ");
    let typed = format!("profile = \"still\"\nduration = {way}");
    let again = parse(&text.replace("profile = \"still\"", &typed));
    again.unwrap_or_else(|error| panic!("{error}: {text}"));
}
