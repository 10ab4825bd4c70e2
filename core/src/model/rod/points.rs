//! The inextensible rod by the angles at a few points: exact kinematics in the modes, in the
//! scalar of the tick.
//!
//! With `φ_p = Σ aₖψₖ(ξ_p)` the position is `r (1, 0) + ∫ (cos φ, sin φ)`, and every integral of
//! two of them over the mass is a sum over pairs of points with constant weights `W_pq = ∫I_p I_q
//! dm`, the payload included, `I_p` the integrals of the Lagrange polynomials.

use super::weights::{SIX, Weights};
use super::{POINTS as FINE, Rod};
use crate::hub::{GravityDirection, HubState};
use crate::math::{Band, Each, Scalar, array, cast, dot, words};
use crate::scene::{LinkShape, Scene};

/// Constants of a rod in `K` modes that do not depend on its stiffness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RodPoints<T, const K: usize, const P: usize = SIX> {
    /// `W_pq`, `q ≤ p`.
    pairs: [[T; P]; P],
    /// `∫I_p dm`, payload included.
    first: [T; P],
    /// `ψₖ` at the points, and at the tip.
    slope: [[T; K]; P],
    tip_slope: [T; K],
    /// `I_p(L)`.
    to_tip: [T; P],
    radius: T,
    mass: T,
    gravity: T,
    direction: GravityDirection<T>,
    alpha: T,
    payload_inertia: T,
    /// `J_h`, or the carriage's mass.
    hub_inertia: T,
    /// The hub is a carriage: it moves the clamp across the link and does not turn it.
    carried: bool,
    /// Rate of the carrier, rad/s.
    carrier: T,
}

/// Motion that the hub gives the link at one instant.
struct Carrying<T> {
    /// Rate and acceleration of the turn.
    rate: T,
    acceleration: T,
    /// Acceleration of the clamp, drag and weight included: hub axes.
    root: [T; 2],
    /// `g cos χ`.
    across: T,
}

/// A shape and its motion at one instant: sine and cosine at the points, `χ̇ = θ̇ + φ̇`, and the
/// accelerations that hold no ä.
struct Points<T, const P: usize> {
    sin: [T; P],
    cos: [T; P],
    /// `χ̇²`.
    spin: [T; P],
    /// `θ̈ + αχ̇`.
    turn: [T; P],
    /// At the clamp, weight included: hub axes.
    root: [T; 2],
}

/// Loads of the arm on its hub, and its tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Load<T> {
    /// Hub torque, N m, or force on the carriage, N.
    pub torque: T,
    /// Bending moment at the clamp, N m.
    pub moment: T,
    /// The tip in the hub frame, m.
    pub tip: [T; 2],
}

impl<T: Scalar, const K: usize> RodPoints<T, K> {
    /// Six points, which follow moves that bend by a radian in two modes.
    pub fn new<S: LinkShape>(scene: &Scene<f64, S>, rod: &Rod<K>) -> Self {
        let weights = match scene.shape.varied() {
            None => Weights::uniform(rod, scene.payload.offset),
            Some(shape) => Weights::varied(rod, shape, scene.link.mass),
        };
        Self::weighted(scene, rod, &weights)
    }
}

impl<T: Scalar, const K: usize> RodPoints<T, K, FINE> {
    /// The rod's own eight points, which a third mode of six polynomials needs.
    pub fn fine<S: LinkShape>(scene: &Scene<f64, S>, rod: &Rod<K>) -> Self {
        Self::weighted(scene, rod, &Weights::fine(rod))
    }
}

impl<T: Scalar, const K: usize, const P: usize> RodPoints<T, K, P> {
    fn weighted<S: LinkShape>(
        scene: &Scene<f64, S>,
        rod: &Rod<K>,
        weights: &Weights<K, P>,
    ) -> Self {
        let (payload, stations) = (scene.payload, rod.stations());
        let Weights { link, to_tip, to_payload, slope } = weights;
        let over_link = |g: &dyn Fn(&[f64; P]) -> f64| -> f64 {
            stations.mass
                * link.iter().zip(&stations.weights).map(|(row, w)| w * g(row)).sum::<f64>()
        };
        let pair = |p: usize, q: usize| {
            over_link(&|row| row[p] * row[q]) + payload.mass * to_payload[p] * to_payload[q]
        };
        let f = T::from_f64;
        Self {
            pairs: array(|p| array(|q| if q <= p { f(pair(p, q)) } else { T::ZERO })),
            first: array(|p| f(over_link(&|row| row[p]) + payload.mass * to_payload[p])),
            slope: slope.each(|row| cast(&row)),
            tip_slope: cast(rod.tip_slope()),
            to_tip: cast(to_tip),
            radius: f(scene.hub.radius),
            mass: f(stations.mass + payload.mass),
            gravity: f(scene.in_plane_gravity()),
            direction: scene.gravity_direction(),
            alpha: f(scene.damping.alpha),
            payload_inertia: f(payload.inertia),
            hub_inertia: f(scene.hub.inertia),
            carried: scene.mount.is_linear(),
            carrier: f(scene.mount.carrier),
        }
    }

