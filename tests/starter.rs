//! Scene files that `stillbeam-sim new` writes.

use stillbeam_sim::reference::rod;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::starter::{Starter, doubts};

fn strip() -> Starter {
    Starter {
        length: 0.5,
        material: "aluminium".to_owned(),
        width: 0.02,
        thickness: 0.002,
        payload: 0.05,
        frequency: None,
        damping: None,
        to: 1.5,
        duration: None,
    }
}

#[test]
fn the_text_is_a_scene_with_what_was_asked_for() {
    let text = strip().text("arm.toml").expect("a scene");
    let scene = SceneFile::parse("arm.toml", &text).expect("a scene");
    assert_eq!(scene.arm.link.length, 0.5);
    assert_eq!(scene.arm.payload.mass, 0.05);
    assert!((scene.arm.link.bending_stiffness - 0.92).abs() < 1e-12);
    // Two first periods of 336 ms, in whole ticks.
    let duration = scene.moves[0].motion.duration();
    assert!((duration - 0.68).abs() < 1e-12, "{duration}");
    assert!(text.lines().all(|line| line.len() <= 100), "{text}");
}

#[test]
fn a_comment_that_is_made_a_line_is_accepted() {
    let text = strip().text("arm.toml").expect("a scene");
    for line in ["# frequency = ", "# torque = ", "# rate = ", "# acceleration = "] {
        assert!(text.contains(line), "{line} is not in {text}");
        let changed = text.replace(line, &line[2..]);
        SceneFile::parse("arm.toml", &changed).unwrap_or_else(|error| panic!("{line}: {error}"));
    }
    let changed = text.replace("# ratio = ", "ratio = ").replace("# from = ", "from = ");
    SceneFile::parse("arm.toml", &changed).expect("damping");
}

#[test]
fn what_is_measured_stands_in_the_file() {
    let measured = Starter { frequency: Some(3.1), damping: Some(0.004), ..strip() };
    let scene = measured.text("a").and_then(|text| SceneFile::parse("a", &text)).expect("a scene");
    let period = rod::first_period(&scene.arm).expect("a period");
    assert!((1.0 / period - 3.1).abs() < 1e-4, "{period}");
    assert!(scene.arm.damping.beta > 0.0);
}

#[test]
fn what_no_scene_may_hold_is_refused() {
    let error = Starter { thickness: -1.0, ..strip() }.text("arm.toml").expect_err("no strip");
    assert!(error.to_string().contains("link.thickness = -1: must be"), "{error}");
    let error = Starter { duration: Some(0.01), ..strip() }.text("arm.toml").expect_err("short");
    assert!(error.to_string().contains("must be at least"), "{error}");
}

/// A strip without payload: `f ∝ t √E / L²`.
#[test]
fn the_shifts_are_those_of_the_formula() {
    let starter = Starter {
        material: "steel".to_owned(),
        thickness: 0.001,
        payload: 0.0,
        to: 1.0,
        ..strip()
    };
    let doubts = doubts(&starter).expect("doubts");
    let shift = |word: &str| doubts.iter().find(|d| d.what.contains(word)).expect(word).shift;
    assert!((shift("thickness") - 0.05).abs() < 1e-6, "{doubts:?}");
    assert!((shift("length") - 0.003_988).abs() < 1e-6, "{doubts:?}");
    assert!((shift("modulus") - 0.024_695).abs() < 1e-6, "{doubts:?}");
    assert!(doubts.is_sorted_by(|a, b| a.shift >= b.shift), "{doubts:?}");
}
