//! With a machine behind each drive: motor, gear, friction and the reference rod, in lock-step.

use stillbeam::axis::Mode;
use stillbeam_sim::talk::{MACHINE, Machine, Session};
use stillbeam_tests::firmware;

use crate::session::{begin, run, status, take};

/// The reference rod behind motor, gear and friction on both drives, in lock-step with QEMU.
fn loaded() -> Session {
    let mut session = loaded_session();
    run(&mut session, &MACHINE);
    session
}

fn loaded_session() -> Session {
    let image = firmware::application("mps2").unwrap_or_else(|error| panic!("{error}"));
    let session = Machine::emulate(&image).and_then(Session::begin_loaded);
    session.unwrap_or_else(|error| panic!("{error}"))
}

/// Every setpoint and frame is the host's own while the encoders' readings come from machines that
/// lag, ring, are jolted and fail; and all of it is the same once more.
#[test]
fn machines_behind_the_drives_are_followed_and_repeat_to_the_bit() {
    let (first, again) = (loaded(), loaded());
    for axis in 0..2 {
        assert_eq!(first.history(axis), again.history(axis));
        assert_eq!(first.followed(axis), again.followed(axis));
        let [behind, energy] = first.followed(axis).expect("a machine");
        println!("axis {axis}: {behind} rad behind, energy {energy:e}");
        assert!(energy < 1e-4, "axis {axis}: {energy:e}");
        assert!(behind > 1e-3, "axis {axis}: {behind} rad");
    }
    // The drive of axis 0 works all along, that of axis 1 faults in the middle of a move.
    let [behind, _] = first.followed(0).expect("a machine");
    assert!(behind < 0.2, "{behind} rad");
    let [setpoints, frames] = first.compared();
    assert!(setpoints > 1000 && frames > 1000, "{setpoints}, {frames}");
}

/// Begins a conversation with loaded drives, and leaves axis 1 `wait` s after the beginning of a
/// move by `turn` rad.
fn moving_session(turn: f64, wait: f64) -> Session {
    let mut session = loaded_session();
    take(&mut session, "enable 1");
    take(&mut session, &format!("move 1 quintic {turn} 0.9"));
    take(&mut session, &format!("wait {wait}"));
    session
}

/// Causes of an axis' stops, in their order, as its ticks were reported.
fn modes(session: &Session, axis: u8, from: usize) -> Vec<Mode> {
    let mut modes: Vec<_> = session.history(axis)[from..].iter().map(|tick| tick.mode).collect();
    modes.dedup();
    modes
}

/// A drive that faults in the middle of a move: the axis brakes along its path and is off, refuses
/// to be enabled until the errors are cleared, and then begins where the shaft is.
#[test]
fn a_drive_that_faults_stops_its_axis_and_is_cleared() {
    let mut session = moving_session(1.0, 0.5);
    let from = session.history(1).len();
    take(&mut session, "fault 1");
    take(&mut session, "wait 0.6");
    let last = session.history(1).last().expect("ticks").number;
    assert_eq!(modes(&session, 1, from), [Mode::Enabled, Mode::Stopping, Mode::Disabled], "{last}");
    assert_eq!(session.drive_is_on(1), Some(false));
    let heard = session.history(1)[from..].iter().position(|tick| tick.mode == Mode::Stopping);
    assert!(heard.expect("it stops") <= 11, "a heartbeat comes every 0.1 s: {heard:?}");
    let refused = take(&mut session, "enable 1");
    assert!(refused.contains("refused: drive.errors = 0x20: must be 0"), "{refused}");
    take(&mut session, "clear 1");
    take(&mut session, "wait 0.2");
    let before = session.history(1).len();
    assert!(take(&mut session, "enable 1").contains("accepted"));
    take(&mut session, "wait 0.3");
    assert_eq!(session.drive_is_on(1), Some(true));
    let [first, last] =
        [session.history(1)[before + 1], *session.history(1).last().expect("ticks")];
    assert_eq!((first.setpoint.rate, last.setpoint.angle), (0.0, first.setpoint.angle));
    // The other axis knows nothing of it.
    assert_eq!(modes(&session, 0, 0), [Mode::Disabled]);
    let log = session.log();
    let logged = |words: &str| log.iter().any(|(_, line)| line.contains(words));
    assert!(logged("axis 1: the drive reports errors 0x20"), "{log:#?}");
}

/// The bus is cut in the middle of a move: the axis stops for want of heartbeats, and is off when
/// the drive comes back and says that its watchdog has switched it off.
#[test]
fn a_cut_bus_stops_the_axis() {
    let mut session = moving_session(2.0, 0.5);
    let from = session.history(1).len();
    take(&mut session, "cut 1");
    take(&mut session, "wait 1.2");
    assert_eq!(modes(&session, 1, from), [Mode::Enabled, Mode::Stopping, Mode::Stopped]);
    let stops = session.history(1)[from..].iter().position(|tick| tick.mode == Mode::Stopping);
    assert!((25..=36).contains(&stops.expect("it stops")), "{stops:?}: 0.35 s after a heartbeat");
    let refused = take(&mut session, "enable 1");
    assert!(refused.contains("refused: drive = silent: its heartbeat must come"), "{refused}");
    take(&mut session, "mend 1");
    take(&mut session, "wait 0.2");
    assert_eq!(session.history(1).last().expect("ticks").mode, Mode::Disabled);
    let refused = take(&mut session, "enable 1");
    assert!(refused.contains("drive.errors = 0x1000000"), "{refused}");
}

/// An encoder that jumps shakes the machine and no setpoint: the hub comes to rest beside its
/// setpoint by what the encoder is off.
#[test]
fn an_encoder_that_jumps_moves_no_setpoint() {
    let ends = [0.0, 0.004].map(|turns| {
        let mut session = moving_session(1.0, 0.4);
        take(&mut session, &format!("jump 1 {turns}"));
        take(&mut session, "rest");
        take(&mut session, "wait 0.5");
        assert_eq!(modes(&session, 1, 0), [Mode::Disabled, Mode::Enabled]);
        (session.history(1).to_vec(), session.followed(1).expect("a machine")[0])
    });
    let [(even, quiet), (shaken, jolted)] = ends;
    assert_eq!(even, shaken);
    assert_ne!(jolted, quiet, "the hub feels it");
}

/// The conversation about faults over and over, three rounds: every setpoint and frame is the
/// host's own, every round is refused the same, and no tick is late. Without the machines behind
/// the drives, which take most of the time. docs/drive.md has the hour.
#[test]
fn rounds_in_the_loop_do_not_drift() {
    let duration = 20.0;
    let mut session = begin("mps2");
    let steps: Vec<&str> = MACHINE.into_iter().filter(|step| !step.starts_with("jump")).collect();
    let mut lines = Vec::new();
    stillbeam_sim::talk::endure(&mut session, &steps, duration, &mut |line| {
        lines.push(line.to_owned());
    })
    .unwrap_or_else(|error| panic!("{error}: {lines:#?}"));
    let ticks = duration / session.tick();
    let [setpoints, frames] = session.compared();
    assert!(setpoints as f64 >= 2.0 * ticks && frames as f64 > ticks, "{setpoints}, {frames}");
    let status = status(&mut session);
    let faults = [status.missed, status.early, status.overruns, status.dropped, status.garbled];
    assert_eq!(faults, [0; 5], "{status:?}");
    // The firmware's own count of ticks, before the one that it answered in.
    let behind = session.now().wrapping_sub(status.clock);
    assert!(behind <= 1, "{behind} ticks: {lines:#?}");
}