    /// `ä` of the modes with squared frequencies `stiffness` and `loss = β ω²`, for coordinates
    /// `a`, their rates `v` and a hub.
    pub fn acceleration(
        &self,
        a: &[T; K],
        v: &[T; K],
        hub: &HubState<T>,
        stiffness: &[T; K],
        loss: &[T; K],
    ) -> [T; K] {
        let carrying = self.carrying(hub);
        let points = self.points(a, v, &carrying);
        let (force, mass) = self.forces(&points);
        let turning = self.payload_inertia
            * (carrying.acceleration + self.alpha * (carrying.rate + dot(&self.tip_slope, v)));
        let right = self.pull(a, v, [stiffness, loss], &force, turning);
        mass.factor().solve(&right)
    }

    /// Torque, bending moment and tip, `acceleration` being ä.
    pub fn load(
        &self,
        a: &[T; K],
        v: &[T; K],
        acceleration: &[T; K],
        hub: &HubState<T>,
    ) -> Load<T> {
        let carrying = self.carrying(hub);
        let mut points = self.points(a, v, &carrying);
        for p in 0..P {
            points.turn[p] += dot(&self.slope[p], acceleration);
        }
        let (force, _) = self.forces(&points);
        let spin = dot(&self.tip_slope, acceleration)
            + self.alpha * (carrying.rate + dot(&self.tip_slope, v));
        let mut moment = self.payload_inertia * (carrying.acceleration + spin);
        let mut shear = self.mass * points.root[1];
        let mut tip = [self.radius, T::ZERO];
        for p in 0..P {
            moment += force[p];
            shear +=
                self.first[p] * (points.turn[p] * points.cos[p] - points.spin[p] * points.sin[p]);
            tip[0] += self.to_tip[p] * points.cos[p];
            tip[1] += self.to_tip[p] * points.sin[p];
        }
        let torque = self.torque(hub, &carrying, moment, shear);
        Load { torque, moment, tip }
    }

    /// Torque, bending moment and tip, as [`Self::load`] of [`Self::acceleration`] but for rounding:
    /// points and forces are computed once for both.
    pub fn answer(
        &self,
        a: &[T; K],
        v: &[T; K],
        hub: &HubState<T>,
        stiffness: &[T; K],
        loss: &[T; K],
    ) -> Load<T> {
        let carrying = self.carrying(hub);
        let points = self.points(a, v, &carrying);
        let (force, mass) = self.forces(&points);
        let drag = self.alpha * (carrying.rate + dot(&self.tip_slope, v));
        let turning = self.payload_inertia * (carrying.acceleration + drag);
        let right = self.pull(a, v, [stiffness, loss], &force, turning);
        let acceleration = mass.factor().solve(&right);
        let mut moment = turning + self.payload_inertia * dot(&self.tip_slope, &acceleration);
        let mut shear = self.mass * points.root[1];
        let mut tip = [self.radius, T::ZERO];
        for p in 0..P {
            let (sin, cos) = (points.sin[p], points.cos[p]);
            let gained = dot(&self.slope[p], &acceleration);
            // What that adds to the forces at all points together.
            let [mut along, mut across] = [T::ZERO; 2];
            for q in 0..P {
                let pair = self.pairs[p.max(q)][p.min(q)];
                along += pair * points.cos[q];
                across += pair * points.sin[q];
            }
            moment += force[p] + gained * (cos * along + sin * across);
            shear += self.first[p] * ((points.turn[p] + gained) * cos - points.spin[p] * sin);
            tip[0] += self.to_tip[p] * cos;
            tip[1] += self.to_tip[p] * sin;
        }
        let torque = self.torque(hub, &carrying, moment, shear);
        Load { torque, moment, tip }
    }

    /// Torque of a moment at the clamp and a force across it.
    #[inline(always)]
    fn torque(&self, hub: &HubState<T>, carrying: &Carrying<T>, moment: T, shear: T) -> T {
        if self.carried {
            shear + self.hub_inertia * (hub.acceleration + carrying.across)
        } else {
            moment + self.radius * shear + self.hub_inertia * hub.acceleration
        }
    }

    /// The right-hand side of `M ä`, `turning` being the payload's own moment but for `ä`.
    #[inline(always)]
    fn pull(
        &self,
        a: &[T; K],
        v: &[T; K],
        [stiffness, loss]: [&[T; K]; 2],
        force: &[T; P],
        turning: T,
    ) -> [T; K] {
        array(|i| {
            let mut sum = -(turning * self.tip_slope[i] + stiffness[i] * a[i] + loss[i] * v[i]);
            for p in 0..P {
                sum -= self.slope[p][i] * force[p];
            }
            sum
        })
    }

    /// `∂Y/∂aₖ` of the straight link's tip, m.
    pub fn tip_swing(&self) -> [T; K] {
        array(|k| {
            let mut sum = T::ZERO;
            for p in 0..P {
                sum += self.to_tip[p] * self.slope[p][k];
            }
            sum
        })
    }

