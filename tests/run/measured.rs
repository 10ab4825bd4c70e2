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
        (
            "ratio = [0.01, 0.2]",
            "damping.ratio = [0.01, 0.2]: the second must be 8.591e-4 to 1.164e-1",
        ),
        ("ratio = [0.01, 0.0001]", "the second must be 8.591e-4 to"),
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

/// A link of given mass whose frequencies are to be found again.
const BAR: &str = "[link]\nlength = 0.44\nmass = 0.27646\n";
const LOAD: &str = "[payload]\nmass = 0.95\n";

fn frequencies(arm: &Scene) -> [f64; 3] {
    natural::frequencies(arm).expect("frequencies")
}

#[test]
fn the_frequency_of_a_clamped_link_gives_its_stiffness() {
    let known = read(&format!("{BAR}bending_stiffness = 94.74\n{LOAD}"));
    let [first, second, _] = frequencies(&known.arm);
    let one = read(&format!("{BAR}frequency = {first}\n{LOAD}"));
    assert_near("EI", one.arm.link.bending_stiffness, 94.74, 1e-9);
    assert_eq!(one.deduced.bending_stiffness, Some(one.arm.link.bending_stiffness));
    assert_eq!(one.deduced.frequency_misfit, None);
    // The geometric mean of what each of two says alone.
    let two = read(&format!("{BAR}frequency = [{}, {}]\n{LOAD}", 1.02 * first, 0.98 * second));
    assert_near("EI", two.arm.link.bending_stiffness, 94.74 * 1.02 * 0.98, 1e-7);
    assert_near("misfit", two.deduced.frequency_misfit.expect("one"), 0.02, 1e-3);
}

#[test]
fn the_frequency_behind_a_known_joint_gives_the_links_stiffness() {
    let joint = "[hub]\nstiffness = 2000\n";
    let known = read(&format!("{BAR}bending_stiffness = 94.74\n{LOAD}{joint}"));
    let [first, second, third] = frequencies(&known.arm);
    let lists = [format!("{first}"), format!("[{first}, {second}, {third}]")];
    for list in lists {
        let found = read(&format!("{BAR}frequency = {list}\n{LOAD}{joint}"));
        assert_near("EI", found.arm.link.bending_stiffness, 94.74, 1e-6);
        assert_eq!(found.arm.hub.stiffness, Some(2000.0));
    }
    // As much as a rigid link reaches, and no more.
    let rigid = read(&format!("{BAR}bending_stiffness = 1e7\n{LOAD}{joint}"));
    let most = frequencies(&rigid.arm)[0];
    let error = refusal(&format!("{BAR}frequency = {}\n{LOAD}{joint}", 1.001 * most));
    assert!(error.contains(&format!("must be less than {most:.1}")), "{most}: {error}");
}

#[test]
fn one_frequency_gives_the_joint_of_a_known_link() {
    let hub = "[hub]\nstiffness = \"deduced\"\n";
    for joint in [230.0, 7.1e3, 1e5] {
        let known =
            read(&format!("{BAR}bending_stiffness = 94.74\n{LOAD}[hub]\nstiffness = {joint}\n"));
        let first = frequencies(&known.arm)[0];
        let keys = format!("{BAR}bending_stiffness = 94.74\nfrequency = {first}\n{LOAD}{hub}");
        let found = read(&keys);
        let stiffness = found.arm.hub.stiffness.expect("a joint");
        assert_near("k", stiffness, joint, 1e-6 * joint);
        assert_eq!(found.deduced.hub_stiffness, Some(stiffness));
        assert_eq!(found.deduced.bending_stiffness, None);
    }
    // A material's stiffness is known too.
    let strip = "[link]\nlength = 0.5\nmaterial = \"aluminium\"\nwidth = 0.04\nthickness = 0.004\n";
    let clamped = frequencies(&read(&format!("{strip}{LOAD}")).arm)[0];
    let found = read(&format!("{strip}frequency = {}\n{LOAD}{hub}", 0.95 * clamped));
    assert_near("frequency", frequencies(&found.arm)[0], 0.95 * clamped, 1e-9);
    let error = refusal(&format!("{strip}frequency = {}\n{LOAD}{hub}", 1.01 * clamped));
    assert!(error.contains(&format!("must be less than {clamped:.4} Hz")), "{error}");
}

