//! The reference solvers against the solutions in `tests/truth`.

mod common;

use common::{NAMES, Truth, difference, truth};
use stillbeam::motion::Limits;
use stillbeam::{Link, Move, Profile, Scene};
use stillbeam_sim::reference::{ReferenceError, Sample, rod};
use stillbeam_sim::trajectory::Trajectory;

fn solve_rod(truth: &Truth, options: &rod::Options) -> Vec<Sample> {
    rod::solve(&truth.scene, &truth.trajectory, &truth.times(), options).unwrap()
}

#[test]
fn rod_agrees_with_the_truth() {
    for name in NAMES {
        let truth = truth(name);
        let run = solve_rod(&truth, &rod::Options::default());
        let error = truth.error(&run);
        // Truths of 5 polynomials differ from 7 by a few 1e-7 in the tip; what the jumps excite of
        // the higher modes shows in the torque alone.
        assert!(error.tip < 5e-6, "{name}: tip {error:?}");
        assert!(error.torque < 3e-3, "{name}: torque {error:?}");
    }
}

#[test]
fn rod_repeats_the_truth_at_its_own_order() {
    for name in NAMES {
        let truth = truth(name);
        let order = if name == "d-fast" { 7 } else { 5 };
        let run = solve_rod(&truth, &rod::Options { order, ..Default::default() });
        let error = truth.error(&run);
        // The files carry nine digits.
        assert!(error.tip < 2e-8 && error.torque < 1e-6, "{name}: {error:?}");
        for (a, b) in run.iter().zip(&truth.samples) {
            assert!(
                (a.angle - b.angle).abs() < 1e-8 * (1.0 + b.angle.abs()),
                "{name}: {a:?} {b:?}"
            );
            assert!((a.rate - b.rate).abs() < 1e-8 * (1.0 + b.rate.abs()), "{name}: {a:?} {b:?}");
            let scale = 1.0 + b.acceleration.abs();
            assert!((a.acceleration - b.acceleration).abs() < 1e-8 * scale, "{name}: {a:?} {b:?}");
            assert!((a.deflection - b.deflection).abs() < 1e-7, "{name}: {a:?} {b:?}");
        }
    }
}

#[test]
fn spin_up_deflects_as_simo_and_vu_quoc_found() {
    let truth = truth("spin-up");
    let times: Vec<f64> = (0..=3000).map(|k| f64::from(k) * 0.01).collect();
    let options = rod::Options { order: 5, ..Default::default() };
    let run = rod::solve(&truth.scene, &truth.trajectory, &times, &options).unwrap();
    let lowest = run.iter().map(|sample| sample.deflection).fold(0.0, f64::min);
    assert!((lowest + 0.5738).abs() < 0.0005, "{lowest}");
}

#[test]
fn explicit_and_implicit_integration_agree() {
    let mut truth = truth("b-tip30-damped-hub");
    // Ten times the damping of the file: the highest polynomial decays within microseconds.
    truth.scene.damping.beta = 0.02;
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) * 0.01).collect();
    let run = |integrator| {
        let options = rod::Options { order: 5, integrator, ..Default::default() };
        rod::solve(&truth.scene, &truth.trajectory, &times, &options).unwrap()
    };
    let explicit = run(Some(rod::Integrator::Explicit));
    let error = difference(&truth.scene, &truth.trajectory, &run(None), &explicit);
    assert!(error.tip < 1e-7 && error.torque < 1e-5, "{error:?}");
}

#[test]
fn very_strong_damping_is_solved() {
    let mut truth = truth("b-tip30-damped-hub");
    truth.scene.damping.beta = 1.0;
    let run = solve_rod(&truth, &rod::Options::default());
    // The link is dragged round nearly straight, and creeps back.
    assert!(run.iter().all(|sample| sample.deflection.abs() < 0.05));
}

#[test]
fn a_buckling_link_and_bad_times_are_refused() {
    let link = Link { length: 1.0, mass: 1.0, bending_stiffness: 0.5 };
    let mut scene = Scene::new(link);
    scene.gravity = 9.81;
    let upright = std::f64::consts::FRAC_PI_2;
    let moves = [Move::To { profile: Profile::Cubic, duration: 1.0, to: 0.0 }];
    let trajectory = Trajectory::plan(upright, &moves, &Limits::default(), 0.010).unwrap();
    let options = rod::Options::default();
    let buckled = rod::solve(&scene, &trajectory, &[0.0], &options);
    assert!(matches!(buckled, Err(ReferenceError::NoEquilibrium { .. })), "{buckled:?}");

    scene.gravity = 0.0;
    for times in [[0.5, 0.4], [0.5, 1.1], [0.5, f64::NAN], [-0.1, 0.5]] {
        let run = rod::solve(&scene, &trajectory, &times, &options);
        assert!(matches!(run, Err(ReferenceError::Time { .. })), "{times:?}");
    }
}
