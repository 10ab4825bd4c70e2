//! `auto`: judges the choices of `auto`, every rung of the ladder, by the reference rod.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::choice::{self, SEED, Summary, Verdict};
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

use super::{counted, verdict};

#[derive(clap::Args)]
pub struct AutoArgs {
    /// The page to be written, whole; a picture is drawn beside it
    #[arg(value_name = "auto.md")]
    page: Option<PathBuf>,
    /// Random arms
    #[arg(long, value_name = "N", default_value_t = 200)]
    count: u64,
    /// Seed of the arms
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
}

impl AutoArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let Self { page, seed, .. } = self;
        let count = counted(self.count)?;
        let verdicts = with_bar("arms", count, |done| choice::campaign(seed, count, &|| done(1)))?;
        for (index, verdict) in verdicts.iter().enumerate().filter(|(_, verdict)| is_bad(verdict)) {
            println!("arm {index}: {verdict:?}");
        }
        let summary = Summary::of(&verdicts);
        println!("{summary:#?}");
        if let Some(page) = page {
            let (text, picture) = (choice::page(seed, &verdicts), choice::picture(&verdicts)?);
            let mut files = Files::default();
            files.add(&page, |file| file.write_all(text.as_bytes()))?;
            files.add(&page.with_extension("svg"), |file| file.write_all(picture.as_bytes()))?;
            files.finish()?;
            println!("{}: written", page.display());
        }
        Ok(verdict(summary.holds()))
    }
}

/// True for a choice that errs by more than was asked for or is two rungs too dear.
fn is_bad(verdict: &Verdict) -> bool {
    verdict.exceeds() || verdict.rungs_too_dear().is_some_and(|rungs| rungs > 1)
}
