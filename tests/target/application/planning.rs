//! Still moves that the firmware plans beside its ticks.

use stillbeam_protocol::Command;
use stillbeam_sim::talk::{Answer, STILL};
use stillbeam_tests::assert_near;

use crate::session::{ON_TIME, begin, run, status, take};

/// Every setpoint of a still move that the target has planned is the host's own plan's, or the
/// conversation would have ended with an error.
#[test]
fn still_moves_are_planned_on_the_target_while_ticks_and_drives_go_on() {
    let mut session = begin("mps2");
    let lines = run(&mut session, &STILL);
    let accepted =
        lines.iter().filter(|line| line.starts_with("still") && line.contains("accepted before"));
    assert_eq!(accepted.count(), 4, "{lines:#?}");
    let outcome = |text: &str| lines.iter().find(|line| line.starts_with(text)).expect("a step");
    let short = outcome("still 0 0.5 0.1");
    assert!(short.contains("refused: move.duration = 0.1 s: must be "), "{short}");
    let fast = outcome("still 0 -1.5 0.76");
    assert!(fast.contains("refused: limits.") && fast.contains("must be 0 to "), "{fast}");
    let rests = session.history(0).last().expect("ticks").setpoint;
    assert_near("angle", rests.angle.radians(), 1.2, 1e-6);
    assert_eq!(rests.rate, 0.0);
    let status = status(&mut session);
    // Plans take many ticks, and no tick, frame or setpoint waits for them.
    assert!(session.now() > 200 && status.late < ON_TIME, "{status:?}");
    assert_eq!([status.missed, status.overruns, status.dropped], [0; 3], "{status:?}");
}

/// A plan takes many ticks on this board; a stop that comes meanwhile acts at once, and the plan
/// that it makes stale is refused.
#[test]
fn a_stop_does_not_wait_for_a_plan() {
    let mut session = begin("mps2");
    take(&mut session, "enable 0");
    take(&mut session, "spin 0 0.5 2");
    take(&mut session, "spin 0 0.5 0");
    let posted = session.post(0, Command::Still { to: 1.0, duration: None }).expect("sent");
    take(&mut session, "wait 0.3");
    let before = session.now();
    let stopped = session.ask(0, Command::Stop);
    assert!(matches!(stopped, Ok(Answer::Accepted(tick)) if tick <= before + 1), "{stopped:?}");
    let Ok(Answer::Refused(why)) = session.answer(posted) else { panic!("it was stopped") };
    let stopped = ["mode = Stopping", "mode = Stopped", "planned before a stop"];
    assert!(stopped.iter().any(|words| why.contains(words)), "{why}");
    let later = session.now() - before;
    assert!(later > 1, "the plan was still being made: {later} ticks");
}

/// Requests that the planner has no room for are refused at once.
#[test]
fn a_busy_planner_says_so() {
    let mut session = begin("mps2");
    take(&mut session, "enable 0");
    let still = Command::Still { to: 1.0, duration: None };
    let posted: Vec<_> = (0..4).map(|_| session.post(0, still).expect("sent")).collect();
    let last = *posted.last().expect("four");
    // Two wait for the planner, which has not begun.
    let Ok(Answer::Refused(why)) = session.answer(last) else { panic!("there is no room") };
    assert_eq!(why, "planner = busy: wait until it has answered");
}
