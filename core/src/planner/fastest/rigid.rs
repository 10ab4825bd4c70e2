//! The shortest time of a rigid arm, with which the search begins.

use crate::motion::Limits;

/// Times of the fastest motion of a rigid arm from rest to rest, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rigid {
    /// All of it.
    pub duration: f64,
    /// Until the greatest rate is reached.
    pub ramp: f64,
}

/// Finds the times of a turn by `angle` rad within `limits`, `inertia` (kg m²) standing for the arm
/// and its hub. `None` if nothing limits it.
pub(super) fn rigid(angle: f64, limits: &Limits, inertia: f64) -> Option<Rigid> {
    let by_torque = limits.torque.map_or(f64::INFINITY, |torque| torque / inertia);
    let acceleration = limits.acceleration.unwrap_or(f64::INFINITY).min(by_torque);
    let jerk = limits.jerk.unwrap_or(f64::INFINITY);
    let limit = limits.rate.unwrap_or(f64::INFINITY);
    if acceleration.is_infinite() && jerk.is_infinite() && limit.is_infinite() {
        return None;
    }
    // The greatest rate is that at which the ramps alone make up the angle, or the limit.
    let settle = if jerk.is_infinite() { 0.0 } else { acceleration / jerk };
    let by_jerk = libm::cbrt(0.25 * angle * angle * jerk);
    let by_both =
        0.5 * acceleration * (libm::sqrt(settle * settle + 4.0 * angle / acceleration) - settle);
    let triangular = if by_jerk * jerk < acceleration * acceleration || acceleration.is_infinite() {
        by_jerk
    } else {
        by_both
    };
    let rate = triangular.min(limit);
    let ramp = if rate * jerk < acceleration * acceleration || acceleration.is_infinite() {
        if jerk.is_infinite() { 0.0 } else { 2.0 * libm::sqrt(rate / jerk) }
    } else {
        rate / acceleration + settle
    };
    Some(Rigid { duration: angle / rate + ramp, ramp })
}

#[cfg(test)]
mod tests {
    use super::rigid;
    use crate::motion::Limits;

    #[test]
    fn times_are_those_of_the_textbook() {
        let near = |limits: Limits, duration: f64, ramp: f64| {
            let found = rigid(2.0, &limits, 0.5).expect("a limit");
            assert!((found.duration - duration).abs() < 1e-12, "{found:?} is not {duration}");
            assert!((found.ramp - ramp).abs() < 1e-12, "{found:?} is not {ramp}");
        };
        let none = Limits::default();
        let acceleration = Some(8.0);
        near(Limits { acceleration, ..none }, 1.0, 0.5);
        near(Limits { torque: Some(4.0), ..none }, 1.0, 0.5);
        near(Limits { acceleration, rate: Some(2.0), ..none }, 1.25, 0.25);
        near(Limits { rate: Some(2.0), ..none }, 1.0, 0.0);
        near(Limits { jerk: Some(64.0), ..none }, 1.0, 0.5);
        near(Limits { jerk: Some(64.0), acceleration: Some(16.0), ..none }, 1.0, 0.5);
        // S-curve of equal sevenths: 6.125, 42.875 and 1.75 times angle over T², T³, T.
        let s_curve = Limits { acceleration: Some(12.25), jerk: Some(85.75), ..none };
        near(Limits { rate: Some(3.5), ..s_curve }, 1.0, 3.0 / 7.0);
        assert_eq!(rigid(2.0, &none, 0.5), None);
    }
}
