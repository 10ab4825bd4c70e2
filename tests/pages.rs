//! Sentences of the pages about figures of their tables and of the code.

use stillbeam::material::MATERIALS;
use stillbeam::{Error, Link, Scene};
use stillbeam_lab::markers;
use stillbeam_protocol::frame;
use stillbeam_sim::arm;
use stillbeam_sim::scene_file::{Deduced, SceneFile};
use stillbeam_tests::{instructions, root};

fn page(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The sentence stands on the page, whatever its lines are broken like.
#[track_caller]
fn says(page: &str, sentence: &str) {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words(page).contains(&words(sentence)), "it no longer says: {sentence}");
}

/// A quantity of a scene: its words in the table of ranges, how it is set, its bounds.
type Quantity = (&'static str, fn(&mut Scene, f64), f64, f64);

/// Not in it: the gravity that buckles a link and what a tick and a method take.
const RANGES: [Quantity; 10] = [
    ("length 1e-3 to 1e3 m", |s, x| s.link.length = x, 1e-3, 1e3),
    ("mass 1e-7 to 1e5 kg", |s, x| s.link.mass = x, 1e-7, 1e5),
    ("EI 1e-9 to 1e12 N m²", |s, x| s.link.bending_stiffness = x, 1e-9, 1e12),
    ("radius 0 to 1e3 m", |s, x| s.hub.radius = x, 0.0, 1e3),
    ("inertia 0 to 1e6 kg m²", |s, x| s.hub.inertia = x, 0.0, 1e6),
    ("mass 0 to 1e5 kg", |s, x| s.payload.mass = x, 0.0, 1e5),
    (
        "inertia 0 to 1e6 kg m², at most (10 L)² times the moving mass",
        |s, x| s.payload.inertia = x,
        0.0,
        1e6,
    ),
    ("α 0 to 1e3 1/s", |s, x| s.damping.alpha = x, 0.0, 1e3),
    ("β 0 to 1 s", |s, x| s.damping.beta = x, 0.0, 1.0),
    ("0 to 1e3 m/s²", |s, x| s.gravity = x, 0.0, 1e3),
];

#[test]
fn the_ranges_are_those_that_are_accepted() {
    let ranges = page("docs/scenes.md");
    // So large and heavy that the payload's inertia is bounded by its number only.
    let scene = Scene::new(Link { length: 10.0, mass: 1e3, bending_stiffness: 1e9 });
    for (words, set, least, most) in RANGES {
        says(&ranges, words);
        let with = |value: f64| {
            let mut scene = scene;
            set(&mut scene, value);
            scene.validate()
        };
        for value in [least, most] {
            assert!(with(value).is_ok(), "{words}: {value}");
        }
        for value in [least - 1e-12 * most.min(1.0), most * 1.001, f64::NAN] {
            let Err(Error::OutOfRange { min, max, .. }) = with(value) else {
                panic!("{words}: {value} is accepted");
            };
            assert_eq!((min, max), (least, most), "{words}: {value}");
        }
    }
    let mut light = Scene::new(Link { length: 0.1, mass: 0.1, bending_stiffness: 1.0 });
    light.payload.inertia = 0.1001;
    assert!(light.validate().is_err(), "(10 L)² times the moving mass is 0.1 kg m²");
}

/// A cell of the accuracy table, % of the link's length.
fn error(solver: &str, scene: &str) -> f64 {
    let page = page("docs/accuracy.md");
    let table = markers::block(&page, "accuracy").expect("the table");
    let rows: Vec<Vec<&str>> = table
        .lines()
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    let column = rows[0].iter().position(|cell| *cell == scene).expect(scene);
    let row = rows.iter().find(|row| row[1] == solver).expect(solver);
    row[column].parse().expect("a number")
}

const PAPER: &str = "newmark, 1 consistent element, 10 ms, f32";
const FAST: &str = "elastica, 2 modes, fast, 10 ms, f32";

#[test]
fn methods_compare_as_their_table_does() {
    says(
        &page("README.md"),
        "follow a violent move hundreds of times closer than the small-deflection scheme",
    );
    let times = error(PAPER, "d-fast") / error(FAST, "d-fast");
    assert!((200.0..1000.0).contains(&times), "{times}");
    says(&page("docs/methods.md"), "good to 1 % of L there");
    says(
        &page("docs/methods.md"),
        "`d-fast`, a move as violent as a light arm sees, the paper's scheme is 13 % off, `elastica` 0.02 %",
    );
    assert_eq!(error(PAPER, "d-fast").round(), 13.0);
    assert_eq!((100.0 * error(FAST, "d-fast")).round(), 2.0);
    for scene in ["b-tip30", "b-tip30-damped-hub", "a-tip30", "s-gravity", "spin-up"] {
        assert!(error(PAPER, scene) <= 1.0, "{scene}");
    }
    assert!(error(PAPER, "d-fast") > 10.0);
}

/// The worst tick of a row of the instruction table.
fn worst(method: &str, size: &str, quality: &str, skip: &str) -> f64 {
    let ticks = instructions::ticks(&page("docs/instructions.csv")).expect("the table");
    let key = [method, size, quality, skip].map(str::to_owned);
    f64::from(ticks[&key])
}

#[test]
fn pages_compare_costs_as_the_instruction_table_does() {
    says(&page("docs/methods.md"), "`fine` where a tick may cost twice as much");
    for skip in ["", "no-gravity", "no-damping", "no-damping no-gravity"] {
        let times = worst("elastica", "2", "fine", skip) / worst("elastica", "2", "fast", skip);
        assert!((1.5..2.0).contains(&times), "{skip}: {times}");
    }
    let instructions = page("docs/instructions.md");
    says(
        &instructions,
        "half as much again where there is neither damping nor gravity, and about the same where there is",
    );
    let nodal = |skip: &str| {
        worst("newmark", "1", "nodal", skip) / worst("newmark", "1", "consistent", skip)
    };
    assert!((1.4..1.7).contains(&nodal("no-damping no-gravity")));
    assert!((0.95..1.1).contains(&nodal("")));
}

#[test]
fn sine_and_cosine_are_as_much_better_as_the_page_says() {
    let page = page("docs/instructions.md");
    says(&page, "an error four orders of magnitude smaller");
    says(&page, "its worst case costs forty times as much");
    let row = |whose: &str| -> Vec<f64> {
        let line = page.lines().find(|line| line.starts_with(&format!("| {whose} |")));
        let cells = line.unwrap_or_else(|| panic!("{whose}")).split('|').skip(2);
        cells.filter_map(|cell| cell.trim().parse().ok()).collect()
    };
    let [own, micromath, libm] = ["stillbeam", "micromath", "libm"].map(row);
    assert!(own[1] <= micromath[1], "in fewer instructions than micromath takes");
    assert!(own[2] * 1e4 <= micromath[2], "{own:?}, {micromath:?}");
    assert!((40.0..60.0).contains(&(libm[1] / own[1])), "{own:?}, {libm:?}");
}

#[test]
fn the_wire_page_knows_the_longest_frame() {
    says(&page("docs/firmware.md"), &format!("At most {} bytes", frame::MAX));
}

/// The page on arms has a file of every kind: each is read, without a remark, and is an arm.
#[test]
fn every_file_on_the_page_of_arms_is_an_arm() {
    let page = page("docs/arms.md");
    let files: Vec<&str> = page
        .split("```toml\n")
        .skip(1)
        .map(|rest| rest.split("```").next().expect("an end"))
        .collect();
    assert_eq!(files.len(), 6);
    for file in &files {
        let scene = SceneFile::parse_arm("docs/arms.md", file).expect(file);
        assert_eq!(scene.remarks, Vec::<String>::new(), "{file}");
        let report = arm::describe(&scene).expect(file);
        assert!(report.frequency_hz[0] > 1.0, "{file}");
        assert_eq!(report.method.is_some(), file.contains("[move]"), "{file}");
        let measured = ["frequency = ", "ratio = "].iter().any(|key| file.contains(key));
        assert_eq!(scene.deduced != Deduced::default(), measured, "{file}");
    }
    let materials = MATERIALS.map(|material| material.name).join(", ");
    says(&page, &format!("**Materials**: {materials} (spruce, along the grain)."));
}

/// README's program is the one that is compiled, with its packages, and README is short.
#[test]
fn readme_has_the_program_that_compiles() {
    let readme = page("README.md");
    let program = page("firmware/first/src/main.rs");
    let program = program.split_once('\n').expect("a description").1;
    assert!(readme.contains(&format!("```rust\n{program}```")), "firmware/first/src/main.rs");
    let manifest = page("firmware/first/Cargo.toml");
    let packages = manifest.split("stillbeam.workspace = true\n").nth(1).expect("packages");
    assert!(readme.contains(packages), "firmware/first/Cargo.toml");
    assert!(readme.lines().count() < 150, "{} lines", readme.lines().count());
}

/// The map and the recipes name files: each is there, below the root or the folder that it is told
/// of.
#[test]
fn the_map_names_files_that_exist() {
    let folders = ["", "core/src", "host-sim/src"].map(|folder| root().join(folder));
    let mut seen = 0;
    for name in ["ARCHITECTURE.md", "CONTRIBUTING.md"] {
        let page = page(name);
        let is_path = |text: &&str| {
            let placeholder = text.contains("NAME") || text.contains("NN");
            text.contains('/') && !text.contains(char::is_whitespace) && !placeholder
        };
        for path in page.split('`').skip(1).step_by(2).filter(is_path) {
            let exists = folders.iter().any(|folder| folder.join(path).exists());
            assert!(exists, "{name}: `{path}` is not there");
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen} paths read");
}
