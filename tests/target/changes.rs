//! Changes of mind over the wire, in lock-step with the host's own.

use std::f64::consts::TAU;

use stillbeam::axis::Mode;
use stillbeam_protocol::{Change, Command};
use stillbeam_sim::talk::{Answer, Session};
use stillbeam_tests::assert_near;

use crate::session::{begin, last, take_all};

/// A target that swings is followed thirty times a second: every setpoint is the host's own, or the
/// conversation would have ended, and the hub is where the target is.
#[test]
fn thirty_targets_a_second_are_tracked_to_the_bit() {
    let mut session = begin("mps2");
    take_all(&mut session, &["enable 0", "wait 0.02"]);
    let middle = last(&session).setpoint.angle.radians();
    // Time of the latest setpoint.
    let begin = session.now();
    let time = |session: &Session| f64::from(session.now() - begin) * session.tick();
    let (turn, omega) = (0.3, TAU * 0.4);
    let mut farthest = 0.0_f64;
    for k in 0..60 {
        let t = time(&session);
        let angle = middle + turn * (1.0 - (omega * t).cos());
        let rate = turn * omega * (omega * t).sin();
        let target = Change::Target { angle, rate, duration: 0.1 };
        let answer = session.ask(0, Command::Change(target)).expect("an answer");
        assert!(matches!(answer, Answer::Accepted(_)), "{answer:?}");
        session.wait(2).expect("ticks");
        let target = middle + turn * (1.0 - (omega * time(&session)).cos());
        let apart = last(&session).setpoint.angle.radians() - target;
        if k > 10 {
            farthest = farthest.max(apart.abs());
        }
    }
    println!("at most {farthest} rad behind the target");
    // Half of the target's acceleration, 1.9 rad/s², times the square of 0.1 s.
    assert!(farthest < 0.01, "{farthest}");
    take_all(&mut session, &["hold 0", "rest"]);
    assert_eq!((last(&session).mode, session.now() > 180), (Mode::Enabled, true));
}

/// Another duration, hold and cancel: what is accepted is the host's own, what waits is dropped or
/// kept as it says, and the axis stays enabled.
#[test]
fn a_move_is_prolonged_held_and_cancelled() {
    let mut session = begin("mps2");
    take_all(
        &mut session,
        &["enable 0", "move 0 quintic 1.5 1.2", "move 0 cubic 1 0.9", "wait 0.4"],
    );
    let said = take_all(&mut session, &["duration 0 1.5"]);
    let tick = said.strip_prefix("accepted before tick ").map(str::parse::<usize>);
    let latest = tick.expect("accepted").expect("a number") - 1;
    take_all(&mut session, &["rest"]);
    let end = session.history(0)[latest + 150].setpoint.angle.radians();
    assert_near("end of the longer move", end, 1.2, 1e-5);
    assert_near("the move behind it", last(&session).setpoint.angle.radians(), 0.9, 1e-5);

    take_all(&mut session, &["move 0 quintic 1 0.4", "move 0 quintic 1 0.8", "wait 0.3"]);
    assert!(take_all(&mut session, &["cancel 0"]).contains("accepted"));
    take_all(&mut session, &["rest"]);
    assert_near("the move under way", last(&session).setpoint.angle.radians(), 0.4, 1e-5);

    take_all(&mut session, &["move 0 quintic 1 1.2", "wait 0.5", "hold 0", "rest"]);
    let held = last(&session);
    assert!((0.5..1.1).contains(&held.setpoint.angle.radians()), "{held:?}");
    assert_eq!(held.mode, Mode::Enabled);
    take_all(&mut session, &["move 0 quintic 1 0", "rest"]);
    assert_near("a move behind it", last(&session).setpoint.angle.radians(), 0.0, 1e-5);
}

#[test]
fn a_change_that_cannot_be_made_is_refused_and_changes_nothing() {
    let mut session = begin("mps2");
    let refused = [
        ("target 0 1 1", "refused: mode = Disabled: enable the axis first"),
        ("hold 0", "refused: mode = Disabled: enable the axis first"),
    ];
    for (step, why) in refused {
        assert_eq!(take_all(&mut session, &[step]), why);
    }
    take_all(&mut session, &["enable 0"]);
    let before = last(&session).setpoint.angle;
    let none = take_all(&mut session, &["duration 0 1"]);
    assert!(none.starts_with("refused: ") && none.contains("move"), "{none}");
    let fast = take_all(&mut session, &["target 0 3 0.2"]);
    assert!(fast.starts_with("refused: limits.rate = "), "{fast}");
    let far = take_all(&mut session, &["target 0 2000 0.2"]);
    assert!(far.starts_with("refused: target.angle = "), "{far}");
    take_all(&mut session, &["wait 0.1"]);
    assert_eq!(last(&session).setpoint.angle, before);
}
