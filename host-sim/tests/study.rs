//! The main job: what the study computes, and what it leaves behind.

use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

use stillbeam_sim::plan::comparison::{Entry, ROBUST};
use stillbeam_sim::report;
use stillbeam_sim::study::{REPORT, Study};

static STUDY: LazyLock<Study> = LazyLock::new(|| Study::compute(&|| ()).unwrap());
static PAGE: LazyLock<String> = LazyLock::new(|| report::render(&STUDY).unwrap());

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected} ± {tolerance}");
}

#[test]
fn periods_over_elements() {
    let meshes = &STUDY.elements.meshes;
    let expected = [(1, 99.29, 143.20), (2, 99.71, 111.13), (4, 99.76, 102.62), (8, 99.76, 100.48)];
    assert_eq!(meshes.len(), expected.len());
    for (mesh, (elements, consistent, lumped)) in meshes.iter().zip(expected) {
        assert_eq!(mesh.elements, elements);
        close(1e3 * mesh.consistent.period, consistent, 0.01);
        close(1e3 * mesh.lumped.period, lumped, 0.02);
        // The curves keep the time that the matrices promise; Newmark at 0.4 ms adds 5e-5.
        close(mesh.consistent.read / mesh.consistent.period, 1.0, 0.01);
        close(mesh.lumped.read / mesh.lumped.period, 1.0, 0.01);
    }
    close(1e3 * STUDY.elements.theory, 99.76, 0.01);
}

#[test]
fn the_printed_mass_contradicts_the_printed_period() {
    let found = &STUDY.link_mass;
    close(1e3 * found.used.period, 99.76, 0.01);
    close(1e3 * found.printed.period, 309.1, 0.05);
    close(1e3 * found.table.period, 70.6, 0.06);
}

#[test]
fn members_with_30_g() {
    let members = &STUDY.members.members;
    let expected = [('A', 1128.3), ('B', 825.4), ('C', 691.5), ('D', 254.2)];
    assert_eq!(members.len(), expected.len());
    for (member, (name, period)) in members.iter().zip(expected) {
        assert_eq!(member.name, name);
        close(1e3 * member.period, period, 0.2);
        assert_eq!(member.undamped.run.rows.len(), 401);
        assert_eq!(member.damped.run.scene.arm.damping.alpha, 0.15);
        assert_eq!(member.damped.run.scene.arm.damping.beta, 0.002);
    }
}

#[test]
fn member_b_arrives_almost_still_until_it_is_damped() {
    let quiet = STUDY.members.quiet().unwrap();
    assert!(quiet.undamped.ratio() < 0.1, "{}", quiet.undamped.ratio());
    assert!(quiet.damped.residual > quiet.undamped.residual);
    assert!(quiet.damped.ratio() > quiet.undamped.ratio());
    for other in STUDY.members.members.iter().filter(|member| member.name != 'B') {
        assert!(other.undamped.ratio() > 0.5, "{}: {}", other.name, other.undamped.ratio());
    }
}

#[test]
fn only_the_cubic_explains_member_b() {
    let profiles = &STUDY.profiles;
    close(profiles.paper, 2.423, 0.001);
    for (zero, expected) in profiles.cubic_zeros.into_iter().zip([1.430, 2.459, 3.471]) {
        close(zero, expected, 6e-4);
    }
    assert!(profiles.margin() > 5.0, "{}", profiles.margin());
}

#[test]
fn a_shorter_step_is_a_smaller_error_of_second_order() {
    let steps = &STUDY.steps.steps;
    for pair in steps.windows(2) {
        assert!(pair[0].run.solver.tick < pair[1].run.solver.tick);
        assert!(pair[0].tip_max < pair[1].tip_max && pair[0].tip_rms < pair[1].tip_rms);
    }
    let at = |tick: f64| steps.iter().find(|step| step.run.solver.tick == tick).unwrap().tip_max;
    close((at(0.01) / at(0.005)).log2(), 2.0, 0.1);
    assert!(at(0.01) < 0.002, "{}", at(0.01));
}

