//! `faults`: what goes wrong around an axis, and what comes of it.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::faults::{Fault, campaign, table};
use stillbeam_lab::markers;
use stillbeam_sim::error::Error;
use stillbeam_sim::{output, println, progress};

#[derive(clap::Args)]
pub struct FaultsArgs {
    /// A text with <!-- stability:faults --> and <!-- /stability --> to be filled
    #[arg(value_name = "stability.md")]
    text: Option<PathBuf>,
    /// Runs a kind of fault, some 13 s of motion each
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    count: u64,
    /// What they are drawn with
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

impl FaultsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let Self { count, seed, .. } = self;
        if !(1..=100_000_000).contains(&count) {
            return Err(Error::new(format_args!("--count = {count}: must be 1 to 100000000")));
        }
        let text = self.text.as_ref().map(|path| {
            let text = std::fs::read_to_string(path).map_err(|cause| {
                Error::file(path, format_args!("{cause}; it must be a text file that can be read"))
            })?;
            // A text without the markers shows before the campaign runs.
            filled(&text, "").map_err(|error| error.within(path.display()))?;
            Ok::<_, Error>((path, text))
        });
        let text = text.transpose()?;
        let bar = progress::bar("runs", Fault::ALL.len() * count as usize);
        let rows = campaign::all(seed, count, &|| bar.inc(1));
        bar.finish_and_clear();
        let rows = rows?;
        let broken: Vec<&String> = rows.iter().flat_map(|(_, outcome)| &outcome.broken).collect();
        let block = format!(
            "`cargo lab faults --count {count} --seed {seed}`\n\n{}\n{}",
            table::markdown(&rows),
            table::refusals(&rows)
        );
        match text {
            Some((path, text)) => {
                let text = filled(&text, &block).map_err(|error| error.within(path.display()))?;
                output::write_whole(path, |file| file.write_all(text.as_bytes()))?;
                println!("{}: filled", path.display());
            }
            None => print!("{block}"),
        }
        for line in broken.iter().take(20) {
            println!("broken: {line}");
        }
        Ok(if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }
}

fn filled(text: &str, block: &str) -> Result<String, Error> {
    markers::fill(text, "stability", &[("faults".to_owned(), block.to_owned())])
}
