//! `mechanisms`: compares the references and the core with the mechanisms' solutions, and tries
//! random mechanisms.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::mechanisms::random::Outcome;
use stillbeam_lab::mechanisms::{NAMES, SOLVERS, page, random, summary};
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::{counted, verdict};

#[derive(clap::Args)]
pub struct MechanismsArgs {
    /// A page with <!-- lab:mechanisms-truth --> and <!-- lab:mechanisms-random --> to be filled
    #[arg(value_name = "mechanisms.md")]
    page: Option<PathBuf>,
    /// Random mechanisms to try
    #[arg(long, value_name = "N", default_value_t = 2_000)]
    count: u64,
    /// Seed of the first of them
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Judge every K-th of them; all are run and looked through for what is not finite
    #[arg(long, value_name = "K", default_value_t = 1)]
    judge: u64,
}

impl MechanismsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let Self { seed, judge, .. } = self;
        let count = counted(self.count)?;
        if judge == 0 {
            return Err(Error::new("--judge = 0: must be 1 at least"));
        }
        let target = Target::open(self.page, [page::NAME, summary::NAME])?;
        let steps = (NAMES.len() * SOLVERS.len()) as u64;
        let truth = with_bar("solutions", steps, |done| page::block(&|| done(1)))?;
        let trials =
            with_bar("mechanisms", count, |done| random::trials(seed, count, judge, &|| done(1)));
        let blocks = [truth, summary::block(&trials, seed, judge)];
        for block in &blocks {
            println!("{}", block.text);
        }
        if let Some(target) = target {
            target.fill(&blocks)?;
        }
        Ok(verdict(trials.iter().all(|trial| trial.outcome != Outcome::NotFinite)))
    }
}
