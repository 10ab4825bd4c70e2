//! The reference solvers against the solutions in `tests/truth`.

use stillbeam::motion::Limits;
use stillbeam::{Link, Move, Profile, Scene};
use stillbeam_lab::reference::truth::{NAMES, Truth, difference};
use stillbeam_sim::reference::{ReferenceError, Sample, fem, rod};
use stillbeam_sim::trajectory::Trajectory;

fn truth(name: &str) -> Truth {
    Truth::read(name).unwrap_or_else(|error| panic!("{error}"))
}

fn solve_rod(truth: &Truth, options: &rod::Options) -> Vec<Sample> {
    rod::solve(&truth.scene, &truth.trajectory, &truth.times(), options).unwrap()
}

fn solve_fem(truth: &Truth, options: &fem::Options) -> Vec<Sample> {
    fem::solve(&truth.scene, &truth.trajectory, &truth.times(), options).unwrap()
}

#[test]
fn rod_agrees_with_the_truth() {
    // The truth of d-fast has the default's order itself, see the next test.
    for name in NAMES.into_iter().filter(|&name| name != "d-fast") {
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
fn fem_agrees_with_the_truth() {
    // An arm of each kind: fast, damped, under gravity; `cargo lab reference` takes all.
    for name in ["d-fast", "b-tip30-damped-hub", "s-gravity"] {
        let truth = truth(name);
        let run = solve_fem(&truth, &fem::Options::default());
        let error = truth.error(&run);
        let tip = if name == "d-fast" { 5e-5 } else { 3e-6 };
        assert!(error.tip < tip && error.torque < 3e-3, "{name}: {error:?}");
    }
}

#[test]
fn spin_up_deflects_as_simo_and_vu_quoc_found() {
    let truth = truth("spin-up");
    let times: Vec<f64> = (0..=1000).map(|k| f64::from(k) * 0.01).collect();
    let options = rod::Options { order: 5, ..Default::default() };
    let rod = rod::solve(&truth.scene, &truth.trajectory, &times, &options).unwrap();
    let options = fem::Options { elements: 16, ..Default::default() };
    let fem = fem::solve(&truth.scene, &truth.trajectory, &times, &options).unwrap();
    for run in [rod, fem] {
        let lowest = run.iter().map(|sample| sample.deflection).fold(0.0, f64::min);
        assert!((lowest + 0.5738).abs() < 0.0005, "{lowest}");
    }
}

#[test]
fn the_two_converge_to_each_other() {
    let truth = truth("s-gravity");
    let rod = solve_rod(&truth, &rod::Options { order: 8, ..Default::default() });
    // Fourth order in the elements, second in the step: doubled and quartered, 16 times less.
    let errors = [(4, 2e-3), (8, 5e-4), (16, 1.25e-4)].map(|(elements, step)| {
        let options = fem::Options { elements, step: Some(step), ..Default::default() };
        difference(&truth.scene, &truth.trajectory, &solve_fem(&truth, &options), &rod)
    });
    for pair in errors.windows(2) {
        assert!(pair[0].tip > 12.0 * pair[1].tip, "{errors:?}");
        assert!(pair[0].torque > 12.0 * pair[1].torque, "{errors:?}");
    }
    assert!(errors[2].tip < 4e-7 && errors[2].torque < 4e-6, "{errors:?}");
}

#[test]
fn a_stiff_hub_element_is_a_rigid_hub() {
    let truth = truth("s-gravity");
    let options = fem::Options { elements: 8, step: Some(1e-3), ..Default::default() };
    let rigid = solve_fem(&truth, &options);
    let errors = [1e2, 1e3, 1e4].map(|stiffness| {
        let hub = fem::HubModel::Element { stiffness };
        let run = solve_fem(&truth, &fem::Options { hub, ..options });
        difference(&truth.scene, &truth.trajectory, &run, &rigid)
    });
    for pair in errors.windows(2) {
        assert!((8.0..12.0).contains(&(pair[0].tip / pair[1].tip)), "{errors:?}");
        assert!((8.0..12.0).contains(&(pair[0].torque / pair[1].torque)), "{errors:?}");
    }
    assert!(errors[2].tip < 5e-5, "{errors:?}");
}

#[test]
fn an_axially_stiff_link_does_not_stretch() {
    let truth = truth("s-gravity");
    let rod = solve_rod(&truth, &rod::Options::default());
    let errors = [1e3, 1e4, 1e5].map(|axial_stiffness| {
        let options =
            fem::Options { elements: 16, step: Some(1e-4), axial_stiffness, ..Default::default() };
        difference(&truth.scene, &truth.trajectory, &solve_fem(&truth, &options), &rod).tip
    });
    assert!(errors.windows(2).all(|pair| pair[0] > 8.0 * pair[1]), "{errors:?}");
}

/// Past π and round, both ways, with jumps of the acceleration inside the moves.
#[test]
fn both_agree_past_half_turns_and_over_jumps() {
    let scene = truth("s-gravity").scene;
    let profile = Profile::Trapezoid;
    let moves = [
        Move::To { profile, duration: 1.2, to: 9.0 },
        Move::To { profile, duration: 1.0, to: -4.0 },
        Move::Dwell { duration: 0.2 },
    ];
    let trajectory = Trajectory::plan(2.5, &moves, &Limits::default(), 0.010).unwrap();
    let times: Vec<f64> = (0..=480).map(|k| f64::from(k) * 0.005).collect();
    let rod = rod::solve(&scene, &trajectory, &times, &rod::Options::default()).unwrap();
    // At these rates (to 19 rad/s, deflections to 0.85 of L) a link of 1e7 stretches by 3e-5.
    let options =
        fem::Options { elements: 16, step: Some(5e-5), axial_stiffness: 1e8, ..Default::default() };
    let fem = fem::solve(&scene, &trajectory, &times, &options).unwrap();
    let error = difference(&scene, &trajectory, &fem, &rod);
    assert!(error.tip < 2e-5 && error.torque < 3e-4, "{error:?}");
    // Right at the jumps the torque is that of the same side.
    let peak = rod.iter().fold(0.0, |peak: f64, sample| peak.max(sample.torque.abs()));
    for (a, b) in rod.iter().zip(&fem) {
        assert_eq!((a.angle, a.rate, a.acceleration), (b.angle, b.rate, b.acceleration));
        assert!((a.torque - b.torque).abs() < 1e-3 * peak, "{a:?} {b:?}");
    }
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
    let buckled = fem::solve(&scene, &trajectory, &[0.0], &fem::Options::default());
    assert!(matches!(buckled, Err(ReferenceError::NoEquilibrium { .. })), "{buckled:?}");

    scene.gravity = 0.0;
    for times in [[0.5, 0.4], [0.5, 1.1], [0.5, f64::NAN], [-0.1, 0.5]] {
        let run = rod::solve(&scene, &trajectory, &times, &options);
        assert!(matches!(run, Err(ReferenceError::Time { .. })), "{times:?}");
    }
}

#[test]
fn options_out_of_range_are_refused() {
    let truth = truth("d-fast");
    for options in [
        rod::Options { order: 4, ..Default::default() },
        rod::Options { tolerance: f64::NAN, ..Default::default() },
    ] {
        let run = rod::solve(&truth.scene, &truth.trajectory, &[0.0], &options);
        assert!(matches!(run, Err(ReferenceError::Options { .. })), "{options:?}");
    }
    let element = |stiffness| fem::HubModel::Element { stiffness };
    for options in [
        fem::Options { elements: 0, ..Default::default() },
        fem::Options { step: Some(0.0), ..Default::default() },
        fem::Options { axial_stiffness: f64::INFINITY, ..Default::default() },
        fem::Options { hub: element(f64::NAN), ..Default::default() },
    ] {
        let run = fem::solve(&truth.scene, &truth.trajectory, &[0.0], &options);
        assert!(matches!(run, Err(ReferenceError::Options { .. })), "{options:?}");
    }
}
