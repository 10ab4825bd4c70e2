//! `still`: judges random still moves and random interruptions by the thousand.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::pages::Target;
use stillbeam_lab::still::{campaign, campaign_page};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::counted;
use campaign_page::{EACH, ROD_EACH};

#[derive(clap::Args)]
pub struct StillArgs {
    /// A page with <!-- lab:campaign-rests --> and <!-- lab:campaign-interruptions --> to be filled
    #[arg(value_name = "still.md")]
    page: Option<PathBuf>,
    /// Random interruptions, a hundred an arm; a tenth as many moves from rest to rest
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    count: u64,
    /// Seed of the moves
    #[arg(long, value_name = "S", default_value_t = 20_260_101)]
    seed: u64,
}

impl StillArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let seed = self.seed;
        let count = counted(self.count)?;
        let page = Target::open(self.page, campaign_page::NAMES)?;
        let moves = count.div_ceil(10);
        let rests = with_bar("rest to rest", moves, |done| {
            campaign::rests(seed, moves as usize, ROD_EACH, &|| done(1))
        })?;
        let arms = count.div_ceil(EACH as u64);
        let interruptions = with_bar("interrupted arms", arms, |done| {
            campaign::interruptions(seed, arms as usize, EACH, &|| done(1))
        })?;
        let blocks = campaign_page::blocks(seed, &rests, &interruptions);
        for block in &blocks {
            println!("{}", block.text);
        }
        if let Some(page) = page {
            page.fill(&blocks)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
