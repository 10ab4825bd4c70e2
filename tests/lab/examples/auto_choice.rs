//! How good the choices of `auto` are: random arms and moves, every rung of the ladder judged by the
//! reference rod. Writes `docs/auto.md` and the picture beside it.
//!
//! ```sh
//! cargo run --release -p stillbeam-lab --example auto_choice -- 10000 docs/auto.md
//! ```
//!
//! Without a page: the summary of 200 arms. A third argument is another seed.

use std::path::PathBuf;

use stillbeam_lab::choice::{self, SEED, Summary};
use stillbeam_sim::{output, progress};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u64 = arguments.next().unwrap_or_else(|| "200".into()).parse()?;
    let page = arguments.next().map(PathBuf::from);
    let seed: u64 = arguments.next().map_or(Ok(SEED), |seed| seed.parse())?;
    let bar = progress::bar("arms", usize::try_from(count)?);
    let verdicts = choice::campaign(seed, count, &|| bar.inc(1))?;
    bar.finish_and_clear();
    for (index, verdict) in verdicts.iter().enumerate() {
        if verdict.exceeds() || verdict.rungs_too_dear().is_some_and(|rungs| rungs > 1) {
            println!("arm {index}: {verdict:?}");
        }
    }
    let summary = Summary::of(&verdicts);
    println!("{summary:#?}");
    if let Some(page) = page {
        let picture = choice::picture(&verdicts)?;
        let text = choice::page(seed, &verdicts);
        output::write_whole(&page, |file| file.write_all(text.as_bytes()))?;
        output::write_whole(&page.with_extension("svg"), |file| {
            file.write_all(picture.as_bytes())
        })?;
    }
    if summary.holds() { Ok(()) } else { Err("a bound does not hold".into()) }
}
