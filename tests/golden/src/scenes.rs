//! The embedded scenes, as `host-sim/scenes/*.toml` have them.

use stillbeam::{Damping, Hub, Link, Move, Payload, Profile, Scene};

/// A scene with what happens in it.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The scene file's name, without its ending.
    pub name: &'static str,
    /// The arm.
    pub scene: Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// The moves, from rest.
    pub moves: &'static [Move],
    /// Time after the moves, s.
    pub settle: f64,
    /// h, s.
    pub tick: f64,
}

const fn arm(length: f64, mass: f64, bending_stiffness: f64, payload: f64) -> Scene {
    let mut scene = Scene::new(Link { length, mass, bending_stiffness });
    scene.payload.mass = payload;
    scene
}

const HALF_TURN: f64 = core::f64::consts::PI;

/// Every embedded scene.
pub const SCENES: [Run; 6] = [
    Run {
        name: "a-tip30",
        scene: arm(0.4, 0.00952, 0.0213344, 0.03),
        from: 0.0,
        moves: &[Move::To { profile: Profile::Cubic, duration: 2.0, to: HALF_TURN }],
        settle: 2.0,
        tick: 0.01,
    },
    Run {
        name: "b-tip30-damped-hub",
        scene: Scene {
            hub: Hub { radius: 0.04, inertia: 0.0 },
            damping: Damping { alpha: 0.15, beta: 0.002 },
            ..arm(0.4, 0.01904, 0.042656, 0.03)
        },
        from: 0.0,
        moves: &[Move::To { profile: Profile::Cubic, duration: 2.0, to: HALF_TURN }],
        settle: 2.0,
        tick: 0.01,
    },
    Run {
        name: "b-tip30",
        scene: arm(0.4, 0.01904, 0.042656, 0.03),
        from: 0.0,
        moves: &[Move::To { profile: Profile::Cubic, duration: 2.0, to: HALF_TURN }],
        settle: 2.0,
        tick: 0.01,
    },
    Run {
        name: "d-fast",
        scene: arm(0.4, 0.0224, 0.46, 0.0),
        from: 0.0,
        moves: &[Move::To { profile: Profile::Cubic, duration: 0.2, to: HALF_TURN }],
        settle: 0.2,
        tick: 0.01,
    },
    Run {
        name: "s-gravity",
        scene: Scene {
            hub: Hub { radius: 0.1, inertia: 0.0 },
            payload: Payload { mass: 0.2, inertia: 0.001 },
            damping: Damping { alpha: 0.0, beta: 0.0001 },
            gravity: 9.81,
            ..arm(1.0, 0.4, 15.0, 0.2)
        },
        from: -0.4,
        moves: &[Move::To { profile: Profile::Quintic, duration: 0.8, to: 0.4 }],
        settle: 0.8,
        tick: 0.01,
    },
    Run {
        name: "spin-up",
        scene: arm(10.0, 12.0, 14000.0, 0.0),
        from: 0.0,
        moves: &[Move::SpinUp { duration: 15.0, rate: 6.0 }],
        settle: 15.0,
        tick: 0.01,
    },
];
