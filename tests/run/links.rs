//! Links of scene files: sections, tubes and rods, masses that are mounted, materials.

use std::f64::consts::PI;

use stillbeam_sim::arm::natural;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_tests::assert_near;

fn read(text: &str) -> SceneFile {
    SceneFile::parse_arm("test", text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[track_caller]
fn same(what: &str, value: f64, expected: f64) {
    assert_near(what, value, expected, 1e-12 * expected.abs());
}

#[test]
fn a_uniform_cross_section_gives_mass_and_stiffness() {
    let aluminium = [69e9, 2800.0];
    let (d, e) = (0.012f64, 0.001f64);
    let inner = d - 2.0 * e;
    let cases = [
        ("width = 0.04\nthickness = 0.004", 0.04 * 0.004, 0.04 * 0.004f64.powi(3) / 12.0),
        ("diameter = 0.012", PI * d * d / 4.0, PI * d.powi(4) / 64.0),
        (
            "diameter = 0.012\nwall = 0.001",
            PI * (d * d - inner * inner) / 4.0,
            PI * (d.powi(4) - inner.powi(4)) / 64.0,
        ),
        (
            "width = 0.03\nthickness = 0.02\nwall = 0.002",
            0.03 * 0.02 - 0.026 * 0.016,
            (0.03 * 0.02f64.powi(3) - 0.026 * 0.016f64.powi(3)) / 12.0,
        ),
    ];
    for (keys, area, moment) in cases {
        for matter in ["material = \"aluminium\"", "youngs_modulus = 69e9\ndensity = 2800"] {
            let scene = read(&format!("[link]\nlength = 0.8\n{matter}\n{keys}\n"));
            assert!(scene.arm.shape.is_uniform(), "{keys}");
            same(keys, scene.arm.link.mass, aluminium[1] * area * 0.8);
            same(keys, scene.arm.link.bending_stiffness, aluminium[0] * moment);
        }
    }
}

/// One link told three ways: in one piece, in two, and by numbers at the ends.
#[test]
fn sections_end_to_end_are_one_link() {
    let tables = |keys: &str| {
        [0.2, 0.3].map(|length| format!("[[link.sections]]\nlength = {length}\n{keys}\n")).concat()
    };
    let sizes = "width = 0.04\nthickness = 0.004";
    let one = read(&format!("[link]\nlength = 0.5\nmaterial = \"aluminium\"\n{sizes}\n"));
    let two = read(&format!("[link]\nmaterial = \"aluminium\"\n{}", tables(sizes)));
    let (area, moment) = (0.04 * 0.004, 0.04 * 0.004f64.powi(3) / 12.0);
    let numbers =
        format!("bending_stiffness = {}\nmass_per_length = {}", 69e9 * moment, 2800.0 * area);
    let three = read(&format!("[link]\nlength = 0.5\n{}", tables(&numbers)));
    let own = format!("{sizes}\nmaterial = \"aluminium\"");
    let four = read(&format!("[link]\nmaterial = \"steel\"\n{}", tables(&own)));
    for scene in [&two, &three, &four] {
        let (link, expected) = (scene.arm.link, one.arm.link);
        same("length", link.length, expected.length);
        same("mass", link.mass, expected.mass);
        same("stiffness", link.bending_stiffness, expected.bending_stiffness);
        let [found, expected] =
            [scene, &one].map(|scene| natural::frequencies(&scene.arm).expect("frequencies"));
        // Elements end where sections do: other ones than the uniform link's.
        assert_near("first", found[0], expected[0], 1e-5 * expected[0]);
        assert_near("second", found[1], expected[1], 5e-4 * expected[1]);
    }
}

/// A mass and a stiffness of the whole link are what the sizes are scaled to.
#[test]
fn what_is_weighed_goes_before_what_is_tabulated() {
    let taper = "[link]\nlength = 0.5\nwidth = [0.03, 0.015]\nthickness = 0.002\n";
    let plain = read(&format!("{taper}material = \"pla\"\n"));
    same("mass", plain.arm.link.mass, 1240.0 * 0.5 * 0.002 * 0.0225);
    let weighed = read(&format!("{taper}material = \"pla\"\nmass = 0.02\n"));
    same("mass", weighed.arm.link.mass, 0.02);
    same("EI", weighed.arm.link.bending_stiffness, plain.arm.link.bending_stiffness);
    let alone = read(&format!("{taper}mass = 0.02\nbending_stiffness = 0.1\n"));
    same("mass", alone.arm.link.mass, 0.02);
    same("EI", alone.arm.link.bending_stiffness, 0.1);
    assert_eq!(alone.arm.shape, {
        let unit = read(&format!("{taper}mass = 0.03\nbending_stiffness = 0.2\n"));
        unit.arm.shape
    });
}

#[test]
fn masses_on_the_link_are_where_they_are_said_to_be() {
    let link = "[link]\nlength = 0.3\nmass = 0.08\nbending_stiffness = 2.0\n";
    let scene = read(&format!(
        "{link}[[link.masses]]\nat = 0.24\nmass = 0.005\n[[link.masses]]\nat = 0.1\nmass = 0.02\n"
    ));
    let [mass, first, second] = scene.arm.link_moments();
    same("mass", mass, 0.105);
    same("first moment", first, 0.08 * 0.15 + 0.24 * 0.005 + 0.1 * 0.02);
    same("second moment", second, 0.08 * 0.03 + 0.24 * 0.24 * 0.005 + 0.01 * 0.02);
    // At the tip it is a payload.
    let tip = read(&format!("{link}[[link.masses]]\nat = 0.3\nmass = 0.05\n"));
    let payload = read(&format!("{link}[payload]\nmass = 0.05\n"));
    let [one, other] = [tip, payload].map(|scene| natural::frequencies(&scene.arm).expect("f"));
    assert_near("frequency", one[0], other[0], 1e-4 * other[0]);
}

#[test]
fn materials_are_found_as_people_write_them() {
    for name in [
        "brass",
        "spring steel",
        "PLA",
        "PETG",
        "ABS",
        "POM",
        "nylon",
        "CFRP tube",
        "wood",
        "stainless_steel",
    ] {
        let scene =
            read(&format!("[link]\nlength = 0.3\nmaterial = \"{name}\"\ndiameter = 0.008\n"));
        let frequency = natural::frequencies(&scene.arm).expect("frequencies")[0];
        assert!((10.0..150.0).contains(&frequency), "{name}: {frequency} Hz");
    }
}

const STRIP: &str = "length = 0.5\nmaterial = \"aluminium\"\nwidth = 0.04\nthickness = 0.004\n";

#[test]
fn links_that_cannot_be_are_refused() {
    let strip = |from: &str, to: &str| format!("[link]\n{}", STRIP.replace(from, to));
    let with = |keys: &str| format!("[link]\n{STRIP}{keys}\n");
    let sections = |link: &str, keys: &str| {
        format!(
            "[link]\nmaterial = \"steel\"\n{link}\n[[link.sections]]\nlength = 0.2\ndiameter = \
             0.01\n[[link.sections]]\n{keys}\n"
        )
    };
    let tapered = "width = [0.03, -0.015]";
    let own = "length = 0.1\nbending_stiffness = 2.0";
    let cases = [
        (
            strip("width = 0.04", "width = -0.04"),
            "4:9: link.width = -0.04: must be 0.000001 to 10 m",
        ),
        (strip("width = 0.04", "width = nan"), "link.width = NaN: must be"),
        (strip("width = 0.04", tapered), "link.width = -0.015: must be"),
        (
            strip("width = 0.04", "width = [0.03, 0.02, 0.01]"),
            "4:9: link.width = [0.03, 0.02, 0.01]: must be a number, or two",
        ),
        (
            strip("width = 0.04", "width = \"4 cm\""),
            "link.width = \"4 cm\": must be a number, or two",
        ),
        (
            strip("width = 0.04", "diameter = 0.04"),
            "link.thickness = 0.004: must be absent beside diameter",
        ),
        (strip("width = 0.04\n", ""), "link.width: missing beside thickness = 0.004"),
        (
            strip("width = 0.04\nthickness = 0.004", "wall = 0.001"),
            "link.diameter: missing beside wall",
        ),
        (
            strip("width = 0.04\nthickness = 0.004", "diameter = 0.01\nwall = 0.006"),
            "link.wall = 0.006: must be 0.000001 to 0.005 m",
        ),
        (with("wall = 0.003"), "link.wall = 0.003: must be 0.000001 to 0.002 m"),
        (with("second_moment = 1e-10"), "link.second_moment = 0.0000000001: must be absent"),
        (with("density = 2700"), "link.density: given beside material = aluminium"),
        (
            strip("material = \"aluminium\"", "youngs_modulus = 7e10\ndensity = -1"),
            "link.density = -1: must be 1 to 100000 kg/m^3",
        ),
        (strip("material = \"aluminium\"", "density = 2700"), "link.bending_stiffness: missing"),
        (
            strip("material = \"aluminium\"", "youngs_modulus = nan\nmass = 1"),
            "link.youngs_modulus = NaN: must be",
        ),
        (
            strip("material = \"aluminium\"", "density = 2700\nmass = 1\nbending_stiffness = 1"),
            "link.mass: given beside density = 2700",
        ),
        (
            strip("aluminium", "cheese"),
            "3:12: link.material = \"cheese\": must be one of acrylic, aluminium,",
        ),
        (strip("length = 0.5\n", ""), "link.length: missing; must be given in [link]"),
        (
            with("[[link.masses]]\nat = 0.6\nmass = 0.01"),
            "7:6: link.masses[0].at = 0.6: must be 0 to 0.5 m",
        ),
        (
            with("[[link.masses]]\nat = 0.1\nmass = -1"),
            "link.masses[0].mass = -1: must be 0 to 100000 kg",
        ),
        (
            with(&"[[link.masses]]\nat = 0.1\nmass = 0.01\n".repeat(5)),
            "link.masses = 5: must be 0 to 4",
        ),
        (
            with("[[link.masses]]\nat = 0.1\nmass = 0.01\ninertia = 1"),
            "link.masses[0].inertia: unknown key",
        ),
        (with("[payload]\noffset = 5.1"), "payload.offset = 5.1: must be 0 to 5 m"),
        (with("[payload]\noffset = nan"), "payload.offset = NaN: must be"),
        (
            sections("length = 0.5", "length = 0.4\ndiameter = 0.01"),
            "link.length = 0.5: must be 0.6",
        ),
        (
            sections("", "length = -0.4\ndiameter = 0.01"),
            "8:10: link.sections[1].length = -0.4: must be",
        ),
        (sections("", "length = 0.4"), "link.sections[1].width: missing; must be width and"),
        (sections("", "diameter = 0.01"), "link.sections[1].length: missing"),
        (
            sections("", "length = 0.4\ndiameter = 0"),
            "9:12: link.sections[1].diameter = 0: must be",
        ),
        (
            sections("", own),
            "link.sections[1].mass_per_length: missing beside bending_stiffness = 2",
        ),
        (
            sections("", &format!("{own}\nmass_per_length = [1.0, 0.0]")),
            "link.sections[1].mass_per_length = 0: must be",
        ),
        (
            sections("", &format!("{own}\nmass_per_length = 1.0\ndiameter = 0.01")),
            "link.sections[1].bending_stiffness: given beside diameter = 0.01",
        ),
        (
            sections("width = 0.01", "length = 0.4\ndiameter = 0.01"),
            "link.width = 0.01: must be absent beside [[link.sections]]",
        ),
        (
            sections("", "length = 0.4\ndiameter = 0.01\nmaterial = \"bras\""),
            "link.sections[1].material = \"bras\": must be one of",
        ),
        (
            sections("frequency = 9", &format!("{own}\nmass_per_length = 1.0")),
            "link.sections[1].bending_stiffness: given beside link.frequency = 9",
        ),
        ("[link]\nsections = []\nlength = 0.5\n".to_owned(), "link.sections = 0: must be 1 to 8"),
        (
            sections("", &"length = 0.1\ndiameter = 0.01\n[[link.sections]]\n".repeat(8)),
            "link.sections",
        ),
    ];
    for (text, words) in cases {
        let error = SceneFile::parse_arm("arm.toml", &text).expect_err(&text).to_string();
        assert!(error.starts_with("arm.toml:") && error.contains(words), "{words}: {error}");
        assert!(error.contains("must be") && !error.contains('\n'), "{error}");
    }
}

/// Values that are probably in another unit.
#[test]
fn sizes_in_other_units_are_remarked_on() {
    let cases = [
        (
            format!("[link]\n{}", STRIP.replace("0.04", "[0.4, 0.9]")),
            "link.width = 0.9: lengths are in m",
        ),
        (
            "[link]\nlength = 0.5\nmaterial = \"steel\"\ndiameter = 0.6\n".to_owned(),
            "link.diameter = 0.6: lengths are in m (0.6 mm = 0.0006 m)",
        ),
        (
            "[link]\nlength = 0.5\nyoungs_modulus = 2e11\ndensity = 7.85\ndiameter = 0.006\n"
                .to_owned(),
            "link.density = 7.85: densities are in kg/m^3 (7.85 g/cm^3 = 7850 kg/m^3)",
        ),
        (
            "[link]\nmaterial = \"steel\"\n[[link.sections]]\nlength = 0.5\ndiameter = 0.3\n"
                .to_owned(),
            "link.sections[0].diameter = 0.3: lengths are in m",
        ),
        (format!("[link]\n{STRIP}[payload]\noffset = 0.6\n"), "payload.offset = 0.6: farther from"),
        (
            format!("[link]\n{STRIP}[hub]\nstiffness = 0.1\n"),
            "hub.stiffness = 0.1: the joint gives",
        ),
    ];
    for (text, words) in cases {
        let remarks = read(&text).remarks;
        assert_eq!(remarks.len(), 1, "{text}: {remarks:?}");
        assert!(remarks[0].starts_with(words), "{words} does not begin: {}", remarks[0]);
    }
}