#[test]
fn rigid_tip_stays_on_the_circle_and_the_flexible_one_swings() {
    let path = &STUDY.tip_path;
    for row in &path.rigid.rows {
        close(row.tip_x_m.hypot(row.tip_y_m), 0.4, 1e-12);
    }
    assert_eq!(path.rigid.residual().unwrap(), 0.0);
    close(path.flexible.peak(), 0.263, 0.02);
    assert_eq!(path.flexible.rows.len(), 1001);
}

#[test]
fn setpoints_are_what_run_writes() {
    let setpoints = &STUDY.setpoints.flexible;
    assert_eq!(setpoints.solver, stillbeam_sim::solver::Solver::PAPER);
    let again = stillbeam_sim::run::run(&setpoints.scene, &setpoints.solver).unwrap();
    assert_eq!(setpoints.rows, again);
}

/// Torques of all joints at once are those of virtual work, and those of rigid links are not.
#[test]
fn an_arm_becomes_a_loop() {
    let found = &STUDY.mechanisms;
    assert!(found.open.apart() < 0.025, "{}", found.open.apart());
    assert!(found.looped.apart() > 0.05, "{}", found.looped.apart());
    let closing = &found.closing;
    assert!(closing.apart() < 0.02, "{}", closing.apart());
    for rows in [&closing.flexible, &closing.other] {
        assert_eq!(rows.len(), 301);
        // The row of closing is the last with the drives of joints 2 and 3.
        let pin = rows[180].tip();
        for row in &rows[181..] {
            let apart = (row.tip()[0] - pin[0]).hypot(row.tip()[1] - pin[1]);
            assert!(apart < 1e-5, "{}: {apart}", row.t);
            assert_eq!(row.torques[1..], [0.0; 2], "{}", row.t);
        }
        assert!((rows[300].joints[0] - 2.0).abs() < 1e-6);
    }
}

#[test]
fn the_page_holds_every_figure_and_the_finding() {
    let titles = [
        "Fig. 1: path of the tip",
        "Fig. 2(a)",
        "Fig. 2(b)",
        "Fig. 5: tip X",
        "Fig. 6(a)",
        "Fig. 6(b)",
        "Fig. 6(c)",
        "Fig. 6(d)",
        "Hub angle",
        "Hub rate",
        "Hub acceleration",
        "Hub torque",
        "Deflection",
    ];
    for title in titles {
        assert!(PAGE.contains(&format!("aria-label=\"{title}")), "{title}");
    }
    for id in ["link-mass", "fig1", "fig2", "fig5", "fig6", "profiles", "setpoints", "mechanisms"] {
        assert!(PAGE.contains(&format!("id=\"{id}\"")), "{id}");
        assert!(PAGE.contains(&format!("href=\"#{id}\"")), "{id}");
    }
    for words in ["0.215 kg", "309.1 ms", "0.0224 kg", "99.76 ms", "illustration"] {
        assert!(PAGE.contains(words), "{words}");
    }
}

