//! The arm along a path.

use crate::assert_near;
use stillbeam::model::{EightElements, Rod};
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::stepper::{Elastica, Modal, Quality};
use stillbeam::{Generator, Move, Profile};

use super::{TICK, scene};

/// A motion that ends inside a tick takes no step with it: the arm behind it vibrates as behind
/// one that ends at the same time in finer ticks.
#[test]
fn a_path_may_end_inside_a_tick() {
    let model = EightElements::consistent(&scene()).expect("model");
    let run = |tick: f64, every: usize| {
        let stepper = Modal::<f64, 2>::new(&model, tick).expect("stepper");
        let mut arm = Generator::<_, 8>::new(stepper, 0.0).expect("generator");
        let mut path = arm.path(Spline::Cubic).expect("a path");
        let rows = [Waypoint::at(0.1337, 0.4).turning(2.0), Waypoint::at(0.2563, 0.7)];
        assert_eq!(arm.feed(&mut path, &mut rows.into_iter()), Ok(true));
        let all = (0..=60 * every).map(|_| arm.tick());
        all.step_by(every).collect::<Vec<_>>()
    };
    let (coarse, fine) = (run(0.01, 1), run(0.0001, 100));
    let swing = fine.iter().map(|s| s.tip[1].abs()).fold(0.0, f64::max);
    for (k, (a, b)) in coarse.iter().zip(&fine).enumerate() {
        assert_near("angle", a.angle.radians(), b.angle.radians(), 1e-12);
        assert_near(&format!("tip at tick {k}"), a.tip[1], b.tip[1], 4e-3 * swing);
    }
}

/// Torque (N m) and residual deflection (of L) of member D with 30 g along a path by 0.8 rad in
/// 1.2 s, in elastica.
fn loads(queue: impl FnOnce(&mut Generator<Elastica<f64, 2>, 8>)) -> [f64; 2] {
    let mut scene = scene();
    scene.payload.mass = 0.03;
    let rod = Rod::<2>::new(&scene).expect("rod");
    let stepper = Elastica::new(&rod, TICK, Quality::Fine, 0.5).expect("stepper");
    let mut arm = Generator::new(stepper, 0.0).expect("generator");
    queue(&mut arm);
    let setpoints: Vec<_> = (0..320).map(|_| arm.tick()).collect();
    assert_near("end", setpoints[120].angle.radians(), 0.8, 1e-12);
    let torque = setpoints.iter().map(|s| s.torque.abs()).fold(0.0, f64::max);
    let residual = setpoints[120..].iter().map(|s| s.tip[1].abs()).fold(0.0, f64::max);
    [torque, residual / 0.4]
}

/// Four waypoints 0.2 rad apart, 0.3 s each: passing them costs a fraction of a stop at each.
#[test]
fn passing_costs_less_than_stopping() {
    let times = [0.3, 0.6, 0.9, 1.2];
    let angles = [0.2, 0.4, 0.6, 0.8];
    let smooth = loads(|arm| {
        arm.push(&Move::To { profile: Profile::Cubic, duration: 1.2, to: 0.8 }).expect("a move");
    });
    let stops = loads(|arm| {
        for to in angles {
            arm.push(&Move::To { profile: Profile::Cubic, duration: 0.3, to }).expect("a move");
        }
    });
    let passes = |spline, rate: Option<f64>| {
        loads(|arm| {
            let mut path = arm.path(spline).expect("a path");
            let mut rows = times.into_iter().zip(angles).map(|(time, angle)| {
                let last = angle == 0.8;
                Waypoint { rate: rate.filter(|_| !last), ..Waypoint::at(time, angle) }
            });
            assert_eq!(arm.feed(&mut path, &mut rows), Ok(true));
        })
    };
    // A stop at each costs eight times the torque of one smooth move and six times the residual.
    assert_near("stops", stops[0] / smooth[0], 7.96, 0.01);
    assert_near("stops", stops[1] / smooth[1], 5.79, 0.01);
    // Through the angles at these times from rest takes 5.36 rad/s² at least, in two stretches of
    // constant acceleration up to the first row; the smooth move takes 3.33.
    for (spline, rate, torque, residual) in [
        (Spline::Cubic, Some(0.8 / 1.2), 2.12, 1.54),
        (Spline::Cubic, None, 1.93, 1.94),
        (Spline::Quintic, Some(0.8 / 1.2), 3.68, 2.36),
        (Spline::Quintic, None, 2.77, 1.35),
    ] {
        let passed = passes(spline, rate);
        assert_near("torque", passed[0] / smooth[0], torque, 0.01);
        assert_near("residual", passed[1] / smooth[1], residual, 0.01);
    }
}
