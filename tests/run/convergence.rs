use stillbeam_sim::compare::compare;
use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::Scalar;
use stillbeam_tests::{newmark, truth};

/// Largest tip error at step `h` against the same mesh at `h/32`.
fn step_error(scene: &SceneFile, elements: usize, h: f64) -> f64 {
    let at = |h| run(scene, &newmark(elements, h, Scalar::F64)).expect("run");
    compare(&at(h), &at(h / 32.0), scene).expect("comparison").tip_max
}

#[test]
fn the_step_converges_with_order_two() {
    // Steps at which the first mode makes the error; whole numbers of them fit the scene's move.
    let cases = [
        ("d-fast", 1, 0.0001),
        ("b-tip30", 1, 0.02),
        ("b-tip30", 4, 0.02),
        ("a-tip30", 1, 0.01),
        ("b-tip30-damped-hub", 2, 0.01),
        ("s-gravity", 1, 0.01),
        ("spin-up", 1, 0.02),
    ];
    for (name, elements, h) in cases {
        let (scene, _) = truth(name);
        let slope =
            (step_error(&scene, elements, h) / step_error(&scene, elements, h / 2.0)).log2();
        assert!((slope - 2.0).abs() <= 0.1, "{name}: order {slope}");
    }
}

#[test]
fn more_elements_come_closer_to_the_rod() {
    let (scene, truth) = truth("spin-up");
    let error = |elements| {
        let rows = run(&scene, &newmark(elements, 0.002, Scalar::F64)).expect("run");
        compare(&rows, &truth, &scene).expect("comparison").tip_max
    };
    let errors = [error(1), error(2), error(4)];
    assert!(errors.is_sorted_by(|a, b| a > b), "{errors:?}");
}
