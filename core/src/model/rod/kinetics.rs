//! Mass, inertia and first moment of the bent rod, and how far moves bend it.

use super::stations::Stations;
use super::{LINK_STATIONS, POINTS, Rod};
use crate::hub::HubState;
use crate::math::{Each, Scalar, array, cast, dot, sin_cos};
use crate::scene::{Scene, Uniform};

/// The rod at modal coordinates `a`, hub-frame axes, nothing moving.
///
/// `ω` is the hub's rate. On a linear axis it is the carriage's velocity `v` along hub-frame Y:
/// then `h = ∂/∂a (∫ρA Y dx + m_p Y_L)`, and `T_vv` is the mass of link and payload.
#[derive(Clone, Copy, Debug)]
pub struct Kinetics<const K: usize, T = f64> {
    /// `M(a)`: `T = ½ȧᵀMȧ + ω hᵀȧ + ½ω² T_θθ`.
    pub mass: [[T; K]; K],
    /// `h(a)`.
    pub coupling: [T; K],
    /// `T_θθ(a)`, the hub's inertia or the carriage's mass left out.
    pub inertia: T,
    /// `∫(X, Y) dm`, payload included: gravity's potential is `g (x sinχ + y cosχ)`.
    pub moment: [T; 2],
    /// The tip `(X, Y)`.
    pub tip: [T; 2],
}

/// The straight rod: what [`Kinetics`] are at `a = 0`, where `M` is the unit matrix, and how they
/// change there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Straight<const K: usize> {
    /// `h`.
    pub coupling: [f64; K],
    /// `T_θθ`.
    pub inertia: f64,
    /// X parts of the moment and of the tip.
    pub moment: f64,
    pub tip: f64,
    /// Slopes of the Y parts.
    pub moment_slope: [f64; K],
    pub tip_slope: [f64; K],
}

impl<const K: usize> Straight<K> {
    /// Of a rod whose modes have these slopes at the points and at the tip.
    pub(super) fn new(
        scene: &Scene<f64, Uniform>,
        stations: &Stations,
        slope: &[[f64; POINTS]; K],
        tip_slope: &[f64; K],
    ) -> Self {
        let length = scene.link.length;
        let (m_p, j_p, radius) = (scene.payload.mass, scene.payload.inertia, scene.hub.radius);
        let along = |row: &[f64; POINTS]| radius + length * row.iter().sum::<f64>();
        let mass: [f64; LINK_STATIONS] = array(|s| stations.mass * stations.weights[s]);
        let x: [f64; LINK_STATIONS] = array(|s| along(&stations.running[s]));
        let x_p = along(&stations.to_payload);
        let carried = scene.mount.is_linear();
        let mut straight = Self {
            coupling: [0.0; K],
            inertia: if carried { stations.mass + m_p } else { m_p * x_p * x_p + j_p },
            moment: dot(&mass, &x) + m_p * x_p,
            tip: along(&stations.to_tip),
            moment_slope: [0.0; K],
            tip_slope: array(|k| length * dot(&stations.to_tip, &slope[k])),
        };
        let moment: [f64; LINK_STATIONS] = array(|s| mass[s] * x[s]);
        if !carried {
            straight.inertia += dot(&moment, &x);
        }
        for k in 0..K {
            let across: [f64; LINK_STATIONS] =
                array(|s| length * dot(&stations.running[s], &slope[k]));
            let payload = m_p * length * dot(&stations.to_payload, &slope[k]);
            straight.moment_slope[k] = dot(&mass, &across) + payload;
            straight.coupling[k] = if carried {
                straight.moment_slope[k]
            } else {
                dot(&moment, &across) + x_p * payload + j_p * tip_slope[k]
            };
        }
        straight
    }
}

/// Constants that the kinetics of a rod are made of, in one precision.
pub(super) struct Bent<T, const K: usize> {
    slope: [[T; POINTS]; K],
    tip_slope: [T; K],
    /// [`Stations`], in m and kg.
    running: [[T; POINTS]; LINK_STATIONS],
    to_tip: [T; POINTS],
    to_payload: [T; POINTS],
    mass: [T; LINK_STATIONS],
    payload_mass: T,
    payload_inertia: T,
    radius: T,
    /// Mass of a rod on a carriage.
    carried: Option<T>,
}

/// A field over the rod: its values at the stations, and at the payload's centre.
type Field<T> = ([T; LINK_STATIONS], T);

impl<T: Scalar, const K: usize> Bent<T, K> {
    pub fn new(rod: &Rod<K>) -> Self {
        let (scene, stations) = (&rod.scene, &rod.stations);
        let f = T::from_f64;
        let scaled = |row: &[f64; POINTS]| row.each(|x| f(scene.link.length * x));
        Self {
            slope: rod.slope.each(|row| cast(&row)),
            tip_slope: cast(&rod.tip_slope),
            running: stations.running.each(|row| scaled(&row)),
            to_tip: scaled(&stations.to_tip),
            to_payload: scaled(&stations.to_payload),
            mass: stations.weights.each(|w| f(stations.mass * w)),
            payload_mass: f(scene.payload.mass),
            payload_inertia: f(scene.payload.inertia),
            radius: f(scene.hub.radius),
            carried: match scene.mount.is_linear() {
                true => Some(f(stations.mass + scene.payload.mass)),
                false => None,
            },
        }
    }

