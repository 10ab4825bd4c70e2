//! The inextensible rod by the angles at a few points: exact kinematics in the modes, in the
//! scalar of the tick.
//!
//! With `φ_p = Σ aₖψₖ(ξ_p)` the position is `r (1, 0) + ∫ (cos φ, sin φ)`, and every integral of
//! two of them over the mass is a form `fᵀWg` of their values at the points with constant weights
//! `W_pq = ∫I_p I_q dm`, the payload included, `I_p` the integrals of the Lagrange polynomials.
//! With `W = R Rᵀ`, factored at set-up, every vector is folded once, `Rᵀf`, at half the cost of
//! `Wf`, and every form is a scalar product of what was folded.

use super::varied::triangle;
use super::weights::{SIX, Weights};
use super::{POINTS as FINE, Rod};
use crate::hub::{GravityDirection, HubState};
use crate::math::{Band, Each, Scalar, array, cast, dot, sin_cos, words};
use crate::scene::{LinkShape, Scene};

/// Constants of a rod in `K` modes that do not depend on its stiffness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RodPoints<T, const K: usize, const P: usize = SIX> {
    /// `R_qp`, `q ≥ p`, of `W = R Rᵀ`.
    fold: [[T; P]; P],
    /// `R⁻¹f`, `f_p = ∫I_p dm`, payload included.
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
}

/// Two vectors over the points, for cosines and for sines, folded.
type Folded<T, const P: usize> = [[T; P]; 2];

/// `aᵀWb` of both.
#[inline(always)]
fn form<T: Scalar, const P: usize>(a: &Folded<T, P>, b: &Folded<T, P>) -> T {
    dot(&a[0], &b[0]) + dot(&a[1], &b[1])
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
        let lower: [[f64; P]; P] = triangle(&array(|p| array(|q| pair(p, q))));
        let mut first: [f64; P] =
            array(|p| over_link(&|row| row[p]) + payload.mass * to_payload[p]);
        for p in 0..P {
            for q in 0..p {
                first[p] -= lower[p][q] * first[q];
            }
            first[p] = if lower[p][p] > 0.0 { first[p] / lower[p][p] } else { 0.0 };
        }
        let f = T::from_f64;
        Self {
            fold: array(|p| array(|q| f(lower[q][p]))),
            first: cast(&first),
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
        let shapes = self.shapes(&points);
        let load = self.weighed(self.load_of(&points), &carrying);
        let turning = self.turning(v, &carrying);
        self.solved(a, v, [stiffness, loss], &shapes, &load, turning)
    }

    /// Torque, bending moment and tip under the acceleration of [`Self::acceleration`].
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
        let shapes = self.shapes(&points);
        let mut load = self.load_of(&points);
        let turning = self.turning(v, &carrying);
        let weighed = self.weighed(load, &carrying);
        let acceleration = self.solved(a, v, [stiffness, loss], &shapes, &weighed, turning);
        for k in 0..K {
            for r in 0..2 {
                for p in 0..P {
                    load[r][p] += acceleration[k] * shapes[k][r][p];
                }
            }
        }
        let shear = self.mass * carrying.root[1] + dot(&self.first, &load[0]);
        let whole = self.folded(&[points.cos, points.sin]);
        let moment = turning
            + self.payload_inertia * dot(&self.tip_slope, &acceleration)
            + form(&whole, &self.weighed(load, &carrying));
        let tip = [self.radius + dot(&self.to_tip, &points.cos), dot(&self.to_tip, &points.sin)];
        Load { torque: self.torque(hub, &carrying, moment, shear), moment, tip }
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

    /// `ä` of `M ä = −(…)`, `turning` being the payload's own moment but for what `ä` adds. Every
    /// folded vector is loaded once for all of its products.
    #[inline(always)]
    fn solved(
        &self,
        a: &[T; K],
        v: &[T; K],
        [stiffness, loss]: [&[T; K]; 2],
        shapes: &[Folded<T, P>; K],
        load: &Folded<T, P>,
        turning: T,
    ) -> [T; K] {
        let mut pull = [T::ZERO; K];
        let mut mass = [[T::ZERO; K]; K];
        for i in 0..K {
            pull[i] = turning * self.tip_slope[i] + stiffness[i] * a[i] + loss[i] * v[i];
            for j in 0..=i {
                mass[i][j] = self.payload_inertia * self.tip_slope[i] * self.tip_slope[j];
            }
        }
        for p in 0..P {
            for r in 0..2 {
                for i in 0..K {
                    pull[i] += shapes[i][r][p] * load[r][p];
                    for j in 0..=i {
                        mass[i][j] += shapes[i][r][p] * shapes[j][r][p];
                    }
                }
            }
        }
        let mut matrix = Band::<T, K, K>::ZERO;
        for i in 0..K {
            pull[i] = -pull[i];
            for j in 0..=i {
                matrix.add(i, j, mass[i][j]);
            }
        }
        matrix.factor().solve(&pull)
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
        let mut points =
            Points { sin: [T::ZERO; P], cos: [T::ZERO; P], spin: [T::ZERO; P], turn: [T::ZERO; P] };
        for p in 0..P {
            (points.sin[p], points.cos[p]) = sin_cos(dot(&self.slope[p], a));
            let rate = carrying.rate + dot(&self.slope[p], v);
            points.spin[p] = rate * rate;
            points.turn[p] = carrying.acceleration + self.alpha * rate;
        }
        points
    }

    /// The payload's own moment but for what `ä` adds.
    #[inline(always)]
    fn turning(&self, v: &[T; K], carrying: &Carrying<T>) -> T {
        let drag = self.alpha * (carrying.rate + dot(&self.tip_slope, v));
        self.payload_inertia * (carrying.acceleration + drag)
    }

    /// `Rᵀf` of two vectors.
    #[inline(always)]
    fn folded(&self, f: &Folded<T, P>) -> Folded<T, P> {
        let mut folded = [[T::ZERO; P]; 2];
        for p in 0..P {
            let mut sum = [self.fold[p][p] * f[0][p], self.fold[p][p] * f[1][p]];
            for q in p + 1..P {
                sum[0] += self.fold[p][q] * f[0][q];
                sum[1] += self.fold[p][q] * f[1][q];
            }
            (folded[0][p], folded[1][p]) = (sum[0], sum[1]);
        }
        folded
    }

    /// Motion of the link in each mode.
    #[inline(always)]
    fn shapes(&self, points: &Points<T, P>) -> [Folded<T, P>; K] {
        let mut shapes = [[[T::ZERO; P]; 2]; K];
        for k in 0..K {
            let mut across = [[T::ZERO; P]; 2];
            for p in 0..P {
                across[0][p] = self.slope[p][k] * points.cos[p];
                across[1][p] = self.slope[p][k] * points.sin[p];
            }
            shapes[k] = self.folded(&across);
        }
        shapes
    }

    /// The accelerations that hold no `ä`, but for the clamp's own.
    #[inline(always)]
    fn load_of(&self, points: &Points<T, P>) -> Folded<T, P> {
        let Points { sin, cos, spin, turn } = points;
        let mut load = [[T::ZERO; P]; 2];
        for p in 0..P {
            load[0][p] = cos[p] * turn[p] - sin[p] * spin[p];
            load[1][p] = sin[p] * turn[p] + cos[p] * spin[p];
        }
        self.folded(&load)
    }

    /// The same with the clamp's.
    #[inline(always)]
    fn weighed(&self, mut load: Folded<T, P>, carrying: &Carrying<T>) -> Folded<T, P> {
        for p in 0..P {
            load[0][p] += carrying.root[1] * self.first[p];
            load[1][p] -= carrying.root[0] * self.first[p];
        }
        load
    }
}

