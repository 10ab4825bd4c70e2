//! `identify`: identifies arms from synthetic logs whose truth is known.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::campaign::with_bar;
use stillbeam_lab::identify::{Case, SEED, Summary, campaign, document, identified, judge};
use stillbeam_lab::pages::Target;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

use super::{counted, verdict};

#[derive(clap::Args)]
pub struct IdentifyArgs {
    /// A page with <!-- lab:identify --> to be filled; pictures are drawn beside it
    #[arg(value_name = "identify.md")]
    page: Option<PathBuf>,
    /// Number of logs
    #[arg(long, value_name = "N", default_value_t = 1000)]
    count: u64,
    /// Seed of the logs
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Only this log, and what comes of it
    #[arg(long, value_name = "INDEX")]
    case: Option<u64>,
}

impl IdentifyArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let count = counted(self.count)?;
        if let Some(index) = self.case {
            let case = Case::random(self.seed, index)?;
            println!("{case:#?}");
            println!("{:#?}", identified(&case)?);
            println!("{:#?}", judge(&case)?);
            return Ok(ExitCode::SUCCESS);
        }
        let page = Target::open(self.page.clone(), ["identify"])?;
        let results = with_bar("logs", count, |done| campaign(self.seed, 0..count, &|| done(1)))?;
        let summary = Summary::of(&results);
        println!(
            "{:<36} {:>5}  {:>15}  {:>26}  {:>26}",
            "", "logs", "hold f, zeta %", "95 % err f, zeta, EI %", "worst f, zeta, EI %"
        );
        for tally in &summary.tallies {
            let percent = |errors: [f64; 3]| {
                let [f, zeta, stiffness] = errors.map(|error| 100.0 * error);
                format!("{f:>8.4} {zeta:>8.2} {stiffness:>8.4}")
            };
            println!(
                "{:<36} {:>5}  {:>7.1} {:>7.1}  {}  {}",
                tally.kind.name(),
                tally.count,
                100.0 * tally.coverage[0],
                100.0 * tally.coverage[1],
                percent(tally.usual),
                percent(tally.worst)
            );
        }
        if let Some((page, path)) = page.zip(self.page.as_ref()) {
            page.fill(&[document::block(self.seed, count, &summary)])?;
            let mut files = Files::default();
            for (name, picture) in document::pictures(self.seed)? {
                let place = path.with_file_name(format!("identify-{name}.svg"));
                files.add(&place, |file| file.write_all(picture.as_bytes()))?;
            }
            files.finish()?;
        }
        Ok(verdict(summary.holds()))
    }
}
