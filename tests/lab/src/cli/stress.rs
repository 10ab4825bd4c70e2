//! `stress`: random scenes by the million.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::stress::draw::{draw, method_name};
use stillbeam_lab::stress::trial::trial;
use stillbeam_lab::stress::{campaign, document, energy, rows, summary::Summary};
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, println, progress};

#[derive(clap::Args)]
pub struct StressArgs {
    /// How many scenes
    #[arg(long, default_value_t = 1_000_000)]
    scenes: u64,
    /// What they are drawn with
    #[arg(long, default_value_t = 8)]
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
        if let Some(arms) = self.energy {
            let bar = progress::bar("arms that ring on", arms);
            let first = self.scene.unwrap_or(0);
            let rings = energy::rings(self.seed, first, arms, energy::TICKS, &|| bar.inc(1));
            bar.finish_and_clear();
            print!("{}", document::energy(&rings));
            return Ok(ExitCode::SUCCESS);
        }
        if let Some(index) = self.scene {
            return Ok(self.one(index));
        }
        if let Some(ticks) = self.long {
            let bar = progress::bar("ticks", document::long_ticks(ticks) as usize);
            let text = document::long(ticks, &|n| bar.inc(n));
            bar.finish_and_clear();
            print!("{}", text?);
            return Ok(ExitCode::SUCCESS);
        }
        // A scene that panics is counted; its message would hide the progress.
        std::panic::set_hook(Box::new(|_| ()));
        if let Some(path) = &self.csv {
            return self.rows(path);
        }
        let bar = progress::bar("random scenes", self.scenes as usize);
        let summary = campaign::run(self.seed, self.scenes, self.part.as_deref(), &|n| bar.inc(n));
        bar.finish_and_clear();
        let summary = summary?;
        print(&summary);
        Ok(if summary.faults() == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }

    fn rows(&self, path: &std::path::Path) -> Result<ExitCode, Error> {
        let bar = progress::bar("random scenes", self.scenes as usize);
        let judged = campaign::each(self.seed, 0..self.scenes, &|n| bar.inc(n));
        bar.finish_and_clear();
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
