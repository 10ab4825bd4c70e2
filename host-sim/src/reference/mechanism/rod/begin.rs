//! The state in which a run begins.

use nalgebra::Vector2;

use super::chain::{Chain, Strip};
use super::equations::Freedom;
use super::kinematics::Motion;
use crate::mechanism::{first_pin, is_passive};
use crate::reference::ReferenceError;

/// Returns the chain at rest, in static equilibrium, its loop closed if it is pinned from the
/// beginning.
pub(super) fn begin(chain: &Chain) -> Result<Motion, ReferenceError> {
    let mut motion = closed(chain)?;
    let pin = pinned(chain);
    // Passive joints of an open chain begin where they are told to, whatever pulls them.
    let free = match pin {
        Some(_) => chain.free(true),
        None => chain.links.iter().flat_map(Strip::curvatures).collect(),
    };
    let freedom = Freedom { free, pin };
    if !chain.settle(&mut motion, &freedom) {
        let angle = motion.q[0];
        return Err(ReferenceError::NoEquilibrium { angle });
    }
    Ok(motion)
}

/// Returns the chain at rest with its loop closed, if it is pinned from the beginning: its links
/// straight, if the passive joints alone can close it.
pub(super) fn closed(chain: &Chain) -> Result<Motion, ReferenceError> {
    let angles: Vec<f64> = chain.mechanism.joints.iter().map(|joint| joint.angle).collect();
    let mut motion = chain.straight(&angles);
    let pin = pinned(chain);
    if let Some(pin) = pin {
        let passive: Vec<usize> = (0..chain.links.len())
            .filter(|&joint| is_passive(&chain.mechanism, joint, true))
            .map(|joint| chain.links[joint].angle)
            .collect();
        // Straight links first: two passive joints or more close the loop without strain.
        if passive.len() >= 2 && chain.close(&mut motion, &passive, pin) {
            return Ok(motion);
        }
        motion = chain.straight(&angles);
        if !chain.close(&mut motion, &chain.free(true), pin) {
            return Err(ReferenceError::OpenLoop { pin: pin.into() });
        }
    }
    Ok(motion)
}

/// Returns the pin of a chain that is closed from the beginning.
pub(super) fn pinned(chain: &Chain) -> Option<Vector2<f64>> {
    first_pin(&chain.mechanism).map(Vector2::from)
}
