//! Conversations with the application in QEMU.

use std::path::Path;

use stillbeam::axis::Tick;
use stillbeam_protocol::{Command, Status};
use stillbeam_sim::talk::{Answer, Machine, Session, Step};
use stillbeam_tests::firmware;

/// Bound on the lateness of a tick that nothing in the firmware holds up, µs. QEMU's clock follows
/// the instructions, but its timers wait for a thread of the host: on a busy one 276 µs have been
/// seen. Planning takes tens of milliseconds, and would be found beyond it.
pub const ON_TIME: u32 = 2_000;

/// Begins a conversation with the application of those features.
pub fn begin(features: &str) -> Session {
    begin_with(&firmware::application(features).unwrap_or_else(|error| panic!("{error}")))
}

/// Begins a conversation with an image.
pub fn begin_with(image: &Path) -> Session {
    Machine::emulate(image).and_then(Session::begin).unwrap_or_else(|error| panic!("{error}"))
}

/// Takes a step and returns the answer.
#[track_caller]
pub fn take(session: &mut Session, text: &str) -> String {
    let step: Step = text.parse().unwrap_or_else(|error| panic!("{error}"));
    step.take(session).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Takes steps and returns the answer to the last.
#[track_caller]
pub fn take_all(session: &mut Session, steps: &[&str]) -> String {
    steps.iter().map(|text| take(session, text)).last().unwrap_or_default()
}

/// Takes steps and returns each with its answer.
pub fn run(session: &mut Session, steps: &[&str]) -> Vec<String> {
    steps.iter().map(|text| format!("{text}: {}", take(session, text))).collect()
}

/// Asks axis 0 for its status.
#[track_caller]
pub fn status(session: &mut Session) -> Status {
    match session.ask(0, Command::Status) {
        Ok(Answer::Status(status)) => status,
        other => panic!("{other:?}"),
    }
}

/// Returns the latest tick of axis 0.
#[track_caller]
pub fn last(session: &Session) -> Tick<f32> {
    *session.history(0).last().expect("ticks")
}
