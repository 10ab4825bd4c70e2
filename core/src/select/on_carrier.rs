//! The choice for an arm on a carrier that turns.

use super::choose::choose_for_moves;
use super::{Auto, Choice, Rung, Tolerance};
use crate::math::Scalar;
use crate::motion::Move;
use crate::stepper::OnCarrier;
use crate::{Error, Scene};

impl<T: Scalar> OnCarrier<Auto<T>> {
    /// Sets up one rung on the scene's carrier: see [`Auto::new`].
    ///
    /// # Errors
    /// Errors of the rung, and a carrier that it cannot follow for ever.
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
        let choice = choose_for_moves(scene, tick, from, moves, tolerance)?;
        Ok((Self::of_rung(scene, tick, choice.rung, choice.bend)?, choice))
    }
}
