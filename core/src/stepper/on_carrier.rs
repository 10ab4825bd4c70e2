//! An arm on a carrier that turns evenly.

use super::{AnyMotion, FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Scalar, Words, round, words};
use crate::motion::Peaks;
use crate::scene::{LinkShape, Mount, Scene};

/// A stepper on a carrier that turns evenly about the hub's own axis, such as a table that bears
/// the motor.
///
/// The hub's motion, its moves and setpoints, are relative to the carrier. The link feels the sum:
/// it spins with `θ̇ + Ω`, and is in equilibrium with that at the beginning. The torque acts
/// between carrier and hub.
///
/// A type of its own, because an arm without a carrier then ticks as if there were none. Ticks of a
/// hub at rest are ticks of one that turns here.
#[derive(Clone, Copy, Debug)]
pub struct OnCarrier<S: Stepper> {
    arm: S,
    /// `Ω`, rad/s.
    carrier: S::Scalar,
}

impl<S: Stepper> OnCarrier<S> {
    /// Sets up the stepper of the arm that stands on the scene's carrier. `set_up` is given the
    /// same arm on a carrier that rests.
    ///
    /// # Errors
    /// A scene that is not accepted, what `set_up` refuses, or a carrier that the stepper cannot
    /// follow for ever.
    pub fn new<P: Scalar, Q: LinkShape>(
        scene: &Scene<P, Q>,
        set_up: impl FnOnce(&Scene<P, Q>) -> Result<S, Error>,
    ) -> Result<Self, Error> {
        let scene = scene.validate()?;
        let carrier = scene.mount.carrier;
        let mount = Mount { carrier: P::ZERO, ..scene.mount };
        let arm = set_up(&Scene { mount, ..scene })?;
        let rate = carrier.to_f64();
        arm.admit(&Peaks { rate: rate.abs(), acceleration: 0.0, jerk: 0.0 }, rate)
            .map_err(|error| of_carrier(error, rate))?;
        Ok(Self { arm, carrier: round(carrier) })
    }

    /// Returns the same arm on the same carrier, its stepper as another type: what `arm` makes of
    /// it must step alike.
    #[must_use]
    pub fn map<R: Stepper<Scalar = S::Scalar>>(self, arm: impl FnOnce(S) -> R) -> OnCarrier<R> {
        OnCarrier { arm: arm(self.arm), carrier: self.carrier }
    }

    /// The stepper of the arm on a carrier that rests.
    pub(super) fn arm(&self) -> &S {
        &self.arm
    }

    /// `Ω`, rad/s.
    pub(super) fn carrier(&self) -> S::Scalar {
        self.carrier
    }

    /// The hub as the link feels it.
    #[inline(always)]
    fn felt(&self, hub: &HubState<S::Scalar>) -> HubState<S::Scalar> {
        HubState { rate: hub.rate + self.carrier, ..*hub }
    }
}

/// The refusal of a carrier's own rate, which no move is to blame for.
fn of_carrier(error: Error, rate: f64) -> Error {
    let max = match error {
        Error::TooFast { max, .. } | Error::OutOfRange { parameter: "move.rate", max, .. } => max,
        error => return error,
    };
    let unit = "rad/s for this arm, method and tick";
    Error::OutOfRange { parameter: "carrier.rate", value: rate, min: -max, max, unit }
}

/// The refusal of a move, its rates relative to the carrier as they were given.
fn relative(error: Error, carrier: f64) -> Error {
    match error {
        Error::TooFast { rate, max } => {
            let carrier = carrier.abs();
            Error::TooFast { rate: rate - carrier, max: (max - carrier).max(0.0) }
        }
        Error::OutOfRange { parameter: "move.rate", value, min, max, unit } => Error::OutOfRange {
            parameter: "move.rate",
            value: value - carrier,
            min: min - carrier,
            max: max - carrier,
            unit,
        },
        error => error,
    }
}

impl<S: Stepper> Stepper for OnCarrier<S> {
    type Scalar = S::Scalar;
    type State = S::State;

    const FAST: FastPaths = FastPaths { at_rest: false, ..S::FAST };

    fn tick(&self) -> f64 {
        self.arm.tick()
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<S::Scalar> {
        self.arm.gravity()
    }

    #[inline(always)]
    fn is_linear_fast(&self, rate: S::Scalar) -> bool {
        self.arm.is_linear_fast(rate + self.carrier.abs())
    }

    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        let carrier = self.carrier.to_f64();
        let rate = peaks.rate + carrier.abs();
        self.arm
            .admit(&Peaks { rate, ..*peaks }, held + carrier)
            .map_err(|error| relative(error, carrier))
    }

    /// The straight arm: without gravity and drag on absolute velocity, an even turn pulls along
    /// the link only.
    fn equilibrium(&self, hub: &HubState<S::Scalar>) -> S::State {
        self.arm.equilibrium(hub)
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut S::State,
        before: &HubState<S::Scalar>,
        after: &HubState<S::Scalar>,
    ) {
        let (before, after) = (self.felt(before), self.felt(after));
        if M::AT_REST {
            self.arm.step::<AnyMotion>(state, &before, &after);
        } else {
            self.arm.step::<M>(state, &before, &after);
        }
    }

    #[inline(always)]
    fn response<M: HubMotion>(
        &self,
        state: &S::State,
        hub: &HubState<S::Scalar>,
    ) -> Response<S::Scalar> {
        let hub = self.felt(hub);
        if M::AT_REST {
            self.arm.response::<AnyMotion>(state, &hub)
        } else {
            self.arm.response::<M>(state, &hub)
        }
    }

    fn tip_angle(&self, state: &S::State) -> S::Scalar {
        self.arm.tip_angle(state)
    }

    #[inline(always)]
    fn kink(&self, state: &mut S::State, moments: KinkMoments<'_, S::Scalar>) {
        self.arm.kink(state, moments);
    }

    #[inline(always)]
    fn is_settled(&self, state: &S::State) -> bool {
        self.arm.is_settled(state)
    }
}

words! {
    [S: Stepper + Words] OnCarrier<S>: arm, carrier;
}
