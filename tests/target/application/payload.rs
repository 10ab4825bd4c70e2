//! Payloads: those that the build has prepared are picked, others need the feature `set-up`. Torque
//! and tip of every setpoint are compared with those of the host's arm, which has been set up.

use stillbeam_sim::talk::Session;

use crate::session::{ON_TIME, begin, run, status, take};

/// Swings an axis with a plain and a still move.
#[track_caller]
fn swing(session: &mut Session, axis: u8) {
    let steps = [
        format!("move {axis} quintic 0.9 1.2"),
        "rest".to_owned(),
        format!("still {axis} 0.2 1.3"),
        "rest".to_owned(),
    ];
    for step in &steps {
        let said = take(session, step);
        assert!(!said.contains("refused"), "{step}: {said}");
    }
}

/// Nothing changes: the next setpoints are those of the host's arm, which keeps its payload.
#[test]
fn a_payload_that_was_not_prepared_is_refused_with_those_that_were() {
    let mut session = begin("mps2");
    take(&mut session, "enable 0");
    swing(&mut session, 0);
    let refused = take(&mut session, "payload 0 0.04");
    let why = "refused: payload.mass = 0.04 kg: must be one that is prepared: 0.03 kg, 0.05 kg; or \
               use a firmware with the feature `set-up`";
    assert_eq!(refused, why);
    // Another axis' payload is no payload of this one.
    let refused = take(&mut session, "payload 0 0.08");
    assert!(refused.contains("payload.mass = 0.08 kg"), "{refused}");
    swing(&mut session, 0);
}

/// There and back again, on both axes: arm and planner are the host's, and no tick is late.
#[test]
fn a_prepared_payload_is_picked_to_the_bit() {
    let mut session = begin("mps2");
    run(&mut session, &["enable 0", "enable 1"]);
    for masses in [["0.05", "0.08"], ["0.03", "0.05"]] {
        for (axis, mass) in [0, 1].into_iter().zip(masses) {
            let said = take(&mut session, &format!("payload {axis} {mass}"));
            assert!(said.contains("accepted"), "{said}");
            swing(&mut session, axis);
        }
    }
    let status = status(&mut session);
    assert_eq!([status.missed, status.overruns, status.dropped], [0; 3], "{status:?}");
    assert!(status.late < ON_TIME, "{status:?}");
}

/// Without a table: any payload, and a planner for it.
#[test]
fn a_firmware_that_sets_up_takes_any_payload() {
    let mut session = begin("mps2,set-up");
    take(&mut session, "enable 0");
    let said = take(&mut session, "payload 0 0.0417");
    assert!(said.contains("accepted"), "{said}");
    swing(&mut session, 0);
    let refused = take(&mut session, "payload 0 -1");
    assert!(refused.starts_with("refused: payload.mass = -1 kg: must be 0 to "), "{refused}");
}