/// Two frequencies may be those of a stiff link behind a soft joint and of a soft link behind a
/// stiff one; three tell them apart.
#[test]
fn two_or_three_frequencies_give_link_and_joint() {
    let hub = "[hub]\nstiffness = \"deduced\"\n";
    for (joint, is_told) in [(100.0, true), (400.0, true), (2e3, false), (2e4, false)] {
        let known =
            read(&format!("{BAR}bending_stiffness = 94.74\n{LOAD}[hub]\nstiffness = {joint}\n"));
        let [first, second, third] = frequencies(&known.arm);
        let of = |list: &str| format!("{BAR}frequency = {list}\n{LOAD}{hub}");
        let two = of(&format!("[{first}, {second}]"));
        let three = of(&format!("[{first}, {second}, {third}]"));
        if !is_told {
            let error = refusal(&two);
            assert!(error.contains("must be three frequencies here"), "{error}");
            assert!(error.contains("EI = 94.7400 N m^2 behind"), "{error}");
            let [stiffness, k] = elsewhere(&error);
            let other =
                format!("{BAR}bending_stiffness = {stiffness}\n{LOAD}[hub]\nstiffness = {k}\n");
            let found = frequencies(&read(&other).arm);
            assert_near("first", found[0], first, 1e-4 * first);
            assert_near("second", found[1], second, 1e-4 * second);
        }
        let told = if is_told { vec![two, three] } else { vec![three] };
        for text in told {
            let found = read(&text);
            assert_near("EI", found.arm.link.bending_stiffness, 94.74, 1e-5);
            assert_near("k", found.arm.hub.stiffness.expect("a joint"), joint, 1e-5 * joint);
            assert_eq!(found.deduced.hub_stiffness, found.arm.hub.stiffness);
        }
    }
    let clamped = read(&format!("{BAR}bending_stiffness = 94.74\n{LOAD}"));
    let [first, second, _] = frequencies(&clamped.arm);
    let error = refusal(&format!("{BAR}frequency = [{}, {second}]\n{LOAD}{hub}", 1.1 * first));
    assert!(error.contains("must be those of a link behind a joint"), "{error}");
}

