//! `mechanisms`: compares the references and the core with the mechanisms' solutions, and tries
//! random mechanisms.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::mechanisms::{NAMES, SOLVERS, page, random, summary};
use stillbeam_lab::pages;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct MechanismsArgs {
    /// A page with <!-- lab:mechanisms-truth --> and <!-- lab:mechanisms-random --> to be filled
    #[arg(value_name = "mechanisms.md")]
    page: Option<PathBuf>,
    /// Random mechanisms to try
    #[arg(long, value_name = "N", default_value_t = 2_000)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    count: u64,
    /// Seed of the first of them
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
}

impl MechanismsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let page = self.page.map(|path| Ok::<_, Error>((pages::read(&path)?, path))).transpose()?;
        if let Some((text, path)) = &page {
            pages::has_places(path, text, [page::NAME, summary::NAME].into_iter())?;
        }
        let count = (NAMES.len() * SOLVERS.len()) as u64;
        let block = with_bar("solutions", count, |done| page::block(&|| done(1)))?;
        let trials = with_bar("mechanisms", self.count, |done| {
            random::trials(self.seed, self.count, &|| done(1))
        });
        let blocks = [block, summary::block(&trials)];
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