#[test]
fn the_page_needs_nothing_but_itself() {
    for forbidden in ["src=", "<link", "<script ", "@import", "url(", "href=\"http", "href=\"//"] {
        assert!(!PAGE.contains(forbidden), "{forbidden}");
    }
    // The one address is the name of the SVG language.
    let addresses = PAGE.matches("http").count();
    assert_eq!(addresses, PAGE.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
}

#[test]
fn every_picture_is_well_formed() {
    let (mut charts, mut moving) = (0, 0);
    for piece in PAGE.split("<svg").skip(1) {
        let (body, _) = piece.split_once("</svg>").expect("the picture ends");
        let picture = format!("<svg{body}</svg>");
        let document = roxmltree::Document::parse(&picture).unwrap();
        let root = document.root_element();
        assert!(root.has_attribute("viewBox"));
        let count = |name: &str| {
            let named = |node: &roxmltree::Node<'_, '_>| node.tag_name().name() == name;
            document.descendants().filter(named).count()
        };
        if count("animate") > 0 {
            assert!(count("text") > 1, "{:?}", root.attribute("aria-label"));
            moving += 1;
        } else {
            assert!(!root.has_attribute("width"));
            assert!(
                count("text") > 6 && count("polyline") > 2,
                "{:?}",
                root.attribute("aria-label")
            );
            charts += 1;
        }
    }
    assert_eq!((charts, moving), (1 + 4 + 3 + 8 + 1 + 6 + 2 + 2 + 1 + 3 + 2, 4));
}

fn program(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillbeam-sim"));
    command.current_dir(folder).args(args).output().unwrap()
}

/// The table of the report: every motion by name, and the still ones below the others.
#[test]
fn still_moves_leave_less_than_the_usual_ones() {
    let found = &STUDY.stillness;
    let residual = |name: &str| {
        let entry = found.entry(name).unwrap_or_else(|| panic!("{name} is missing"));
        entry.nominal().residual
    };
    for base in ["cubic", "quintic", "cycloid", "s-curve"] {
        for name in ["", ", ZV", ", ZVD", ", EI", ", MZV"].map(|shaper| format!("{base}{shaper}")) {
            assert!(residual(&name) > 100.0 * residual("still"), "{name}");
        }
    }
    close(residual("quintic, EI"), 0.0768, 5e-4);
    let robust = found.entry(ROBUST).unwrap();
    let most = |entry: &Entry| entry.residuals().fold(0.0, f64::max);
    assert!(found.entries.iter().all(|entry| most(entry) >= most(robust)));
    // The curves go through the table.
    for curve in &found.curves {
        let (_, left) = curve.points[curve.points.len() / 2];
        close(left, residual(&curve.motion), 1e-9);
    }
}

/// Names and contents, by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let read = |entry: std::io::Result<std::fs::DirEntry>| {
        let entry = entry.unwrap();
        (entry.file_name().into_string().unwrap(), std::fs::read(entry.path()).unwrap())
    };
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(read).collect();
    files.sort();
    files
}

#[test]
fn without_a_command_the_study_runs_and_a_second_run_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let bare = program(folder.path(), &[]);
    assert!(bare.status.success(), "{}", String::from_utf8_lossy(&bare.stderr));
    let text = String::from_utf8(bare.stdout).unwrap();
    for words in ["99.29", "143.20", "0.8254", REPORT] {
        assert!(text.contains(words), "{words} is not in\n{text}");
    }
    let other = folder.path().join("deep/er");
    STUDY.write(&other).expect("a folder that can be made");
    let first = files(&folder.path().join("stillbeam-study"));
    let second = files(&other);
    let names: Vec<&str> = first.iter().map(|file| file.0.as_str()).collect();
    let expected = [
        "fig1-tip-path.csv",
        "fig2-elements.csv",
        "fig2-periods.csv",
        "fig5-errors.csv",
        "fig5-steps.csv",
        "fig6-members.csv",
        "fig6-summary.csv",
        "mechanisms-closing.csv",
        "mechanisms-loop.csv",
        "mechanisms-open.csv",
        "profiles.csv",
        REPORT,
        "setpoints.csv",
        "stillness-swing.csv",
        "stillness.csv",
    ];
    assert_eq!(names, expected);
    assert!(first == second, "the second run differs");
    let report = first.iter().find(|file| file.0 == REPORT).expect("a report");
    assert!(report.1 == PAGE.as_bytes(), "the report is not the page");
    for name in names.iter().filter(|name| name.ends_with(".csv")) {
        assert!(PAGE.contains(&format!("href=\"{name}\"")), "{name} is not linked");
    }
}

#[test]
fn a_folder_that_cannot_be_is_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), "kept").unwrap();
    for out in ["file", "file/below"] {
        let refused = program(folder.path(), &["study", "--out", out]);
        assert_eq!(refused.status.code(), Some(2), "{out}");
        let text = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(text.contains("--out") && text.contains("must be"), "{text}");
    }
    let left = files(folder.path());
    assert_eq!(left, [("file".to_owned(), b"kept".to_vec())]);
}
