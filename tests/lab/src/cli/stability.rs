//! `stability`: where the methods are stable and accurate, as maps and as blocks of a page.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use stillbeam_lab::markers;
use stillbeam_lab::stability::document::Findings;
use stillbeam_lab::stability::{map, page};
use stillbeam_lab::stress::{campaign, document, energy};
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, println, progress};

#[derive(clap::Args)]
pub struct StabilityArgs {
    /// A text with <!-- stability:NAME --> and <!-- /stability --> to be filled; a picture is drawn
    /// beside it
    #[arg(value_name = "stability.md")]
    text: Option<PathBuf>,
    /// Folder for the maps: a page, pictures, a CSV
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Change nothing; exit with 1 where what takes seconds is no longer true in the text
    #[arg(long, requires = "text", conflicts_with_all = ["out", "full"])]
    check: bool,
    /// Fill in the campaigns too, which take some minutes
    #[arg(long, requires = "text")]
    full: bool,
    /// Random scenes of the campaign
    #[arg(long, default_value_t = 1_000_000, requires = "full")]
    scenes: u64,
    /// Arms that ring on for a million ticks
    #[arg(long, default_value_t = 100, requires = "full")]
    arms: usize,
    /// Ticks of each long run
    #[arg(long, default_value_t = 100_000_000, requires = "full")]
    ticks: u64,
    /// What scenes are drawn with
    #[arg(long, default_value_t = 8, requires = "full")]
    seed: u64,
}

impl StabilityArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let bar = progress::bar("maps", map::STEPS);
        let findings = Findings::compute(&|| bar.inc(1));
        bar.finish_and_clear();
        let findings = findings?;
        if let Some(folder) = &self.out {
            println!("{}", page::write(folder, &findings)?.display());
        }
        let mut found = findings.blocks();
        let Some(path) = &self.text else {
            for (_, block) in &found {
                println!("{block}");
            }
            return Ok(ExitCode::SUCCESS);
        };
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a text file that can be read"))
        })?;
        let filled = |found: &[(String, String)]| {
            markers::fill(&text, "stability", found).map_err(|error| error.within(path.display()))
        };
        // A text without the markers shows before the campaigns run.
        let cheap = filled(&found)?;
        if self.check {
            return Ok(check(path, &text, &cheap));
        }
        if self.full {
            found.extend(self.campaigns()?);
        }
        let text = filled(&found)?;
        output::write_whole(path, |file| file.write_all(text.as_bytes()))?;
        println!("{}: filled", path.display());
        if let Some(elastica) = findings.spinning().iter().find(|map| map.name == "elastica-2-fast")
        {
            let svg = page::spinning_chart(elastica).svg()?;
            let picture = path.with_extension("svg");
            output::write_whole(&picture, |file| file.write_all(svg.as_bytes()))?;
            println!("{}: drawn", picture.display());
        }
        Ok(ExitCode::SUCCESS)
    }

    fn campaigns(&self) -> Result<Vec<(String, String)>, Error> {
        // A scene that panics is counted; its message would hide the progress.
        std::panic::set_hook(Box::new(|_| ()));
        let bar = progress::bar("random scenes", self.scenes as usize);
        let summary = campaign::run(self.seed, self.scenes, None, &|n| bar.inc(n));
        bar.finish_and_clear();
        let summary = summary?;
        let bar = progress::bar("arms that ring on", self.arms);
        let rings = energy::rings(self.seed, 0, self.arms, energy::TICKS, &|| bar.inc(1));
        bar.finish_and_clear();
        let bar = progress::bar("ticks", document::long_ticks(self.ticks) as usize);
        let long = document::long(self.ticks, &|n| bar.inc(n));
        bar.finish_and_clear();
        let command = |what: String| format!("`cargo lab stress {what}`\n\n");
        let blocks = [
            ("scenes", document::scenes(&summary)),
            ("reasons", document::reasons(&summary)),
            ("precision", document::precision(&summary)),
            (
                "energy",
                command(format!("--energy {} --seed {}", self.arms, self.seed))
                    + &document::energy(&rings),
            ),
            ("long", command(format!("--long {}", self.ticks)) + &long?),
        ];
        Ok(blocks.map(|(name, block)| (name.to_owned(), block)).to_vec())
    }
}

fn check(path: &Path, text: &str, filled: &str) -> ExitCode {
    match markers::difference(text, filled) {
        Some((old, new)) => {
            println!("{}: {old} is now {new}", path.display());
            println!("  `cargo lab stability {}` fills the tables anew", path.display());
            ExitCode::FAILURE
        }
        None => {
            println!("{}: the tables are true", path.display());
            ExitCode::SUCCESS
        }
    }
}
