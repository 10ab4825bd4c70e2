//! The geometrically exact, inextensible rod of one link, generalised to a chain: every flexible
//! link's curvature in Legendre polynomials, passive joints' angles, Runge-Kutta in time.
//!
//! A link's tangent is at `Φ + Σ aₖψₖ`, `ψₖ = ∫₀ˢ Pₖ₋₁/L`; its points follow by quadrature. Mass
//! matrix and torques are sums over all points that have mass, `Σ m JᵀJ` and `Σ m Jᵀa`, with the
//! Jacobians of the points: virtual work, without a recursion. Largest difference from the truth
//! files: see `docs/mechanisms.md`.

mod begin;
mod chain;
mod equations;
mod kinematics;
mod march;
mod statics;

use chain::Chain;
use stillbeam::mechanism::Mechanism;

use super::timetable::Timetable;
use crate::mechanism::Drives;
use crate::mechanism::table::Row;
use crate::reference::ReferenceError;
use crate::reference::option::within;

/// Options of the solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of polynomials a flexible link, 2 to 8.
    pub order: usize,
    /// Relative and absolute tolerance of a step, on angles in rad and on their rates over the
    /// chain's first angular frequency; 1e-12 to 1e-4.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { order: 5, tolerance: 1e-9 }
    }
}

/// Returns the angles of the joints with which a mechanism begins, rad: in a closed loop, and under
/// gravity, those of its static equilibrium.
pub fn initial(mechanism: &Mechanism) -> Result<Vec<f64>, ReferenceError> {
    let chain = Chain::new(mechanism, Options::default().order);
    let motion = begin::begin(&chain)?;
    Ok(chain.links.iter().map(|link| motion.q[link.angle]).collect())
}

/// Returns the row of a mechanism at rest in static equilibrium.
pub fn at_rest(mechanism: &Mechanism) -> Result<Row, ReferenceError> {
    let chain = Chain::new(mechanism, Options::default().order);
    let motion = begin::begin(&chain)?;
    Ok(march::row(&chain, 0.0, &motion, &nalgebra::DVector::zeros(chain.size)))
}

/// Returns the angles of the joints at which a mechanism begins if its links stay straight, rad: of
/// a closed loop those that close it. `None` if the loop closes by bending its links only.
pub(super) fn closed_straight(mechanism: &Mechanism) -> Result<Option<Vec<f64>>, ReferenceError> {
    let chain = Chain::new(mechanism, Options::default().order);
    let motion = begin::closed(&chain)?;
    let straight = chain.stiffnesses().all(|(i, _)| motion.q[i] == 0.0);
    Ok(straight.then(|| chain.links.iter().map(|link| motion.q[link.angle]).collect()))
}

/// Solves a run of a mechanism and samples it at `times` (s, ascending, within the run). Calls
/// `progress` with the fraction of the run that is done.
///
/// The mechanism starts from rest in static equilibrium. See [`Options`] for errors.
pub fn solve(
    mechanism: &Mechanism,
    drives: &Drives,
    times: &[f64],
    options: &Options,
    progress: &dyn Fn(f64),
) -> Result<Vec<Row>, ReferenceError> {
    within("order", options.order as f64, [2.0, 8.0], "2 to 8 polynomials")?;
    within("tolerance", options.tolerance, [1e-12, 1e-4], "1e-12 to 1e-4")?;
    let chain = Chain::new(mechanism, options.order);
    let timetable = Timetable::new(mechanism, drives, times)?;
    march::run(&chain, &timetable, options.tolerance, progress)
}
