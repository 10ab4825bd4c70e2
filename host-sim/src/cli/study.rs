//! `study`, the default command: computes the paper's figures.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::study::Study;
use stillbeam_sim::{println, progress};

#[derive(clap::Args)]
pub struct StudyArgs {
    /// Folder for the report and the CSVs
    #[arg(long, value_name = "DIR", default_value = FOLDER)]
    out: PathBuf,
    /// Show the report in the browser
    #[arg(long)]
    open: bool,
}

const FOLDER: &str = "stillbeam-study";

impl Default for StudyArgs {
    fn default() -> Self {
        Self { out: FOLDER.into(), open: false }
    }
}

impl StudyArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        Study::check_folder(&self.out)?;
        let bar = progress::bar("reference rod", Study::STEPS);
        let study = Study::compute(&|| bar.inc(1));
        bar.finish_and_clear();
        let study = study?;
        let files = study.write(&self.out)?;
        print(&study);
        if let Some((report, tables)) = files.split_first() {
            println!("\nreport: {}", report.display());
            println!("data:   {} CSV files beside it", tables.len());
            if self.open {
                super::show(report);
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn print(study: &Study) {
    println!("The paper's study (Kato and Isobe), stillbeam-sim {}\n", env!("CARGO_PKG_VERSION"));
    println!(
        "First period of member D, ms         (continuous beam {:.2})",
        1e3 * study.elements.theory
    );
    println!("  elements    lumped  consistent");
    for mesh in &study.elements.meshes {
        println!(
            "  {:>8}  {:>8.2}  {:>10.2}",
            mesh.elements,
            1e3 * mesh.lumped.period,
            1e3 * mesh.consistent.period
        );
    }
    println!(
        "\nStep size, member A with 30 g        (against {} ms)",
        1e3 * study.steps.finest.solver.tick
    );
    println!("  step, ms   tip error, % of L");
    for step in &study.steps.steps {
        println!("  {:>8}  {:>18.4}", 1e3 * step.run.solver.tick, 1e2 * step.tip_max);
    }
    println!("\nMembers with 30 g, pi rad in 2 s     (deflections in % of L)");
    println!("                         undamped         damped (illustrative)");
    println!("  member  period, s     peak  residual     peak  residual");
    for member in &study.members.members {
        let (quiet, damped) = (&member.undamped, &member.damped);
        println!(
            "  {:>6}  {:>9.4}  {:>7.2}  {:>8.2}  {:>7.2}  {:>8.2}",
            member.name,
            member.period,
            1e2 * quiet.peak,
            1e2 * quiet.residual,
            1e2 * damped.peak,
            1e2 * damped.residual
        );
    }
    println!();
    for line in study.findings() {
        println!("{}", wrapped(&line));
    }
}

/// Returns a paragraph as a list item, wrapped to the width of a terminal.
fn wrapped(text: &str) -> String {
    let (mut lines, mut line) = (Vec::new(), String::from("-"));
    for word in text.split(' ') {
        if line.chars().count() + word.chars().count() >= 88 {
            lines.push(std::mem::replace(&mut line, String::from(" ")));
        }
        line.push(' ');
        line.push_str(word);
    }
    lines.push(line);
    lines.join("\n")
}
