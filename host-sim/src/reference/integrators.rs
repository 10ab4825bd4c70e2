//! The library's Runge-Kutta methods, with the settings of every solver here.

use differential_equations::methods::{DiagonallyImplicitRungeKutta, ExplicitRungeKutta};
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::traits::State;

/// Dormand and Prince's method of order 8 with that tolerance, relative and absolute. Its first
/// step is `first` s; 0 leaves it to the method.
pub(crate) fn explicit<Y: State<f64>>(
    tolerance: f64,
    first: f64,
) -> impl OrdinaryNumericalMethod<f64, Y> {
    ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).h0(first).max_steps(usize::MAX)
}

/// Dormand and Prince's method of order 5, as [`explicit`]: half of the evaluations a step, for a
/// loose tolerance and steps that are cut short by what the machine is told anew.
pub(crate) fn explicit_loose<Y: State<f64>>(
    tolerance: f64,
    first: f64,
) -> impl OrdinaryNumericalMethod<f64, Y> {
    ExplicitRungeKutta::dopri5().rtol(tolerance).atol(tolerance).h0(first).max_steps(usize::MAX)
}

/// Kvaerno's method of order 5, diagonally implicit, as [`explicit`].
pub(crate) fn implicit<Y: State<f64>>(
    tolerance: f64,
    first: f64,
) -> impl OrdinaryNumericalMethod<f64, Y> {
    DiagonallyImplicitRungeKutta::kvaerno745()
        .rtol(tolerance)
        .atol(tolerance)
        .newton_tol(0.1 * tolerance)
        .h0(first)
        .max_steps(usize::MAX)
        // The library counts all rejections, not those in a row.
        .max_rejects(usize::MAX)
}
