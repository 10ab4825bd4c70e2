//! Cases that the campaigns have found: seed and number of the scene.

use stillbeam_lab::stress::draw::{Drawn, draw, draw_plain};
use stillbeam_lab::stress::trial::{Verdict, trial};
use stillbeam_sim::solver::{Mass, Method, Solver};

fn outcome(seed: u64, index: u64, wanted: impl Fn(&Solver) -> bool) -> Verdict {
    of(&draw_plain(seed, index), wanted)
}

fn of(drawn: &Drawn, wanted: impl Fn(&Solver) -> bool) -> Verdict {
    let solver = drawn.solvers.iter().find(|solver| wanted(solver)).expect("its solver");
    trial(drawn, solver)
}

/// The effective matrix, rounded to f32, was `K` alone and less: what it held beside it was no
/// mass, and the step fed the arm until its setpoints were no numbers.
#[test]
fn newmark_refuses_a_tick_that_leaves_its_matrix_no_inertia() {
    let eight = |solver: &Solver| {
        solver.method == Method::Newmark && solver.elements == 8 && solver.mass == Mass::Consistent
    };
    for index in [59_019, 65_635, 77_404] {
        let outcome = outcome(9, index, eight);
        let Verdict::Refused(reason) = &outcome else { panic!("{index}: {outcome:?}") };
        assert!(reason.starts_with("solver.tick"), "{reason}");
    }
}

/// A hundred link masses three quarters of a length beyond the tip, on a soft joint: in f32 the
/// effective matrix of ticks while the hub turns was no longer positive, and the setpoints no
/// numbers.
#[test]
fn newmark_refuses_a_payload_that_hides_the_rest_of_its_matrix() {
    let outcome = of(&draw(8, 45_454), |solver| solver.method == Method::Newmark);
    let Verdict::Refused(reason) = &outcome else { panic!("{outcome:?}") };
    assert!(reason.starts_with("solver.tick") && reason.contains("payload"), "{reason}");
}

/// Gravity feeds an undamped arm whose hub turns at twice its frequency, by physics, until f32 has
/// no number for it: now it stays finite.
#[test]
fn newmark_stays_finite_under_parametric_resonance() {
    let lumped = |solver: &Solver| {
        solver.method == Method::Newmark && solver.elements == 1 && solver.mass == Mass::Lumped
    };
    let outcome = outcome(9, 96_867, lumped);
    let Verdict::Ran(run) = &outcome else { panic!("{outcome:?}") };
    assert_eq!(run.broken, [None, None], "{run:?}");
}

/// The same of modes.
#[test]
fn modal_stays_finite_under_parametric_resonance() {
    for (index, modes) in [(62_616, 3), (97_077, 1), (423_763, 2)] {
        let outcome =
            outcome(8, index, |solver| solver.method == Method::Modal && solver.modes == modes);
        let Verdict::Ran(run) = &outcome else { panic!("{index}: {outcome:?}") };
        assert_eq!(run.broken, [None, None], "{index}: {run:?}");
    }
}

/// A gravity that takes nearly all of the first mode's stiffness, at 1.6 rad a tick: the step fed
/// the arm until it was no number.
#[test]
fn modal_refuses_a_gravity_that_feeds_it() {
    let outcome = outcome(5, 20_310, |solver| solver.method == Method::Modal);
    let Verdict::Refused(reason) = &outcome else { panic!("{outcome:?}") };
    assert!(reason.starts_with("gravity.acceleration"), "{reason}");
}

/// An arm that its weight bends by 0.8 L, at 3 rad a tick: it did not stay where it rests, in f32
/// elsewhere than in f64.
#[test]
fn elastica_refuses_a_tick_at_which_a_sagging_arm_does_not_rest() {
    let outcome = outcome(5, 915, |solver| solver.method == Method::Elastica);
    let Verdict::Refused(reason) = &outcome else { panic!("{outcome:?}") };
    assert!(reason.starts_with("solver.tick"), "{reason}");
}
