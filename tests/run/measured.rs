//! Scene files that give what was measured: damping ratios and frequencies.

use std::f64::consts::TAU;

use stillbeam::Scene;
use stillbeam::model::{EightElements, Modes};
use stillbeam_sim::arm::natural;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_tests::assert_near;

const LINK: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n[payload]\nmass = \
                    0.03\n";

fn read(text: &str) -> SceneFile {
    SceneFile::parse_arm("test", text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn refusal(text: &str) -> String {
    SceneFile::parse_arm("arm.toml", text).expect_err(text).to_string()
}

/// Damping ratios of the first modes by the free response of the modes' own equations.
fn ratios(arm: &Scene) -> [f64; 2] {
    let omega = Modes::of(&EightElements::consistent(arm).expect("model")).frequency;
    [0, 1].map(|i| 0.5 * (arm.damping.alpha / omega[i] + arm.damping.beta * omega[i]))
}

#[test]
fn one_damping_ratio_makes_one_term() {
    let with = |from: &str| read(&format!("{LINK}[damping]\nratio = 0.02\nfrom = \"{from}\"\n"));
    let (alpha, beta) = (with("alpha"), with("beta"));
    assert_eq!((alpha.arm.damping.beta, beta.arm.damping.alpha), (0.0, 0.0));
    let omega = TAU * natural::frequencies(&alpha.arm).expect("frequencies")[0];
    assert_near("alpha", alpha.arm.damping.alpha, 2.0 * 0.02 * omega, 1e-12);
    assert_near("beta", beta.arm.damping.beta, 2.0 * 0.02 / omega, 1e-15);
    assert_eq!(alpha.deduced.alpha, Some(alpha.arm.damping.alpha));
    assert_eq!(beta.deduced.lines().len(), 1);
    assert!(beta.deduced.lines()[0].ends_with("s, from a damping ratio of 0.02"));
}

#[test]
fn two_damping_ratios_make_both_terms() {
    for [first, second] in [[0.01, 0.03], [0.005, 0.005], [0.02, 0.002]] {
        let scene = read(&format!("{LINK}[damping]\nratio = [{first}, {second}]\n"));
        let [one, two] = ratios(&scene.arm);
        assert_near("first", one, first, 1e-12);
        assert_near("second", two, second, 1e-12);
        assert!(scene.arm.damping.alpha > 0.0 && scene.arm.damping.beta > 0.0);
    }
    // What one term makes is taken back, whatever its rounding.
    for term in ["alpha", "beta"] {
        let scene = read(&format!("{LINK}[damping]\nratio = 0.01\nfrom = \"{term}\"\n"));
        let [one, two] = ratios(&scene.arm);
        let again = read(&format!("{LINK}[damping]\nratio = [{one}, {two}]\n")).arm.damping;
        assert_near("alpha", again.alpha, scene.arm.damping.alpha, 1e-9);
        assert_near("beta", again.beta, scene.arm.damping.beta, 1e-12);
    }
}

#[test]
fn damping_ratios_that_cannot_be_are_refused() {
    let cases = [
        ("ratio = 0.02", "9:9: damping.ratio = 0.02: must be beside damping.from"),
        ("ratio = [0.01, 0.2]", "damping.ratio = [0.01, 0.2]: the second must be 1."),
        ("ratio = [0.01, 0.0001]", "the second must be 1."),
        ("ratio = 2\nfrom = \"beta\"", "damping.ratio = 2: must be 0 to less than 1"),
        ("ratio = [0.01, -0.1]", "damping.ratio = [0.01, -0.1]: must be 0 to less than 1"),
        ("ratio = nan\nfrom = \"beta\"", "damping.ratio = NaN: must be 0"),
        ("ratio = [0.01, 0.02, 0.03]", "must be one ratio or two"),
        ("ratio = []", "must be a number for the first mode, or"),
        ("ratio = \"small\"", "9:9: damping.ratio = \"small\": must be a number"),
        ("ratio = [0.01, 0.02]\nfrom = \"beta\"", "damping.from = \"beta\": must be absent beside"),
        ("from = \"beta\"", "damping.from = \"beta\": must be absent without damping.ratio"),
        ("ratio = 0.01\nfrom = \"gamma\"", "damping.from = \"gamma\": must be one of alpha, beta"),
        (
            "ratio = 0.01\nfrom = \"beta\"\nalpha = 0.1",
            "damping.alpha = 0.1: must be absent beside",
        ),
    ];
    for (keys, words) in cases {
        let error = refusal(&format!("{LINK}\n[damping]\n{keys}\n"));
        assert!(error.starts_with("arm.toml:") && error.contains(words), "{words}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}
