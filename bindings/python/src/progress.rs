//! Progress of long work: a call of the user's own, or the command line's bar on the terminal.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use pyo3::prelude::*;
use stillbeam_sim::limits::load;
use stillbeam_sim::progress::{Late, ProgressBar, bar, late};

/// Report of a piece of work.
pub struct Progress {
    call: Option<Py<PyAny>>,
    /// The first exception of the call. Later calls are left out.
    failed: Mutex<Option<PyErr>>,
}

impl Progress {
    /// Creates the progress of one piece of work. `call` takes a few words and a fraction.
    pub fn new(call: Option<Py<PyAny>>) -> Self {
        Self { call, failed: Mutex::new(None) }
    }

    /// True if the user has a call.
    pub fn is_called(&self) -> bool {
        self.call.is_some()
    }

    /// Tells that the fraction `done` of the work is done. Also looks for an interrupt of the user,
    /// which ends the work's result once it is there.
    pub fn tell(&self, what: &str, done: f64) {
        let Ok(mut failed) = self.failed.lock() else { return };
        if failed.is_some() {
            return;
        }
        *failed = Python::attach(|py| {
            let told = self.call.as_ref().map(|call| call.call1(py, (what, done)).map(drop));
            told.unwrap_or(Ok(())).and_then(|()| py.check_signals()).err()
        });
    }

    /// Returns the work's result, or the exception that the call raised.
    pub fn end<T>(self, result: PyResult<T>) -> PyResult<T> {
        match self.failed.into_inner() {
            Ok(Some(error)) => Err(error),
            _ => result,
        }
    }

    /// Counts steps of a known number, from any thread.
    pub fn steps<'a>(&'a self, what: &'static str, count: usize) -> Steps<'a> {
        let bar = (!self.is_called()).then(|| bar(what, count));
        Steps { progress: self, what, count, done: AtomicUsize::new(0), bar }
    }

    /// Tells of the check of a scene's load limits.
    pub fn limits(&self) -> Limits<'_> {
        Limits {
            progress: self,
            check: late("limits, by the rod"),
            search: late("a duration within the limits"),
        }
    }
}

/// Steps that are done one by one.
pub struct Steps<'a> {
    progress: &'a Progress,
    what: &'static str,
    count: usize,
    done: AtomicUsize,
    bar: Option<ProgressBar>,
}

impl Steps<'_> {
    /// Counts one step.
    pub fn step(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        match &self.bar {
            Some(bar) => bar.inc(1),
            None => self.progress.tell(self.what, done as f64 / self.count as f64),
        }
    }
}

impl Drop for Steps<'_> {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Two bars that wait for a second before they show.
pub struct Limits<'a> {
    progress: &'a Progress,
    check: Late,
    search: Late,
}

impl Limits<'_> {
    /// Shows what the check is at.
    pub fn tell(&self, at: load::Progress) {
        match (at, self.progress.is_called()) {
            (load::Progress::Checked(done), true) => self.progress.tell("limits", done),
            (load::Progress::Checked(done), false) => self.check.set(done),
            (load::Progress::Tried(_), true) => {
                self.progress.tell("a duration within the limits", 0.0)
            }
            (load::Progress::Tried(duration), false) => {
                self.check.clear();
                self.search.turn(|| format!("trying {duration:.3} s"));
            }
        }
    }
}
