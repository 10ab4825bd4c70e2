//! Steps of a library's Runge-Kutta methods to a given time.

use differential_equations::error::Error;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use differential_equations::traits::State;

use super::ReferenceError;

/// Steps to exactly `stop`, s, on a stretch that begins at `begin` s. Calls `each_step` after every
/// accepted step. `lost` is the reason for a step that is not finite.
pub(crate) fn advance<Y: State<f64>, F: ODE<f64, Y>>(
    method: &mut impl OrdinaryNumericalMethod<f64, Y>,
    system: &F,
    [begin, stop]: [f64; 2],
    lost: &str,
    each_step: &mut dyn FnMut(f64, &Y),
) -> Result<(), ReferenceError> {
    // Rounding may leave a sliver before a stop; a step that small is none.
    while stop - method.t() > 1e-13 * stop.max(1.0) {
        let proposed = method.h();
        if !proposed.is_finite() {
            let reason = lost.to_owned();
            return Err(ReferenceError::Integration { time: method.t(), reason });
        }
        let left = stop - method.t();
        let cut = proposed >= left;
        if cut {
            method.set_h(left);
        }
        method.step(system).map_err(|error| failure(begin, error))?;
        if matches!(method.status(), Status::RejectedStep) {
            // Where no step is finite the library shortens it on and on, until time stands still.
            if method.t() + method.h() == method.t() {
                let reason = lost.to_owned();
                return Err(ReferenceError::Integration { time: method.t(), reason });
            }
        } else {
            each_step(method.t(), method.y());
            if cut {
                method.set_h(proposed.max(method.h()));
            }
        }
    }
    Ok(())
}

/// Reason of a rod whose state is lost.
pub(crate) const NOT_FINITE: &str = "the state is not finite";

/// Returns the error of a method that stopped on a stretch that begins at `begin` s.
pub(crate) fn failure<Y: State<f64>>(begin: f64, error: Error<f64, Y>) -> ReferenceError {
    let (time, reason) = match error {
        Error::MaxSteps { t, .. } => (t, "too many steps".to_owned()),
        Error::StepSize { t, .. } => (t, "the step became too small".to_owned()),
        Error::Stiffness { t, .. } => (t, "too many steps in a row were rejected".to_owned()),
        Error::LinearAlgebra { t, msg, .. } => (t, msg),
        other => (begin, format!("{other:?}")),
    };
    ReferenceError::Integration { time, reason }
}
