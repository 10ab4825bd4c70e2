//! Places and torques of five mechanisms.

use super::scenes::{self, Row, Scene};

/// Errors of a run.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    /// Largest distance of a joint or the tip, over the total length.
    place: f64,
    /// Largest error of a torque, over the peak of its own joint.
    torque: f64,
    /// Largest error of an angle, rad: of passive joints, the others are commanded.
    angle: f64,
    /// Largest error of a link's end in the frame of its base, over the link's length.
    deflection: f64,
}

/// A row of the truth on each side of a jump of acceleration is left out for torques.
fn errors(scene: &Scene, rows: &[Row], tick: f64) -> Errors {
    let truth = scenes::truth(scene.name, scene.mechanism.links.len());
    let every = (0.01 / tick).round() as usize;
    assert_eq!(rows.len(), (truth.len() - 1) * every + 1, "{}", scene.name);
    let jumps = scene.jumps();
    let length = scene.mechanism.total_length();
    let peaks = scenes::peaks(&truth);
    let mut worst = Errors::default();
    for (row, exact) in rows.iter().step_by(every).zip(&truth) {
        assert!((row.time - exact.time).abs() < 1e-9);
        for (end, exact) in row.ends.iter().zip(&exact.ends) {
            worst.place = worst.place.max((end[0] - exact[0]).hypot(end[1] - exact[1]) / length);
        }
        let links = scene.mechanism.links.iter();
        for ((found, exact), link) in row.deflections.iter().zip(&exact.deflections).zip(links) {
            worst.deflection = worst.deflection.max((found - exact).abs() / link.length);
        }
        for (found, exact) in row.angles.iter().zip(&exact.angles) {
            worst.angle = worst.angle.max((found - exact).abs());
        }
        if jumps.iter().any(|jump| (row.time - jump).abs() < 0.011) {
            continue;
        }
        for (joint, peak) in peaks.iter().enumerate().filter(|(_, peak)| **peak > 1e-6) {
            worst.torque =
                worst.torque.max((row.torques[joint] - exact.torques[joint]).abs() / peak);
        }
    }
    worst
}

/// Bounds of places, torques, angles and deflections.
type Bounds = [f64; 4];

/// Holds n = 2 and n = 3 at 10 ms and n = 3 at 5 ms to bounds, in f32.
fn assert_accurate<const LINKS: usize, const C2: usize, const C3: usize>(
    scene: &Scene,
    bounds: [Bounds; 3],
) {
    let found = [
        errors(scene, &scenes::run::<f32, LINKS, 3, C2, 3>(scene, 0.01), 0.01),
        errors(scene, &scenes::run::<f32, LINKS, 4, C3, 5>(scene, 0.01), 0.01),
        errors(scene, &scenes::run::<f32, LINKS, 4, C3, 5>(scene, 0.005), 0.005),
    ];
    for (found, bounds) in found.iter().zip(bounds) {
        let Errors { place, torque, angle, deflection } = *found;
        println!("{:14} {place:.2e} {torque:.2e} {angle:.2e} {deflection:.2e}", scene.name);
        for (error, bound) in [place, torque, angle, deflection].iter().zip(bounds) {
            assert!(*error <= bound, "{}: {found:?}, {bounds:?}", scene.name);
        }
    }
}

/// Measured figures beside the bounds, which are those with a little room. Angles of driven joints
/// are commanded: what is left is rounding.
#[test]
fn places_and_torques_are_those_of_the_truth() {
    assert_accurate::<2, 6, 8>(
        &scenes::arm_dd(),
        [
            [6e-4, 8e-3, 1e-6, 5.8e-4],   // 5.7e-4 7.6e-3 5.4e-4
            [5.6e-4, 7e-3, 1e-6, 5.8e-4], // 5.3e-4 6.3e-3 5.4e-4
            [9e-5, 9e-4, 1e-6, 1e-4],     // 7.9e-5 8.2e-4 8.9e-5
        ],
    );
    assert_accurate::<2, 6, 8>(
        &scenes::arm_bc_sag(),
        [
            [3e-4, 1.5e-3, 1e-6, 2.8e-4], // 2.7e-4 1.3e-3 2.5e-4
            [7e-6, 4.2e-4, 1e-6, 1.5e-5], // 6.2e-6 3.8e-4 1.3e-5
            [3e-6, 6.5e-5, 1e-6, 5.5e-6], // 2.4e-6 5.9e-5 4.8e-6
        ],
    );
    assert_accurate::<2, 6, 8>(
        &scenes::rigid_forearm(),
        [
            [1.3e-3, 1.4e-2, 1e-6, 2.8e-3], // 1.2e-3 1.3e-2 2.6e-3
            [1.3e-3, 1.4e-2, 1e-6, 2.7e-3], // 1.2e-3 1.3e-2 2.4e-3
            [1.8e-4, 3.2e-3, 1e-6, 3.6e-4], // 1.6e-4 2.9e-3 3.2e-4
        ],
    );
    assert_accurate::<3, 9, 12>(
        &scenes::four_bar(),
        [
            [7e-5, 2.2e-2, 6.6e-3, 4.3e-3],   // 6.0e-5 2.1e-2 6.1e-3 4.0e-3
            [2.2e-5, 1.7e-2, 1.1e-3, 6.4e-4], // 2.0e-5 1.6e-2 9.2e-4 5.6e-4
            [5e-6, 3.7e-3, 1.7e-4, 1e-4],     // 4.2e-6 3.3e-3 1.4e-4 8.4e-5
        ],
    );
    assert_accurate::<3, 9, 12>(
        &scenes::latch(),
        [
            [3.8e-4, 4.4e-3, 2e-3, 3e-4],     // 3.6e-4 4.1e-3 1.8e-3 2.8e-4
            [4.2e-4, 4.7e-3, 2.2e-3, 3.2e-4], // 3.9e-4 4.3e-3 2.0e-3 2.9e-4
            [9.6e-5, 1.1e-3, 4.9e-4, 7.2e-5], // 8.9e-5 1.0e-3 4.6e-4 6.7e-5
        ],
    );
}

/// Both precisions are equally good: rounding is far below the error of the tick.
#[test]
fn single_precision_is_enough() {
    for scene in [scenes::four_bar(), scenes::latch()] {
        let single = errors(&scene, &scenes::run::<f32, 3, 3, 9, 3>(&scene, 0.01), 0.01);
        let double = errors(&scene, &scenes::run::<f64, 3, 3, 9, 3>(&scene, 0.01), 0.01);
        assert!((single.place - double.place).abs() < 1e-6);
        assert!((single.torque - double.torque).abs() < 1e-4);
    }
}
