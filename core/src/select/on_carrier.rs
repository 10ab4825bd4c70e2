//! The choice for an arm on a carrier that turns.

use super::{Auto, Choice, Rung, Tolerance, choose};
use crate::math::Scalar;
use crate::motion::{Move, Moves};
use crate::stepper::{OnCarrier, check_tick};
use crate::{Error, Scene};

impl<T: Scalar> OnCarrier<Auto<T>> {
    /// Sets up one rung on the scene's carrier: see [`Auto::new`].
    ///
    /// # Errors
    /// What the rung refuses, and a carrier that it cannot follow for ever.
    pub fn of_rung(scene: &Scene, tick: f64, rung: Rung, bend: f64) -> Result<Self, Error> {
        Self::new(scene, |arm| Auto::new(arm, tick, rung, bend))
    }

    /// Sets up the cheapest rung that is good enough for these moves relative to the carrier: see
    /// [`Auto::choose`].
    ///
    /// # Errors
    /// Those of [`Auto::choose`].
    pub fn choose(
        scene: &Scene,
        tick: f64,
        from: f64,
        moves: &[Move],
        tolerance: &Tolerance,
    ) -> Result<(Self, Choice), Error> {
        let motion = Moves::new(from, moves, check_tick(tick)?)?;
        let choice = choose(scene, tick, &motion, tolerance, &mut |_| ())?;
        Ok((Self::of_rung(scene, tick, choice.rung, choice.bend)?, choice))
    }
}
