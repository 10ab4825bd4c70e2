//! Inverse dynamics: forces run from the tip to the base, and all joint torques come at once.

use super::along::{at_points, over_points};
use super::pose::{Pose, Vector, cross, plus};
use super::{Body, Model};
use crate::math::{Scalar, array};

/// Motion of one link in the global frame, as the forward pass leaves it for the backward one.
#[derive(Clone, Copy, Debug)]
struct Motion<T, const Q: usize> {
    /// Acceleration of the clamp, gravity's included.
    clamp: Vector<T>,
    /// Acceleration of the next joint, or of the tip.
    end: Vector<T>,
    /// Time derivative of the tangents' rates, `W n − Ω² t`.
    tangents: [Vector<T>; Q],
    /// Angular acceleration of the hub, without damping, and of the end.
    hub_angular: T,
    end_angular: T,
    /// Rate of the end.
    end_rate: T,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Residual of every coordinate: of a curvature the generalised force that is missing for
    /// `acceleration`, of a joint the torque that its motor must give, N m.
    ///
    /// `acceleration` is to hold `q̈ + αq̇`: damping in proportion to mass is that much more
    /// acceleration, of all but hubs. Elastic forces are left out. `force` is what the ground
    /// pushes on the chain's end with, N.
    pub(super) fn inverse_dynamics(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
        acceleration: &[[T; W]; LINKS],
        force: Option<Vector<T>>,
    ) -> [[T; W]; LINKS] {
        let mut residual = [[T::ZERO; W]; LINKS];
        self.add_inverse_dynamics(pose, rate, acceleration, force, &mut residual);
        residual
    }

    /// Adds to `residual` what [`Self::inverse_dynamics`] returns; what it held of joints is lost.
    #[inline(never)]
    pub(super) fn add_inverse_dynamics(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
        acceleration: &[[T; W]; LINKS],
        force: Option<Vector<T>>,
        residual: &mut [[T; W]; LINKS],
    ) {
        let motions = self.forward(pose, rate, acceleration);
        let (mut f, mut moment) = self.tip_force(&pose[LINKS - 1], &motions[LINKS - 1], force);
        for j in (0..LINKS).rev() {
            let (body, motion, pose) = (&self.links[j], &motions[j], &pose[j]);
            if body.offset != T::ZERO {
                moment += body.offset * cross(pose.end, f);
            }
            let mut sums = over_points::<T, W, Q>(&body.moments(motion, pose, f));
            // The moment at the end acts on the coordinate that turns the end, the first.
            sums[1] += moment;
            for k in 1..W {
                residual[j][k] += sums[k];
            }
            f = plus(f, body.mass, motion.clamp);
            for q in 0..Q {
                f = plus(f, body.first[q], motion.tangents[q]);
            }
            moment = moment + sums[0] + body.hub * motion.hub_angular;
            if body.radius != T::ZERO {
                moment += body.radius * cross(pose.base, f);
            }
            residual[j][0] = moment;
            if j > 0 {
                let inner = &self.links[j - 1];
                f = plus(f, inner.joint, motions[j - 1].end);
                moment += inner.stator * motions[j - 1].end_angular;
            }
        }
    }

    #[inline(always)]
    fn forward(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
        acceleration: &[[T; W]; LINKS],
    ) -> [Motion<T, Q>; LINKS] {
        // The ground falls upwards where there is gravity.
        let mut a = [T::ZERO, self.gravity];
        let (mut omega, mut angular) = (T::ZERO, T::ZERO);
        core::array::from_fn(|j| {
            let (body, pose) = (&self.links[j], &pose[j]);
            omega += rate[j][0];
            angular += acceleration[j][0];
            // A hub is not damped.
            let hub_angular = angular - self.alpha * omega;
            if body.radius != T::ZERO {
                a = plus(a, body.radius, spun(pose.base, omega, angular));
            }
            let clamp = a;
            let rates = at_points::<T, W, Q>(omega, &rate[j]);
            let angulars = at_points::<T, W, Q>(angular, &acceleration[j]);
            let tangents = array(|q| spun(pose.tangents[q], rates[q], angulars[q]));
            for q in 0..Q {
                a = plus(a, body.lengths[q], tangents[q]);
            }
            omega += rate[j][1];
            angular += acceleration[j][1];
            if body.offset != T::ZERO {
                a = plus(a, body.offset, spun(pose.end, omega, angular));
            }
            Motion { clamp, end: a, tangents, hub_angular, end_angular: angular, end_rate: omega }
        })
    }

    /// Force and moment at the chain's end.
    #[inline(always)]
    fn tip_force(
        &self,
        pose: &Pose<T, Q>,
        motion: &Motion<T, Q>,
        force: Option<Vector<T>>,
    ) -> (Vector<T>, T) {
        let load = &self.load;
        let mut a = motion.end;
        if load.offset != T::ZERO {
            a = plus(a, load.offset, spun(pose.end, motion.end_rate, motion.end_angular));
        }
        let mut f = [load.mass * a[0], load.mass * a[1]];
        let mut moment = load.inertia * motion.end_angular;
        if load.offset != T::ZERO {
            moment += load.offset * cross(pose.end, f);
        }
        if let Some(pushed) = force {
            f = plus(f, -T::ONE, pushed);
        }
        (f, moment)
    }
}

impl<T: Scalar, const W: usize, const Q: usize> Body<T, W, Q> {
    /// Moment of what accelerates the link and all beyond on each tangent, `f` at the link's end.
    #[inline(always)]
    fn moments(&self, motion: &Motion<T, Q>, pose: &Pose<T, Q>, f: Vector<T>) -> [T; Q] {
        array(|q| {
            let mut n = [self.lengths[q] * f[0], self.lengths[q] * f[1]];
            n = plus(n, self.first[q], motion.clamp);
            for p in 0..Q {
                n = plus(n, self.second[q][p], motion.tangents[p]);
            }
            cross(pose.tangents[q], n)
        })
    }
}

/// `W n − Ω² t`: acceleration of the end of a unit vector `t` that turns at Ω and ever faster by W.
#[inline(always)]
fn spun<T: Scalar>(t: Vector<T>, omega: T, angular: T) -> Vector<T> {
    let square = omega * omega;
    [-(angular * t[1]) - square * t[0], angular * t[0] - square * t[1]]
}