    /// Everything that depends on the shape alone.
    #[inline(never)]
    pub fn kinetics(&self, a: &[T; K]) -> Kinetics<K, T> {
        let mut sin = [T::ZERO; POINTS];
        let mut cos = [T::ZERO; POINTS];
        for p in 0..POINTS {
            let mut phi = self.slope[0][p] * a[0];
            for k in 1..K {
                phi += self.slope[k][p] * a[k];
            }
            (sin[p], cos[p]) = sin_cos(phi);
        }
        let by_slope = |k: usize, f: &[T; POINTS], sign: T| -> [T; POINTS] {
            array(|p| sign * (self.slope[k][p] * f[p]))
        };
        let mut x = self.integral(&cos);
        for place in &mut x.0 {
            *place += self.radius;
        }
        x.1 += self.radius;
        let y = self.integral(&sin);
        let along: [Field<T>; K] = array(|k| self.integral(&by_slope(k, &sin, -T::ONE)));
        let across: [Field<T>; K] = array(|k| self.integral(&by_slope(k, &cos, T::ONE)));
        let mut mass = [[T::ZERO; K]; K];
        for i in 0..K {
            for j in 0..=i {
                mass[i][j] = self.pair(&along[i], &along[j])
                    + self.pair(&across[i], &across[j])
                    + self.payload_inertia * self.tip_slope[i] * self.tip_slope[j];
                mass[j][i] = mass[i][j];
            }
        }
        Kinetics {
            mass,
            coupling: array(|i| {
                if self.carried.is_some() {
                    return self.first(&across[i]);
                }
                self.pair(&x, &across[i]) - self.pair(&y, &along[i])
                    + self.payload_inertia * self.tip_slope[i]
            }),
            inertia: self
                .carried
                .unwrap_or_else(|| self.pair(&x, &x) + self.pair(&y, &y) + self.payload_inertia),
            moment: [self.first(&x), self.first(&y)],
            tip: [dot(&self.to_tip, &cos) + self.radius, dot(&self.to_tip, &sin)],
        }
    }

    /// `∫f` from the clamp, `f` by its values at the points.
    #[inline(never)]
    fn integral(&self, f: &[T; POINTS]) -> Field<T> {
        (self.running.each(|row| dot(&row, f)), dot(&self.to_payload, f))
    }

    /// `∫f g dm`, payload included.
    #[inline(never)]
    fn pair(&self, f: &Field<T>, g: &Field<T>) -> T {
        let mut sum = self.payload_mass * (f.1 * g.1);
        for s in 0..LINK_STATIONS {
            sum += self.mass[s] * (f.0[s] * g.0[s]);
        }
        sum
    }

    /// `∫f dm`, payload included.
    fn first(&self, f: &Field<T>) -> T {
        dot(&self.mass, &f.0) + self.payload_mass * f.1
    }
}

impl<const K: usize> Rod<K> {
    /// Largest tip angle relative to the hub to expect of a motion with accelerations up to that
    /// many rad/s² (a carriage's: m/s²), rad: twice the quasi-static one, and the sag under
    /// gravity; first mode.
    pub fn bend(&self, acceleration: f64) -> f64 {
        let compliance = self.tip_slope[0] / (self.frequency[0] * self.frequency[0]);
        // A hub that turns meets gravity across the link somewhere; a carriage holds it one way.
        let across = if self.scene.mount.is_linear() {
            let mut hub = HubState::ZERO;
            self.scene.gravity_direction().aim(&mut hub);
            f64::abs(hub.cos)
        } else {
            1.0
        };
        let weight = self.scene.in_plane_gravity() * across * self.straight.moment_slope[0];
        compliance * (2.0 * self.straight.coupling[0].abs() * acceleration + weight)
    }

    /// Modal coordinates to expect with tip angles up to `bend` rad: the first mode alone makes the
    /// bend, the others reach six times their quasi-static share.
    pub(crate) fn range(&self, bend: f64) -> [f64; K] {
        let coupling = &self.straight.coupling;
        let share: [f64; K] =
            array(|k| (coupling[k] / (self.frequency[k] * self.frequency[k])).abs());
        array(|k| {
            let of_first = if k == 0 { 1.0 } else { 6.0 * share[k] / share[0] };
            of_first * bend / self.tip_slope[0]
        })
    }

    /// The straight rod.
    pub(crate) fn straight(&self) -> &Straight<K> {
        &self.straight
    }

    /// Everything that depends on the shape alone.
    pub fn kinetics(&self, a: &[f64; K]) -> Kinetics<K> {
        Bent::new(self).kinetics(a)
    }
}

#[cfg(test)]
mod tests {
    use super::Rod;
    use crate::scene::{Link, Mount, Scene};

    /// The straight rod is the bent one at `a = 0`, on a hub and on a carriage.
    #[test]
    fn a_straight_rod_is_one_that_is_bent_by_nothing() {
        for mount in [Mount::ROTARY, Mount::LINEAR] {
            let mut scene = Scene::new(Link { length: 0.4, mass: 0.02, bending_stiffness: 0.04 });
            (scene.payload.mass, scene.payload.inertia, scene.payload.offset) = (0.03, 1e-5, 0.02);
            (scene.hub.radius, scene.mount) = (if mount.is_linear() { 0.0 } else { 0.05 }, mount);
            let rod = Rod::<2>::new(&scene).expect("a rod");
            let (straight, bent) = (rod.straight(), rod.kinetics(&[0.0; 2]));
            let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-14 * y.abs(), "{x} is not {y}");
            near(straight.inertia, bent.inertia);
            near(straight.moment, bent.moment[0]);
            near(straight.tip, bent.tip[0]);
            for k in 0..2 {
                near(straight.coupling[k], bent.coupling[k]);
                let mut a = [0.0; 2];
                a[k] = 1e-7;
                let bent = rod.kinetics(&a);
                // Y is odd: the difference errs by the square of the angle.
                assert!((straight.moment_slope[k] - bent.moment[1] * 1e7).abs() < 1e-9);
                assert!((straight.tip_slope[k] - bent.tip[1] * 1e7).abs() < 1e-9);
            }
        }
    }
}
