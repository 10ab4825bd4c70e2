//! Paths over the wire, row by row, in lock-step with the host's own.

use stillbeam::axis::{Cause, Mode};
use stillbeam::motion::{Spline, Waypoint};
use stillbeam_protocol::Command;
use stillbeam_sim::talk::Answer;
use stillbeam_tests::{assert_near, firmware, image};

use crate::session::{ON_TIME, begin, last, status, take_all};

/// With paths and still moves: flash, and statics with the deepest stack of paths.
const FLASH: u64 = 152 * 1024;
const RAM: u64 = 24 * 1024;

/// A hundred rows through a queue of eight segments: every setpoint is the host's own, every row is
/// passed at its time, and no tick is late for a plan.
#[test]
fn a_path_of_many_rows_runs_through_the_queue_to_the_bit() {
    for spline in Spline::ALL {
        let mut session = begin("mps2,path");
        take_all(&mut session, &["home 0 0", "enable 0", "wait 0.02"]);
        let answer = session.ask(0, Command::Path(spline)).expect("an answer");
        assert!(matches!(answer, Answer::Accepted(_)), "{answer:?}");
        let row = |k: u32| Waypoint::at(0.06 * f64::from(k), 0.006 * f64::from(k % 3));
        let mut first = None;
        for k in 1..=100 {
            let answer = session.offer(0, row(k), k == 100).expect("an answer");
            let Answer::Accepted(tick) = answer else { panic!("row {k}: {answer:?}") };
            // The first is taken when the window of twelve is full.
            first = first.or((k == 12).then_some(tick));
        }
        take_all(&mut session, &["rest"]);
        // Time 0 of a path is the first tick behind that.
        let begin = first.expect("twelve rows") as usize;
        let history = session.history(0);
        for k in 1..=100 {
            let setpoint = &history[begin + 6 * k as usize].setpoint;
            assert_near("row", setpoint.angle.radians(), row(k).angle, 2e-6);
        }
        let status = status(&mut session);
        assert_eq!([status.missed, status.overruns, status.dropped], [0; 3], "{status:?}");
        // The hand-over of a piece of a quintic spline masks the tick for 158 µs.
        assert!(status.late < ON_TIME, "{spline}: no plan holds a tick up: {status:?}");
        let image = firmware::application("mps2,path").unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        println!("{spline}: {footprint:?}, stack {}", status.stack);
        assert!(footprint.flash <= FLASH, "{footprint:?}");
        assert!(footprint.ram + u64::from(status.stack) < RAM, "{footprint:?}, {status:?}");
    }
}

#[test]
fn a_firmware_without_paths_says_so() {
    let mut session = begin("mps2");
    take_all(&mut session, &["enable 0"]);
    let why = "refused: path = not planned: use a firmware with the feature `path`";
    assert_eq!(take_all(&mut session, &["path 0 cubic"]), why);
    assert_eq!(take_all(&mut session, &["last 0 1 0.5"]), why);
}

/// Rows that stay away end the path at rest, within the limits; the next one is told why.
#[test]
fn rows_that_stay_away_end_the_path_at_rest() {
    let mut session = begin("mps2,path");
    take_all(&mut session, &["home 0 0", "enable 0", "path 0 cubic", "row 0 0.3 0.1 0.6"]);
    take_all(&mut session, &["rest"]);
    let end = last(&session).setpoint;
    assert!((0.1..0.3).contains(&end.angle.radians()), "{end:?}");
    let late = take_all(&mut session, &["row 0 0.6 0.4"]);
    assert!(late.starts_with("accepted"), "it waits for the rows behind it: {late}");
    let starved = take_all(&mut session, &["last 0 0.9 0.5"]);
    assert!(starved.starts_with("refused: waypoint.time = past"), "{starved}");
    let over = take_all(&mut session, &["row 0 1.2 0.5"]);
    assert_eq!(over, "refused: waypoint = without a path: begin a path first");
    // And the axis goes on.
    take_all(&mut session, &["path 0 quintic", "row 0 0.5 0.4", "last 0 1 0.1", "rest"]);
    assert_near("end", last(&session).setpoint.angle.radians(), 0.1, 1e-5);
}

/// A row beyond the limits is refused with them; a stop ends a path, and its rows.
#[test]
fn a_bad_row_and_a_stop_end_a_path() {
    let mut session = begin("mps2,path");
    assert!(take_all(&mut session, &["path 0 cubic"]).contains("mode = Disabled"));
    take_all(&mut session, &["home 0 0", "enable 0", "path 0 cubic", "row 0 0.4 0.1 0.2"]);
    let back = take_all(&mut session, &["row 0 0.4 0.2"]);
    assert!(back.starts_with("refused: waypoint.time = 0.4 s: must be "), "{back}");
    let fast = take_all(&mut session, &["row 0 0.5 2 0"]);
    assert!(fast.starts_with("refused: limits.rate = "), "{fast}");
    take_all(&mut session, &["rest", "path 0 cubic", "row 0 1 0.4 0.2", "wait 0.5", "stop 0"]);
    let stopped = take_all(&mut session, &["last 0 2 0.2 0"]);
    assert!(stopped.starts_with("refused: mode = Stop"), "{stopped}");
    take_all(&mut session, &["rest"]);
    let status = status(&mut session);
    assert_eq!((status.mode, status.cause), (Mode::Stopped, Some(Cause::Requested)));
}
