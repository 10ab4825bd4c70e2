//! The arm that does not bend.

use super::{FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Scalar, round, words};
use crate::motion::Peaks;
use crate::scene::{LinkShape, Scene};

/// Rigid arm: `τ = (J_h + J_r)θ̈ + J_r αθ̇ + g cosχ S`, the tip at `(r + L, 0)`.
#[derive(Clone, Copy, Debug)]
pub struct Rigid<T> {
    tick: f64,
    inertia: T,
    drag: T,
    weight: T,
    reach: T,
    gravity: GravityDirection<T>,
}

impl<T: Scalar> Rigid<T> {
    /// `tick` in s.
    pub fn new<P: Scalar, S: LinkShape>(scene: &Scene<P, S>, tick: f64) -> Result<Self, Error> {
        let scene = scene.validate()?;
        scene.check_no_carrier()?;
        let tick = super::check_tick(tick)?;
        let inertia = scene.rigid_inertia();
        Ok(Self {
            tick,
            inertia: round(scene.hub.inertia + inertia),
            drag: round(scene.damping.alpha * inertia),
            weight: round(scene.in_plane_gravity() * scene.first_moment()),
            reach: round(scene.reach()),
            gravity: scene.gravity_direction(),
        })
    }
}

impl<T: Scalar> Stepper for Rigid<T> {
    type Scalar = T;
    type State = ();

    const FAST: FastPaths = FastPaths::BOTH;

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        &self.gravity
    }

    #[inline(always)]
    fn is_linear_fast(&self, _: T) -> bool {
        self.weight == T::ZERO && self.drag == T::ZERO
    }

    /// Carries any move: it has no state that could run away.
    fn admit(&self, _: &Peaks, _: f64) -> Result<(), Error> {
        Ok(())
    }

    fn equilibrium(&self, _: &HubState<T>) {}

    #[inline(always)]
    fn step<M: HubMotion>(&self, (): &mut (), _: &HubState<T>, _: &HubState<T>) {}

    #[inline(always)]
    fn response<M: HubMotion>(&self, (): &(), hub: &HubState<T>) -> Response<T> {
        let mut torque = self.inertia * hub.acceleration;
        if !M::LINEAR {
            torque = torque + self.drag * hub.rate + self.weight * hub.cos;
        }
        Response { torque, tip: [self.reach, T::ZERO] }
    }

    fn tip_angle(&self, (): &()) -> T {
        T::ZERO
    }

    /// Does nothing: an arm that does not bend keeps nothing of a kink.
    #[inline(always)]
    fn kink(&self, (): &mut (), _: KinkMoments<'_, T>) {}

    #[inline(always)]
    fn is_settled(&self, (): &()) -> bool {
        true
    }
}

words! {
    [T: Scalar] Rigid<T>: tick, inertia, drag, weight, reach, gravity;
}

#[cfg(test)]
mod tests {
    use super::Rigid;
    use crate::stepper::{AnyMotion, Stepper};
    use crate::{Angle, HubState, Link, Scene};

    /// Without a link that bends the torque is inertia times acceleration, `(m L²/3 + m_p L²) θ̈`.
    #[test]
    fn the_torque_is_inertia_times_acceleration() {
        let mut scene = Scene::new(Link { length: 0.5, mass: 0.3, bending_stiffness: 1.0 });
        scene.payload.mass = 0.2;
        let arm = Rigid::<f64>::new(&scene, 0.01).expect("an arm");
        let mut hub = HubState::at_rest(Angle { turns: 3, part: 0.2 });
        hub.acceleration = 4.0;
        let response = arm.response::<AnyMotion>(&(), &hub);
        let expected = (0.3 / 3.0 + 0.2) * 0.25 * 4.0;
        assert!((response.torque - expected).abs() < 1e-15, "{} N m", response.torque);
        assert_eq!(response.tip, [0.5, 0.0]);
    }
}
