//! A root of a function of one variable, within a bracket.

/// Most evaluations. Bisection alone takes 53 for the precision of a root that is not zero.
const EVALUATIONS: u32 = 100;

/// Returns the root of a function that is negative at `low` and not at `high`, to rounding.
///
/// `f` returns value and slope. Newton's steps begin at `guess`; one that leaves the bracket, or
/// does not halve the step before it, is replaced by a bisection. A slope of zero bisects.
pub(super) fn root(
    mut low: f64,
    mut high: f64,
    guess: f64,
    mut f: impl FnMut(f64) -> (f64, f64),
) -> f64 {
    let mut x = guess.max(low).min(high);
    let mut step_before = high - low;
    for _ in 0..EVALUATIONS {
        let (value, slope) = f(x);
        if value < 0.0 {
            low = x
        } else {
            high = x
        }
        let newton = x - value / slope;
        let inside = low < newton && newton < high;
        let halves = libm::fabs(newton - x) < 0.5 * libm::fabs(step_before);
        // Of the two ends, the upper is on the side of the root that is asked for.
        let next = if inside && halves { newton } else { low + 0.5 * (high - low) };
        step_before = next - x;
        if libm::fabs(step_before) <= f64::EPSILON * libm::fabs(x) || value == 0.0 {
            break;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn roots_are_found_wherever_newton_would_leave() {
        let cube = |x: f64| (x * x * x - 1e-12, 3.0 * x * x);
        assert!((root(0.0, 1e3, 1e3, cube) - 1e-4).abs() < 1e-18);
        // Newton's step from the guess leaves the bracket; the slope vanishes at 0.
        let step = |x: f64| (libm::tanh(x - 3.0), 1.0 - libm::tanh(x - 3.0).powi(2));
        assert!((root(-50.0, 50.0, 20.0, step) - 3.0).abs() < 1e-15);
        let bisected = root(0.0, 1.0, 0.5, |x| (x - 0.3, 0.0));
        assert!((bisected - 0.3).abs() <= f64::EPSILON, "{bisected}");
        assert!(root(0.0, 1.0, 0.5, |x| (x - 1.0, 0.0)) >= 1.0 - 2.0 * f64::EPSILON);
    }
}
