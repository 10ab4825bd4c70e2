//! Sweeps from the command line: rows, refusals, fronts, tables.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use stillbeam_lab::markers;
use stillbeam_lab::sweep::pareto::front;
use stillbeam_lab::sweep::row::{Row, Rows, header};

/// Nine cases: newmark with 1 and 2 elements at 10, 5 and 2.5 ms, and the rigid arm.
const SPEC: &str = "scenes = [\"s-gravity\"]\n[[grid]]\nmethod = [\"newmark\", \"rigid\"]\n\
                    elements = [1, 2]\ntick = [0.01, 0.005, 0.0025]\n";
const CASES: usize = 9;

/// A folder with the spec in it.
struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        let bench = Self { folder: tempfile::tempdir().unwrap() };
        fs::write(bench.path("spec.toml"), SPEC).unwrap();
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let program = env!("CARGO_BIN_EXE_stillbeam-lab");
        Command::new(program).args(arguments).current_dir(&self.folder).output().unwrap()
    }

    /// Runs what must succeed and returns what it prints.
    fn succeed(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    /// Runs what must be refused, in one line with exit code 2, and returns the line.
    fn refuse(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let line = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert_eq!(line.lines().count(), 1, "{line}");
        assert!(line.contains("must ") || line.contains("use "), "{line}");
        line
    }

    fn rows(&self, name: &str) -> Vec<Row> {
        rows(&self.path(name))
    }

    fn lines(&self, name: &str) -> Vec<String> {
        fs::read_to_string(self.path(name)).unwrap().lines().map(str::to_owned).collect()
    }

    fn write(&self, name: &str, lines: &[String]) {
        fs::write(self.path(name), lines.join("\n") + "\n").unwrap();
    }
}

fn rows(path: &Path) -> Vec<Row> {
    Rows::open(path).unwrap().map(Result::unwrap).collect()
}

#[test]
fn a_sweep_writes_a_row_a_case() {
    let bench = Bench::new();
    let said = bench.succeed(&["sweep", "spec.toml", "--csv", "one.csv"]);
    assert!(said.contains("9 cases to one.csv"), "{said}");
    let rows = bench.rows("one.csv");
    let numbers: Vec<u64> = rows.iter().map(|row| row.id.case).collect();
    assert_eq!(numbers, (1..=CASES as u64).collect::<Vec<_>>());
    // A small-deflection model where the link bends by 17 % of L: 0.6 % of L at 10 ms.
    assert!((rows[0].errors.tip_max - 0.0061).abs() < 1e-4, "{:?}", rows[0]);
    for row in &rows {
        let cost = row.cost.expect("every case has its cost");
        assert!(cost.worst_ns >= cost.tick_ns && cost.setup_us > 0.0, "{row:?}");
    }
    // Nothing is left beside the spec and the output.
    assert_eq!(fs::read_dir(&bench.folder).unwrap().count(), 2);
}

#[test]
fn what_is_not_a_sweep_is_refused() {
    let bench = Bench::new();
    bench.succeed(&["sweep", "spec.toml", "--csv", "out.csv"]);
    let lines = bench.lines("out.csv");
    let column = header().iter().position(|&name| name == "tip_error_max").unwrap();

    for (value, says) in [("1.2x", "invalid float"), ("NaN", "0 or more"), ("-1", "0 or more")] {
        let mut broken = lines.clone();
        let mut cells: Vec<&str> = lines[3].split(',').collect();
        cells[column] = value;
        broken[3] = cells.join(",");
        bench.write("broken.csv", &broken);
        let line = bench.refuse(&["pareto", "broken.csv", "--out", "pictures"]);
        for part in ["broken.csv", "line 4", "tip_error_max", says] {
            assert!(line.contains(part), "{part}: {line}");
        }
    }

    fs::write(bench.path("run.csv"), "t_s,angle_rad\n0,0\n").unwrap();
    let line = bench.refuse(&["pareto", "run.csv", "--out", "pictures"]);
    assert!(line.contains("header"), "{line}");

    for (name, text) in [
        ("scene", SPEC.replace("s-gravity", "nowhere")),
        ("elements", SPEC.replace("[1, 2]", "[3]")),
        ("key", SPEC.replace("elements", "element")),
        ("tick", SPEC.replace("0.005", "50.0")),
    ] {
        fs::write(bench.path("wrong.toml"), text).unwrap();
        let line = bench.run(&["sweep", "wrong.toml", "--csv", "no.csv"]);
        assert_eq!(line.status.code(), Some(2), "{name}");
    }
    assert!(!bench.path("no.csv").exists() && !bench.path("pictures").exists());
}

#[test]
fn the_front_is_what_nothing_dominates() {
    // A fixed sequence of points on a coarse lattice, so that ties occur.
    let mut seed = 1_u32;
    let mut next = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 27)
    };
    for size in [0, 1, 2, 50, 400] {
        let mut points: Vec<(f64, f64)> = (0..size).map(|_| (next(), next())).collect();
        points.extend([(f64::NAN, 0.0), (0.0, f64::INFINITY)]);
        let chosen = front(&points);
        let dominates = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        for (index, &point) in points[..size].iter().enumerate() {
            let beaten = points[..size].iter().any(|&other| dominates(other, point));
            let first = points[..size].iter().position(|&other| other == point) == Some(index);
            assert_eq!(chosen.contains(&index), !beaten && first, "{point:?}");
        }
        assert!(chosen.iter().all(|&index| index < size));
        assert!(chosen.windows(2).all(|w| points[w[0]].0 < points[w[1]].0));
    }
}

