//! Sweeps from the command line: shards, interruptions, joins, fronts, tables.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use stillbeam_lab::sweep::pareto::front;
use stillbeam_lab::sweep::row::{CaseId, Errors, Row, Rows, header};
use stillbeam_sim::solver::{Method, SolverKeys};

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
        assert!(line.contains("must be") || line.contains("use "), "{line}");
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

/// Rows without what differs from run to run.
fn errors(rows: &[Row]) -> Vec<Row> {
    rows.iter().map(|row| Row { cost: None, ..row.clone() }).collect()
}

#[test]
fn shards_join_to_the_rows_of_one_run() {
    let bench = Bench::new();
    bench.succeed(&["sweep", "spec.toml", "--csv", "one.csv"]);
    for shard in ["1", "2"] {
        let (csv, share) = (format!("{shard}.csv"), format!("{shard}/2"));
        bench.succeed(&["sweep", "spec.toml", "--csv", &csv, "--shard", &share]);
    }
    bench.succeed(&["merge", "joined.csv", "2.csv", "1.csv"]);
    let (one, joined) = (bench.rows("one.csv"), bench.rows("joined.csv"));
    assert_eq!(one.len(), CASES);
    assert_eq!(errors(&one), errors(&joined));
    // A small-deflection model where the link bends by 17 % of L: 0.6 % of L at 10 ms.
    assert!((one[0].errors.tip_max - 0.0061).abs() < 1e-4, "{:?}", one[0]);
    for row in &one {
        let cost = row.cost.unwrap();
        assert!(cost.worst_ns >= cost.tick_ns && cost.setup_us > 0.0, "{row:?}");
    }
    // Nothing is left beside the outputs.
    assert!(
        fs::read_dir(&bench.folder)
            .unwrap()
            .flatten()
            .all(|file| { !file.file_name().to_string_lossy().ends_with(".part") })
    );

    let gap = bench.refuse(&["merge", "no.csv", "1.csv"]);
    assert!(gap.contains("case 2 of 9 is in no shard"), "{gap}");
    let twice = bench.refuse(&["merge", "no.csv", "1.csv", "2.csv", "1.csv"]);
    assert!(twice.contains("1.csv: case 1: another shard has it"), "{twice}");
    assert!(!bench.path("no.csv").exists());
}

#[test]
fn resume_runs_only_what_is_missing() {
    let bench = Bench::new();
    bench.succeed(&["sweep", "spec.toml", "--csv", "out.csv"]);
    let whole = bench.rows("out.csv");

    // Two rows lost; the others carry a mark that a new measurement would wipe out.
    let mut lines = bench.lines("out.csv");
    for line in &mut lines[1..] {
        let cut = line.rfind(',').unwrap();
        line.replace_range(cut.., ",987654");
    }
    let mut kept = lines.clone();
    kept.remove(7);
    kept.remove(2);
    bench.write("out.csv", &kept);
    let said = bench.succeed(&["sweep", "spec.toml", "--csv", "out.csv", "--resume"]);
    assert!(said.contains("2 run, 2 timed"), "{said}");
    let again = bench.rows("out.csv");
    assert_eq!(errors(&again), errors(&whole));
    let marked = |row: &&Row| row.cost.unwrap().worst_ns == 987654.0;
    assert_eq!(again.iter().filter(marked).count(), CASES - 2);

    // Interrupted while it computed errors, in the middle of a line.
    let part = "new.csv.errors.part";
    fs::write(bench.path(part), lines[..4].join("\n") + "\n" + &lines[4][..30]).unwrap();
    let refused = bench.refuse(&["sweep", "spec.toml", "--csv", "new.csv"]);
    assert!(refused.contains("new.csv.errors.part") && refused.contains("--resume"), "{refused}");
    let said = bench.succeed(&["sweep", "spec.toml", "--csv", "new.csv", "--resume"]);
    assert!(said.contains("6 run, 9 timed"), "{said}");
    assert_eq!(errors(&bench.rows("new.csv")), errors(&whole));
    assert!(!bench.path(part).exists());

    // Interrupted while it timed.
    bench.write("late.csv.errors.part", &lines);
    bench.write("late.csv.part", &lines[..6]);
    let said = bench.succeed(&["sweep", "spec.toml", "--csv", "late.csv", "--resume"]);
    assert!(said.contains("0 run, 4 timed"), "{said}");
    assert_eq!(bench.rows("late.csv").iter().filter(marked).count(), 5);
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
        for arguments in [
            &["merge", "joined.csv", "broken.csv"][..],
            &["pareto", "broken.csv", "--out", "pictures"],
            &["sweep", "spec.toml", "--csv", "broken.csv", "--resume"],
        ] {
            let line = bench.refuse(arguments);
            for part in ["broken.csv", "line 4", "tip_error_max", says] {
                assert!(line.contains(part), "{part}: {line}");
            }
        }
    }

    bench.succeed(&["run", "d-fast", "--csv", "run.csv"]);
    for arguments in [
        &["merge", "joined.csv", "run.csv"][..],
        &["pareto", "run.csv", "--out", "pictures"],
        &["sweep", "spec.toml", "--csv", "run.csv", "--resume"],
    ] {
        let line = bench.refuse(arguments);
        assert!(line.contains("header"), "{line}");
    }

    // A sweep of something else.
    fs::write(bench.path("other.toml"), SPEC.replace("0.0025", "0.002")).unwrap();
    bench.succeed(&["sweep", "other.toml", "--csv", "other.csv"]);
    bench.refuse(&["sweep", "spec.toml", "--csv", "other.csv", "--resume"]);
    let line = bench.refuse(&["merge", "joined.csv", "out.csv", "other.csv"]);
    assert!(line.contains("one sweep"), "{line}");

    for shard in ["0/2", "3/2", "1", "a/b"] {
        bench.refuse(&["sweep", "spec.toml", "--csv", "no.csv", "--shard", shard]);
    }
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
    assert!(!bench.path("no.csv").exists() && !bench.path("joined.csv").exists());
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
fn reference_writes_the_columns_of_run() {
    let bench = Bench::new();
    bench.succeed(&["reference", "d-fast", "--solver", "rod", "--csv", "rod.csv"]);
    bench.succeed(&["run", "d-fast", "--csv", "run.csv"]);
    let (rod, run) = (bench.lines("rod.csv"), bench.lines("run.csv"));
    assert_eq!((&rod[0], rod.len()), (&run[0], run.len()));
    let said = bench.succeed(&["compare", "run.csv", "rod.csv", "--scene", "d-fast"]);
    assert!(said.contains("41 common times"), "{said}");
    // The last row of the move has the left-hand acceleration, -6 pi / T^2.
    let end: Vec<f64> = rod[21].split(',').map(|cell| cell.parse().unwrap()).collect();
    assert!((end[0] - 0.2).abs() < 1e-12 && (end[3] + 471.2389).abs() < 1e-3, "{end:?}");

    bench.succeed(&["reference", "d-fast", "--csv", "fine.csv", "--every", "0.003"]);
    let times: Vec<String> = bench.lines("fine.csv");
    assert!(times[1].starts_with("0") && times.last().unwrap().starts_with("0.4,"));
    for every in ["0", "-1", "5", "nan"] {
        bench.refuse(&["reference", "d-fast", "--csv", "no.csv", "--every", every]);
    }
    assert!(!bench.path("no.csv").exists());
}

