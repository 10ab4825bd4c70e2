//! `shortest`: plans random time-optimal motions, and holds them against Ruckig's.

use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::shortest::{draw::draw, run, summary::Summary, trial::trial};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::{counted, verdict};

#[derive(clap::Args)]
pub struct ShortestArgs {
    /// Number of motions
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    count: u64,
    /// Seed of the motions
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Only this motion, and what comes of it
    #[arg(long, value_name = "INDEX")]
    case: Option<u64>,
}

impl ShortestArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        counted(self.count)?;
        if let Some(index) = self.case {
            let case = draw(self.seed, index);
            println!("{case:#?}");
            println!("{:#?}", trial(&case));
            return Ok(ExitCode::SUCCESS);
        }
        let summary =
            with_bar("random motions", self.count, |done| run(self.seed, 0..self.count, done));
        print(&summary);
        Ok(verdict(summary.faults == 0))
    }
}

fn print(summary: &Summary) {
    println!(
        "{:<26} {:>8} {:>9} {:>9} {:>10} {:>10} {:>10} {:>10}",
        "motions", "cases", "refused", "by peer", "longer", "shorter", "excess", "miss"
    );
    for (kind, counts) in &summary.counts {
        println!(
            "{:<26} {:>8} {:>9} {:>9} {:>10.1e} {:>10.1e} {:>10.1e} {:>10.1e}",
            kind.name(),
            counts.cases,
            counts.refused,
            counts.peer_refused,
            counts.longer,
            counts.shorter,
            counts.excess,
            counts.miss
        );
    }
    for (index, fault) in &summary.first {
        println!("motion {index}: {fault}");
    }
}
