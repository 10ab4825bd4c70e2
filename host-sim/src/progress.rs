//! Progress on the terminal; silent where standard error is none.

use std::time::{Duration, Instant};

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

/// Takes the part of one long task that is done, 0 to 1, and shows it once the task has taken a second.
/// What it shows is gone when it is dropped.
pub fn after_a_second(what: &'static str) -> impl FnMut(f64) {
    let began = Instant::now();
    let mut shown: Option<Shown> = None;
    move |part| {
        if began.elapsed() > Duration::from_secs(1) {
            let Shown(bar) = shown.get_or_insert_with(|| Shown(percent(what)));
            bar.set_position((100.0 * part) as u64);
        }
    }
}

/// A bar that goes away with its task.
struct Shown(ProgressBar);

impl Drop for Shown {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
