//! Places and torques of five mechanisms.

use stillbeam::Scalar;

use super::scenes::{self, Row, Scene};

/// Largest error of a joint's place or the tip's over the total length, and of a torque over its
/// peak. A tick of the truth on each side of a jump of acceleration is left out for torques.
fn errors(scene: &Scene, rows: &[Row], tick: f64) -> (f64, f64) {
    let truth = scenes::truth(scene.name, scene.mechanism.links.len());
    let every = (0.01 / tick).round() as usize;
    assert_eq!(rows.len(), (truth.len() - 1) * every + 1, "{}", scene.name);
    let jumps = scene.jumps();
    let length = scene.mechanism.total_length();
    let peaks = scenes::peaks(&truth);
    let (mut place, mut torque): (f64, f64) = (0.0, 0.0);
    for (row, exact) in rows.iter().step_by(every).zip(&truth) {
        assert!((row.time - exact.time).abs() < 1e-9);
        for (end, exact) in row.ends.iter().zip(&exact.ends) {
            place = place.max((end[0] - exact[0]).hypot(end[1] - exact[1]) / length);
        }
        for (found, exact) in row.deflections.iter().zip(&exact.deflections) {
            place = place.max((found - exact).abs() / length);
        }
        for (found, exact) in row.angles.iter().zip(&exact.angles) {
            assert!(
                (found - exact).abs() < 0.01,
                "{} at {}: {found}, {exact}",
                scene.name,
                row.time
            );
        }
        if jumps.iter().any(|jump| (row.time - jump).abs() < 0.011) {
            continue;
        }
        for (joint, peak) in peaks.iter().enumerate().filter(|(_, peak)| **peak > 1e-6) {
            torque = torque.max((row.torques[joint] - exact.torques[joint]).abs() / peak);
        }
    }
    (place, torque)
}

/// Bounds of places and torques: of n = 2 and n = 3 at 10 ms, of n = 3 at 5 ms.
type Bounds = [(f64, f64); 3];

fn assert_accurate<T: Scalar, const LINKS: usize, const C2: usize, const C3: usize>(
    scene: &Scene,
    bounds: Bounds,
) {
    let found = [
        errors(scene, &scenes::run::<T, LINKS, 3, C2, 3>(scene, 0.01), 0.01),
        errors(scene, &scenes::run::<T, LINKS, 4, C3, 5>(scene, 0.01), 0.01),
        errors(scene, &scenes::run::<T, LINKS, 4, C3, 5>(scene, 0.005), 0.005),
    ];
    for (found, bound) in found.iter().zip(bounds) {
        assert!(found.0 <= bound.0 && found.1 <= bound.1, "{}: {found:?}, {bound:?}", scene.name);
    }
}

/// Measured figures beside the bounds, which are those with a little room.
fn assert_all_accurate<T: Scalar>() {
    // 5.7e-4 0.76 %, 5.3e-4 0.63 %, 7.9e-5 0.08 %
    let bounds = [(6e-4, 0.009), (5.6e-4, 0.007), (9e-5, 0.001)];
    assert_accurate::<T, 2, 6, 8>(&scenes::arm_dd(), bounds);
    // 2.7e-4 0.13 %, 9.6e-6 0.04 %, 5.3e-6 0.01 %
    let bounds = [(3e-4, 0.0015), (1.2e-5, 0.0005), (7e-6, 0.0002)];
    assert_accurate::<T, 2, 6, 8>(&scenes::arm_bc_sag(), bounds);
    // 1.2e-3 1.30 %, 1.2e-3 1.28 %, 1.6e-4 0.29 %
    let bounds = [(1.25e-3, 0.014), (1.25e-3, 0.014), (1.8e-4, 0.0032)];
    assert_accurate::<T, 2, 6, 8>(&scenes::rigid_forearm(), bounds);
    // 6.2e-5 2.03 %, 1.9e-5 1.48 %, 4.2e-6 0.34 %
    let bounds = [(7e-5, 0.022), (2.2e-5, 0.016), (6e-6, 0.0038)];
    assert_accurate::<T, 3, 9, 12>(&scenes::four_bar(), bounds);
    // 7.4e-5 0.15 %, 1.0e-4 0.14 %, 1.2e-5 0.02 %
    let bounds = [(9e-5, 0.0018), (1.2e-4, 0.0018), (1.5e-5, 0.0003)];
    assert_accurate::<T, 3, 9, 12>(&scenes::latch(), bounds);
}

#[test]
fn places_and_torques_are_those_of_the_truth_in_f32() {
    assert_all_accurate::<f32>();
}

#[test]
fn places_and_torques_are_those_of_the_truth_in_f64() {
    assert_all_accurate::<f64>();
}
