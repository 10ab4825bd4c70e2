//! `fastest`: compares the fastest still moves with other motions within the same limits.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::fastest::{cases, motions, page};
use stillbeam_lab::pages;
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
        let page = self.page.map(|path| Ok::<_, Error>((pages::read(&path)?, path))).transpose()?;
        if let Some((text, path)) = &page {
            pages::has_places(path, text, page::NAMES.into_iter())?;
        }
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
        if let Some((text, path)) = &page {
            pages::write(path, text, &blocks)?;
            println!("{}: filled", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}
