//! The loop of every campaign: numbered cases on all cores, in order, under a watch.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use rayon::prelude::*;
use stillbeam_sim::error::Error;
use stillbeam_sim::progress;

/// Cases whose results are in memory at a time if a campaign only counts them.
pub const CHUNK: u64 = 10_000;

/// Time after which a case is taken to hang. A case takes some milliseconds, and some seconds if
/// `auto` tries a stiff arm for ten thousand ticks.
const PATIENCE: Duration = Duration::from_secs(600);

/// Runs the cases of those numbers on all cores and returns their results, in the order of the
/// numbers. `one` must depend on its number alone, so that the results do not depend on the
/// threads.
///
/// A case that hangs cannot be interrupted. It ends the program in one line that names it, `what`
/// and its number. `done` is called after each case.
pub fn each<R: Send>(
    what: &str,
    numbers: Range<u64>,
    done: &(dyn Fn() + Sync),
    one: impl Fn(u64) -> R + Sync,
) -> Vec<R> {
    let watch = Watch::default();
    watch.over(what, || {
        numbers
            .into_par_iter()
            .map(|index| {
                watch.begin(index);
                let result = one(index);
                watch.end(index);
                done();
                result
            })
            .collect()
    })
}

/// Runs the cases 0 to `count` as [`each`] does, and adds up what comes of them.
///
/// # Errors
/// The first case that fails.
pub fn total<R: Default + Send>(
    what: &str,
    count: u64,
    done: &(dyn Fn() + Sync),
    one: impl Fn(u64) -> Result<R, Error> + Sync,
    add: impl Fn(&mut R, R),
) -> Result<R, Error> {
    let mut total = R::default();
    for numbers in chunks(0, count) {
        for outcome in each(what, numbers, done, &one) {
            add(&mut total, outcome?);
        }
    }
    Ok(total)
}

/// Cuts the numbers from `from` to `to` at every multiple of [`CHUNK`].
pub fn chunks(from: u64, to: u64) -> impl Iterator<Item = Range<u64>> {
    let begins = std::iter::successors(Some(from), |at| Some((at / CHUNK + 1) * CHUNK));
    begins.take_while(move |&at| at < to).map(move |at| at..to.min((at / CHUNK + 1) * CHUNK))
}

/// Runs a task of `steps` steps beside a progress bar. The task reports the steps it has made.
pub fn with_bar<R>(what: &str, steps: u64, task: impl FnOnce(&(dyn Fn(u64) + Sync)) -> R) -> R {
    let bar = progress::bar(what, steps as usize);
    let result = task(&|made| bar.inc(made));
    bar.finish_and_clear();
    result
}

/// Sets the number of threads for all that follows. Without a number it is one a core.
///
/// # Errors
/// An error is returned if the number is not 1 to 1024.
pub fn on_threads(threads: Option<usize>) -> Result<(), Error> {
    let Some(threads) = threads else { return Ok(()) };
    if !(1..=1024).contains(&threads) {
        return Err(Error::new(format_args!("--threads = {threads}: must be 1 to 1024")));
    }
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().map_err(|cause| {
        Error::new(format_args!("--threads = {threads}: {cause}; must be what the machine allows"))
    })
}

/// Cases that are running, with the time when each began.
#[derive(Default)]
struct Watch {
    under_way: Mutex<Vec<(u64, Instant)>>,
}

impl Watch {
    fn begin(&self, index: u64) {
        self.cases().push((index, Instant::now()));
    }

    fn end(&self, index: u64) {
        self.cases().retain(|(under_way, _)| *under_way != index);
    }

    /// Returns a case that has run for longer than `patience`.
    fn overdue(&self, patience: Duration) -> Option<u64> {
        self.cases().iter().find(|case| case.1.elapsed() > patience).map(|case| case.0)
    }

    fn cases(&self) -> std::sync::MutexGuard<'_, Vec<(u64, Instant)>> {
        self.under_way.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Checks the cases once a second while `run` runs.
    fn over<R>(&self, what: &str, run: impl FnOnce() -> R) -> R {
        let (stop, stopped) = channel::<()>();
        std::thread::scope(|scope| {
            scope.spawn(move || {
                while stopped.recv_timeout(Duration::from_secs(1)) == Err(RecvTimeoutError::Timeout)
                {
                    if let Some(index) = self.overdue(PATIENCE) {
                        let seconds = PATIENCE.as_secs();
                        eprintln!("error: {what} {index}: runs on; must end within {seconds} s");
                        std::process::exit(Error::EXIT_CODE.into());
                    }
                }
            });
            let result = run();
            drop(stop);
            result
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;

    #[test]
    fn results_stand_in_order_on_any_number_of_threads() {
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let made = AtomicU64::new(0);
            let done = || {
                made.fetch_add(1, Ordering::Relaxed);
            };
            let squares = pool.install(|| each("case", 5..205, &done, |index| index * index));
            assert_eq!(squares, (5..205).map(|index| index * index).collect::<Vec<_>>());
            assert_eq!(made.into_inner(), 200);
        }
    }

    #[test]
    fn chunks_are_cut_at_the_same_numbers_wherever_they_begin() {
        let cut = |from, to| chunks(from, to).collect::<Vec<_>>();
        assert_eq!(cut(0, 0), []);
        assert_eq!(cut(3, 10_000), vec![3..10_000; 1]);
        assert_eq!(cut(7, 20_001), [7..10_000, 10_000..20_000, 20_000..20_001]);
    }

    #[test]
    fn only_a_case_under_way_is_overdue() {
        let watch = Watch::default();
        watch.begin(4);
        watch.begin(5);
        watch.end(4);
        std::thread::sleep(Duration::from_millis(2));
        assert_eq!(watch.overdue(Duration::from_millis(1)), Some(5));
        assert_eq!(watch.overdue(Duration::from_secs(60)), None);
        watch.end(5);
        assert_eq!(watch.overdue(Duration::ZERO), None);
    }

    #[test]
    fn no_threads_are_refused() {
        assert!(on_threads(None).is_ok());
        let error = on_threads(Some(0)).unwrap_err().to_string();
        assert_eq!(error, "--threads = 0: must be 1 to 1024");
    }
}
