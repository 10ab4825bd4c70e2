//! `fastest`: compares the fastest still moves with other motions within the same limits.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::fastest::{cases, motions, page};
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct FastestArgs {
    /// A page with <!-- lab:fastest-a --> and <!-- lab:fastest-d --> to be filled
    #[arg(value_name = "still.md")]
    page: Option<PathBuf>,
}

impl FastestArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let page = Target::open(self.page, page::NAMES)?;
        let cases = cases::all()?;
        // One at a time: the planning times are measured.
        let judged = with_bar("limits", cases.len() as u64, |done| {
            let judge = |case: cases::Case| {
                let entries = motions::entries(&case)?;
                done(1);
                Ok((case, entries))
            };
            cases.into_iter().map(judge).collect::<Result<Vec<_>, Error>>()
        })?;
        let blocks = page::blocks(&judged);
        for block in &blocks {
            println!("{}", block.text);
        }
        if let Some(page) = page {
            page.fill(&blocks)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
