//! Reference solutions of mechanisms. As for one link, the two solvers share no method with the
//! core, nor with each other. Only the mechanism and the commanded motion are common.
//!
//! | | [`rod`] | [`fem`] |
//! |---|---|---|
//! | links | inextensible, geometrically exact | stretch a little, corotational elements |
//! | unknowns | curvatures and passive angles | nodal displacements in the global frame |
//! | closed loop | multipliers on accelerations | the pinned node is held |
//! | in time | Runge-Kutta, error-controlled | Newmark with equilibrium iterations |
//! | torques | virtual work of the inertia forces | nodal forces carried to the joints |

pub mod fem;
pub mod rod;
mod timetable;

use super::ReferenceError;
use crate::mechanism::table::Row;
use crate::mechanism::{Drives, MechanismScene};
use crate::truth::Reference;

/// Solves a mechanism's run at `times` (s, rising, within the run). Calls `progress` with the
/// fraction that is done.
pub fn solve(
    reference: Reference,
    scene: &MechanismScene,
    drives: &Drives,
    times: &[f64],
    progress: &dyn Fn(f64),
) -> Result<Vec<Row>, ReferenceError> {
    let mechanism = &scene.mechanism;
    match reference {
        Reference::Rod => rod::solve(mechanism, drives, times, &rod::Options::default(), progress),
        Reference::Fem => fem::solve(mechanism, drives, times, &fem::Options::default(), progress),
    }
}
