//! The application in QEMU, in lock-step with the host: every setpoint and every drive frame is
//! compared bit for bit. The board it is built for and has not run on.

use std::path::Path;

use stillbeam::axis::Mode;
use stillbeam_lab::markers;
use stillbeam_protocol::{Command, Status};
use stillbeam_sim::talk::{
    Answer, DEMONSTRATION, FAULTS, FIRST, MACHINE, Machine, STILL, Session, Step,
};
use stillbeam_tests::firmware_page::{FITTED, Fit};
use stillbeam_tests::{assert_near, firmware, firmware_page, image, root};

/// Whole application on the emulated board. Until arms had joints that give, offset payloads and
/// mounts it was 64 and 16 KiB; 68 KiB of flash until drives were watched and moves held against their
/// frames, until it recorded and took changes of mind.
const FLASH: u64 = 77 * 1024;
const RAM: u64 = 19 * 1024;
/// With the planner of still moves: until then 116 and 32 KiB, and 128 KiB of flash.
const STILL_FLASH: u64 = 135 * 1024;
const STILL_RAM: u64 = 41 * 1024;

/// Time of an instruction of the emulated board, s.
const INSTRUCTION: f64 = 64e-9;

fn begin() -> Session {
    begin_with("mps2")
}

fn begin_with(features: &str) -> Session {
    let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
    Machine::emulate(&image).and_then(Session::begin).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn take(session: &mut Session, text: &str) -> String {
    let step: Step = text.parse().unwrap_or_else(|error| panic!("{error}"));
    step.take(session).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[track_caller]
fn status(session: &mut Session) -> Status {
    match session.ask(0, Command::Status) {
        Ok(Answer::Status(status)) => status,
        other => panic!("{other:?}"),
    }
}

/// The demonstration, what came of each step, and what was logged.
fn demonstration() -> (Session, Vec<String>) {
    let mut session = begin();
    let lines = run(&mut session, &DEMONSTRATION);
    (session, lines)
}

fn run(session: &mut Session, steps: &[&str]) -> Vec<String> {
    steps.iter().map(|text| format!("{text}: {}", take(session, text))).collect()
}

/// The reference rod behind motor, gear and friction on both drives, in lock-step with QEMU.
fn loaded() -> Session {
    let mut session = loaded_session();
    run(&mut session, &MACHINE);
    session
}

fn loaded_session() -> Session {
    let image = firmware::application("mps2").unwrap_or_else(|error| panic!("{error}"));
    Machine::emulate(&image)
        .and_then(Session::begin_loaded)
        .unwrap_or_else(|error| panic!("{error}"))
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
    let mut session = loaded_session();
    for step in ["enable 1", "move 1 quintic 1.0 0.9", "wait 0.5"] {
        take(&mut session, step);
    }
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
    let mut session = loaded_session();
    for step in ["enable 1", "move 1 quintic 2.0 0.9", "wait 0.5"] {
        take(&mut session, step);
    }
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
        let mut session = loaded_session();
        for step in ["enable 1", "move 1 quintic 1.0 0.9", "wait 0.4"] {
            take(&mut session, step);
        }
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

/// A minute of the conversation about faults, over and over: every setpoint and frame is the host's
/// own, every round is refused the same, and no tick is late. Without the machines behind the
/// drives, which take most of the time.
#[test]
fn a_minute_in_the_loop_does_not_drift() {
    let mut session = begin();
    let steps: Vec<&str> = MACHINE.into_iter().filter(|step| !step.starts_with("jump")).collect();
    let mut lines = Vec::new();
    stillbeam_sim::talk::endure(&mut session, &steps, 60.0, &mut |line| {
        lines.push(line.to_owned());
    })
    .unwrap_or_else(|error| panic!("{error}: {lines:#?}"));
    let ticks = 60.0 / session.tick();
    let [setpoints, frames] = session.compared();
    assert!(setpoints as f64 >= 2.0 * ticks && frames as f64 > ticks, "{setpoints}, {frames}");
    let status = status(&mut session);
    let faults = [status.missed, status.early, status.overruns, status.dropped, status.garbled];
    assert_eq!(faults, [0; 5], "{status:?}");
    // The firmware's own count of ticks, before the one that it answered in.
    let behind = session.now().wrapping_sub(status.clock);
    assert!(behind <= 1, "{behind} ticks: {lines:#?}");
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
    assert!(status.late < 100, "no planning holds a tick up: {status:?}");
}

/// Every setpoint of a still move that the target has planned is the host's own plan's, or the
/// conversation would have ended with an error.
#[test]
fn still_moves_are_planned_on_the_target_while_ticks_and_drives_go_on() {
    let mut session = begin_with("mps2,still");
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
    assert!(session.now() > 200 && status.late < 100, "{status:?}");
    assert_eq!([status.missed, status.overruns, status.dropped], [0; 3], "{status:?}");
}

/// A plan takes many ticks on this board; a stop that comes meanwhile acts at once, and the plan
/// that it makes stale is refused.
#[test]
fn a_stop_does_not_wait_for_a_plan() {
    let mut session = begin_with("mps2,still");
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

#[test]
fn a_firmware_without_the_planner_says_so() {
    let mut session = begin();
    take(&mut session, "enable 0");
    let said = take(&mut session, "still 0 1.0");
    assert!(said.contains("refused: still = no planner"), "{said}");
}

/// Requests that the planner has no room for are refused at once.
#[test]
fn a_busy_planner_says_so() {
    let mut session = begin_with("mps2,still");
    take(&mut session, "enable 0");
    let still = Command::Still { to: 1.0, duration: None };
    let posted: Vec<_> = (0..4).map(|_| session.post(0, still).expect("sent")).collect();
    let last = *posted.last().expect("four");
    // Two wait for the planner, which has not begun.
    let Ok(Answer::Refused(why)) = session.answer(last) else { panic!("there is no room") };
    assert_eq!(why, "planner = busy: wait until it has answered");
}

/// The host runs its own axes through the same late and missed ticks; setpoints are compared to the
/// bit.
#[test]
fn late_ticks_change_nothing_and_missed_ones_stretch_or_stop_the_path() {
    let mut session = begin();
    let lines = run(&mut session, &FAULTS);
    let status = status(&mut session);
    assert_eq!(status.missed, 1 + 3, "{lines:#?}");
    assert!((4_000..9_000).contains(&status.late), "{status:?}");
    assert_eq!(status.cause, Some(stillbeam::axis::Cause::MissedTicks));
    assert_eq!(status.dropped, 0, "no burst: {status:?}");
    let log = session.log();
    assert!(
        log.iter().any(|(_, line)| line.contains("MissedTicks")) || lines[11].contains("stopped")
    );
}

/// What a missed tick is late by is not carried along: the ticks keep their phase.
#[test]
fn lateness_of_missed_ticks_does_not_add_up() {
    let mut session = begin();
    for stall in 1..=6 {
        take(&mut session, "stall 0.025");
        assert_eq!(status(&mut session).missed, stall);
    }
    assert!(status(&mut session).late < 9_000);
}

#[test]
fn a_stall_beyond_what_can_be_granted_is_refused() {
    let mut session = begin();
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
    let mut session = begin();
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
    let mut session = begin();
    assert_eq!(take(&mut session, "enable 2"), "refused: axis: must be 0 to 1");
}

/// Named angles: the arm stands still while its angle gets another name.
#[test]
fn homing_names_the_angle_and_moves_no_shaft() {
    let mut session = begin();
    assert!(take(&mut session, "home 0 0.5").contains("accepted"));
    take(&mut session, "enable 0");
    take(&mut session, "wait 0.1");
    let last = session.history(0).last().expect("ticks").setpoint;
    assert_near("angle", last.angle.radians(), 0.5, 1e-6);
    assert!(take(&mut session, "home 0 0").contains("refused: mode = Enabled"));
}

#[test]
fn the_application_keeps_its_budgets() {
    let images = [
        ("mps2", &DEMONSTRATION[..], FLASH, RAM),
        ("mps2,still", &STILL[..], STILL_FLASH, STILL_RAM),
    ];
    for (features, steps, flash, ram) in images {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        let mut session = begin_with(features);
        run(&mut session, steps);
        let stack = u64::from(status(&mut session).stack);
        println!("{features}: {footprint:?}, stack {stack}");
        assert!(footprint.flash <= flash, "{features}: {footprint:?}");
        assert!(stack > 1000, "the paint was really there: {stack}");
        // Statics grow up, the stack down: what is left between them is still painted.
        assert!(footprint.ram + stack < ram, "{features}: {footprint:?}, stack {stack}");
    }
}

/// A stop may come out of any tick; no panic may.
#[test]
fn no_panic_is_reachable_from_an_axis_tick() {
    let image = firmware::build("no_panic_axis").unwrap_or_else(|error| panic!("{error}"));
    let functions = image::functions(&image).unwrap_or_else(|error| panic!("{error}"));
    // The ticks are really in there.
    assert!(functions.iter().any(|name| name.contains("axis")), "{functions:#?}");
    let error =
        firmware::build_with("no_panic_axis", "STILLBEAM_FAULT", "panic").expect_err("a panic");
    assert!(error.contains("panic-never"), "{error}");
}

/// Built and measured, not run: there are no such boards here, and QEMU has none.
#[test]
fn the_nucleo_boards_build_and_fit() {
    for (features, flash) in [
        ("nucleo-g474re", 96 * 1024),
        ("nucleo-g474re,still", 154 * 1024),
        ("nucleo-g491re", 96 * 1024),
    ] {
        let image = firmware::application(features).unwrap_or_else(|error| panic!("{error}"));
        let footprint = image::footprint(&image).unwrap_or_else(|error| panic!("{error}"));
        println!("{features}: {footprint:?}");
        assert!((20_000..flash).contains(&footprint.flash), "{footprint:?}");
        assert!(footprint.ram < 16 * 1024, "{footprint:?}");
    }
}

/// The page says what happens. Instruction counts and sizes may be off by what a change of the code
/// makes until the page is written anew; everything else is as it stands there.
#[test]
fn the_pages_are_what_the_firmware_does() {
    // The table of axes has a test of its own.
    let blocks = firmware_page::blocks().unwrap_or_else(|error| panic!("{error}"));
    let page = std::fs::read_to_string(root().join("docs/firmware.md")).expect("docs/firmware.md");
    let written = firmware_page::replace(&page, &blocks).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(without_counts(&page), without_counts(&written), "write the page anew");
    for block in blocks {
        assert!(markers::has(&page, &block.name), "{} has no place", block.name);
    }
}

/// The table of axes holds every method, its arithmetic is right, and a method of each end is
/// counted again: to 2 %, as the instruction table is.
#[test]
fn as_many_axes_fit_as_the_page_says() {
    let page = std::fs::read_to_string(root().join("docs/firmware.md")).expect("docs/firmware.md");
    let table = markers::block(&page, "axes").expect("the table of axes");
    let rows: Vec<&str> = table.lines().skip(2).take_while(|line| line.starts_with('|')).collect();
    assert_eq!(rows.len(), FITTED.len(), "{rows:#?}");
    for ((name, id), row) in FITTED.into_iter().zip(rows) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let count = |i: usize| cells[i].parse().unwrap_or_else(|_| panic!("{row}"));
        let written = Fit { moving: count(2), worst: count(3) };
        assert_eq!(row.to_owned() + "\n", firmware_page::row(name, &written));
        if ["Newmark1Nodal", "Elastica2"].contains(&id) {
            let counted = firmware_page::fit(id).unwrap_or_else(|error| panic!("{error}"));
            for (was, is) in [(written.moving, counted.moving), (written.worst, counted.worst)] {
                assert!(was.abs_diff(is) * 50 <= was, "{name}: {counted:?}, write the page anew");
            }
        }
    }
}

/// What is counted for the table of axes is what the application's tick costs, to 8 %: the
/// application's also watches the heartbeats of its drives.
#[test]
fn the_image_that_counts_axes_stands_for_the_application() {
    let fit = firmware_page::fit("Newmark1Nodal").unwrap_or_else(|error| panic!("{error}"));
    let mut session = begin();
    for step in ["enable 0", "enable 1", "move 0 s-curve 1.2 1.5", "move 1 s-curve 1.2 1.5", "rest"]
    {
        let said = take(&mut session, step);
        assert!(!said.contains("refused"), "{step}: {said}");
    }
    let own = status(&mut session).worst;
    println!("application {own}, {fit:?}");
    assert!(own.abs_diff(fit.moving) * 12 <= own, "application {own}, {fit:?}");
}

/// Lines that hold counts of instructions or bytes, with every number as `#`. How long a plan
/// takes, by a tick or two, is such a count too, and all that is said after a plan is said that
/// much later.
fn without_counts(page: &str) -> Vec<String> {
    let mut planned = false;
    let mut kept = Vec::new();
    for line in page.lines() {
        planned = (planned || line == "<!-- lab:still -->") && line != "<!-- /lab -->";
        let reported = planned && line.contains(" | ");
        if planned || line.contains("instructions") || line.starts_with('|') {
            let parts = line.split(|c: char| c.is_ascii_digit() || planned && c == ' ');
            let parts: Vec<_> = parts.filter(|part| !part.is_empty()).collect();
            kept.extend((!reported).then(|| parts.join("#")));
        } else {
            kept.push(line.to_owned());
        }
    }
    kept
}

#[test]
fn a_missing_image_is_named_with_how_to_build_it() {
    let Err(error) = Machine::emulate(Path::new("no-such-image")) else { panic!("it is missing") };
    let error = error.to_string();
    assert!(error.contains("no-such-image") && error.contains("--profile application"), "{error}");
}

/// The method stands in `axes.rs` and nowhere else: the host runs whichever the firmware names.
#[test]
fn another_method_is_one_line_in_axes() {
    for method in ["Modal2", "Elastica2"] {
        let change = ["stillbeam_methods::Newmark1Nodal", &format!("stillbeam_methods::{method}")];
        let image = firmware::changed_application("mps2", method, change)
            .unwrap_or_else(|error| panic!("{error}"));
        let mut session = Machine::emulate(&image)
            .and_then(Session::begin)
            .unwrap_or_else(|error| panic!("{method}: {error}"));
        let lines = run(&mut session, &FIRST);
        let [setpoints, frames] = session.compared();
        assert!(setpoints > 100 && frames > 50, "{method}: {setpoints}, {frames}, {lines:#?}");
        assert!(lines.iter().any(|line| line.contains("stopped")), "{method}: {lines:#?}");
        let status = status(&mut session);
        assert_eq!([status.missed, status.early, status.overruns], [0; 3], "{method}: {status:?}");
    }
}

/// The tick stands in `axes.rs` and nowhere else: at another one a missed tick is found, and half a
/// second of silence is half a second. In 2 ms the emulated board does not get its first setpoints
/// out.
#[test]
fn another_tick_is_one_line_in_axes() {
    let tick = 0.005;
    let change = ["TICK: f64 = 0.010", "TICK: f64 = 0.005"];
    let image = firmware::changed_application("mps2", "5ms", change)
        .unwrap_or_else(|error| panic!("{error}"));
    let mut session =
        Machine::emulate(&image).and_then(Session::begin).unwrap_or_else(|error| panic!("{error}"));
    assert_near("tick", session.tick(), tick, 0.0);
    take(&mut session, "enable 0");
    take(&mut session, "move 0 quintic 1.7 1.57");
    take(&mut session, "wait 0.3");
    take(&mut session, "stall 0.012");
    assert_eq!(status(&mut session).missed, 1);
    take(&mut session, "rest");
    let heard = session.now();
    take(&mut session, "silence 0.6");
    let lost =
        session.history(0).iter().find(|tick| tick.mode != Mode::Enabled && tick.number > heard);
    let silent = lost.expect("the link is lost").number - heard;
    assert!((80..=120).contains(&silent), "{silent} ticks of 5 ms, 0.5 s after the last heartbeat");
}

/// An image names its board: one of another board is no image to run in QEMU.
#[test]
fn an_image_of_another_board_is_refused() {
    let image = firmware::application("nucleo-g474re").unwrap_or_else(|error| panic!("{error}"));
    let Err(error) = Machine::emulate(&image) else { panic!("it is for another board") };
    let error = error.to_string();
    assert!(error.contains("board = nucleo-g474re: must be mps2"), "{error}");
    assert!(error.contains("--features mps2"), "{error}");
}

/// The golden run names no board: it is not taken for the application.
#[test]
fn another_image_is_refused() {
    let image = firmware::build("golden").unwrap_or_else(|error| panic!("{error}"));
    let Err(error) = Machine::emulate(&image) else { panic!("it is not the application") };
    assert!(error.to_string().contains("no board is named in it"), "{error}");
}
