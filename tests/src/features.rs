//! Features of arms beyond a clamped uniform link, each put on an arm of one's choice.

use stillbeam::scene::{PointMass, Section, Varied};
use stillbeam::{Damping, Scene};

/// Shape of a link that tapers in three sections, one of them thick.
///
/// # Panics
/// Never: the sections are right.
pub fn tapered() -> Varied {
    let section = |length, ei, rho| Section::linear(length, ei, rho).expect("a section");
    let sections = [
        section(0.15, [3.0, 3.0], [1.6, 1.6]),
        section(0.5, [1.2, 0.8], [1.0, 0.9]),
        section(0.35, [0.8, 0.5], [0.9, 0.6]),
    ];
    Varied::of_sections(&sections).expect("a link").1
}

/// Returns the arm with each feature alone, and with all of them. A payload that has no mass is
/// given a fifth of the link's where the feature is about it.
///
/// # Panics
/// Never: every feature is within its range.
pub fn featured(arm: &Scene) -> Vec<(&'static str, Scene)> {
    let (link, length) = (arm.link, arm.link.length);
    let joint = |scene: &Scene| {
        let mut scene = *scene;
        scene.hub.stiffness = Some(8.0 * link.bending_stiffness / length);
        scene
    };
    let offset = |scene: &Scene| {
        let mut scene = *scene;
        if scene.payload.mass == 0.0 {
            scene.payload.mass = 0.2 * link.mass;
        }
        scene.payload.offset = 0.1 * length;
        scene.payload.inertia += scene.payload.mass * (0.03 * length).powi(2);
        scene
    };
    let masses = |scene: &Scene| {
        let mass = 0.1 * link.mass;
        [0.3, 0.7].iter().fold(*scene, |scene, share| {
            scene.with_mass(PointMass { position: share * length, mass }).expect("room")
        })
    };
    let sections = |scene: &Scene| Scene { shape: tapered(), ..*scene };
    // Link and joint in series: some 0.02 of critical for the joint by itself.
    let damped = |scene: &Scene| {
        let slow = (link.mass + arm.payload.mass) * length.powi(3) / link.bending_stiffness;
        let omega = (3.0 / slow).sqrt();
        let joint = Damping::joint_of_ratio(0.02, omega);
        Scene { damping: Damping { joint, ..scene.damping }, ..*scene }
    };
    vec![
        ("joint", joint(arm)),
        ("damped joint", damped(&joint(arm))),
        ("offset", offset(arm)),
        ("sections", sections(arm)),
        ("masses", masses(arm)),
        ("all", joint(&offset(&masses(&sections(arm))))),
        ("all, damped joint", damped(&joint(&offset(&masses(&sections(arm)))))),
    ]
}
