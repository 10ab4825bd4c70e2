//! Inverse dynamics: forces run from the tip to the base, and all joint torques come at once.

use super::Model;
use super::pose::{Pose, Vector, cross, plus, turned, turned_back};
use crate::math::Scalar;

/// Motion of one link in its own frame, as the forward pass leaves it for the backward one.
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
    /// pushes on the chain's end with, in the global frame, N.
    #[inline(never)]
    pub(super) fn inverse_dynamics(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
        acceleration: &[[T; W]; LINKS],
        force: Option<Vector<T>>,
    ) -> [[T; W]; LINKS] {
        let motions = self.forward(pose, rate, acceleration);
        let mut residual = [[T::ZERO; W]; LINKS];
        let (mut f, mut moment) = self.tip_force(pose, &motions[LINKS - 1], force);
        for j in (0..LINKS).rev() {
            let (body, motion, pose) = (&self.links[j], &motions[j], &pose[j]);
            if body.offset != T::ZERO {
                moment += body.offset * cross(pose.end, f);
            }
            // The moment at the end acts on the coordinate that turns the end, the first.
            residual[j][1] = moment;
            let mut at_points = T::ZERO;
            for q in 0..Q {
                let [cos, sin] = pose.tangents[q];
                let mut n = [
                    body.lengths[q] * f[0] + body.first[q] * motion.clamp[0],
                    body.lengths[q] * f[1] + body.first[q] * motion.clamp[1],
                ];
                for p in 0..Q {
                    n = plus(n, body.second[q][p], motion.tangents[p]);
                }
                let mu = cos * n[1] - sin * n[0];
                at_points += mu;
                for k in 1..W {
                    residual[j][k] += body.slopes[q][k] * mu;
                }
            }
            f = plus(f, body.mass, motion.clamp);
            for q in 0..Q {
                f = plus(f, body.first[q], motion.tangents[q]);
            }
            moment = moment + at_points + body.radius * f[1] + body.hub * motion.hub_angular;
            residual[j][0] = moment;
            if j > 0 {
                let inner = &self.links[j - 1];
                f = plus(turned(pose.frame, f), inner.joint, motions[j - 1].end);
                moment += inner.stator * motions[j - 1].end_angular;
            }
        }
        residual
    }

    #[inline(always)]
    fn forward(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        rate: &[[T; W]; LINKS],
        acceleration: &[[T; W]; LINKS],
    ) -> [Motion<T, Q>; LINKS] {
        let zero = [T::ZERO; 2];
        let mut motions = [Motion {
            clamp: zero,
            end: zero,
            tangents: [zero; Q],
            hub_angular: T::ZERO,
            end_angular: T::ZERO,
            end_rate: T::ZERO,
        }; LINKS];
        // The ground falls upwards where there is gravity.
        let mut a = [T::ZERO, self.gravity];
        let (mut omega, mut angular) = (T::ZERO, T::ZERO);
        for j in 0..LINKS {
            let (body, pose) = (&self.links[j], &pose[j]);
            a = turned_back(pose.frame, a);
            omega += rate[j][0];
            angular += acceleration[j][0];
            let motion = &mut motions[j];
            // A hub is not damped.
            motion.hub_angular = angular - self.alpha * omega;
            a = [a[0] - body.radius * (omega * omega), a[1] + body.radius * angular];
            motion.clamp = a;
            for q in 0..Q {
                let (mut rate_here, mut angular_here) = (omega, angular);
                for k in 1..W {
                    rate_here += body.slopes[q][k] * rate[j][k];
                    angular_here += body.slopes[q][k] * acceleration[j][k];
                }
                let spun = spun(pose.tangents[q], rate_here, angular_here);
                motion.tangents[q] = spun;
                a = plus(a, body.lengths[q], spun);
            }
            omega += rate[j][1];
            angular += acceleration[j][1];
            if body.offset != T::ZERO {
                a = plus(a, body.offset, spun(pose.end, omega, angular));
            }
            (motion.end, motion.end_rate, motion.end_angular) = (a, omega, angular);
        }
        motions
    }

    /// Force and moment at the chain's end, in the last link's frame.
    #[inline(always)]
    fn tip_force(
        &self,
        pose: &[Pose<T, Q>; LINKS],
        motion: &Motion<T, Q>,
        force: Option<Vector<T>>,
    ) -> (Vector<T>, T) {
        let load = &self.load;
        let mut a = motion.end;
        let end = pose[LINKS - 1].end;
        if load.offset != T::ZERO {
            a = plus(a, load.offset, spun(end, motion.end_rate, motion.end_angular));
        }
        let mut f = [load.mass * a[0], load.mass * a[1]];
        let mut moment = load.inertia * motion.end_angular;
        if load.offset != T::ZERO {
            moment += load.offset * cross(end, f);
        }
        if let Some(mut pushed) = force {
            for pose in pose {
                pushed = turned_back(pose.frame, pushed);
            }
            f = plus(f, -T::ONE, pushed);
        }
        (f, moment)
    }
}

/// `W n − Ω² t`: acceleration of the end of a unit vector `t` that turns at Ω and ever faster by W.
#[inline(always)]
fn spun<T: Scalar>(t: Vector<T>, omega: T, angular: T) -> Vector<T> {
    let square = omega * omega;
    [-(angular * t[1]) - square * t[0], angular * t[0] - square * t[1]]
}
