//! Direction of gravity in the hub frame.

use core::f64::consts::TAU;

use super::HubState;
use crate::math::{Scalar, words};

/// Direction of gravity as the hub frame sees it.
///
/// Gravity pulls along `−(sin χ, cos χ)` of the hub frame. With δ the angle by which it is turned
/// from global −Y, counter-clockwise, `χ = θ − δ` on a hub that turns. A carriage does not turn:
/// there `χ = −δ`, whatever its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityDirection<T> {
    /// True if χ changes with the hub's angle.
    follows: bool,
    /// δ in turns.
    turns: T,
    /// Sine and cosine of −δ.
    sin: T,
    cos: T,
}

impl<T: Scalar> GravityDirection<T> {
    /// No gravity. The hub's sine and cosine then stay 0 and 1.
    pub const NONE: Self = Self { follows: false, turns: T::ZERO, sin: T::ZERO, cos: T::ONE };

    /// Gravity on a hub that turns, turned by δ = `direction` rad from global −Y.
    pub(crate) fn on_turning_hub<P: Scalar>(direction: P) -> Self {
        Self { follows: true, ..Self::on_carriage(direction) }
    }

    /// Gravity on a carriage, turned by δ = `direction` rad from global −Y.
    #[inline(never)]
    pub(crate) fn on_carriage<P: Scalar>(direction: P) -> Self {
        let turns = T::from_f64(direction.to_f64() / TAU);
        let (sin, cos) = (-turns).sin_cos_turns();
        Self { follows: false, turns, sin, cos }
    }

    /// True if gravity acts on the arm and χ changes with the hub's angle. Then every tick needs
    /// [`HubState::update_sin_cos`]. If not, χ is set once.
    #[inline(always)]
    pub(crate) fn follows_hub(&self) -> bool {
        self.follows
    }

    /// δ in turns.
    #[inline(always)]
    pub(crate) fn in_turns(&self) -> T {
        self.turns
    }

    /// Sets `hub.sin` and `hub.cos` to sine and cosine of χ. Set-up only.
    pub fn aim(&self, hub: &mut HubState<T>) {
        if self.follows {
            hub.update_sin_cos(self.turns);
        } else {
            (hub.sin, hub.cos) = (self.sin, self.cos);
        }
    }

    /// Returns the hub, whose `sin` and `cos` are those of θ itself, as a stepper is given it: with
    /// those of χ.
    pub fn aimed(&self, hub: &HubState<T>) -> HubState<T> {
        let (sin, cos) = self.seen_from(hub);
        HubState { sin, cos, ..*hub }
    }

    /// Returns `(sin χ, cos χ)` for a hub whose `sin` and `cos` are those of θ itself.
    #[inline(always)]
    pub fn seen_from(&self, hub: &HubState<T>) -> (T, T) {
        if self.follows {
            (hub.sin * self.cos + hub.cos * self.sin, hub.cos * self.cos - hub.sin * self.sin)
        } else {
            (self.sin, self.cos)
        }
    }
}

words! {
    [T: Scalar] GravityDirection<T>: follows, turns, sin, cos;
}

#[cfg(test)]
mod tests {
    use core::f64::consts::FRAC_PI_2;

    use super::GravityDirection;
    use crate::hub::{Angle, HubState};

    fn hub(radians: f64) -> HubState<f64> {
        let mut hub = HubState::at_rest(Angle::from_radians(radians));
        hub.update_sin_cos(0.0);
        hub
    }

    /// Gravity that is turned by δ pulls on a hub at θ as plain gravity does at θ − δ.
    #[test]
    fn both_ways_to_chi_agree() {
        for (theta, delta) in [(0.3, 0.0), (0.3, 0.8), (-2.0, 2.5), (3.0, -3.0)] {
            let gravity = GravityDirection::<f64>::on_turning_hub(delta);
            let mut aimed = hub(theta);
            let (sin, cos) = gravity.seen_from(&aimed);
            gravity.aim(&mut aimed);
            let exact = (theta - delta).sin_cos();
            for (found, exact) in
                [(sin, exact.0), (cos, exact.1), (aimed.sin, exact.0), (aimed.cos, exact.1)]
            {
                assert!((found - exact).abs() < 1e-15, "{theta}, {delta}: {found}, not {exact}");
            }
        }
    }

    /// Without a direction, χ is θ to the bit.
    #[test]
    fn plain_gravity_keeps_the_bits_of_the_hub() {
        let gravity = GravityDirection::<f64>::on_turning_hub(0.0);
        for theta in [0.1, -1.4, 3.0] {
            let plain = hub(theta);
            assert_eq!(gravity.seen_from(&plain), (plain.sin, plain.cos));
        }
    }

    /// A carriage sees the same χ everywhere. A quarter turn is exact: gravity then pulls along +X,
    /// out from the clamp, and not at all across the link.
    #[test]
    fn on_a_carriage_the_position_does_not_matter() {
        let hanging = GravityDirection::<f64>::on_carriage(FRAC_PI_2);
        for position in [0.0, 0.4, -7.0] {
            assert_eq!(hanging.seen_from(&hub(position)), (-1.0, 0.0));
        }
    }
}