#[test]
fn a_table_that_is_no_longer_true_is_found() {
    let bench = Bench::new();
    let text = "# Read me\n<!-- table:accuracy -->\n| solver | d-fast |\n<!-- /table -->\n";
    fs::write(bench.path("README.md"), text).unwrap();
    let output = bench.run(&["tables", "README.md", "--check"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("table:accuracy, line 1"));
    assert_eq!(fs::read_to_string(bench.path("README.md")).unwrap(), text);
    fs::write(bench.path("README.md"), "no markers").unwrap();
    bench.refuse(&["tables", "README.md"]);
}

/// Largest resident size of the process so far, KiB.
#[cfg(target_os = "linux")]
fn peak_memory(process: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
#[cfg(target_os = "linux")]
fn a_million_rows_are_joined_in_little_memory() {
    const ROWS: u64 = 1_000_000;
    const SHARDS: u64 = 4;
    let bench = Bench::new();
    let mut arguments = vec!["merge".to_owned(), "all.csv".to_owned()];
    let keys = SolverKeys {
        method: Some(Method::Newmark),
        elements: Some(1),
        tick: Some(0.01),
        spin: Some(true),
        ..SolverKeys::default()
    };
    let mut row = Row {
        id: CaseId { sweep: "5eed".to_owned(), case: 0, cases: ROWS, scene: "d-fast".to_owned() },
        keys,
        errors: Errors { tip_max: 0.13, tip_rms: 0.05, residual: None, torque: 0.4 },
        cost: None,
    };
    for shard in 1..=SHARDS {
        let name = format!("{shard}.csv");
        let mut file =
            csv::WriterBuilder::new().has_headers(false).from_path(bench.path(&name)).unwrap();
        file.write_record(header()).unwrap();
        for case in (shard..=ROWS).step_by(SHARDS as usize) {
            row.id.case = case;
            row.write(&mut file).unwrap();
        }
        file.flush().unwrap();
        arguments.push(name);
    }
    let program = env!("CARGO_BIN_EXE_stillbeam-lab");
    let mut command = Command::new(program);
    let mut child = command.args(&arguments).current_dir(&bench.folder).spawn().unwrap();
    let mut peak = 0;
    let status = loop {
        peak = peak.max(peak_memory(child.id()).unwrap_or(0));
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        std::thread::sleep(std::time::Duration::from_millis(2));
    };
    assert!(status.success());
    println!("peak memory of joining {ROWS} rows: {peak} KiB");
    assert!((1..1024 * 1024).contains(&peak), "{peak} KiB");
    let last = Rows::open(&bench.path("all.csv")).unwrap().map(Result::unwrap);
    let mut expected = 1;
    for row in last {
        assert_eq!(row.id.case, expected);
        expected += 1;
    }
    assert_eq!(expected, ROWS + 1);
}
