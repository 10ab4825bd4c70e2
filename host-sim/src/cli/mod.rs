//! The command line: parses the words, calls the library and prints lines. One command a file.

mod arm;
mod compare;
mod completions;
mod drive;
mod export;
mod identify;
mod mechanism;
mod motion;
mod new;
mod plan;
mod playground;
mod reference;
mod rows;
mod run;
mod study;
#[cfg(feature = "talk")]
mod talk;
mod tick;

use std::io::{IsTerminal, stdout};
use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use serde::Serialize;
use stillbeam_sim::console::note;
use stillbeam_sim::error::Error;
use stillbeam_sim::limits::load::Progress;
use stillbeam_sim::{println, progress, scenes, sketch};

/// Runs a task that checks a scene's load limits and shows what it is at. The search for a duration
/// that keeps them has no end that could be told beforehand.
fn with_limits_shown<T>(task: impl FnOnce(&dyn Fn(Progress)) -> T) -> T {
    let check = progress::late("limits, by the rod");
    let search = progress::late("a duration within the limits");
    task(&|at| match at {
        Progress::Checked(done) => check.set(done),
        Progress::Tried(duration) => {
            check.clear();
            search.turn(|| format!("trying {duration:.3} s"));
        }
    })
}

/// Draws quantities over time below a command's lines, if standard output is a terminal. Each is
/// its title with unit, and its values at even times from 0 to `end` s.
fn draw(quantities: impl IntoIterator<Item = (impl AsRef<str>, Vec<f64>)>, end: f64) {
    if !stdout().is_terminal() {
        return;
    }
    for (title, values) in quantities {
        if let Some(lines) = sketch::over_time(title.as_ref(), values.into_iter(), end) {
            println!("\n{lines}");
        }
    }
}

/// Returns the largest magnitude of a quantity of rows.
fn peak<R>(rows: &[R], of: impl Fn(&R) -> f64) -> f64 {
    rows.iter().map(of).map(f64::abs).fold(0.0, f64::max)
}

/// Prints figures as one JSON object.
fn print_json(figures: &impl Serialize) -> Result<(), Error> {
    println!("{}", serde_json::to_string_pretty(figures).map_err(Error::new)?);
    Ok(())
}

/// Says where `count` rows went, `what` they are.
fn print_written(count: usize, what: &str, csv: Option<&Path>) {
    match csv {
        Some(csv) => println!("  {count} {what} to {}", csv.display()),
        None => println!("  {count} {what}; --csv OUT.csv writes them"),
    }
}

/// Refuses `--open` where no page is written. `option` writes one.
fn refuse_to_open(open: bool, page: Option<&Path>, option: &str) -> Result<(), Error> {
    if open && page.is_none() {
        return Err(Error::new(format_args!(
            "--open: no page is written; must be beside {option}, which writes one"
        )));
    }
    Ok(())
}

/// Shows a page in the browser. The page is written by then, so that a failure is a note.
fn show(page: &Path) {
    if let Err(cause) = open::that(page) {
        note(&format!("--open: {cause}; open {} yourself", page.display()));
    }
}

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
    /// Write a scene to start from; asks for what no flag gives
    New(new::NewArgs),
    /// Say what a scene's arm is: masses, frequencies, damping, sag, and the method for it
    Arm(arm::ArmArgs),
    /// Run the core on a scene and write its setpoints
    Run(run::RunArgs),
    /// Find frequencies and damping in a measured log, and write a scene with them
    Identify(Box<identify::IdentifyArgs>),
    /// Plan a move that arrives still, judge it and draw it
    Plan(plan::PlanArgs),
    /// Write the page in which an arm moves, with sliders for all that it is
    Playground(playground::PlaygroundArgs),
    /// Let a drive and its machine follow a scene, with less and with more feed-forward
    Drive(drive::DriveArgs),
    /// Write a scene's stepper as constants, for a program without set-up
    Export(export::ExportArgs),
    /// Compare two runs of a scene
    Compare(compare::CompareArgs),
    /// Solve a scene with a reference solver
    Reference(reference::ReferenceArgs),
    /// Talk to the firmware in QEMU or on a board, and compare all it sends with the host's own run
    #[cfg(feature = "talk")]
    Talk(talk::TalkArgs),
    /// List the embedded scenes
    Scenes,
    /// Print the words that a shell completes
    Completions(completions::CompletionsArgs),
    /// Write pages for `man`
    Man(completions::ManArgs),
}

impl Cli {
    /// Carries out the command.
    pub fn execute(self) -> Result<ExitCode, Error> {
        match self.command {
            None => study::StudyArgs::default().execute(),
            Some(Command::Study(args)) => args.execute(),
            Some(Command::New(args)) => args.execute(),
            Some(Command::Arm(args)) => args.execute(),
            Some(Command::Run(args)) => args.execute(),
            Some(Command::Identify(args)) => args.execute(),
            Some(Command::Plan(args)) => args.execute(),
            Some(Command::Playground(args)) => args.execute(),
            Some(Command::Completions(args)) => args.execute(),
            Some(Command::Man(args)) => args.execute(),
            Some(Command::Drive(args)) => args.execute(),
            Some(Command::Export(args)) => args.execute(),
            Some(Command::Compare(args)) => args.execute(),
            Some(Command::Reference(args)) => args.execute(),
            #[cfg(feature = "talk")]
            Some(Command::Talk(args)) => args.execute(),
            Some(Command::Scenes) => {
                for (name, about) in scenes::list().chain(stillbeam_sim::mechanism::scenes::list())
                {
                    println!("{name:<20} {about}");
                }
                Ok(ExitCode::SUCCESS)
            }
        }
    }
}
