//! What a still move does to the arm, found by flying through it.

use super::flight::Stride;
use super::{Flex, Still, StillMove};
use crate::Error;
use crate::math::Scalar;
use crate::motion::Limits;

/// Greatest magnitudes over a move, by the planner's model of the scene's own arm, between the ticks
/// too.
///
/// Error of torque and moment against the reference rod, from 1.5 first periods on: measured 7e-4 of
/// the peak, 1e-3 asserted by the tests. What is left is the third mode's share, which a planner with
/// two modes does not see; it grows in shorter moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Survey {
    /// |τ| at the hub, N m.
    pub torque: f64,
    /// |M| at the clamp, N m.
    pub moment: f64,
    /// Deflection of the tip, m.
    pub deflection: f64,
    /// Amplitude of the tip's deflection that is left, all modes in step, m. A bound: to 1e-4 of the
    /// length, 100,000 random interruptions left no more.
    pub residual: f64,
}

impl Survey {
    /// Largest deflection that is taken, of L: beyond it the arm may bend back on itself.
    pub const MOST_BEND: f64 = 0.7;

    /// What the arm's torque and moment may exceed the surveyed ones by, of themselves: a limit is
    /// kept with this much to spare.
    pub const MARGIN: f64 = 1e-3;

    /// Refuses torque and bending moment above their limits, with [`Self::MARGIN`] to spare, and a
    /// deflection beyond 0.7 `length`.
    pub fn admit(&self, limits: &Limits, length: f64) -> Result<(), Error> {
        self.admit_loads(limits)?;
        let (deflection, most) = (self.deflection, Self::MOST_BEND * length);
        if deflection > most {
            return Err(Error::DeflectsTooFar { deflection, most });
        }
        Ok(())
    }

    /// Refuses torque and bending moment above their limits, likewise.
    pub(super) fn admit_loads(&self, limits: &Limits) -> Result<(), Error> {
        limits.admit_torque((1.0 + Self::MARGIN) * self.torque)?;
        limits.admit_moment((1.0 + Self::MARGIN) * self.moment)
    }
}

/// The greatest magnitude of a quantity that is seen at even steps, between the steps too: of three
/// that turn, the vertex of the parabola through them.
struct Peak<T> {
    last: [T; 2],
    most: T,
}

impl<T: Scalar> Peak<T> {
    fn new(first: T) -> Self {
        let mut peak = Self { last: [first; 2], most: T::ZERO };
        peak.raise(first);
        peak
    }

    fn see(&mut self, after: T) {
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

impl<T: Scalar, const K: usize> Still<T, K> {
    /// Flies the scene's own arm through a move, once: from the state that the move was planned
    /// from. In short steps whatever the duration: what the long ones of a search miss of an arm that
    /// rings hard has reached 0.15 % of L.
    pub fn survey(&self, plan: &StillMove, flex: Option<&Flex<T, K>>) -> Survey {
        self.survey_in(&self.fine, plan, flex)
    }

    /// [`Self::survey`] in the steps of a search, for what a search has to know of every try: where
    /// nothing limits the loads, only the deflection.
    pub(super) fn glance(&self, plan: &StillMove, flex: Option<&Flex<T, K>>) -> Survey {
        let stride = if flex.is_some() { &self.fine } else { self.stride(plan.duration()) };
        self.survey_in(stride, plan, flex)
    }

    fn survey_in(
        &self,
        stride: &Stride<T, K>,
        plan: &StillMove,
        flex: Option<&Flex<T, K>>,
    ) -> Survey {
        let path = stride.fine(&plan.path());
        let curve = path.segment(&plan.bulge).cast::<T>();
        let arm = &stride.arms[0];
        let (first, last) = (curve.hub(0), curve.hub(path.ticks));
        let begin = flex.copied().unwrap_or_else(|| arm.rest(&self.chain, &first));
        let load = arm.load(&self.chain, &begin, &first);
        let mut torque = Peak::new(load.torque);
        let mut moment = Peak::new(load.moment);
        let mut bend = Peak::new(load.tip[1]);
        let watch = |flex: &Flex<T, K>, hub: &_| {
            let load = arm.load(&self.chain, flex, hub);
            torque.see(load.torque);
            moment.see(load.moment);
            bend.see(load.tip[1]);
        };
        let end = arm.fly(&self.chain, stride.per_step, &curve, path.ticks, &begin, watch);
        Survey {
            torque: torque.most.to_f64(),
            moment: moment.most.to_f64(),
            deflection: bend.most.to_f64(),
            residual: arm.ringing(&self.chain, &end, &arm.rest(&self.chain, &last)),
        }
    }
}
