//! `reference`: lets the two reference solvers converge to each other.

use std::process::ExitCode;

use stillbeam_lab::reference::convergence;
use stillbeam_lab::reference::truth::NAMES;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct ReferenceArgs {
    /// Only these scenes of tests/truth [default: all of them]
    #[arg(value_name = "SCENE", value_parser = clap::builder::PossibleValuesParser::new(NAMES))]
    scenes: Vec<String>,
}

impl ReferenceArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let chosen =
            |name: &&&str| self.scenes.is_empty() || self.scenes.iter().any(|s| s == **name);
        for name in NAMES.iter().filter(chosen) {
            convergence::of(name, &|line| println!("{line}"))?;
            println!();
        }
        Ok(ExitCode::SUCCESS)
    }
}
