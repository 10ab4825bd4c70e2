//! A stop brakes all joints along their common path.

use stillbeam::chain::{Chain, ChainGenerator};
use stillbeam::{Error, Limits, Move, Profile};

use super::scenes;

type Arm = ChainGenerator<f32, 2, 3, 6, 3, 8>;

const LIMITS: Limits = Limits {
    rate: None,
    acceleration: Some(30.0),
    deceleration: None,
    jerk: None,
    torque: None,
    moment: None,
};

fn arm() -> Arm {
    let chain = Chain::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let mut arm = Arm::new(chain, [0.0, 0.3]).expect("a generator");
    for joint in 0..2 {
        arm.limit(joint, LIMITS).expect("limits");
    }
    for (joint, to) in [(0, 1.0), (1, 1.3), (0, 0.5), (1, -0.4)] {
        let duration = 0.6;
        arm.push(joint, &Move::To { profile: Profile::Quintic, duration, to }).expect("a move");
    }
    arm
}

/// Angles that both joints pass at the same time, every 1/20 tick.
fn path() -> Vec<[f64; 2]> {
    let chain =
        Chain::<f64, 2, 3, 6, 3>::new(&scenes::arm_dd().mechanism, 0.0005).expect("a chain");
    let mut arm = ChainGenerator::<f64, 2, 3, 6, 3, 8>::new(chain, [0.0, 0.3]).expect("an arm");
    for (joint, to) in [(0, 1.0), (1, 1.3), (0, 0.5), (1, -0.4)] {
        let motion = Move::To { profile: Profile::Quintic, duration: 0.6, to };
        arm.push(joint, &motion).expect("a move");
    }
    (0..2_600).map(|_| arm.tick().joints.map(|joint| joint.angle.radians())).collect()
}

#[test]
fn a_stop_at_any_tick_stays_on_the_path_and_keeps_the_limits() {
    let path = path();
    for begins in [1, 5, 17, 30, 44, 59, 60, 61, 75, 100, 119, 130] {
        let mut arm = arm();
        let mut last = arm.tick();
        for _ in 1..begins {
            last = arm.tick();
        }
        arm.stop().expect("limits are set");
        let mut ticks = 0;
        while arm.is_stopping() {
            let setpoint = arm.tick();
            ticks += 1;
            assert!(ticks < 200, "from tick {begins}");
            let angles = setpoint.joints.map(|joint| joint.angle.precise().radians());
            let off = path
                .iter()
                .map(|at| (at[0] - angles[0]).abs().max((at[1] - angles[1]).abs()))
                .fold(f64::INFINITY, f64::min);
            assert!(off < 2e-3, "from tick {begins}: {off} rad off the path");
            for (joint, before) in setpoint.joints.iter().zip(&last.joints) {
                let step = (joint.rate - before.rate).abs() / 0.01;
                assert!(step <= 30.0 * 1.02, "from tick {begins}: {step} rad/s²");
            }
            last = setpoint;
        }
        assert!(last.joints.iter().all(|joint| joint.rate.abs() < 1e-4), "{last:?}");
        assert!(arm.is_holding());
        // It holds where it stopped, and takes other moves.
        let held = arm.tick();
        for (joint, before) in held.joints.iter().zip(&last.joints) {
            assert_eq!((joint.angle, joint.rate), (before.angle, 0.0));
        }
        arm.push(0, &Move::To { profile: Profile::Quintic, duration: 1.0, to: 0.0 })
            .expect("a move");
    }
}

#[test]
fn a_stop_needs_limits_and_lets_no_move_in() {
    let chain = Chain::new(&scenes::arm_dd().mechanism, 0.01).expect("a chain");
    let mut free = Arm::new(chain, [0.0, 0.3]).expect("a generator");
    assert!(matches!(
        free.stop(),
        Err(Error::OutOfRange { parameter: "joints[0].limits.acceleration", .. })
    ));
    let mut arm = arm();
    for _ in 0..20 {
        arm.tick();
    }
    arm.stop().expect("limits are set");
    let motion = Move::To { profile: Profile::Quintic, duration: 0.6, to: 0.0 };
    assert!(matches!(arm.push(0, &motion), Err(Error::Moving)));
}
