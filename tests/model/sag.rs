use stillbeam::model::Model;
use stillbeam::{Link, Scene};
use stillbeam_tests::assert_near;

const LINK: Link = Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 };

/// Sag of an arm at rest: the small-deflection model against the rod, for a small load.
#[test]
fn equilibrium_of_the_model_and_of_the_rod_agree_for_small_sag() {
    let mut scene = Scene::new(LINK);
    scene.gravity = 9.81;
    scene.payload.mass = 0.001;
    let angle = stillbeam::Angle::from_radians(0.3);
    let rod = stillbeam_sim::reference::rod::rest_deflection(&scene, angle).expect("equilibrium");
    let (sin, cos) = angle.sin_cos();
    let model = Model::<16, 4>::consistent(&scene).expect("model");
    let linear = model.equilibrium(sin, cos)[model.tip()];
    assert_near("sag", linear, rod, 1e-3 * rod.abs());
}
