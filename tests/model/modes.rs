use stillbeam::model::{EightElements, Modes};
use stillbeam_sim::dispatch::first_period;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::Mass;
use stillbeam_tests::assert_near;

fn period_ms(scene: &str, elements: usize, mass: Mass) -> f64 {
    let scene = scenes::open(scene).expect("embedded scene");
    1e3 * first_period(&scene.arm, elements, mass).expect("period")
}

#[test]
fn first_period_of_member_d_with_consistent_mass() {
    for (elements, expected) in [(1, 99.29), (2, 99.71), (4, 99.76), (8, 99.76)] {
        let period = period_ms("d-fast", elements, Mass::Consistent);
        assert_near("period, ms", period, expected, 0.01);
    }
}

#[test]
fn first_period_of_member_d_with_lumped_mass() {
    for (elements, expected) in [(1, 143.20), (2, 111.13), (4, 102.62), (8, 100.48)] {
        let period = period_ms("d-fast", elements, Mass::Lumped);
        assert_near("period, ms", period, expected, 0.02);
    }
}

#[test]
fn first_period_with_thirty_grams() {
    let expected =
        [("a-tip30", 1128.3), ("b-tip30", 825.4), ("c-tip30", 691.5), ("d-tip30", 254.2)];
    for (scene, expected) in expected {
        assert_near(scene, period_ms(scene, 8, Mass::Consistent), expected, 0.2);
    }
}

/// Roots of `cos λ cosh λ = −1`: `ω = λ² √(EI/ρA)/L²`.
#[test]
fn the_lowest_modes_are_those_of_the_cantilever() {
    let scene = scenes::open("d-fast").expect("embedded scene").arm;
    let modes = Modes::of(&EightElements::consistent(&scene).expect("model"));
    let scale =
        (scene.link.bending_stiffness / scene.mass_per_length()).sqrt() / scene.link.length.powi(2);
    let roots = [(1.875_104_068_711_961, 5e-6), (4.694_091_132_974_175, 1e-4), (7.854_757, 1e-3)];
    for (i, (root, relative)) in roots.into_iter().enumerate() {
        let expected = root * root * scale;
        assert_near("frequency", modes.frequency[i], expected, relative * expected);
    }
}

#[test]
fn mode_shapes_are_mass_normalised_and_stiffness_orthogonal() {
    for name in ["d-fast", "s-gravity"] {
        let scene = scenes::open(name).expect("embedded scene").arm;
        let model = EightElements::consistent(&scene).expect("model");
        let modes = Modes::of(&model);
        let product =
            |a: &[f64; 16], b: &[f64; 16]| -> f64 { a.iter().zip(b).map(|(x, y)| x * y).sum() };
        for i in 0..16 {
            for j in 0..16 {
                let mass = product(&model.mass().times(&modes.shape[i]), &modes.shape[j]);
                let stiffness = product(&model.stiffness().times(&modes.shape[i]), &modes.shape[j]);
                let same = f64::from(u8::from(i == j));
                assert_near("mass", mass, same, 1e-8);
                let (wi, wj) = (modes.frequency[i], modes.frequency[j]);
                assert_near("stiffness", stiffness / (wi * wj), same, 1e-8);
            }
            assert!(modes.shape[i][model.tip()] > 0.0, "mode {i} deflects to +y");
        }
    }
}
