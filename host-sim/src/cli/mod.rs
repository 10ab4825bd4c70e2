//! The command line: words in, a library call, lines out. One command a file.

mod compare;
#[cfg(feature = "faults")]
mod faults;
mod merge;
mod pareto;
mod plan;
mod reference;
mod run;
mod stability;
mod still;
mod stress;
mod study;
mod sweep;
mod tables;
#[cfg(feature = "talk")]
mod talk;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;

/// Feed-forward setpoints for flexible robot links, tried on the desktop.
///
/// Without a command: the paper's study, with tables and a report.
#[derive(Parser)]
#[command(name = "stillbeam-sim", version)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Run the paper's study: tables and a report (also without a command)
    Study(study::StudyArgs),
    /// Run the core on a scene and write its setpoints
    Run(run::RunArgs),
    /// Plan a move that arrives still, judge it and draw it
    Plan(plan::PlanArgs),
    /// How far two runs of a scene are apart
    Compare(compare::CompareArgs),
    /// Solve a scene with a reference solver
    Reference(reference::ReferenceArgs),
    /// Run many solvers on many scenes: error and time of each
    Sweep(sweep::SweepArgs),
    /// Join the shards of a sweep
    Merge(merge::MergeArgs),
    /// Draw a sweep's error against its time and answer what a choice costs
    Pareto(pareto::ParetoArgs),
    /// Fill the tables in README.md, or check them
    Tables(tables::TablesArgs),
    /// Talk to the firmware in QEMU or on a board, and compare all it sends with the host's own run
    #[cfg(feature = "talk")]
    Talk(talk::TalkArgs),
    /// Fill the tables of docs/still.md and draw its picture, or check the tables
    Still(still::StillArgs),
    /// Map where the methods are stable and accurate; fill docs/stability.md, or check it
    Stability(stability::StabilityArgs),
    /// Run random scenes, far outside of what an arm is, by the million
    Stress(stress::StressArgs),
    /// Inject faults around an axis, and count what comes out
    #[cfg(feature = "faults")]
    Faults(faults::FaultsArgs),
    /// List the embedded scenes
    Scenes,
}

impl Cli {
    /// Carries out the command.
    pub fn execute(self) -> Result<ExitCode, Error> {
        match self.command {
            None => study::StudyArgs::default().execute(),
            Some(Command::Study(args)) => args.execute(),
            Some(Command::Run(args)) => args.execute(),
            Some(Command::Plan(args)) => args.execute(),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Reference(args)) => args.execute(),
            Some(Command::Sweep(args)) => args.execute(),
            Some(Command::Merge(args)) => args.execute(),
            Some(Command::Pareto(args)) => args.execute(),
            Some(Command::Tables(args)) => args.execute(),
            #[cfg(feature = "talk")]
            Some(Command::Talk(args)) => args.execute(),
            Some(Command::Still(args)) => args.execute(),
            Some(Command::Stability(args)) => args.execute(),
            Some(Command::Stress(args)) => args.execute(),
            #[cfg(feature = "faults")]
            Some(Command::Faults(args)) => args.execute(),
            Some(Command::Scenes) => {
                for (name, about) in scenes::list() {
                    println!("{name:<20} {about}");
                }
                Ok(ExitCode::SUCCESS)
            }
        }
    }
}

/// Opens a scene and says on standard error what in it is probably in another unit.
fn open(name_or_path: &str) -> Result<SceneFile, Error> {
    let scene = scenes::open(name_or_path)?;
    for line in &scene.remarks {
        note(line);
    }
    Ok(scene)
}

/// A line on standard error that is no error. Where it cannot be written, nobody reads it.
fn note(words: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr(), "note: {words}");
}
