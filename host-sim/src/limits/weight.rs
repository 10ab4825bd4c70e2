//! Loads that hold the arm at rest against its weight.

use stillbeam::{Angle, Scene};

use crate::error::Error;
use crate::reference::rod;

/// Greatest step of the hub between two equilibria, rad. The peak of a holding torque is as flat as
/// a cosine's, so this step gives it to 1e-4.
const STEP: f64 = 0.03;

/// Greatest range of hub angles, rad. Beyond two turns the torques repeat.
const TURN: f64 = 2.0 * std::f64::consts::TAU;

/// Returns the greatest hub torque and clamp moment, N m, of the arm at rest under its weight
/// anywhere between two hub angles, rad. The motor feels them however slowly the hub moves from one
/// angle to the other. Zero without gravity.
pub fn holding(arm: &Scene, from: f64, to: f64) -> Result<[f64; 2], Error> {
    let mut most = [0.0_f64; 2];
    if arm.in_plane_gravity() == 0.0 {
        return Ok(most);
    }
    // A carriage carries the same weight everywhere.
    let to = if arm.mount.is_linear() { from } else { to };
    let to = from + (to - from).clamp(-TURN, TURN);
    let steps = ((to - from).abs() / STEP).ceil().max(1.0) as u32;
    for k in 0..=steps {
        let angle = from + (to - from) * f64::from(k) / f64::from(steps);
        // Where the arm has no rest there is none to be held against.
        let Ok(loads) = rod::rest_loads(arm, Angle::from_radians(angle)) else { continue };
        for (most, load) in most.iter_mut().zip(loads) {
            *most = most.max(load.abs());
        }
    }
    Ok(most)
}