/// The EI and the k of an error that are not of the link that was measured.
fn elsewhere(error: &str) -> [f64; 2] {
    let numbers = |text: &str| -> Vec<f64> {
        text.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    let pairs: Vec<Vec<f64>> = error.split("EI = ").skip(1).map(numbers).collect();
    let other = pairs.iter().find(|pair| (pair[0] - 94.74).abs() > 1e-3).expect("another link");
    [other[0], other[1]]
}

/// Sizes say how the stiffness is spread, the frequency how much there is of it; and how far that
/// is from the material's own is said.
#[test]
fn a_frequency_scales_a_tapered_link() {
    let taper = |keys: &str| {
        format!(
            "[link]\nlength = 0.5\nwidth = [0.03, 0.015]\nthickness = 0.002\n{keys}\n[payload]\nmass \
             = 0.03\n"
        )
    };
    let material = read(&taper("material = \"aluminium\""));
    let [first, second, _] = frequencies(&material.arm);
    let slower = 0.9 * first;
    let found = read(&taper(&format!("material = \"aluminium\"\nfrequency = {slower}")));
    let [one, two, _] = frequencies(&found.arm);
    assert_near("first", one, slower, 1e-9);
    assert_near("second", two, 0.9 * second, 1e-7);
    assert_near("factor", found.deduced.over_material.expect("one"), 0.81, 1e-9);
    assert!(found.deduced.lines()[0].ends_with("19.0 % less than material and section give"));
    // Of a mass and a shape without a material.
    let mass = material.arm.link.mass;
    let found = read(&taper(&format!("mass = {mass}\nfrequency = {first}")));
    assert_eq!(found.deduced.over_material, None);
    let stiffness = material.arm.link.bending_stiffness;
    assert_near("EI", found.arm.link.bending_stiffness, stiffness, 1e-8 * stiffness);
}

#[test]
fn damping_ratios_count_the_joint() {
    let arm = format!("{BAR}bending_stiffness = 94.74\n{LOAD}[hub]\nstiffness = 2000\n");
    let of = |keys: &str| {
        let scene = read(&format!("{arm}[damping]\n{keys}\n"));
        let frequency = frequencies(&scene.arm);
        (scene.arm.damping, natural::damping_ratios(&scene.arm, &frequency).expect("ratios"))
    };
    let (damping, ratio) = of("ratio = 0.03\nfrom = \"joint\"");
    assert!(damping.alpha == 0.0 && damping.beta == 0.0 && damping.joint > 0.0);
    assert_near("first", ratio[0], 0.03, 1e-9);
    // The joint holds a part of the energy only.
    let (known, ratio) = of("joint_ratio = 0.03");
    assert!(ratio[0] < 0.03 && known.joint < damping.joint);
    let (_, both) = of("joint_ratio = 0.03\nratio = [0.02, 0.2]");
    assert_near("first", both[0], 0.02, 1e-9);
    assert_near("second", both[1], 0.2, 1e-9);
    // Share of the energy by hand: an end force bends joint and link like L²/k to L³/3EI.
    let [link, joint] = [0.44f64.powi(3) / 3.0 / 94.74, 0.44 * 0.44 / 2000.0];
    assert_near("share", ratio[0] / 0.03, joint / (joint + link), 0.02);
}

#[test]
fn measurements_that_tell_nothing_are_refused() {
    let joint = "[hub]\nstiffness = \"deduced\"\n";
    let link = "bending_stiffness = 94.74\n";
    let cases = [
        ("frequency = -2\n", "", "4:13: link.frequency = -2: must be 0.001 to 100000 Hz"),
        ("frequency = nan\n", "", "link.frequency = NaN: must be"),
        ("frequency = [9, 2]\n", "", "link.frequency = [9.0, 2.0]: must be"),
        ("frequency = [2, 9, 20, 30]\n", "", "of the first 3 at most"),
        ("frequency = \"fast\"\n", "", "link.frequency = \"fast\": must be a number for the first"),
        ("frequency = [2.0, 4.0]\n", "", "must be frequencies of one arm to 20 %; the nearest"),
        (
            "bending_stiffness = 94.74\nfrequency = 9\n",
            "",
            "4:21: link.bending_stiffness: given beside link.frequency = 9; must be absent",
        ),
        (
            "frequency = [9, 150]\nyoungs_modulus = 7e10\n",
            joint,
            "link.youngs_modulus: given beside",
        ),
        ("frequency = 9\n", joint, "link.bending_stiffness: missing; must be EI"),
        (link, joint, "hub.stiffness = \"deduced\": must be beside link.frequency"),
        (link, "[hub]\nstiffness = \"soft\"\n", "hub.stiffness = \"soft\": must be a number, or"),
        (link, "[hub]\nstiffness = -5\n", "hub.stiffness = -5: must be 0.000000001 to"),
        (link, "[hub]\nstiffness = nan\n", "hub.stiffness = NaN: must be"),
        (link, "[damping]\njoint = 0.01\n", "damping.joint = 0.01: must be beside hub.stiffness"),
        (
            link,
            "[damping]\nratio = 0.01\nfrom = \"joint\"\n",
            "damping.from = \"joint\": must be beside hub.stiffness",
        ),
        (
            link,
            "[hub]\nstiffness = 200\n[damping]\njoint_ratio = 0.1\nratio = [0.01, 0.1]\n",
            "must be at least 0.0",
        ),
        (
            link,
            "[hub]\nstiffness = 200\n[damping]\njoint = 0.1\njoint_ratio = 0.1\n",
            "damping.joint = 0.1: must be absent beside damping.joint_ratio",
        ),
    ];
    for (keys, tables, words) in cases {
        let error = refusal(&format!("{BAR}{keys}{LOAD}{tables}"));
        assert!(error.starts_with("arm.toml:") && error.contains(words), "{words}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}
