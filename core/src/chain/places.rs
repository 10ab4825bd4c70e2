//! Places of the links' ends in a state.

use super::along::at_points;
use super::pose::{Pose, Vector, direction, plus, turned_back};
use super::stages::Slots;
use super::{Chain, ChainState, Model};
use crate::math::Scalar;

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Directions of all links in a state.
    #[inline(always)]
    pub(super) fn pose_of(&self, state: &ChainState<T, LINKS, W>) -> [Pose<T, Q>; LINKS] {
        let mut coordinates = state.shape;
        for j in 0..LINKS {
            coordinates[j][0] = state.joints[j].angle.part;
        }
        self.model.pose(&coordinates)
    }

    /// Writes the places of a state from its angles.
    #[inline(never)]
    pub(super) fn locate(&self, state: &mut ChainState<T, LINKS, W>) {
        let pose = self.pose_of(state);
        self.write_places(state, |j| self.model.links[j].reach(&pose[j]));
    }

    /// Writes the places of a state whose coordinates are `moved`, rad, from those of `pose`. Its
    /// directions are turned by that, `t cos δ + n sin δ` to the third power of δ.
    #[inline(always)]
    pub(super) fn locate_near(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        pose: &[Pose<T, Q>; LINKS],
        moved: &Slots<T, LINKS, W>,
    ) {
        let mut angle = T::ZERO;
        self.write_places(state, |j| {
            let (body, pose) = (&self.model.links[j], &pose[j]);
            let clamp = angle + moved[j][0];
            let angles = at_points::<T, W, Q>(clamp, &moved[j]);
            angle = clamp + moved[j][1];
            body.reach_along(
                || turned_little(pose.base, clamp),
                |q| turned_little(pose.tangents[q], angles[q]),
                || turned_little(pose.end, angle),
            )
        });
    }

    /// Writes the places of a state. `reach` is called link by link and tells how far its end is
    /// from its joint.
    #[inline(always)]
    fn write_places(
        &self,
        state: &mut ChainState<T, LINKS, W>,
        mut reach: impl FnMut(usize) -> Vector<T>,
    ) {
        let mut place = [T::ZERO; 2];
        let mut angle = T::ZERO;
        for j in 0..LINKS {
            let reach = reach(j);
            place = plus(place, T::ONE, reach);
            angle += state.joints[j].angle.part;
            state.ends[j] = place;
            state.tips[j] = turned_back(direction(angle), reach);
            angle += self.model.turns * state.shape[j][1];
        }
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Place of the chain's end, m.
    #[inline(always)]
    pub(super) fn tip(&self, pose: &[Pose<T, Q>; LINKS]) -> Vector<T> {
        let mut place = [T::ZERO; 2];
        for j in 0..LINKS {
            place = plus(place, T::ONE, self.links[j].reach(&pose[j]));
        }
        place
    }
}

/// `t` turned by a small angle, rad.
#[inline(always)]
fn turned_little<T: Scalar>(t: Vector<T>, angle: T) -> Vector<T> {
    let half_square = T::HALF * (angle * angle);
    let sin = angle - T::from_f64(1.0 / 3.0) * (angle * half_square);
    [t[0] - (sin * t[1] + half_square * t[0]), t[1] + (sin * t[0] - half_square * t[1])]
}

#[cfg(test)]
mod tests {
    use super::turned_little;

    #[test]
    fn a_small_turn_is_exact_to_the_fourth_power() {
        for angle in [-0.1_f64, -0.01, 0.0, 0.03, 0.1] {
            let [x, y] = turned_little([0.6, 0.8], angle);
            let (sin, cos) = angle.sin_cos();
            let error = (x - (0.6 * cos - 0.8 * sin)).hypot(y - (0.8 * cos + 0.6 * sin));
            assert!(error <= 1.01 * angle.powi(4) / 24.0 + 1e-16, "{angle}: {error}");
        }
    }
}
