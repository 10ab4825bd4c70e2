//! The torque of the setpoints alone, without a look at the hub.

use stillbeam_sim::plant::{Effort, Options, Parts, Plant};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::servo::setpoints::Setpoints;
use stillbeam_sim::trajectory::Side;

/// Largest distance of the hub from the commanded angle, rad, over the scene's moves.
fn deviation(scene: &SceneFile) -> f64 {
    let setpoints = Setpoints::of(scene).expect("setpoints");
    let tick = setpoints.tick;
    let trajectory = scene.trajectory(tick).expect("a motion");
    let start = setpoints.list[0].setpoint.angle.radians();
    let options = Options { order: 6, tolerance: 1e-8 };
    let mut plant =
        Plant::at_rest(&scene.arm, &Parts::default(), start, &options).expect("a plant");
    let mut worst = 0.0_f64;
    for (k, pair) in setpoints.list.windows(2).enumerate() {
        let begin = tick * k as f64;
        let (from, to) = (pair[0].setpoint.torque, pair[1].before.torque);
        let torque = |t: f64| from + (to - from) * (t - begin) / tick;
        plant.advance(begin + tick, &Effort::Over(&torque)).expect("a step");
        let commanded = trajectory.at(begin + tick, Side::Left).angle.radians();
        worst = worst.max((plant.shown().angle - commanded).abs());
    }
    worst
}

fn d_tip30(tick: f64) -> SceneFile {
    let mut scene = scenes::open("d-tip30").expect("an embedded scene");
    scene.solver.tick = Some(tick);
    for step in &mut scene.moves {
        step.settle = 0.1;
    }
    scene
}

/// Inverse dynamics promises that the torque alone makes the motion.
#[test]
fn torque_alone_makes_the_motion() {
    for (tick, bound) in [(0.01, 5e-3), (0.001, 1e-3)] {
        let found = deviation(&d_tip30(tick));
        println!("{tick} s: {found:e} rad");
        assert!(found < bound, "{tick} s: {found:e} rad");
    }
}
