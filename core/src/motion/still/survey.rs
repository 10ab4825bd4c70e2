//! What a still move does to the arm, found by flying through it.

use super::{Flex, Still, StillMove};
use crate::Error;
use crate::math::Scalar;
use crate::motion::Limits;

/// Greatest magnitudes over a move, by the planner's model of the scene's own arm.
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

    /// Refuses torque and bending moment above their limits, and a deflection beyond 0.7 `length`.
    pub fn admit(&self, limits: &Limits, length: f64) -> Result<(), Error> {
        limits.admit_torque(self.torque)?;
        limits.admit_moment(self.moment)?;
        let (deflection, most) = (self.deflection, Self::MOST_BEND * length);
        if deflection > most {
            return Err(Error::DeflectsTooFar { deflection, most });
        }
        Ok(())
    }
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// Flies the scene's own arm through a move, once: from the state that the move was planned
    /// from. An arm that is not at rest then is flown in short steps whatever the duration: what the
    /// long ones of a search miss of one that rings hard has reached 0.15 % of L.
    pub fn survey(&self, plan: &StillMove, flex: Option<&Flex<T, K>>) -> Survey {
        let stride = if flex.is_some() { &self.fine } else { self.stride(plan.duration()) };
        let path = stride.fine(&plan.path());
        let curve = path.segment(&plan.bulge).cast::<T>();
        let arm = &stride.arms[0];
        let (first, last) = (curve.hub(0), curve.hub(path.ticks));
        let begin = flex.copied().unwrap_or_else(|| arm.rest(&self.chain, &first));
        let (mut torque, mut moment, mut bend) = (T::ZERO, T::ZERO, T::ZERO);
        let raise = |most: &mut T, value: T| {
            let value = if value < T::ZERO { -value } else { value };
            // A value that is no number stays: whoever compares it then refuses.
            if value > *most || !value.is_finite() {
                *most = value;
            }
        };
        let mut watch = |flex: &Flex<T, K>, hub: &_| {
            let load = arm.load(&self.chain, flex, hub);
            raise(&mut torque, load.torque);
            raise(&mut moment, load.moment);
            raise(&mut bend, load.tip[1]);
        };
        watch(&begin, &first);
        let end = arm.fly(&self.chain, stride.per_step, &curve, path.ticks, &begin, &mut watch);
        Survey {
            torque: torque.to_f64(),
            moment: moment.to_f64(),
            deflection: bend.to_f64(),
            residual: arm.ringing(&self.chain, &end, &arm.rest(&self.chain, &last)),
        }
    }
}
