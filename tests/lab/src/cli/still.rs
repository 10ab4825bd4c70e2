//! `still`: the comparison of still moves with other motions, as tables and as a picture.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::markers;
use stillbeam_lab::still::document;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::{println, progress};

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
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a text file that can be read"))
        })?;
        let bar = progress::bar("reference rod", document::STEPS);
        let found = document::blocks(&|| bar.inc(1));
        bar.finish_and_clear();
        let filled =
            markers::fill(&text, "still", &found?).map_err(|error| error.within(path.display()))?;
        if !self.check {
            let bar = progress::bar("pictures", document::PICTURE_STEPS);
            let mut files = Files::default();
            files.add(path, |file| file.write_all(filled.as_bytes()))?;
            let pictures = document::pictures(&mut files, path, &|| bar.inc(1));
            bar.finish_and_clear();
            let pictures = pictures?;
            files.finish()?;
            println!("{}: filled", path.display());
            for picture in pictures {
                println!("{}: drawn", picture.display());
            }
            return Ok(ExitCode::SUCCESS);
        }
        if let Some((old, new)) = markers::difference(&text, &filled) {
            println!("{}: {old} is now {new}", path.display());
            println!("  `cargo lab still {}` fills the tables anew", path.display());
            return Ok(ExitCode::FAILURE);
        }
        println!("{}: the tables are true", path.display());
        Ok(ExitCode::SUCCESS)
    }
}
