use crate::assert_near;
use stillbeam::model::Model;
use stillbeam::{Link, Scalar, Scene};

const LINK: Link = Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 };

/// Largest relative error of tip deflection and slope under a tip force, a tip moment and a
/// uniform load, each against the closed form of the cantilever.
fn worst_error<T: Scalar, const N: usize, const W: usize>() -> f64 {
    let model = Model::<N, W>::consistent(&Scene::new(LINK)).expect("model");
    let factors = model.stiffness().map(T::from_f64).factor();
    let (l, ei) = (LINK.length, LINK.bending_stiffness);
    let mut force = [0.0; N];
    force[N - 2] = 1.0;
    let mut moment = [0.0; N];
    moment[N - 1] = 1.0;
    // The weight vector is the load of 1 m/s² on the link's mass.
    let uniform = *model.weight();
    let q = LINK.mass / l;
    let cases = [
        (force, l.powi(3) / (3.0 * ei), l.powi(2) / (2.0 * ei)),
        (moment, l.powi(2) / (2.0 * ei), l / ei),
        (uniform, q * l.powi(4) / (8.0 * ei), q * l.powi(3) / (6.0 * ei)),
    ];
    cases
        .into_iter()
        .flat_map(|(load, deflection, slope)| {
            let x = factors.solve(&load.map(T::from_f64));
            [x[N - 2].to_f64() / deflection - 1.0, x[N - 1].to_f64() / slope - 1.0]
        })
        .map(f64::abs)
        .fold(0.0, f64::max)
}

#[test]
fn static_loads_are_exact_at_the_nodes() {
    for error in [
        worst_error::<f64, 2, 2>(),
        worst_error::<f64, 4, 4>(),
        worst_error::<f64, 8, 4>(),
        worst_error::<f64, 16, 4>(),
    ] {
        assert!(error < 1e-10, "{error:e}");
    }
}

#[test]
fn static_loads_in_f32() {
    for error in
        [worst_error::<f32, 2, 2>(), worst_error::<f32, 4, 4>(), worst_error::<f32, 8, 4>()]
    {
        assert!(error < 1e-4, "{error:e}");
    }
    let error = worst_error::<f32, 16, 4>();
    assert!(error < 5e-4, "{error:e}");
}

/// Condensing massless rotations changes nothing for forces on the deflections.
#[test]
fn lumped_models_carry_a_tip_force_exactly() {
    fn deflection<const D: usize, const N: usize>() -> f64 {
        let model = Model::<N, N>::lumped::<D>(&Scene::new(LINK)).expect("model");
        let mut force = [0.0; N];
        force[model.tip()] = 1.0;
        model.stiffness().factor().solve(&force)[model.tip()]
    }
    let expected = LINK.length.powi(3) / (3.0 * LINK.bending_stiffness);
    for value in
        [deflection::<2, 1>(), deflection::<4, 2>(), deflection::<8, 4>(), deflection::<16, 8>()]
    {
        assert_near("tip deflection", value, expected, 1e-9 * expected);
    }
}

#[test]
fn a_lumped_model_of_the_wrong_size_is_refused() {
    let mut scene = Scene::new(LINK);
    scene.payload.inertia = 1e-6;
    let error = Model::<4, 4>::lumped::<8>(&scene).expect_err("the tip's rotation has inertia");
    assert_eq!(error.to_string().split(':').next(), Some("elements"));
    assert!(Model::<5, 5>::lumped::<8>(&scene).is_ok());
}

/// A self-weight cantilever buckles at ρA g L³/EI = 7.837 (Greenhill).
#[test]
fn a_link_that_would_buckle_upright_is_refused() {
    let at = |load: f64| {
        let mut scene = Scene::new(Link { length: 1.0, mass: 1.0, bending_stiffness: 1.0 });
        scene.gravity = load;
        Model::<16, 4>::consistent(&scene)
    };
    assert!(at(7.8).is_ok());
    let error = at(7.9).expect_err("above Greenhill's load");
    assert!(error.to_string().starts_with("gravity.acceleration = 7.9"), "{error}");
}
