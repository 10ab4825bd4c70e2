//! The lab's command line: parses the words, calls the library and prints lines. One command a
//! file.

mod auto;
mod docs;
mod fastest;
mod faults;
mod gentle;
mod identify;
mod interrupted;
mod mechanisms;
mod pareto;
mod plant;
mod reference;
mod shortest;
mod stability;
mod still;
mod stress;
mod sweep;
mod tables;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use stillbeam_lab::campaign;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

/// The pages of stillbeam's docs and the campaigns behind them.
#[derive(Parser)]
#[command(name = "cargo lab", version)]
pub struct Cli {
    /// Threads to run on [default: one a core]
    #[arg(long, value_name = "N", global = true)]
    threads: Option<usize>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Write every page with tables that take seconds, or check them
    #[command(after_help = docs::OTHERS)]
    Docs(docs::DocsArgs),
    /// Judge the choices of `auto` on random arms; write docs/auto.md
    Auto(auto::AutoArgs),
    /// Judge random still moves and interruptions; fill their part of docs/still.md
    Still(still::StillArgs),
    /// Run random scenes, far outside of what an arm is, by the million, and long runs
    Stress(stress::StressArgs),
    /// Map where the methods are stable and accurate
    Stability(stability::StabilityArgs),
    /// Inject faults around an axis, and count what comes out
    Faults(faults::FaultsArgs),
    /// Run random axes with their drives and machines under faults, in the loop
    Plant(plant::PlantArgs),
    /// Run many solvers on many scenes: error and time of each
    Sweep(sweep::SweepArgs),
    /// Draw a sweep's error against its time and answer what a choice costs
    Pareto(pareto::ParetoArgs),
    /// Plan random time-optimal motions, and hold their durations against Ruckig's
    Shortest(shortest::ShortestArgs),
    /// Compare the fastest still moves with other motions within the same limits; fill their part
    /// of docs/still.md
    Fastest(fastest::FastestArgs),
    /// Plan for arms known to a range, with a residual that may be left, and in a given duration;
    /// fill their part of docs/still.md
    Gentle(gentle::GentleArgs),
    /// Break off random fastest moves; fill their part of docs/still.md
    Interrupted(interrupted::InterruptedArgs),
    /// Identify random arms from synthetic logs, and hold what is found against the truth
    Identify(identify::IdentifyArgs),
    /// Compare the references and the core with the solutions of mechanisms
    Mechanisms(mechanisms::MechanismsArgs),
    /// Let the two reference solvers converge to each other
    Reference(reference::ReferenceArgs),
    /// Print the tables of docs/accuracy.md
    Tables(tables::TablesArgs),
}

impl Cli {
    /// Carries out the command.
    pub fn execute(self) -> Result<ExitCode, Error> {
        campaign::on_threads(self.threads)?;
        match self.command {
            Command::Docs(args) => args.execute(),
            Command::Auto(args) => args.execute(),
            Command::Still(args) => args.execute(),
            Command::Stress(args) => args.execute(),
            Command::Stability(args) => args.execute(),
            Command::Faults(args) => args.execute(),
            Command::Plant(args) => args.execute(),
            Command::Sweep(args) => args.execute(),
            Command::Pareto(args) => args.execute(),
            Command::Shortest(args) => args.execute(),
            Command::Fastest(args) => args.execute(),
            Command::Gentle(args) => args.execute(),
            Command::Interrupted(args) => args.execute(),
            Command::Identify(args) => args.execute(),
            Command::Mechanisms(args) => args.execute(),
            Command::Reference(args) => args.execute(),
            Command::Tables(args) => args.execute(),
        }
    }
}

/// Refuses a campaign without cases, or with too many to end.
fn counted(count: u64) -> Result<u64, Error> {
    if (1..=100_000_000).contains(&count) {
        return Ok(count);
    }
    Err(Error::new(format_args!("--count = {count}: must be 1 to 100000000")))
}

/// Prints the first of what a campaign found broken. Returns success if it found nothing.
fn unbroken<'a>(broken: impl Iterator<Item = &'a String>) -> ExitCode {
    let mut broken = broken.peekable();
    let holds = broken.peek().is_none();
    for line in broken.take(20) {
        println!("broken: {line}");
    }
    verdict(holds)
}

/// Returns success if a campaign found nothing, else exit code 1.
fn verdict(holds: bool) -> ExitCode {
    if holds { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
