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
    pub fn plus(self, delta: T) -> Self {
        let (whole, part) = (self.part + delta).split();
        Self { turns: self.turns.wrapping_add(whole), part }
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
    pub fn cast<T: Scalar>(self) -> Angle<T> {
        Angle { turns: self.turns, part: T::from_f64(self.part) }
    }
}
