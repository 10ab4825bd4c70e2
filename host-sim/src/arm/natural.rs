//! Natural frequencies and damping ratios of an arm with its hub held.

use std::f64::consts::TAU;

use stillbeam::Scene;
use stillbeam::model::{EightElements, Modes};

use crate::error::Error;

/// Modes that are shown and may be measured.
pub const MODES: usize = 3;

/// Relative change of the joint's stiffness in a central difference.
const DIFFERENCE: f64 = 1e-3;

/// Returns the frequencies of the first modes, Hz, ascending: the straight arm with its payload,
/// hub held, without gravity and damping. Eight elements; the error of a uniform clamped link is
/// 5e-6 of the first, 1e-4 of the second and 1e-3 of the third, all of them too high.
pub fn frequencies(arm: &Scene) -> Result<[f64; MODES], Error> {
    let modes = Modes::of(&EightElements::consistent(arm)?);
    Ok(std::array::from_fn(|i| modes.frequency[i] / TAU))
}

/// Returns the damping ratios of the first modes, whose frequencies in Hz are given:
/// `ζ = (α/ω + (β + e β_J) ω)/2`, `e` the joint's share of the mode's strain energy.
pub fn damping_ratios(arm: &Scene, frequency: &[f64; MODES]) -> Result<[f64; MODES], Error> {
    let share = joint_shares(arm)?;
    Ok(std::array::from_fn(|i| {
        let omega = TAU * frequency[i];
        let damping = &arm.damping;
        0.5 * (damping.alpha / omega + (damping.beta + share[i] * damping.joint) * omega)
    }))
}

/// Returns the joint's shares of the modes' strain energies, 0 to 1, by Rayleigh's quotient: `e =
/// d ln ω²/d ln k`. Zero of a clamped link.
pub fn joint_shares(arm: &Scene) -> Result<[f64; MODES], Error> {
    let Some(stiffness) = arm.hub.stiffness else { return Ok([0.0; MODES]) };
    let with = |factor: f64| {
        let mut arm = *arm;
        arm.hub.stiffness = Some(stiffness * factor);
        frequencies(&arm)
    };
    let (below, above) = (with(1.0 / (1.0 + DIFFERENCE))?, with(1.0 + DIFFERENCE)?);
    let step = 2.0 * DIFFERENCE.ln_1p();
    Ok(std::array::from_fn(|i| (2.0 * (above[i] / below[i]).ln() / step).clamp(0.0, 1.0)))
}
