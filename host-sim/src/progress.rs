//! Progress on the terminal; silent where standard error is none.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over so many steps. It shows after the first.
pub fn bar(what: &str, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(what.to_owned());
    if let Ok(style) =
        ProgressStyle::with_template("{msg:24} {bar:40} {pos}/{len}  {elapsed}, {eta} left")
    {
        bar.set_style(style);
    }
    bar
}

/// Percent of one long solution.
pub fn percent(what: &str) -> ProgressBar {
    bar(what, 100)
}
