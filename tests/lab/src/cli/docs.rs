//! `docs`: writes or checks every page with blocks that take seconds.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_lab::pages::{self, PAGES, Page, Pages};
use stillbeam_sim::error::Error;
use stillbeam_sim::println;

use super::verdict;

/// Pages that other commands write, for `--help`.
pub const OTHERS: &str = "\
Written by commands of their own, because they take minutes or an emulator:
  docs/auto.md, its figures     cargo lab auto docs/auto.md --count N
  docs/still.md, campaigns      cargo lab still docs/still.md
  docs/still.md, fastest        cargo lab fastest docs/still.md
  docs/still.md, gentle         cargo lab gentle docs/still.md
  docs/still.md, broken off     cargo lab interrupted docs/still.md
  docs/identify.md, its table   cargo lab identify docs/identify.md
  docs/mechanisms.md            cargo lab mechanisms docs/mechanisms.md
  docs/stability.md, campaigns  cargo run --profile long -p stillbeam-lab -- stress docs/stability.md
  docs/stability.md, faults     cargo lab faults docs/stability.md
  docs/drive.md, robustness     cargo lab plant docs/drive.md
  docs/stability.md, fuzzing    sh tests/fuzz/long
  docs/instructions.*           cargo run --release -p stillbeam-tests --bin instructions
  docs/firmware.md              cargo run --release -p stillbeam-tests --bin firmware
Of docs/auto.md, --check compares the command and the distribution of the arms.";

#[derive(clap::Args)]
pub struct DocsArgs {
    /// Only these pages, by their paths from the root [default: every page]
    #[arg(value_name = "PAGE")]
    pages: Vec<String>,
    /// Change nothing; exit with 1 where a page is no longer true
    #[arg(long)]
    check: bool,
    /// Root of the repository
    #[arg(long, value_name = "DIR", default_value = ".")]
    root: PathBuf,
}

impl DocsArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let chosen: Vec<Page> = if self.pages.is_empty() {
            PAGES.to_vec()
        } else {
            self.pages.iter().map(|path| pages::named(path)).collect::<Result<_, _>>()?
        };
        let pages = Pages::at(&self.root);
        let mut holds = true;
        for page in &chosen {
            if self.check {
                holds &= check(&pages, page)?;
            } else {
                for path in pages.write(page)? {
                    println!("{}: written", path.display());
                }
            }
        }
        Ok(verdict(holds))
    }
}

fn check(pages: &Pages, page: &Page) -> Result<bool, Error> {
    let path = page.path;
    let found = pages.check(page)?;
    match &found {
        None => println!("{path}: true"),
        Some(difference) => {
            println!("{path}:{difference}");
            println!("  `cargo lab docs {path}` writes it anew");
        }
    }
    Ok(found.is_none())
}
