//! Other mounts for drawn arms: carriages, planes that lean, gravity that is turned, carriers.

use std::f64::consts::{FRAC_PI_2, PI};

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::{AxisKind, Damping, Mount, Move, Scene};
use stillbeam_sim::step::Motion;

use super::draw::Drawn;

/// Mounts half of the drawn arms otherwise than on a hub that turns in a vertical plane: a quarter
/// of all on a carriage, an eighth on a carrier that turns, an eighth in a plane that leans.
///
/// From numbers of its own, so that what else is drawn stays what it is.
pub fn mounted(drawn: Drawn, seed: u64, index: u64) -> Drawn {
    let mut rng = StdRng::seed_from_u64(seed.wrapping_mul(0xd6e8_feb8_6659_fd93) ^ index);
    let rng = &mut rng;
    let plane = Mount {
        tilt: if rng.random_bool(0.5) { 0.0 } else { rng.random_range(0.0..FRAC_PI_2) },
        direction: [0.0, FRAC_PI_2, -FRAC_PI_2, rng.random_range(-PI..PI)][rng.random_range(0..4)],
        ..Mount::ROTARY
    };
    match rng.random_range(0..8) {
        0 | 1 => on_carriage(drawn, plane),
        2 => on_carrier(drawn, rng.random_range(-2.0..2.0)),
        3 => with(drawn, plane),
        _ => drawn,
    }
}

fn with(mut drawn: Drawn, mount: Mount) -> Drawn {
    drawn.scene.arm = Scene { mount, ..drawn.scene.arm };
    drawn
}

/// The moves in metres are such that the clamp is accelerated as on the hub that turns.
fn on_carriage(mut drawn: Drawn, plane: Mount) -> Drawn {
    let lever = drawn.scene.arm.reach();
    drawn.scene.from *= lever;
    for step in &mut drawn.scene.moves {
        if let Motion::Move(motion) = &mut step.motion {
            *motion = stretched(*motion, lever);
        }
    }
    with(drawn, Mount { axis: AxisKind::Linear, ..plane })
}

/// A carrier at so many first frequencies. What has no equilibrium there is left out.
fn on_carrier(mut drawn: Drawn, frequencies: f64) -> Drawn {
    let arm = drawn.scene.arm;
    let damping = Damping { alpha: 0.0, ..arm.damping };
    drawn.scene.arm = Scene { damping, gravity: 0.0, ..arm };
    let carrier = (frequencies * drawn.omega).clamp(-1e3, 1e3);
    with(drawn, Mount { carrier, ..Mount::ROTARY })
}

/// The same move on an axis of which `lever` units are one of the other.
fn stretched(motion: Move, lever: f64) -> Move {
    match motion {
        Move::To { profile, duration, to } => Move::To { profile, duration, to: lever * to },
        Move::SpinUp { duration, rate } => Move::SpinUp { duration, rate: lever * rate },
        other => other,
    }
}
