//! `still`: the comparison of still moves with other motions, as tables and as a picture.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::plan::document;
use stillbeam_sim::{output, progress};

#[derive(clap::Args)]
pub struct StillArgs {
    /// A text with <!-- still:NAME --> and <!-- /still -->; a picture is drawn beside it
    #[arg(value_name = "still.md")]
    text: PathBuf,
    /// Change nothing; exit with 1 where the tables in the text are no longer true
    #[arg(long)]
    check: bool,
}

impl StillArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let path = &self.text;
        let text = std::fs::read_to_string(path)
            .map_err(|cause| Error::file(path, format_args!("{cause}; accepted is a text")))?;
        let bar = progress::bar("reference rod", document::STEPS);
        let blocks = document::blocks(&|| bar.inc(1));
        bar.finish_and_clear();
        let filled =
            document::fill(&text, &blocks?).map_err(|error| error.within(path.display()))?;
        if !self.check {
            output::write_whole(path, |file| file.write_all(filled.as_bytes()))?;
            let picture = path.with_extension("svg");
            document::picture(&picture)?;
            println!("{}: filled; {}: drawn", path.display(), picture.display());
            return Ok(ExitCode::SUCCESS);
        }
        let mut lines = text.lines().zip(filled.lines());
        if let Some((old, new)) = lines.find(|(old, new)| old != new) {
            println!("{}: {old} is now {new}", path.display());
            println!("  `stillbeam-sim still {}` fills the tables anew", path.display());
            return Ok(ExitCode::FAILURE);
        }
        println!("{}: the tables are true", path.display());
        Ok(ExitCode::SUCCESS)
    }
}
