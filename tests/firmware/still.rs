//! Still moves of an axis, as the firmware's planner makes them.

use stillbeam::axis::Policy;
use stillbeam::planner::Planner;
use stillbeam::{Error, Limits, Link, Move, Scene};
use stillbeam_tests::assert_near;

use super::common::{Arm, LIMITS, POLICY, TICK, ask, assert_continuous, enabled, radians, run};

const LINK: Link = Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 };

fn planner() -> Planner<f32, 2> {
    let mut scene = Scene::new(LINK);
    scene.payload.mass = 0.03;
    scene.gravity = 1.0;
    Planner::new(&scene, TICK).unwrap()
}

fn still(axis: &mut Arm, to: f64, duration: Option<f64>) -> Result<u32, Error> {
    let planned = axis.plan_context()?.plan_still(&planner(), to, duration);
    axis.take(&planned?)
}

#[test]
fn a_still_move_is_followed_like_any_other() {
    for duration in [None, Some(2.0)] {
        let mut axis = enabled(POLICY);
        still(&mut axis, 2.5, duration).unwrap();
        let all = run(&mut axis, 400);
        assert_continuous(&all, &LIMITS);
        assert_near("angle", radians(all.last().unwrap()), 2.5, 1e-6);
        assert!(axis.rests());
    }
}

/// It waits behind another move and begins where that ends.
#[test]
fn a_still_move_waits_for_the_moves_before_it() {
    let mut axis = enabled(POLICY);
    let quintic = Move::To { profile: stillbeam::Profile::Quintic, duration: 0.8, to: 2.0 };
    ask(&mut axis, &quintic).unwrap();
    run(&mut axis, 10);
    assert_eq!(still(&mut axis, 1.0, Some(1.5)), Ok(80));
    let all = run(&mut axis, 300);
    assert_continuous(&all, &LIMITS);
    assert_near("angle", radians(all.last().unwrap()), 1.0, 1e-6);
}

/// Every limit of the axis is one of the plan's, and so are the planner's own, of what the arm
/// does.
#[test]
fn what_the_planner_refuses_is_named() {
    let error = |limits: Limits, duration| {
        let mut axis = enabled(Policy { limits, ..POLICY });
        match still(&mut axis, 2.5, duration) {
            Err(error) => error.to_string(),
            other => panic!("{other:?}"),
        }
    };
    assert!(error(LIMITS, Some(0.05)).starts_with("move.duration = 0.05"));
    assert!(error(LIMITS, Some(f64::NAN)).starts_with("move.duration = NaN"));
    let slow = Limits { rate: Some(0.1), ..LIMITS };
    assert!(error(slow, Some(1.0)).starts_with("limits.rate"));
    let weak = planner().with_load_limits(Some(1e-4), None).unwrap();
    for duration in [Some(1.0), None] {
        let refused = enabled(POLICY).plan_context().unwrap().plan_still(&weak, 2.5, duration);
        let error = refused.map(drop).unwrap_err().to_string();
        assert!(error.starts_with("limits.torque"), "{error}");
    }
}

#[test]
fn a_turning_hub_has_no_still_move() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &Move::SpinUp { duration: 0.5, rate: 3.0 }).unwrap();
    run(&mut axis, 60);
    let refused = still(&mut axis, 1.0, Some(1.5));
    assert_eq!(refused, Err(Error::NotAtRest { rate: 3.0 }));
}
