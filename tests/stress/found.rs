//! What the campaigns have found, case by case: seed and number of the scene.

use stillbeam_sim::solver::{Mass, Method, Solver};
use stillbeam_sim::stress::draw::draw;
use stillbeam_sim::stress::trial::{Verdict, trial};

fn outcome(seed: u64, index: u64, wanted: impl Fn(&Solver) -> bool) -> Verdict {
    let drawn = draw(seed, index);
    let solver = drawn.solvers.iter().find(|solver| wanted(solver)).expect("its solver");
    trial(&drawn, solver)
}

/// The effective matrix, rounded to f32, was `K` alone and less: what it held beside it was no mass,
/// and the step fed the arm until its setpoints were no numbers.
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
