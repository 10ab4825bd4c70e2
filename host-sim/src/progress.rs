//! Progress on the terminal. Prints nothing if standard error is not a terminal.

use std::cell::OnceCell;
use std::time::{Duration, Instant};

pub use indicatif::ProgressBar;
use indicatif::ProgressStyle;

/// Creates a bar over `steps` steps. It shows at once, with the time that has passed: the first
/// step may be a long one.
pub fn bar(what: &str, steps: usize) -> ProgressBar {
    let bar = ProgressBar::new(steps as u64).with_message(what.to_owned());
    if let Ok(style) =
        ProgressStyle::with_template("{msg:24} {bar:40} {pos}/{len}  {elapsed}, {eta} left")
    {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

/// Creates a bar in percent for one long solution.
pub fn percent(what: &str) -> ProgressBar {
    bar(what, 100)
}

/// Creates a bar for a task that is mostly short. It shows after a second and goes away when
/// dropped.
pub fn late(what: &str) -> Late {
    Late { what: what.to_owned(), begun: Instant::now(), bar: OnceCell::new() }
}

/// A bar that waits for a second before it shows.
#[derive(Debug)]
pub struct Late {
    what: String,
    begun: Instant,
    bar: OnceCell<ProgressBar>,
}

impl Late {
    /// Shows the fraction that is done, 0 to 1.
    pub fn set(&self, done: f64) {
        if self.is_due() {
            self.bar.get_or_init(|| percent(&self.what)).set_position((100.0 * done) as u64);
        }
    }

    /// Shows what the task is at, in place of a fraction that nobody knows.
    pub fn turn(&self, at: impl FnOnce() -> String) {
        if self.is_due() {
            let bar = self.bar.get_or_init(spinner);
            bar.set_message(format!("{}: {}", self.what, at()));
            bar.inc(1);
        }
    }

    /// Takes the bar from the terminal, so that another one has its line.
    pub fn clear(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }

    fn is_due(&self) -> bool {
        self.begun.elapsed() > Duration::from_secs(1)
    }
}

/// Creates a sign of life for a task whose number of steps is unknown.
fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}  {elapsed}") {
        bar.set_style(style);
    }
    bar
}

impl Drop for Late {
    fn drop(&mut self) {
        self.clear();
    }
}
