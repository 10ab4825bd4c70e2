//! Random scenes on other mounts: carriages, planes that lean, gravity that is turned, carriers.

use std::f64::consts::{FRAC_PI_2, PI};

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::{AxisKind, Damping, Mount, Move, Scene};
use stillbeam_sim::solver::{Mass, Method};
use stillbeam_sim::step::Step;

use super::draw::{Drawn, draw};

/// Draws the scene of that number under that seed as [`draw`] does, and mounts it otherwise: half
/// of the arms on a carriage, a quarter on a carrier that turns, the others in a plane that leans.
///
/// A family of its own, so that the numbers of the scenes that campaigns have found stay theirs.
pub fn draw_mounted(seed: u64, index: u64) -> Drawn {
    let mut rng = StdRng::seed_from_u64(seed.wrapping_mul(0xd6e8_feb8_6659_fd93) ^ index);
    let rng = &mut rng;
    let mut drawn = draw(seed, index);
    let arm = drawn.scene.arm;
    let mut mount = Mount {
        tilt: if rng.random_bool(0.5) { 0.0 } else { rng.random_range(0.0..FRAC_PI_2) },
        direction: [0.0, FRAC_PI_2, -FRAC_PI_2, rng.random_range(-PI..PI)][rng.random_range(0..4)],
        ..Mount::ROTARY
    };
    match rng.random_range(0..4) {
        0 | 1 => {
            mount.axis = AxisKind::Linear;
            // The same acceleration of the clamp for the same acceleration of the axis.
            let lever = arm.hub.radius + arm.link.length;
            drawn.scene.from *= lever;
            for step in &mut drawn.scene.moves {
                *step = Step { motion: stretched(step.motion, lever), ..*step };
            }
            drawn.scene.arm = Scene { mount, ..arm };
        }
        2 => {
            mount = Mount { carrier: drawn.omega * rng.random_range(-2.0..2.0), ..Mount::ROTARY };
            let damping = Damping { alpha: 0.0, ..arm.damping };
            drawn.scene.arm = Scene { mount, damping, gravity: 0.0, ..arm };
            drawn.solvers.retain(|solver| match solver.method {
                Method::Newmark | Method::Auto => false,
                Method::Modal => solver.elements == 8 && solver.mass == Mass::Consistent,
                _ => true,
            });
        }
        _ => drawn.scene.arm = Scene { mount, ..arm },
    }
    drawn
}

/// The same move on an axis of which `lever` units are one of the other.
fn stretched(motion: Move, lever: f64) -> Move {
    match motion {
        Move::To { profile, duration, to } => Move::To { profile, duration, to: lever * to },
        Move::SpinUp { duration, rate } => Move::SpinUp { duration, rate: lever * rate },
        other => other,
    }
}
