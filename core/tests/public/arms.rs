//! Arms as people have them: joints that give, payloads beyond the tip, links of sections.

use stillbeam::material::Material;
use stillbeam::model::{EightElements, Modes, OneElement, Rod};
use stillbeam::scene::{CrossSection, PointMass, Section};
use stillbeam::{Error, Link, Payload, Scene};

/// 69 GPa, 2800 kg/m³.
fn aluminium() -> &'static Material {
    Material::named("aluminium").expect("a material")
}

/// A link of one section of a material.
fn bar(length: f64, material: &Material, cut: CrossSection<[f64; 2]>) -> Scene {
    Scene::of_sections(&[Section::tapered(length, material, cut).expect("a section")])
        .expect("an arm")
}

fn strip(length: f64, width: [f64; 2], thickness: [f64; 2]) -> Scene {
    bar(length, aluminium(), CrossSection::Strip { width, thickness })
}

fn point(mass: f64) -> Payload {
    Payload { mass, ..Payload::default() }
}

/// A machine's link of 0.44 m with 0.95 kg.
fn machine(stiffness: Option<f64>) -> Scene {
    let mut scene = Scene::new(Link { length: 0.44, mass: 0.27646, bending_stiffness: 94.74 });
    scene.payload.mass = 0.95;
    scene.hub.stiffness = stiffness;
    scene
}

fn gripper(offset: f64) -> Scene {
    Scene {
        payload: Payload { mass: 0.5, inertia: 4e-4, offset },
        ..strip(0.5, [0.04; 2], [0.004; 2])
    }
}

/// Arms with their first two periods, s, from finite elements of sixty and more.
fn arms() -> [(&'static str, Scene, [f64; 2]); 10] {
    let steel = Material::named("steel").expect("a material");
    let tube = CrossSection::Tube { diameter: [0.012; 2], wall: [0.001; 2] };
    let sensor = Material { name: "", youngs_modulus: 70e9, density: 2700.0 };
    let cut = CrossSection::Strip { width: [0.05; 2], thickness: [0.002; 2] };
    let with = |scene: Scene, mass: f64| Scene { payload: point(mass), ..scene };
    [
        ("clamped", machine(None), [0.109604, 0.0063166]),
        ("joint", machine(Some(7.1e3)), [0.114586, 0.0066599]),
        ("soft joint", machine(Some(230.0)), [0.215873, 0.0089854]),
        ("gripper", gripper(0.0), [0.249375, 0.0198181]),
        ("gripper beyond", gripper(0.05), [0.283742, 0.0227017]),
        ("width", with(strip(0.5, [0.03, 0.015], [0.002; 2]), 0.03), [0.238909, 0.0315086]),
        ("thickness", with(strip(0.5, [0.02; 2], [0.003, 0.002]), 0.03), [0.175648, 0.0248348]),
        (
            "steel rod",
            with(bar(0.5, steel, CrossSection::Round { diameter: [0.006; 2] }), 0.05),
            [0.099399, 0.0121855],
        ),
        ("tube", with(bar(0.8, aluminium(), tube), 0.2), [0.201113, 0.0131571]),
        (
            "sensor",
            bar(0.3, &sensor, cut)
                .with_mass(PointMass { position: 0.24, mass: 0.005 })
                .expect("a mass on the link"),
            [1.0 / 17.195, 1.0 / 114.49],
        ),
    ]
}

/// `(relative error of the first period, of the second)`.
fn errors(omega: [f64; 2], periods: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|i| (std::f64::consts::TAU / omega[i] / periods[i] - 1.0).abs())
}

#[test]
fn eight_elements_have_the_periods_of_sixty() {
    for (name, scene, periods) in arms() {
        let modes = Modes::of(&EightElements::consistent(&scene).expect("a model"));
        let [first, second] = errors([modes.frequency[0], modes.frequency[1]], periods);
        assert!(first < 5e-4 && second < 2e-3, "{name}: {first:.1e} {second:.1e}");
    }
}

#[test]
fn the_rod_has_the_periods_of_sixty_elements() {
    for (name, scene, periods) in arms() {
        let rod = Rod::<2>::new(&scene).expect("a rod");
        let [first, second] = errors(*rod.frequency(), periods);
        assert!(first < 5e-4 && second < 2e-3, "{name}: {first:.1e} {second:.1e}");
    }
}

/// One element of any link is exact under a force at its tip: with nearly all the mass there, so is
/// the first period.
#[test]
fn one_element_carries_a_tip_load_exactly() {
    let cuts = [
        Section::linear(0.2, [4.0, 4.0], [1e-5, 1e-5]),
        Section::linear(0.3, [0.5, 0.2], [1e-5, 1e-5]),
    ]
    .map(|section| section.expect("a section"));
    let mut scene = Scene::of_sections(&cuts).expect("an arm");
    scene.payload.mass = 1.0;
    let omega =
        |scene: &Scene| Modes::of(&OneElement::consistent(scene).expect("a model")).frequency[0];
    // Compliance ∫ (L − x)²/EI dx.
    let mut compliance = 0.0;
    let steps = 100_000;
    for i in 0..steps {
        let x = 0.5 * (f64::from(i) + 0.5) / f64::from(steps);
        let ei = if x < 0.2 { 4.0 } else { 0.5 - (x - 0.2) };
        compliance += 0.5 / f64::from(steps) * (0.5 - x) * (0.5 - x) / ei;
    }
    let found = omega(&scene).powi(2) * compliance;
    assert!((found - 1.0).abs() < 1e-5, "{found}");
    assert!((scene.link.bending_stiffness * 3.0 * compliance / 0.125 - 1.0).abs() < 1e-6);
    // And behind a joint: 1/k times L² more.
    scene.hub.stiffness = Some(2.0);
    let found = omega(&scene).powi(2) * (compliance + 0.25 / 2.0);
    assert!((found - 1.0).abs() < 1e-5, "{found}");
}