#[test]
fn pareto_draws_and_answers() {
    let bench = Bench::new();
    let spec = "scenes = [\"s-gravity\"]\n[[grid]]\nmethod = [\"newmark\"]\nelements = [1, 4]\ntick = [0.01, 0.001]\n\
                mass = [\"lumped\", \"consistent\"]\n";
    fs::write(bench.path("spec.toml"), spec).unwrap();
    bench.succeed(&["sweep", "spec.toml", "--csv", "out.csv"]);
    let said = bench.succeed(&["pareto", "out.csv", "--scene", "s-gravity", "--out", "pictures"]);
    for part in ["10 ms against 1 ms", "1 element against 4", "lumped", "no rows around"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let page = fs::read_to_string(bench.path("pictures/index.html")).unwrap();
    assert!(page.contains("10 ms against 1 ms") && page.contains("<svg"));
    // Needs nothing but itself.
    assert!(!page.contains("src=") && !page.contains("<link"), "{page}");
    let svg = fs::read_to_string(bench.path("pictures/s-gravity.svg")).unwrap();
    assert!(roxmltree::Document::parse(&svg).is_ok());
    assert_eq!(bench.rows("pictures/s-gravity.csv"), bench.rows("out.csv"));
    let line = bench.refuse(&["pareto", "out.csv", "--scene", "b-tip30", "--out", "pictures"]);
    assert!(line.contains("s-gravity"), "{line}");
}

#[test]
fn a_page_that_is_no_longer_true_is_found() {
    let bench = Bench::new();
    fs::create_dir(bench.path("docs")).unwrap();
    let text = "# Accuracy\n<!-- lab:accuracy -->\n| solver | d-fast |\n<!-- /lab -->\n<!-- lab:torque -->\n<!-- /lab -->\n";
    fs::write(bench.path("docs/accuracy.md"), text).unwrap();
    let output = bench.run(&["docs", "docs/accuracy.md", "--check"]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("docs/accuracy.md:3: | solver | d-fast | is now | solver"), "{said}");
    assert!(said.contains("`cargo lab docs docs/accuracy.md`"), "{said}");
    assert_eq!(fs::read_to_string(bench.path("docs/accuracy.md")).unwrap(), text);

    bench.succeed(&["docs", "docs/accuracy.md"]);
    let written = fs::read_to_string(bench.path("docs/accuracy.md")).unwrap();
    let committed = include_str!("../../../docs/accuracy.md");
    for name in ["accuracy", "torque"] {
        let [written, committed] = [&written, committed].map(|page| markers::block(page, name));
        assert_eq!(written.unwrap(), committed.unwrap());
    }

    // A page that costs nothing to check: as committed, and without the last line of its table.
    let committed = include_str!("../../../docs/auto.md");
    fs::write(bench.path("docs/auto.md"), committed).unwrap();
    let said = bench.succeed(&["docs", "docs/auto.md", "--check"]);
    assert_eq!(said, "docs/auto.md: true\n");
    let end = committed.rfind("<!-- /lab").unwrap();
    let last = committed[..end - 1].rfind('\n').unwrap() + 1;
    fs::write(bench.path("docs/auto.md"), committed[..last].to_owned() + &committed[end..])
        .unwrap();
    assert_eq!(bench.run(&["docs", "docs/auto.md", "--check"]).status.code(), Some(1));

    fs::write(bench.path("docs/accuracy.md"), "no markers").unwrap();
    let line = bench.refuse(&["docs", "docs/accuracy.md", "--check"]);
    assert!(line.contains("lab:accuracy"), "{line}");
    bench.refuse(&["docs", "docs/styl.md"]);
}

/// A spec that cannot be read is refused with file, line and column.
#[test]
fn a_spec_is_refused_where_it_is_wrong() {
    let bench = Bench::new();
    for (spec, words) in [
        (
            "scenes = [\"d-fast\"]\n[[grid]]\nmethod = [\"modl\"]\n",
            "spec.toml:3:11: grid[0].method[0] = \"modl\": must be one of ",
        ),
        ("scenes = [\"d-fast\"]\n[grid]\ntick = [0.01]\n", "spec.toml:2:1: grid: must be [[grid]]"),
        (
            "scenes = [\"d-fast\"]\n[[grid]]\nticks = [0.01]\n",
            "spec.toml:3:1: grid[0].ticks: unknown key",
        ),
        (
            "scenes = []\n[[grid]]\ntick = [0.01]\n",
            "spec.toml:1:10: scenes = []: must be one or more",
        ),
    ] {
        fs::write(bench.path("spec.toml"), spec).unwrap();
        let text = bench.refuse(&["sweep", "spec.toml", "--csv", "out.csv"]);
        assert!(text.contains(words), "{words} is not in: {text}");
    }
}
