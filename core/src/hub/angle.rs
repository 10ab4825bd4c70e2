//! The hub angle as whole turns and a remainder.

use core::f64::consts::TAU;

use crate::math::Scalar;

/// An angle `turns + part`, in turns.
///
/// `part` lies in `−½ ..= ½`, so that its resolution (3e-8 turn in f32) does not depend on how
/// often the hub has gone round. Turns rather than radians, because whole turns then come off
/// without rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Angle<T> {
    /// Whole turns; wraps after 2³¹.
    pub turns: i32,
    /// The rest, turns, `−½ ..= ½`.
    pub part: T,
}

impl<T: Scalar> Angle<T> {
    /// Returns the angle `delta` turns further on; `|delta|` below 2²¹ − 1 turns.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, delta: T) -> Self {
        let (whole, part) = (self.part + delta).split();
        Self { turns: self.turns.wrapping_add(whole), part }
    }

    /// Returns the same angle in the precision of set-up.
    #[inline(always)]
    #[must_use]
    pub fn precise(self) -> Angle<f64> {
        Angle { turns: self.turns, part: self.part.to_f64() }
    }

    /// Turns from `start` to here, as one number.
    pub fn since(self, start: Self) -> T {
        let whole = self.turns.wrapping_sub(start.turns);
        let magnitude = T::from_u32(whole.unsigned_abs());
        (if whole < 0 { -magnitude } else { magnitude }) + (self.part - start.part)
    }

    /// Turns, as one number: exact to 2e-16 of itself.
    pub fn in_turns(self) -> f64 {
        f64::from(self.turns) + self.part.to_f64()
    }

    /// Radians, as one number.
    pub fn radians(self) -> f64 {
        TAU * self.in_turns()
    }

    /// `(sin θ, cos θ)`.
    #[inline(always)]
    pub fn sin_cos(self) -> (T, T) {
        self.part.sin_cos_turns()
    }
}

impl Angle<f64> {
    /// Converts an angle in radians; `|radians|` below 2³¹ − 1 turns.
    pub fn from_radians(radians: f64) -> Self {
        Self { turns: 0, part: 0.0 }.plus(radians / TAU)
    }

    /// Rounds the remainder to the scalar of the tick.
    #[must_use]
    pub fn cast<T: Scalar>(self) -> Angle<T> {
        Angle { turns: self.turns, part: T::from_f64(self.part) }
    }
}

#[cfg(test)]
mod tests {
    use super::Angle;

    /// A turn of ten thousand keeps the fraction that an f32 of radians would have lost.
    #[test]
    fn far_turns_keep_their_fraction() {
        let mut angle = Angle { turns: 0, part: 0.0_f32 };
        for _ in 0..10_000 {
            angle = angle.plus(1.0);
        }
        angle = angle.plus(1e-7);
        assert_eq!(angle, Angle { turns: 10_000, part: 1e-7 });
    }

    #[test]
    fn half_a_turn_is_where_the_count_changes() {
        let before = Angle { turns: 0, part: 0.499_f64 };
        let after = before.plus(0.002);
        assert_eq!(after.turns, 1);
        assert!((after.part + 0.499).abs() < 1e-15, "{after:?}");
        assert!((after.since(before) - 0.002).abs() < 1e-15);
        assert!((before.since(after) + 0.002).abs() < 1e-15);
    }

    #[test]
    fn radians_come_back() {
        for radians in [-1e6, -3.2, 0.0, 1e-9, 100.0] {
            let back = Angle::from_radians(radians).radians();
            assert!((back - radians).abs() <= 4.0 * f64::EPSILON * radians.abs(), "{back}");
        }
    }

    /// The difference survives the wrap of the count of turns.
    #[test]
    fn the_count_of_turns_may_wrap() {
        let before = Angle { turns: i32::MAX, part: 0.25_f64 };
        let after = before.plus(0.5);
        assert_eq!(after, Angle { turns: i32::MIN, part: -0.25 });
        assert_eq!(after.since(before), 0.5);
    }
}