/// A uniform link in one piece, in two sections, and with a mass of nothing on it.
#[test]
fn sections_that_are_alike_make_a_uniform_link() {
    let mut plain = Scene::new(Link { length: 0.5, mass: 0.06, bending_stiffness: 0.9 });
    let half = |length: f64| Section::linear(length, [0.9; 2], [0.12; 2]).expect("a section");
    let mut cut = Scene::of_sections(&[half(0.2), half(0.3)]).expect("an arm");
    for scene in [&mut plain, &mut cut] {
        scene.hub.radius = 0.04;
        scene.payload = Payload { mass: 0.05, inertia: 1e-5, offset: 0.02 };
        scene.hub.stiffness = Some(20.0);
    }
    let (a, b) = (
        EightElements::consistent(&plain).expect("a model"),
        EightElements::consistent(&cut).expect("a model"),
    );
    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-9 * scale;
    for i in 0..16 {
        for j in 0..=i {
            let pairs = [
                (a.mass(), b.mass()),
                (a.stiffness(), b.stiffness()),
                (a.spin(), b.spin()),
                (a.tension(), b.tension()),
                (a.shortening(), b.shortening()),
            ];
            for (n, (a, b)) in pairs.into_iter().enumerate() {
                let scale = (a.get(i, i) * a.get(j, j)).abs().sqrt();
                assert!(close(a.get(i, j), b.get(i, j), scale), "matrix {n}: {i} {j}");
            }
        }
        assert!(close(a.coupling()[i], b.coupling()[i], 1e-2));
    }
    assert!(close(a.rigid_inertia(), b.rigid_inertia(), a.rigid_inertia()));
    assert!(close(a.first_moment(), b.first_moment(), a.first_moment()));
    let (a, b) = (Rod::<3>::new(&plain).expect("a rod"), Rod::<3>::new(&cut).expect("a rod"));
    for k in 0..3 {
        assert!(close(a.frequency()[k], b.frequency()[k], a.frequency()[k]), "mode {k}");
    }
    let bent = [0.02, -0.003, 0.001];
    // Eight points integrate a bent uniform link's mass to 1e-5, sections' stations exactly.
    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-5 * scale;
    let (a, b) = (a.kinetics(&bent), b.kinetics(&bent));
    assert!(close(a.inertia, b.inertia, a.inertia), "{} {}", a.inertia, b.inertia);
    for k in 0..3 {
        assert!(close(a.coupling[k], b.coupling[k], 1e-1), "{:?} {:?}", a.coupling, b.coupling);
        assert!(close(a.mass[k][0], b.mass[k][0], 1.0), "{:?} {:?}", a.mass, b.mass);
    }
    assert!(close(a.tip[0], b.tip[0], 1.0) && close(a.tip[1], b.tip[1], 1.0));
}

/// As the joint grows stiff, the arm tends to the clamped one.
#[test]
fn a_stiff_joint_is_a_clamp() {
    let clamped = Modes::of(&EightElements::consistent(&machine(None)).expect("a model"));
    let rod = Rod::<3>::new(&machine(None)).expect("a rod");
    for (stiffness, error) in [(1e9, 1e-6), (1e12, 1e-9)] {
        let scene = machine(Some(stiffness));
        let modes = Modes::of(&EightElements::consistent(&scene).expect("a model"));
        let own = Rod::<3>::new(&scene).expect("a rod");
        for k in 0..3 {
            assert!((modes.frequency[k] / clamped.frequency[k] - 1.0).abs() < error, "mode {k}");
            assert!((own.frequency()[k] / rod.frequency()[k] - 1.0).abs() < error, "mode {k}");
        }
    }
}

#[test]
fn bad_arms_are_refused_by_name() {
    let refused = |result: Result<Scene, Error>, begin: &str| {
        let text = result.expect_err(begin).to_string();
        assert!(text.starts_with(begin), "{text}");
    };
    let mut scene = machine(Some(0.0));
    refused(scene.validate(), "hub.stiffness = 0: must be");
    scene.hub.stiffness = Some(f64::NAN);
    refused(scene.validate(), "hub.stiffness = NaN: must be");
    scene = machine(None);
    scene.payload.offset = 5.0;
    refused(scene.validate(), "payload.offset = 5: must be");
    scene.payload.offset = -0.01;
    refused(scene.validate(), "payload.offset = -0.01: must be 0 to 4.4 m");
    let beyond = PointMass { position: 0.5, mass: 0.01 };
    refused(machine(None).with_mass(beyond), "link.masses.position = 0.5: must be 0 to 0.44 m");
    refused(Scene::of_sections(&[]), "link.sections = 0: must be 1 to 8 sections");
    let mut scene = machine(None);
    for _ in 0..4 {
        scene = scene.with_mass(PointMass { position: 0.1, mass: 0.01 }).expect("room");
    }
    refused(
        scene.with_mass(PointMass { position: 0.1, mass: 0.01 }),
        "link.masses = 5: must be 0 to 4 masses",
    );
    let thin = Section::linear(0.1, [0.0, 1.0], [0.1; 2]).expect_err("no stiffness");
    assert!(thin.to_string().starts_with("link.sections.bending_stiffness = 0: must be"), "{thin}");
}
