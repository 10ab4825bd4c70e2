//! Worth of feed-forward: the figures that are promised, and the order that is explained.

use stillbeam_sim::scenes;
use stillbeam_sim::servo::bench::{Bench, Feed};
use stillbeam_sim::servo::setpoints::Setpoints;
use stillbeam_sim::servo::trials::{Outcome, Report, Trial, Unknown};
use stillbeam_sim::servo::{Between, Machine, Protocol, moving};

const POSITION: Trial = Trial { feed: Feed::POSITION, ..Trial::PLAIN };
const VELOCITY: Trial = Trial { feed: Feed::VELOCITY, ..Trial::PLAIN };
const LINEAR: Trial = Trial { between: Some(Between::Linear), ..Trial::PLAIN };

fn report(machine: &Machine, trials: &[Trial]) -> Report {
    let scene = scenes::open("d-tip30-quick").expect("an embedded scene");
    Report::of(&scene, machine, trials, &|| ()).expect("a report")
}

fn of<'a>(report: &'a Report, trial: &Trial) -> &'a Outcome {
    let outcome = report.find(trial).expect("a row");
    let error = outcome.trace.energy_error;
    assert!(error < 1e-6, "{trial:?}: energy off by {error:e}");
    outcome
}

/// An ODrive with its own gains, a little friction, 10 ms setpoints. A velocity without the torque
/// that it takes makes the loop of so soft a drive no better; torque does, and most of what is left
/// is the hold between setpoints.
#[test]
fn torque_is_worth_more_than_ten_times_on_default_gains() {
    let report = report(&Machine::default(), &[POSITION, VELOCITY, Trial::PLAIN, LINEAR]);
    let hub = |trial: &Trial| of(&report, trial).judged.hub;
    let [position, velocity, held, linear] =
        [POSITION, VELOCITY, Trial::PLAIN, LINEAR].map(|trial| hub(&trial));
    println!("{position} {velocity} {held} {linear}");
    // A linear prototype with another friction had 1.24, 1.35, 0.080 and 0.030 rad.
    assert!((position - 1.24).abs() < 0.05 && (velocity - 1.35).abs() < 0.05);
    assert!(held < 0.08 && linear < 0.03 && linear < held);
    assert!(held < 0.1 * position && velocity > position);
    let text = report.conclusion();
    assert!(text.starts_with("feed-forward makes the hub's largest error 24 times"), "{text}");
}

/// The same with gains for the arm: a still move leaves what it promises, and with a payload that
/// is off by 10 % what the planner says that it is sensitive to.
#[test]
fn a_stiff_drive_leaves_what_the_planner_says() {
    let machine = Machine::open("odrive-tuned").expect("a machine");
    let payload = |factor| Trial { unknown: Unknown::Payload(factor), ..Trial::STILL };
    let trials = [POSITION, Trial::PLAIN, Trial::STILL, payload(0.9), payload(1.1)];
    let report = report(&machine, &trials);
    assert!(report.no_still.is_none(), "{:?}", report.no_still);
    let hub = |trial: &Trial| of(&report, trial).judged.hub;
    assert!(hub(&Trial::PLAIN) < 0.1 * hub(&POSITION));
    let text = report.conclusion();
    assert!(!text.contains(" 0.000 ") && !text.contains(" 0.00 "), "digits are lost: {text}");
    let still = of(&report, &Trial::STILL).judged.residual;
    assert!(still < 1e-3, "{still}");
    // Its page shows the same: the arm that is still stays, the others swing on.
    let animation = moving::animation(&report);
    let swings = animation.panels.iter().map(|panel| {
        let rest = panel.arms[0].frames.iter().rev().take(20);
        let swung = rest.map(|frame| frame.deflections[0].abs());
        swung.fold(0.0, f64::max) / report.arm.link.length
    });
    let swings: Vec<f64> = swings.collect();
    assert!(swings[0] > 0.1 && swings[1] > 0.1 && swings[2] < 1e-3, "{swings:?}");
    for factor in [0.9, 1.1] {
        let outcome = of(&report, &payload(factor));
        let ratio = outcome.judged.residual / outcome.exact;
        println!("{factor}: {} of {}", outcome.judged.residual, outcome.exact);
        assert!((ratio - 1.0).abs() < 0.2, "{factor}: {ratio} of the planner's sensitivity");
    }
}

/// A gear with compliance, backlash and cogging; a CiA 402 drive.
#[test]
fn other_machines_gain_too() {
    let geared = Machine::open("geared").expect("a machine");
    let cia402 =
        Machine { drive: Protocol::named("cia402").expect("a drive"), ..Machine::default() };
    for machine in [geared, cia402] {
        let report = report(&machine, &[POSITION, LINEAR]);
        let [position, linear] = [POSITION, LINEAR].map(|trial| of(&report, &trial).judged.hub);
        assert!(linear < 0.05 * position, "{}: {position}, {linear}", machine.drive.name());
    }
}

/// The same run twice is the same to the bit, and a velocity that no frame holds is refused before
/// the first setpoint.
#[test]
fn runs_repeat_and_frames_are_not_saturated() {
    let mut scene = scenes::open("d-tip30-quick").expect("an embedded scene");
    scene.moves[0].settle = 0.0;
    let setpoints = Setpoints::of(&scene).expect("setpoints");
    let options = stillbeam_sim::plant::Options { order: 5, tolerance: 1e-6 };
    let mut machine = Machine::default();
    let bench =
        |machine: &Machine| Bench::new(&scene.arm, machine, &setpoints, Feed::ALL, &options);
    let run = || bench(&machine).expect("a bench").run().expect("a run");
    assert_eq!(run().shown, run().shown);
    machine.parts.gear.ratio.motor = 20;
    let error = bench(&machine).err().expect("too fast").to_string();
    assert!(error.starts_with("drive.velocity = 3"), "{error}");
    assert!(error.contains("must be -32.767 to 32.767 turn/s, what its frame holds"), "{error}");
}
