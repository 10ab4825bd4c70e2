//! Steps of a library's Runge-Kutta methods to a given time.

use std::fmt::Display;

use differential_equations::error::Error;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use differential_equations::traits::State;

use super::ReferenceError;

/// Steps to exactly `stop`, s, on a stretch that begins at `begin` s. Calls `each_step` after every
/// accepted step.
pub(crate) fn advance<Y: State<f64> + Display, F: ODE<f64, Y>>(
    method: &mut impl OrdinaryNumericalMethod<f64, Y>,
    system: &F,
    begin: f64,
    stop: f64,
    each_step: &mut dyn FnMut(f64, &Y),
) -> Result<(), ReferenceError> {
    // Rounding may leave a sliver before a stop; a step that small is none.
    while stop - method.t() > 1e-13 * stop.max(1.0) {
        let proposed = method.h();
        if !proposed.is_finite() {
            let reason = "the state is not finite".to_owned();
            return Err(ReferenceError::Integration { time: method.t(), reason });
        }
        let left = stop - method.t();
        let cut = proposed >= left;
        if cut {
            method.set_h(left);
        }
        method.step(system).map_err(|error| failure(begin, error))?;
        if !matches!(method.status(), Status::RejectedStep) {
            each_step(method.t(), method.y());
            if cut {
                method.set_h(proposed.max(method.h()));
            }
        }
    }
    Ok(())
}

/// Returns the error of a method that stopped on a stretch that begins at `begin` s.
pub(crate) fn failure<Y: State<f64> + Display>(begin: f64, error: Error<f64, Y>) -> ReferenceError {
    let (time, reason) = match error {
        Error::MaxSteps { t, .. } => (t, "too many steps".to_owned()),
        Error::StepSize { t, .. } => (t, "the step became too small".to_owned()),
        Error::Stiffness { t, .. } => (t, "too many steps in a row were rejected".to_owned()),
        Error::LinearAlgebra { t, msg, .. } => (t, msg),
        other => (begin, other.to_string()),
    };
    ReferenceError::Integration { time, reason }
}
