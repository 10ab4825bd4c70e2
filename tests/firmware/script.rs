//! Requests to the firmware in words.

use stillbeam::motion::{Spline, Waypoint};
use stillbeam::{Payload, PlainMove, Profile};
use stillbeam_protocol::{Change, Command};
use stillbeam_sim::talk::{DEMONSTRATION, FAULTS, FIRST, STILL, Step};

#[test]
fn words_are_steps() {
    let step = |text: &str| text.parse::<Step>().unwrap();
    let profile = Profile::SCurve;
    let motion = PlainMove::To { profile, duration: 0.8, to: -1.5 };
    assert_eq!(step(" move 1  s-curve 0.8 -1.5 "), Step::Ask(1, Command::Move(motion)));
    let payload = Payload { mass: 0.05, inertia: 0.0, offset: 0.0 };
    assert_eq!(step("payload 0 0.05"), Step::Ask(0, Command::Payload(payload)));
    assert_eq!(step("wait 0.35"), Step::Wait(0.35));
    assert_eq!(step("stop 3"), Step::Ask(3, Command::Stop));
    assert_eq!(step("still 0 1.5"), Step::Ask(0, Command::Still { to: 1.5, duration: None }));
    let timed = Command::Still { to: 1.5, duration: Some(0.9) };
    assert_eq!(step("still 0 1.5 0.9"), Step::Ask(0, timed));
    assert_eq!(step("stall 0.014"), Step::Stall(0.014));
    let change = |change| Step::Ask(0, Command::Change(change));
    let target = |rate| change(Change::Target { angle: 1.5, rate, duration: 0.9 });
    assert_eq!(step("target 0 1.5 0.9"), target(0.0));
    assert_eq!(step("target 0 1.5 0.9 -0.2"), target(-0.2));
    assert_eq!(step("duration 0 0.7"), change(Change::Duration(0.7)));
    assert_eq!(step("path 1 quintic"), Step::Ask(1, Command::Path(Spline::Quintic)));
    let row = |row, last| Step::Ask(0, Command::Waypoint { row, last });
    assert_eq!(step("row 0 0.5 -0.3"), row(Waypoint::at(0.5, -0.3), false));
    assert_eq!(step("last 0 0.5 1 0.2"), row(Waypoint::at(0.5, 1.0).turning(0.2), true));
    assert_eq!(step("hold 0"), change(Change::Hold));
    assert_eq!(step("cancel 0"), change(Change::Cancel));
    for text in [&DEMONSTRATION[..], &FIRST, &STILL, &FAULTS].concat() {
        step(text);
    }
}

#[test]
fn what_is_no_step_is_named_with_what_it_must_be() {
    for bad in [
        "",
        "jump 0",
        "move",
        "move 0 cubic 1",
        "move x cubic 1 1",
        "stop 300",
        "rest 1",
        "still 0 1 x",
        "target 0 1",
        "target 0 1 1 x",
        "hold 0 1",
        "path 0 linear",
        "row 0 1",
        "last 0 1 2 x",
    ] {
        let error = bad.parse::<Step>().unwrap_err().to_string();
        assert!(error.starts_with(&format!("step = \"{bad}\": must be enable A,")), "{error}");
        assert!(!error.contains('\n'));
    }
}