    /// The motion of the clamp. `hub.sin` and `hub.cos` are those of θ.
    #[inline(always)]
    fn carrying(&self, hub: &HubState<T>) -> Carrying<T> {
        let (sin, cos) = self.direction.seen_from(hub);
        let (along, across) = (self.gravity * sin, self.gravity * cos);
        let pushed = hub.acceleration + self.alpha * hub.rate;
        if self.carried {
            let root = [along, across + pushed];
            return Carrying { rate: T::ZERO, acceleration: T::ZERO, root, across };
        }
        let rate = hub.rate + self.carrier;
        Carrying {
            rate,
            acceleration: hub.acceleration,
            root: [along - self.radius * rate * rate, across + self.radius * pushed],
            across,
        }
    }

    fn points(&self, a: &[T; K], v: &[T; K], carrying: &Carrying<T>) -> Points<T, P> {
        let mut points = Points {
            sin: [T::ZERO; P],
            cos: [T::ZERO; P],
            spin: [T::ZERO; P],
            turn: [T::ZERO; P],
            root: carrying.root,
        };
        let per_radian = T::from_f64(0.5 / core::f64::consts::PI);
        for p in 0..P {
            (points.sin[p], points.cos[p]) = (per_radian * dot(&self.slope[p], a)).sin_cos_turns();
            let rate = carrying.rate + dot(&self.slope[p], v);
            points.spin[p] = rate * rate;
            points.turn[p] = carrying.acceleration + self.alpha * rate;
        }
        points
    }

    /// Returns the force at each point by all the others and the clamp, and the mass matrix.
    #[inline(always)]
    fn forces(&self, points: &Points<T, P>) -> ([T; P], Band<T, K, K>) {
        let Points { sin, cos, spin, turn, root } = points;
        let mut mass = Band::<T, K, K>::ZERO;
        for i in 0..K {
            for j in 0..=i {
                mass.add(i, j, self.payload_inertia * self.tip_slope[i] * self.tip_slope[j]);
            }
        }
        let mut force = [T::ZERO; P];
        for p in 0..P {
            force[p] +=
                self.pairs[p][p] * turn[p] + self.first[p] * (cos[p] * root[1] - sin[p] * root[0]);
            for i in 0..K {
                for j in 0..=i {
                    mass.add(i, j, self.pairs[p][p] * self.slope[p][i] * self.slope[p][j]);
                }
            }
            for q in 0..p {
                let along = self.pairs[p][q] * (cos[p] * cos[q] + sin[p] * sin[q]);
                let across = self.pairs[p][q] * (sin[p] * cos[q] - cos[p] * sin[q]);
                force[p] += along * turn[q] + across * spin[q];
                force[q] += along * turn[p] - across * spin[p];
                for i in 0..K {
                    for j in 0..=i {
                        let both = self.slope[p][i] * self.slope[q][j]
                            + self.slope[q][i] * self.slope[p][j];
                        mass.add(i, j, along * both);
                    }
                }
            }
        }
        (force, mass)
    }
}

words! {
    [T: Scalar, const K: usize, const P: usize] RodPoints<T, K, P>: pairs, first, slope, tip_slope, to_tip, radius, mass, gravity,
        direction, alpha, payload_inertia, hub_inertia, carried, carrier;
}

#[cfg(test)]
mod tests {
    use super::RodPoints;
    use crate::hub::{Angle, HubState};
    use crate::model::Rod;
    use crate::{Link, Scene};

    /// One evaluation answers what two do, with everything that a scene can hold.
    #[test]
    fn an_answer_is_the_load_under_the_acceleration() {
        let mut scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.04 });
        (scene.payload.mass, scene.payload.inertia, scene.payload.offset) = (0.03, 1e-5, 0.02);
        (scene.hub.radius, scene.hub.inertia) = (0.05, 2e-4);
        (scene.damping.alpha, scene.gravity) = (0.3, 2.0);
        let rod = Rod::<2>::new(&scene).expect("a rod");
        let points = RodPoints::<f64, 2>::new(&scene, &rod);
        let mut hub = HubState::turning(Angle::from_radians(0.7), 3.0);
        hub.acceleration = -20.0;
        (hub.sin, hub.cos) = hub.angle.sin_cos();
        let (a, v) = ([0.02, -0.001], [0.3, 0.1]);
        let stiffness = rod.frequency().map(|omega| omega * omega);
        let loss = [0.5, 20.0];
        let acceleration = points.acceleration(&a, &v, &hub, &stiffness, &loss);
        let apart = points.load(&a, &v, &acceleration, &hub);
        let once = points.answer(&a, &v, &hub, &stiffness, &loss);
        let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12 * y.abs().max(1.0), "{x} {y}");
        near(once.torque, apart.torque);
        near(once.moment, apart.moment);
        assert_eq!(once.tip, apart.tip);
    }
}
