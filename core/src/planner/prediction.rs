//! Predicts the arm's answer to a still move by simulating it.

use super::simulate::Resolution;
use super::{ArmState, Planner, StillMove};
use crate::Error;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::Limits;

/// Greatest magnitudes over a move, by the planner's model of the scene's own arm, between the
/// ticks too.
///
/// Error of torque and moment against the reference rod, from 1.5 first periods on: measured 7e-4
/// of the peak, 1e-3 asserted by the tests. What is left is the third mode's share, which a planner
/// with two modes does not see; it grows in shorter moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Prediction {
    /// |τ| at the hub, N m.
    pub torque: f64,
    /// |M| at the clamp, N m.
    pub moment: f64,
    /// Deflection of the tip, m.
    pub deflection: f64,
    /// Amplitude of the tip's deflection that is left, all modes in step, m. A bound: to 1e-4 of
    /// the length, 100,000 random interruptions left no more.
    pub residual: f64,
}

impl Prediction {
    /// Largest deflection that a request accepts, of L. Beyond it the arm may bend back on itself.
    pub const MAX_DEFLECTION: f64 = 0.7;

    /// Relative error of torque and moment. A limit is kept with this much to spare.
    pub const MARGIN: f64 = 1e-3;

    /// Refuses torque and bending moment above their limits, with [`Self::MARGIN`] to spare, and a
    /// deflection above 0.7 `length`.
    pub fn admit(&self, limits: &Limits, length: f64) -> Result<(), Error> {
        self.admit_loads(limits)?;
        self.admit_deflection(Self::MAX_DEFLECTION * length)
    }

    /// Refuses torque and bending moment above their limits, with [`Self::MARGIN`] to spare.
    pub(super) fn admit_loads(&self, limits: &Limits) -> Result<(), Error> {
        limits.admit_torque((1.0 + Self::MARGIN) * self.torque)?;
        limits.admit_moment((1.0 + Self::MARGIN) * self.moment)
    }

    /// Refuses a deflection above `most` m.
    pub(super) fn admit_deflection(&self, most: f64) -> Result<(), Error> {
        if self.deflection > most {
            return Err(Error::DeflectsTooFar { deflection: self.deflection, most });
        }
        Ok(())
    }
}

/// True if torque or bending moment is limited.
pub(super) fn limits_loads(limits: &Limits) -> bool {
    limits.torque.is_some() || limits.moment.is_some()
}

/// Greatest magnitude of a quantity that is sampled at even steps. Between the steps it is the
/// vertex of the parabola through three samples.
pub(super) struct Peak<T> {
    last: [T; 2],
    pub most: T,
}

impl<T: Scalar> Peak<T> {
    pub fn new(first: T) -> Self {
        let mut peak = Self { last: [first; 2], most: T::ZERO };
        peak.raise(first);
        peak
    }

    pub fn see(&mut self, after: T) {
        let [before, here] = self.last;
        if (here - before) * (after - here) < T::ZERO {
            let (bend, tilt) = (before - T::TWO * here + after, after - before);
            self.raise(here - tilt * tilt / (T::from_u32(8) * bend));
        }
        self.raise(after);
        self.last = [here, after];
    }

    fn raise(&mut self, value: T) {
        let value = if value < T::ZERO { -value } else { value };
        // A value that is no number stays: whoever compares it then refuses.
        if value > self.most || !value.is_finite() {
            self.most = value;
        }
    }
}

impl<T: Scalar, const K: usize> Planner<T, K> {
    /// Predicts the arm's answer to a move by simulating the scene's own arm once, from the state
    /// that the move was planned from (`None`: equilibrium).
    ///
    /// The steps are short whatever the duration: with the long ones of a search, the residual of
    /// an arm that rings hard was off by up to 0.15 % of L.
    #[must_use]
    pub fn predict(&self, plan: &StillMove, flex: Option<&ArmState<T, K>>) -> Prediction {
        self.predict_in(&self.fine, plan, flex)
    }

    /// [`Self::predict`] in the steps of a search, which see the deflection well enough.
    pub(super) fn glance(&self, plan: &StillMove, flex: Option<&ArmState<T, K>>) -> Prediction {
        let resolution = if flex.is_some() { &self.fine } else { self.resolution(plan.duration()) };
        self.predict_in(resolution, plan, flex)
    }

    fn predict_in(
        &self,
        resolution: &Resolution<T, K>,
        plan: &StillMove,
        flex: Option<&ArmState<T, K>>,
    ) -> Prediction {
        let path = resolution.refine(&plan.path());
        let curve = path.segment(&plan.bulge).cast::<T>();
        let arm = &resolution.arms[0];
        let (first, last) = (curve.hub(0), curve.hub(path.ticks));
        let begin = flex.copied().unwrap_or_else(|| arm.equilibrium(&self.points, &first));
        let load = arm.load(&self.points, &begin, &first);
        let mut torque = Peak::new(load.torque);
        let mut moment = Peak::new(load.moment);
        let mut bend = Peak::new(load.tip[1]);
        let watch = |flex: &ArmState<T, K>, hub: &_| {
            let load = arm.load(&self.points, flex, hub);
            torque.see(load.torque);
            moment.see(load.moment);
            bend.see(load.tip[1]);
        };
        let end = arm.simulate(
            &self.points,
            resolution.per_step,
            |k| curve.hub(k),
            path.ticks,
            &begin,
            watch,
        );
        let rest = if plan.rate == 0.0 {
            arm.equilibrium(&self.points, &last)
        } else {
            let end = HubState::turning(last.angle, T::from_f64(plan.rate));
            arm.steady(&self.points, &end)
        };
        Prediction {
            torque: torque.most.to_f64(),
            moment: moment.most.to_f64(),
            deflection: bend.most.to_f64(),
            residual: arm.ringing(&self.points, &end, &rest),
        }
    }
}
