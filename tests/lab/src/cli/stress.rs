//! `stress`: runs random scenes by the million, arms that ring on, and runs as long as a machine's
//! life.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::markers::Block;
use stillbeam_lab::pages::Target;
use stillbeam_lab::stress::draw::{draw, method_name};
use stillbeam_lab::stress::trial::trial;
use stillbeam_lab::stress::{campaign, document, energy, rows, summary::Summary};
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, println};

use super::{counted, verdict};

/// Number of undamped arms of the page.
const ARMS: usize = 100;

/// Ticks of each long run of the page.
const TICKS: u64 = 100_000_000;

#[derive(clap::Args)]
pub struct StressArgs {
    /// A page to be filled with everything: the scenes, the arms that ring on, the long runs
    #[arg(value_name = "stability.md", conflicts_with_all = ["csv", "scene"])]
    page: Option<PathBuf>,
    /// Of the page, fill only what is about random scenes
    #[arg(long, requires = "page", conflicts_with_all = ["energy", "long"])]
    only_scenes: bool,
    /// Number of scenes
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    count: u64,
    /// Seed of the scenes
    #[arg(long, value_name = "S", default_value_t = 8)]
    seed: u64,
    /// Keep what is done in this file, and go on from it
    #[arg(long, value_name = "OUT.toml")]
    part: Option<PathBuf>,
    /// Write a row a run to this file
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// In place of random scenes: let so many undamped arms ring on for a million ticks each
    #[arg(long, value_name = "ARMS")]
    energy: Option<usize>,
    /// In place of random scenes: repeated moves, a vibration and a rotation for so many ticks each
    #[arg(long, value_name = "TICKS")]
    long: Option<u64>,
    /// Only this scene, and what comes of it; of arms that ring on, the first
    #[arg(long, value_name = "INDEX")]
    scene: Option<u64>,
}

impl StressArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        counted(self.count)?;
        if let Some(page) = Target::open(self.page.clone(), document::NAMES)? {
            return self.page(&page);
        }
        if let Some(arms) = self.energy {
            print!("{}", self.rings(arms));
            return Ok(ExitCode::SUCCESS);
        }
        if let Some(index) = self.scene {
            return Ok(self.one(index));
        }
        if let Some(ticks) = self.long {
            print!("{}", long(ticks)?);
            return Ok(ExitCode::SUCCESS);
        }
        if let Some(path) = &self.csv {
            return self.rows(path);
        }
        let summary = self.summary(self.part.as_deref())?;
        print(&summary);
        Ok(verdict(summary.faults() == 0))
    }

    /// Runs everything and fills the page.
    fn page(&self, page: &Target) -> Result<ExitCode, Error> {
        let summary = self.summary(self.part.as_deref())?;
        let mut texts = vec![
            document::scenes(&summary),
            document::reasons(&summary),
            document::precision(&summary),
        ];
        if !self.only_scenes {
            texts.extend(self.long_runs()?);
        }
        let named = document::NAMES.into_iter().zip(texts);
        let blocks: Vec<Block> = named.map(|(name, text)| Block::new(name, text)).collect();
        page.fill(&blocks)?;
        Ok(verdict(summary.faults() == 0))
    }

    /// The page's arms that ring on, and its runs of days.
    fn long_runs(&self) -> Result<[String; 2], Error> {
        let (arms, ticks) = (self.energy.unwrap_or(ARMS), self.long.unwrap_or(TICKS));
        let command = |what: String| format!("`cargo lab stress {what}`\n\n");
        Ok([
            command(format!("--energy {arms} --seed {}", self.seed)) + &self.rings(arms),
            command(format!("--long {ticks}")) + &long(ticks)?,
        ])
    }

    fn summary(&self, part: Option<&Path>) -> Result<Summary, Error> {
        quiet();
        with_bar("random scenes", self.count, |done| {
            campaign::run(self.seed, self.count, part, done)
        })
    }

    fn rings(&self, arms: usize) -> String {
        let first = self.scene.unwrap_or(0);
        let rings = with_bar("arms that ring on", arms as u64, |done| {
            energy::rings(self.seed, first, arms, energy::TICKS, &|| done(1))
        });
        document::energy(&rings)
    }

    fn rows(&self, path: &Path) -> Result<ExitCode, Error> {
        quiet();
        let judged = with_bar("random scenes", self.count, |done| {
            campaign::each(self.seed, 0..self.count, done)
        });
        output::write_whole(path, |file| rows::write(file, &judged))?;
        Ok(ExitCode::SUCCESS)
    }

    fn one(&self, index: u64) -> ExitCode {
        let drawn = draw(self.seed, index);
        println!("{:#?}", drawn.scene);
        println!("first frequency {:.4e} rad/s", drawn.omega);
        for solver in &drawn.solvers {
            println!("{}: {:?}", method_name(solver), trial(&drawn, solver));
        }
        ExitCode::SUCCESS
    }
}

/// Silences the message of a panic. A scene that panics is counted; its message would hide the
/// progress.
fn quiet() {
    std::panic::set_hook(Box::new(|_| ()));
}

fn long(ticks: u64) -> Result<String, Error> {
    with_bar("ticks", document::long_ticks(ticks), |done| document::long(ticks, &|made| done(made)))
}

fn print(summary: &Summary) {
    println!("{} scenes, seed {}, {} ticks", summary.scenes, summary.seed, summary.ticks);
    println!(
        "{:<24} {:>8} {:>8} {:>6} {:>10} {:>10}  f32 against f64: median, 99 %, most",
        "method", "ran", "refused", "panic", "not finite", "off target"
    );
    for (name, counts) in &summary.methods {
        println!(
            "{name:<24} {:>8} {:>8} {:>6} {:>10} {:>10}",
            counts.ran, counts.refused, counts.panicked, counts.not_finite, counts.off_target
        );
        for (decade, spread) in &counts.deflection {
            println!(
                "    condition 1e{decade}: {:>8} {:.1e} {:.1e} {:.1e}",
                spread.count(),
                spread.quantile(0.5),
                spread.quantile(0.99),
                spread.most
            );
        }
    }
    for (reason, count) in &summary.reasons {
        println!("{count:>10}  {reason}");
    }
    for failure in &summary.failures {
        println!("scene {}, {}: {}", failure.index, failure.method, failure.what);
    }
}
