//! The page's numbers are those of `run`, to the bit.

use stillbeam_sim::compare::residual;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_tests::browser::Browser;

use super::open;

/// Settings of the page. With the first it begins.
const SETTINGS: [&str; 4] = [
    "",
    "material=steel&length=330&thickness=0.7&payload=35&angle=140&duration=0.83&damping=0&shaper=zvd",
    "material=carbon-epoxy&length=900&width=37&payload=0&duration=0.42&angle=45&robust=0.2&error=-7&shaper=mzv",
    "length=700&thickness=3.3&payload=215&damping=2.3&angle=180&duration=1.21&error=12&robust=0.1&shaper=ei",
];

/// Name of the line that makes the file's arm the one in the picture.
const STIFFNESS: &str = "# bending_stiffness = ";

/// Returns the arm and the motion of a scene file of the page, and the arm in its picture.
fn scene_of(kind: &str, text: &str) -> SceneFile {
    let parse = |text: &str| {
        SceneFile::parse("scene.toml", text)
            .unwrap_or_else(|error| panic!("{kind}: {error}\n{text}"))
    };
    let real = parse(&text.replace(STIFFNESS, &STIFFNESS[2..]));
    // The motion stays the one that is planned for the file's own arm.
    SceneFile { moves: parse(text).moves, ..real }
}

/// Returns the rows of a motion in the page, of ten numbers each.
fn table(browser: &mut Browser, kind: &str) -> Vec<[f64; 10]> {
    let words = browser.text(&format!(
        "Array.from(new BigUint64Array(playground.runOf('{kind}').table.buffer), (bits) => \
         bits.toString(16)).join(' ')"
    ));
    let bits = words.split(' ').map(|word| u64::from_str_radix(word, 16).expect("a number"));
    let numbers: Vec<f64> = bits.map(f64::from_bits).collect();
    let (rows, rest) = numbers.as_chunks();
    assert!(rest.is_empty());
    rows.to_vec()
}

#[test]
fn every_setpoint_has_the_bits_of_run() {
    let mut browser = Browser::start();
    for settings in SETTINGS {
        open(&mut browser, settings);
        for kind in ["cubic", "shaped", "still"] {
            let text = browser.text(&format!("playground.scene('{kind}')"));
            let scene = scene_of(kind, &text);
            let solver = scene.solver.resolve().expect("a solver");
            let rows = run(&scene, &solver).unwrap_or_else(|error| panic!("{kind}: {error}"));
            let shown = table(&mut browser, kind);
            assert_eq!(shown.len(), rows.len(), "{settings}: {kind}");
            for (shown, row) in shown.iter().zip(&rows) {
                let expected = row.numbers();
                let same = (0..8).all(|k| shown[k].to_bits() == expected[k].to_bits());
                assert!(same, "{settings}: {kind}: {shown:?} is not {expected:?}");
            }
            let left = residual(&rows, &scene, solver.tick).expect("a residual").value();
            let left = left.expect("an arm at rest");
            let said = browser.value(&format!("playground.runOf('{kind}').residual"));
            let said = said.as_f64().expect("a number");
            println!("{settings}: {kind}: {said:e} {left:e}");
            assert!((said - left).abs() <= 1e-9 + 1e-3 * left, "{kind}: {said} is not {left}");
        }
    }
    assert_eq!(browser.trouble(), [""; 0]);
}

/// A scene of the page, changed in one digit, is another one: the comparison can fail.
#[test]
fn another_arm_has_other_bits() {
    let mut browser = Browser::start();
    open(&mut browser, "");
    let text = browser.text("playground.scene('cubic')");
    let changed = text.replace("width = 0.02\n", "width = 0.0200001\n");
    assert_ne!(text, changed);
    let scene = scene_of("cubic", &changed);
    let rows = run(&scene, &scene.solver.resolve().expect("a solver")).expect("a run");
    let shown = table(&mut browser, "cubic");
    assert!(shown.iter().zip(&rows).any(|(shown, row)| shown[7] != row.torque_nm));
}
