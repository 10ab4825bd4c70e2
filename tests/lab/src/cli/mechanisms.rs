//! `mechanisms`: compares the references and the core with the mechanisms' solutions.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::mechanisms::{NAMES, SOLVERS, page};
use stillbeam_lab::pages;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

#[derive(clap::Args)]
pub struct MechanismsArgs {
    /// A page with <!-- lab:mechanisms-truth --> to be filled
    #[arg(value_name = "mechanisms.md")]
    page: Option<PathBuf>,
}

impl MechanismsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let page = self.page.map(|path| Ok::<_, Error>((pages::read(&path)?, path))).transpose()?;
        if let Some((text, path)) = &page {
            pages::has_places(path, text, std::iter::once(page::NAME))?;
        }
        let count = (NAMES.len() * SOLVERS.len()) as u64;
        let block = with_bar("solutions", count, |done| page::block(&|| done(1)))?;
        println!("{}", block.text);
        if let Some((text, path)) = &page {
            pages::write(path, text, &[block])?;
            println!("{}: filled", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}
