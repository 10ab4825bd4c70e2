//! `gentle`: what moves with a piecewise-linear acceleration do for arms known to a range, with a
//! residual that may be left, and in a given duration.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::fastest::gentle;
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct GentleArgs {
    /// A page with <!-- lab:fastest-robust -->, <!-- lab:fastest-within --> and <!-- lab:gentlest
    /// --> to be filled
    #[arg(value_name = "still.md")]
    page: Option<PathBuf>,
}

impl GentleArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let page = Target::open(self.page, gentle::NAMES)?;
        let blocks = gentle::blocks()?;
        for block in &blocks {
            println!("{}", block.text);
        }
        if let Some(page) = page {
            page.fill(&blocks)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
