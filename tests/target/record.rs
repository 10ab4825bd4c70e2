//! Recordings of the application: from the board to an arm.

use std::fs;
use std::path::PathBuf;

use stillbeam::Scene;
use stillbeam::axis::Mode;
use stillbeam_protocol::Command;
use stillbeam_sim::identify::{Identified, Request};
use stillbeam_sim::talk::{self, Answer, Excitation, Recording, Session};
use stillbeam_tests::{assert_near, root};

use crate::session::{ON_TIME, begin};

/// Arm behind the stand-in's sensor of axis 1: natural frequency, Hz, and damping ratio.
const FREQUENCY: f64 = 2.84;
const DAMPING_RATIO: f64 = 0.011;

fn record(session: &mut Session, excitation: Excitation) -> Recording {
    talk::record(session, 1, excitation, None).unwrap_or_else(|error| panic!("{error}"))
}

/// Writes a log as `talk --record` does and identifies it as it is, with the arm of `axes.rs`.
fn identify(session: &Session, recording: &Recording, name: &str) -> Identified {
    let path: PathBuf = root().join("target/firmware").join(name);
    let mut text = Vec::new();
    recording.write(&mut text).expect("a vector takes anything");
    fs::write(&path, text).expect("the folder of the images");
    let arm = Scene::from(*session.replica(1).expect("an axis").scene());
    let scene = Some(("axes.rs".to_owned(), arm));
    let request = Request { logs: vec![path], scene, ..Request::default() };
    request.carry_out().unwrap_or_else(|error| panic!("{error}"))
}

/// The arm that is documented has another frequency than the one whose sensor is read; the log
/// tells it, and the fitted arm has it.
#[test]
fn a_log_of_the_board_tells_the_arm_that_its_sensor_shows() {
    for (excitation, name) in [(Excitation::Cubic, "cubic.csv"), (Excitation::Sweep, "sweep.csv")] {
        let mut session = begin("mps2");
        let recording = record(&mut session, excitation);
        let Identified { report, .. } = identify(&session, &recording, name);
        println!("{name}: {} samples, {report:#?}", recording.samples.len());
        let mode = &report.modes[0];
        assert_eq!(report.case, "forced");
        assert_near("frequency", mode.frequency_hz, FREQUENCY, 1e-4 * FREQUENCY);
        assert_near("damping", mode.damping_ratio, DAMPING_RATIO, 0.01 * DAMPING_RATIO);
        assert!(report.fit_percent > 99.0, "{name}: {}", report.fit_percent);
        assert!(report.warnings.is_empty(), "{name}: {:#?}", report.warnings);
        let arm = report.arm.expect("a scene was given");
        let [documented, fitted] =
            [arm.documented_frequency_hz[0], arm.fitted_frequency_hz[0]].map(|f| f / FREQUENCY);
        assert!((documented - 1.0).abs() > 0.02, "{name}: the arm of axes.rs is another");
        assert_near("fitted", fitted, 1.0, 2e-4);
    }
}

/// A row for every tick from the beginning to the end of the motion, none lost: hub angles are the
/// drive's, which follows the setpoints, and times are those of the ticks.
#[test]
fn every_tick_of_the_motion_is_in_the_log() {
    let mut session = begin("mps2");
    let recording = record(&mut session, Excitation::Cubic);
    assert_eq!((recording.column.as_str(), recording.lost), ("tip_deflection_m", 0));
    for (k, sample) in recording.samples.iter().enumerate() {
        let late = sample.time - 10_000 * k as u32;
        assert!(late < ON_TIME, "row {k}: {} us", sample.time);
    }
    let hub: Vec<f64> = recording.samples.iter().map(|s| s.hub.radians()).collect();
    let history = session.history(1);
    let moves = |angles: &[f64]| angles.windows(2).position(|pair| pair[0] != pair[1]);
    let setpoints: Vec<f64> = history.iter().map(|tick| tick.setpoint.angle.radians()).collect();
    let on = history.iter().position(|tick| tick.mode == Mode::Enabled).expect("it was enabled");
    let first = on + moves(&setpoints[on..]).expect("it was moved");
    let offset = first + 1 - moves(&hub).expect("it was moved");
    assert!(hub.len() > 400, "{}", hub.len());
    for (k, angle) in hub.iter().enumerate() {
        assert_near("hub", *angle, setpoints[offset + k - 1], 2e-6);
    }
    assert_eq!(session.drive_is_on(1), Some(false), "it is switched off again");
}

/// A refusal comes before the arm moves, and names what it must be.
#[test]
fn a_recording_that_cannot_be_made_is_refused_before_the_arm_moves() {
    let mut session = begin("mps2");
    let mut refuse = |axis, turn| {
        let refused = talk::record(&mut session, axis, Excitation::Cubic, Some(turn));
        refused.expect_err("it cannot be made").to_string()
    };
    assert_eq!(refuse(2, 0.1), "--axis = 2: must be 0 to 1");
    let error = refuse(1, 1.5);
    assert!(error.starts_with("--turn = 1.5 rad: must be above 0 and at most "), "{error}");
    assert!(session.history(1).iter().all(|tick| tick.mode == Mode::Disabled));
}

/// A host that is gone ends its recording: the board sends no rows to nobody.
#[test]
fn a_lost_link_ends_the_recording() {
    let mut session = begin("mps2");
    let ask = |session: &mut Session, command| session.ask(0, command).expect("an answer");
    assert!(matches!(ask(&mut session, Command::Enable), Answer::Accepted(_)));
    let begun = ask(&mut session, Command::Record(true));
    assert_eq!(begun, Answer::Recording("tip_deflection_m".to_owned()));
    session.keep_silent(80).expect("ticks");
    let ended = ask(&mut session, Command::Record(false));
    assert_eq!(ended, Answer::Recorded { samples: 0, lost: 0 });
    let again = ask(&mut session, Command::Record(true));
    assert_eq!(again, Answer::Refused("mode = Stopped: enable the axis first".to_owned()));
}
