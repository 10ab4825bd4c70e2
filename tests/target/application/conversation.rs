//! The whole policy in a conversation, late and missed ticks, and what is not understood.

use stillbeam::axis::{Cause, Mode};
use stillbeam_sim::talk::{DEMONSTRATION, FAULTS, Session, Step};
use stillbeam_tests::assert_near;

use super::without_counts;
use crate::session::{ON_TIME, begin, run, status, take};

/// Time of an instruction of the emulated board, s.
const INSTRUCTION: f64 = 64e-9;

/// The demonstration, what came of each step, and what was logged.
fn demonstration() -> (Session, Vec<String>) {
    let mut session = begin("mps2");
    let lines = run(&mut session, &DEMONSTRATION);
    (session, lines)
}

#[test]
fn the_firmware_and_the_host_agree_to_the_bit_through_the_whole_policy() {
    let (mut session, lines) = demonstration();
    let [setpoints, frames] = session.compared();
    assert!(setpoints > 800 && frames > 800, "{setpoints} setpoints, {frames} frames");
    let outcome = |text: &str| {
        let line = lines.iter().find(|line| line.starts_with(text));
        line.unwrap_or_else(|| panic!("{text} in {lines:#?}"))
    };
    let refused = [
        ("move 0 cubic 0.5 0", "mode = Stopped: enable the axis first"),
        ("move 0 cubic 0.1 3", "must be 0 to 5 rad/s"),
    ];
    for (text, why) in refused {
        assert!(outcome(text).contains("refused") && outcome(text).contains(why), "{lines:#?}");
    }
    let accepted = lines.iter().filter(|line| line.contains("accepted before tick")).count();
    assert_eq!(accepted, 13, "{lines:#?}");
    assert!(outcome("silence").contains("axis 1 stopped"), "{lines:#?}");

    let log = session.log();
    let logged = |words: &str| log.iter().any(|(_, line)| line.contains(words));
    assert!(logged("instructions last") && logged("under 100"), "{log:#?}");
    assert_eq!([session.drive_is_on(0), session.drive_is_on(1)], [Some(false); 2]);
    for axis in 0..2 {
        // Switched on where the drive said that it was.
        let mut history = session.history(axis).iter();
        let first = history.find(|tick| tick.mode == Mode::Enabled).expect("it was enabled");
        let measured = 0.05 * f64::from(axis + 1);
        assert_near("first angle", first.setpoint.angle.in_turns(), measured, 1e-6);
    }
    let status = status(&mut session);
    let faults = [status.missed, status.overruns, status.dropped, status.garbled, status.saturated];
    assert_eq!(faults, [0; 5], "{status:?}");
    // A stop out of the tick included, and still far from the tick's time.
    assert!(f64::from(status.worst) * INSTRUCTION < session.tick() / 20.0, "{status:?}");
    assert!(status.late < ON_TIME, "no planning holds a tick up: {status:?}");
}

/// The host runs its own axes through the same late and missed ticks; setpoints are compared to the
/// bit.
#[test]
fn late_ticks_change_nothing_and_missed_ones_stretch_or_stop_the_path() {
    let mut session = begin("mps2");
    let lines = run(&mut session, &FAULTS);
    let status = status(&mut session);
    assert_eq!(status.missed, 1 + 3, "{lines:#?}");
    assert!((4_000..9_000).contains(&status.late), "{status:?}");
    assert_eq!(status.cause, Some(Cause::MissedTicks));
    assert_eq!(status.dropped, 0, "no burst: {status:?}");
    let log = session.log();
    assert!(
        log.iter().any(|(_, line)| line.contains("MissedTicks")) || lines[11].contains("stopped")
    );
}

/// Lateness of a missed tick is not carried along: the ticks keep their phase.
#[test]
fn lateness_of_missed_ticks_does_not_add_up() {
    let mut session = begin("mps2");
    for stall in 1..=6 {
        take(&mut session, "stall 0.025");
        assert_eq!(status(&mut session).missed, stall);
    }
    assert!(status(&mut session).late < 9_000);
}

#[test]
fn a_stall_beyond_what_can_be_granted_is_refused() {
    let mut session = begin("mps2");
    let step: Step = "stall 0.1".parse().expect("a step");
    let error = step.take(&mut session).expect_err("too long").to_string();
    assert_eq!(error, "stall = 0.1 s: must be 0 to 0.065 s in QEMU");
}

/// In virtual time nothing depends on how fast this machine is. An instruction is 1.6 counts of the
/// timer, so that a count of them may be off by one.
#[test]
fn two_runs_are_the_same_to_the_tick() {
    let [(one, lines), (other, again)] = [demonstration(), demonstration()];
    assert_eq!(without_counts(&lines.join("\n")), without_counts(&again.join("\n")));
    assert_eq!(one.compared(), other.compared());
    assert_eq!(one.history(1), other.history(1));
}

#[test]
fn garbage_on_the_line_is_counted_and_changes_nothing() {
    let mut session = begin("mps2");
    take(&mut session, "enable 0");
    take(&mut session, "move 0 quintic 0.8 1.2");
    session.disturb(&[0xff; 90]).expect("the line takes anything");
    session.disturb(&[0, 1, 2, 3, 0, 0, 9, 0]).expect("the line takes anything");
    take(&mut session, "rest");
    assert_eq!(status(&mut session).garbled, 3);
    take(&mut session, "move 0 cubic 1.0 0.2");
    take(&mut session, "rest");
}

#[test]
fn an_axis_that_does_not_exist_is_refused() {
    let mut session = begin("mps2");
    assert_eq!(take(&mut session, "enable 2"), "refused: axis: must be 0 to 1");
}

/// Named angles: the arm stands still while its angle gets another name.
#[test]
fn homing_names_the_angle_and_moves_no_shaft() {
    let mut session = begin("mps2");
    assert!(take(&mut session, "home 0 0.5").contains("accepted"));
    take(&mut session, "enable 0");
    take(&mut session, "wait 0.1");
    let last = session.history(0).last().expect("ticks").setpoint;
    assert_near("angle", last.angle.radians(), 0.5, 1e-6);
    assert!(take(&mut session, "home 0 0").contains("refused: mode = Enabled"));
}
