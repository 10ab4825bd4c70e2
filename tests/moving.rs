//! Arms and mechanisms that are drawn as they move.

use stillbeam::{Limits, Move, Profile};
use stillbeam_sim::animation::{INTERVALS, Panel};
use stillbeam_sim::mechanism::table::Row;
use stillbeam_sim::mechanism::{self, MechanismScene};
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::plan::{self, Options, Request};
use stillbeam_sim::scenes;

#[test]
fn both_arms_end_where_they_shall_and_one_is_still() {
    let arm = scenes::open("b-tip30").expect("a scene").arm;
    let (limits, options, tick) = (Limits::default(), Options::default(), 0.01);
    let (from, to, duration, robust) = (0.0, 1.2, Some(1.0), None);
    let request = Request { arm, from, to, duration, limits, robust, options, tick };
    let plan = request.plan().expect("a plan").plan;
    let quintic = Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.2 };
    let [quintic, still] = [quintic, plan.motion()]
        .map(|motion| Motion::of(0.0, motion, tick).judge(&arm, 0.0).expect("a judgement"));
    let animation = plan::moving::animation(&request, &quintic, &still).expect("a picture");
    let swing = |panel: &Panel| {
        let rest = panel.arms[0].frames.iter().rev().take(40);
        rest.fold(0.0, |most: f64, frame| most.max(frame.deflections[0].abs()))
    };
    let [quintic, still] = [0, 1].map(|k| &animation.panels[k]);
    assert!(swing(still) < 1e-3 * arm.link.length, "{}", swing(still));
    assert!(swing(quintic) > 20.0 * swing(still), "{}", swing(quintic));
    assert!(quintic.remark.contains(" % of L left"), "{}", quintic.remark);
    for panel in [quintic, still] {
        let last = panel.arms[0].frames.last().expect("a frame");
        let reach = arm.hub.radius + arm.link.length;
        let [x, y] = last.line[last.line.len() - 1];
        let off = (x - reach * f64::cos(1.2)).hypot(y - reach * f64::sin(1.2));
        assert!(off < 1.1 * last.deflections[0].abs() + 1e-9, "{off} {:?}", last.deflections);
    }
}

/// The joints that are drawn are the ends of the links, and a loop's tip stays on its pin.
#[test]
fn joints_and_pin_are_where_the_table_has_them() {
    for name in ["two-links", "four-bar"] {
        let scene = mechanism::scenes::open(name).expect("a name").expect("a scene");
        let rows = mechanism::run::run(&scene, &scene.solver().expect("a solver")).expect("a run");
        let animation = mechanism::moving::animation(&scene, &rows).expect("a picture");
        let frames = &animation.panels[0].arms[0].frames;
        let stride = rows.len().div_ceil(frames.len());
        assert!(frames.len() > 50 && frames.len() <= INTERVALS + 1, "{}", frames.len());
        for (frame, row) in frames.iter().zip(rows.iter().step_by(stride)) {
            assert_eq!(frame.line.last(), row.ends.last());
            assert_eq!(frame.joints, row.ends[..row.ends.len() - 1]);
            assert_eq!(frame.deflections, row.deflections);
        }
        let count = scene.mechanism.links.len();
        let dashed = animation.svg().matches("stroke-dasharray=\"7 5\"").count();
        assert_eq!(dashed, usize::from(count > 1), "{name}");
    }
}

/// A link that is drawn passes through its ends, and a straight one through its middle.
#[test]
fn links_are_drawn_where_their_ends_are() {
    let scene: MechanismScene = mechanism::scenes::open("forearm").unwrap().unwrap();
    let row = Row {
        joints: vec![0.0, 0.5],
        ends: vec![[0.3, 0.0], [0.3 + 0.32 * f64::cos(0.5), 0.32 * f64::sin(0.5)]],
        deflections: vec![0.0; 2],
        torques: vec![0.0; 2],
        t: 0.0,
    };
    let line = mechanism::picture::shape(&scene, &row);
    for end in &row.ends {
        assert!(line.iter().any(|(x, y)| (x - end[0]).hypot(y - end[1]) < 1e-12));
    }
    // Half of the forearm's strip, which begins 20 mm from the elbow.
    let half = [0.3 + 0.17 * f64::cos(0.5), 0.17 * f64::sin(0.5)];
    assert!(line.iter().any(|(x, y)| (x - half[0]).hypot(y - half[1]) < 1e-12));
}