words! {
    [T: Scalar, const K: usize, const P: usize] RodPoints<T, K, P>: fold, first, slope, tip_slope, to_tip, radius, mass, gravity,
        direction, alpha, payload_inertia, hub_inertia, carried, carrier;
}

#[cfg(test)]
mod tests {
    use super::RodPoints;
    use crate::hub::{Angle, HubState};
    use crate::model::Rod;
    use crate::{Link, Scene};

    /// Of an arm that does not vibrate on a hub that stands: the answer to the hub's acceleration
    /// and to the weight is that of the rod's own kinetics.
    #[test]
    fn an_answer_is_that_of_the_kinetics() {
        let mut scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.04 });
        (scene.payload.mass, scene.payload.inertia, scene.payload.offset) = (0.03, 1e-5, 0.02);
        (scene.hub.radius, scene.hub.inertia, scene.gravity) = (0.05, 2e-4, 2.0);
        let rod = Rod::<2>::new(&scene).expect("a rod");
        let points = RodPoints::<f64, 2, 8>::fine(&scene, &rod);
        let mut hub = HubState::turning(Angle::from_radians(0.7), 0.0);
        hub.acceleration = -20.0;
        (hub.sin, hub.cos) = hub.angle.sin_cos();
        let (a, still) = ([0.02, -0.001], [0.0; 2]);
        let stiffness = rod.frequency().map(|omega| omega * omega);
        let (sin, cos) = points.direction.seen_from(&hub);
        let kinetics = rod.kinetics(&a);
        let potential = |a: &[f64; 2]| {
            let [x, y] = rod.kinetics(a).moment;
            2.0 * (x * sin + y * cos)
        };
        let acceleration = points.acceleration(&a, &still, &hub, &stiffness, &still);
        for i in 0..2 {
            let mut beside = [a; 2];
            beside[0][i] -= 1e-5;
            beside[1][i] += 1e-5;
            let slope = (potential(&beside[1]) - potential(&beside[0])) / 2e-5;
            let inertia = crate::math::dot(&kinetics.mass[i], &acceleration);
            let rest = inertia + kinetics.coupling[i] * hub.acceleration + stiffness[i] * a[i];
            assert!((rest + slope).abs() < 1e-7, "mode {i}: {rest} and {slope}");
        }
        let answer = points.answer(&a, &still, &hub, &stiffness, &still);
        let [x, y] = kinetics.moment;
        let torque = crate::math::dot(&kinetics.coupling, &acceleration)
            + (kinetics.inertia + 2e-4) * hub.acceleration
            + 2.0 * (x * cos - y * sin);
        assert!((answer.torque - torque).abs() < 1e-12, "{} is not {torque}", answer.torque);
        for r in 0..2 {
            assert!((answer.tip[r] - kinetics.tip[r]).abs() < 1e-12);
        }
    }
}
