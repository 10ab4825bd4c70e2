//! `sweep`: run time against error, over many solvers and scenes.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::sweep::execute::execute;
use stillbeam_lab::sweep::plan::{Plan, Shard};
use stillbeam_lab::sweep::spec::Spec;
use stillbeam_sim::error::Error;
use stillbeam_sim::{console, println};

#[derive(clap::Args)]
pub struct SweepArgs {
    /// What to cross, a TOML file [default: the embedded spec]
    spec: Option<PathBuf>,
    /// Where the rows go, one a case
    #[arg(long, value_name = "OUT.csv")]
    csv: PathBuf,
    /// Only the i-th of n parts, for n machines; join them with `merge`
    #[arg(long, value_name = "i/n")]
    shard: Option<String>,
    /// Go on where an interrupted sweep has stopped; run what OUT.csv lacks
    #[arg(long)]
    resume: bool,
}

impl SweepArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let spec = match &self.spec {
            Some(path) => Spec::read(path)?,
            None => Spec::embedded()?,
        };
        for scene in &spec.scenes {
            console::open(scene)?;
        }
        let shard = self.shard.as_deref().map_or(Ok(Shard::WHOLE), str::parse)?;
        let plan = Plan::new(&spec)?;
        let done = execute(&plan, shard, &self.csv, self.resume)?;
        println!("{} of {} cases to {}", done.cases, plan.cases.len(), self.csv.display());
        if self.resume {
            println!("  {} run, {} timed; the others were there", done.run, done.timed);
        }
        if shard == Shard::WHOLE {
            println!("  `cargo lab pareto {} --out DIR` draws them", self.csv.display());
        } else {
            println!("  `cargo lab merge OUT.csv SHARD.csv...` joins the shards");
        }
        Ok(ExitCode::SUCCESS)
    }
}
