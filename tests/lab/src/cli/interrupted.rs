//! `interrupted`: breaks off random fastest moves by the thousand.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::fastest::interrupted;
use stillbeam_lab::markers::Block;
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::counted;

/// Interruptions of one arm.
const EACH: u64 = 100;

/// Name of the block.
const NAME: &str = "fastest-interruptions";

#[derive(clap::Args)]
pub struct InterruptedArgs {
    /// A page with <!-- lab:fastest-interruptions --> to be filled
    #[arg(value_name = "still.md")]
    page: Option<PathBuf>,
    /// Random interruptions, a hundred an arm
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    count: u64,
    /// Seed of the moves
    #[arg(long, value_name = "S", default_value_t = 20_260_101)]
    seed: u64,
}

impl InterruptedArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let arms = counted(self.count)?.div_ceil(EACH);
        let page = Target::open(self.page, [NAME])?;
        let all = with_bar("interrupted arms", arms, |done| {
            interrupted::interruptions(self.seed, arms as usize, EACH as usize, &|| done(1))
        })?;
        let block = Block::new(NAME, interrupted::page(self.seed, &all));
        println!("{}", block.text);
        if let Some(page) = page {
            page.fill(&[block])?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
