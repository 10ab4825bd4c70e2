//! `pareto`: draws error against time and describes it in words.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::sweep::page;
use stillbeam_lab::sweep::picture::{self, Picture};
use stillbeam_lab::sweep::row::{Row, Rows};
use stillbeam_sim::error::Error;

#[derive(clap::Args)]
pub struct ParetoArgs {
    /// A CSV of sweep
    #[arg(value_name = "SWEEP.csv")]
    sweep: PathBuf,
    /// Only this scene [default: every scene of the sweep]
    #[arg(long)]
    scene: Option<String>,
    /// Folder for the page and a picture a scene
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

impl ParetoArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let rows = Rows::open(&self.sweep)?.collect::<Result<Vec<Row>, _>>()?;
        let known = picture::scenes(&rows);
        let scenes = match &self.scene {
            None if known.is_empty() => {
                return Err(Error::file(&self.sweep, "no rows; must be a CSV of sweep"));
            }
            None => known,
            Some(name) if known.contains(&name.as_str()) => vec![name.as_str()],
            Some(name) => {
                return Err(Error::new(format_args!(
                    "--scene = \"{name}\": must be {}",
                    known.join(", ")
                )));
            }
        };
        let pictures: Vec<Picture<'_>> =
            scenes.iter().map(|scene| Picture::of(&rows, scene)).collect();
        let file = page::write(&self.out, &pictures)?;
        let mut text: String = pictures.iter().map(page::text).collect();
        text += &page::summary(&pictures);
        text += &format!("{}\n", file.display());
        // Long enough to be piped into something that stops reading.
        let _ = std::io::stdout().write_all(text.as_bytes());
        Ok(ExitCode::SUCCESS)
    }
}
