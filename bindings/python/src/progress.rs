//! Long work: its progress, told to a call of the user's own or by the command line's bar on the
//! terminal, and its end before the time, by an interrupt or an exception of that call.

use std::panic::resume_unwind;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use stillbeam_sim::error::Error;
use stillbeam_sim::limits::load;
use stillbeam_sim::progress::{Late, ProgressBar, bar, late};

use crate::error::refused;

/// Interval at which the interpreter is asked for an interrupt.
const WATCH: Duration = Duration::from_millis(20);

/// Report of a piece of work.
pub struct Progress {
    call: Option<Py<PyAny>>,
    /// The exception that ends the work: an interrupt, or the first one of the call.
    failed: Mutex<Option<PyErr>>,
    /// True once there is one.
    stopped: AtomicBool,
}

/// Payload of the unwinding of work that is stopped.
struct Stopped;

impl Progress {
    /// Creates the progress of one piece of work. `call` takes a few words and a fraction.
    pub fn new(call: Option<Py<PyAny>>) -> Self {
        Self { call, failed: Mutex::new(None), stopped: AtomicBool::new(false) }
    }

    /// True if the user has a call.
    pub fn is_called(&self) -> bool {
        self.call.is_some()
    }

    /// Does work with the interpreter released, in a thread of its own, because the interpreter
    /// sees an interrupt in the thread only that called it. The work ends at the next step that it
    /// tells of.
    ///
    /// # Errors
    /// The interrupt, an exception of the call, or the error of the work.
    pub fn work<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> Result<T, Error> + Send,
    ) -> PyResult<T> {
        let ended = py.detach(|| {
            thread::scope(|scope| {
                let (sender, receiver) = channel::<()>();
                let thread = scope.spawn(move || {
                    // Dropped at the end of the work, however it ends.
                    let _sender = sender;
                    work()
                });
                while receiver.recv_timeout(WATCH) == Err(RecvTimeoutError::Timeout) {
                    if let Err(interrupt) = Python::attach(|py| py.check_signals()) {
                        self.stop(interrupt);
                    }
                }
                thread.join()
            })
        });
        if let Some(error) = self.failed.lock().ok().and_then(|mut failed| failed.take()) {
            return Err(error);
        }
        match ended {
            Ok(result) => result.map_err(refused),
            Err(panic) => resume_unwind(panic),
        }
    }

    /// Notes the exception that ends the work, if it is the first one.
    fn stop(&self, error: PyErr) {
        if let Ok(mut failed) = self.failed.lock() {
            failed.get_or_insert(error);
        }
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Leaves the work if it is to end. Unwinding passes through work that knows of no end before
    /// its time, and through threads of its own.
    fn check(&self) {
        if self.stopped.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Stopped));
        }
    }

    /// Tells that the fraction `done` of the work is done.
    pub fn tell(&self, what: &str, done: f64) {
        self.check();
        let Some(call) = &self.call else { return };
        let told = Python::attach(|py| call.call1(py, (what, done)).map(drop));
        if let Err(error) = told {
            self.stop(error);
        }
        self.check();
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
            Some(bar) => {
                bar.inc(1);
                self.progress.check();
            }
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
        self.progress.check();
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
