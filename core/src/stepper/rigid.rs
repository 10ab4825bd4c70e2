//! The arm that does not bend.

use super::{Response, Stepper};
use crate::Error;
use crate::hub::HubState;
use crate::math::{Scalar, round};
use crate::motion::{Kink, Peaks};
use crate::scene::Scene;

/// Rigid arm: `τ = (J_h + J_r)θ̈ + J_r αθ̇ + g cosθ S`, the tip at `(r + L, 0)`.
#[derive(Clone, Copy, Debug)]
pub struct Rigid<T> {
    tick: f64,
    inertia: T,
    drag: T,
    weight: T,
    reach: T,
}

impl<T: Scalar> Rigid<T> {
    /// `tick` in s.
    pub fn new<P: Scalar>(scene: &Scene<P>, tick: f64) -> Result<Self, Error> {
        let scene = scene.validate()?;
        let tick = super::check_tick(tick)?;
        let inertia = scene.rigid_inertia();
        Ok(Self {
            tick,
            inertia: round(scene.hub.inertia + inertia),
            drag: round(scene.damping.alpha * inertia),
            weight: round(scene.gravity * scene.first_moment()),
            reach: round(scene.reach()),
        })
    }
}

impl<T: Scalar> Stepper for Rigid<T> {
    type Scalar = T;
    type State = ();

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn is_directed(&self) -> bool {
        self.weight != T::ZERO
    }

    const PLAIN: bool = true;
    const RESTS: bool = true;

    /// Carries any move: it has no state that could run away.
    fn admit(&self, _: &Peaks, _: f64) -> Result<(), Error> {
        Ok(())
    }

    #[inline(always)]
    fn is_plain(&self, _: T) -> bool {
        self.weight == T::ZERO && self.drag == T::ZERO
    }

    #[inline(always)]
    fn advance_in_cubic(&self, (): &mut (), _: &HubState<T>, hub: &HubState<T>) -> Response<T> {
        Response { torque: self.inertia * hub.acceleration, tip: [self.reach, T::ZERO] }
    }

    fn equilibrium(&self, _: &HubState<T>) {}

    #[inline(always)]
    fn step(&self, (): &mut (), _: &HubState<T>, _: &HubState<T>) {}

    /// An arm that does not bend keeps nothing of it.
    fn kink(&self, (): &mut (), _: &Kink<T>) {}

    #[inline(always)]
    fn swing(&self, (): &mut (), _: &HubState<T>) {}

    #[inline(always)]
    fn response_at_rest(&self, (): &(), hub: &HubState<T>) -> Response<T> {
        self.response(&(), hub)
    }

    fn shift(&self, (): &mut (), _: T) {}

    #[inline(always)]
    fn is_settled(&self, (): &()) -> bool {
        true
    }

    #[inline(always)]
    fn response(&self, (): &(), hub: &HubState<T>) -> Response<T> {
        Response {
            torque: self.inertia * hub.acceleration + self.drag * hub.rate + self.weight * hub.cos,
            tip: [self.reach, T::ZERO],
        }
    }
}
