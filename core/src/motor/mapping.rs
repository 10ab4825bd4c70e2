//! Hub angle to motor turns and back: ratio, sign and zero.

use core::f64::consts::TAU;

use crate::Error;
use crate::hub::Angle;
use crate::math::Scalar;

/// n = motor/link turns, as the teeth give it: no rounding builds up over days of rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ratio {
    /// Turns of the motor …
    pub motor: u16,
    /// … in so many turns of the hub.
    pub link: u16,
}

/// Sign between the motor's turn and the hub's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Direction {
    /// Both positive together.
    Same,
    /// The gear, or the way the motor is mounted, turns it round.
    Opposite,
}

/// The shaft's angle `± n θ + zero`, all in turns.
///
/// Error of a round trip in f32: 1.2e-7 turn of the hub plus 6e-8 turn of the motor, however far
/// both have turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping<T> {
    ratio: Ratio,
    direction: Direction,
    zero: Angle<T>,
    /// `n / 2π`, rad/s of the hub to turns/s of the motor.
    velocity: T,
}

impl Ratio {
    /// A ratio of whole numbers of teeth, 1 to 65,535 each.
    pub fn validate(self) -> Result<Self, Error> {
        Error::check("motor.ratio.motor", f64::from(self.motor), 1.0, 65_535.0, "turns")?;
        Error::check("motor.ratio.link", f64::from(self.link), 1.0, 65_535.0, "turns")?;
        Ok(self)
    }

    /// n.
    pub fn value<T: Scalar>(self) -> T {
        T::from_u32(self.motor.into()) / T::from_u32(self.link.into())
    }

    /// An angle times `motor/link`: whole turns in integers, so that only the remainder is rounded.
    fn scale<T: Scalar>(self, angle: Angle<T>) -> Angle<T> {
        let whole = i64::from(angle.turns) * i64::from(self.motor);
        let link = i64::from(self.link);
        let rest = T::from_u32(whole.rem_euclid(link) as u32);
        let part =
            (rest + angle.part * T::from_u32(self.motor.into())) / T::from_u32(self.link.into());
        // Turns wrap after 2³¹, as the hub's do.
        Angle { turns: whole.div_euclid(link) as i32, part: T::ZERO }.plus(part)
    }

    fn inverse(self) -> Self {
        Self { motor: self.link, link: self.motor }
    }
}

impl<T: Scalar> Mapping<T> {
    /// `zero` is the shaft's angle where the hub's is 0, turns, up to 1e6 either way.
    pub fn new(ratio: Ratio, direction: Direction, zero: f64) -> Result<Self, Error> {
        let ratio = ratio.validate()?;
        let zero = Error::check("motor.zero", zero, -1e6, 1e6, "turns")?;
        let zero = Angle { turns: 0, part: 0.0 }.plus(zero).cast();
        let velocity = T::from_f64(ratio.value::<f64>() / TAU);
        Ok(Self { ratio, direction, zero, velocity })
    }

    /// The shaft's angle, turns, for the hub's.
    pub fn to_motor(&self, hub: Angle<T>) -> Angle<T> {
        sum(self.turned(self.ratio.scale(hub)), self.zero)
    }

    /// The hub's angle for the shaft's.
    pub fn to_link(&self, shaft: Angle<T>) -> Angle<T> {
        self.turned(self.ratio.inverse().scale(sum(shaft, negative(self.zero))))
    }

    /// The shaft's velocity, turns/s, for the hub's rate, rad/s.
    pub fn velocity(&self, rate: T) -> T {
        self.signed(rate * self.velocity)
    }

    /// A torque or velocity that is positive with the hub, as positive with the motor.
    pub fn signed(&self, value: T) -> T {
        match self.direction {
            Direction::Same => value,
            Direction::Opposite => -value,
        }
    }

    /// The shaft's angle where the hub's is 0.
    pub fn zero(&self) -> Angle<T> {
        self.zero
    }

    /// Returns the same gear with the zero at which the shaft's angle `shaft` belongs to the hub
    /// angle `hub`.
    #[must_use]
    pub fn homed(self, shaft: Angle<T>, hub: Angle<T>) -> Self {
        let from_zero = self.turned(self.ratio.scale(hub));
        Self { zero: sum(shaft, negative(from_zero)), ..self }
    }

    fn turned(&self, angle: Angle<T>) -> Angle<T> {
        match self.direction {
            Direction::Same => angle,
            Direction::Opposite => negative(angle),
        }
    }
}

fn sum<T: Scalar>(a: Angle<T>, b: Angle<T>) -> Angle<T> {
    let sum = a.plus(b.part);
    Angle { turns: sum.turns.wrapping_add(b.turns), part: sum.part }
}

fn negative<T: Scalar>(angle: Angle<T>) -> Angle<T> {
    Angle { turns: angle.turns.wrapping_neg(), part: -angle.part }
}
