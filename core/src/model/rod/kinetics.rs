//! Mass, inertia and first moment of the bent rod, and how far moves bend it.

use super::{LINK_STATIONS, POINTS, Rod};
use crate::hub::HubState;
use crate::math::{Each, Scalar, array, dot};

/// The rod at modal coordinates `a`, hub-frame axes, nothing moving.
///
/// `ω` is the hub's rate. On a linear axis it is the carriage's velocity `v` along hub-frame Y:
/// then `h = ∂/∂a (∫ρA Y dx + m_p Y_L)`, and `T_vv` is the mass of link and payload.
#[derive(Clone, Copy, Debug)]
pub struct Kinetics<const K: usize> {
    /// `M(a)`: `T = ½ȧᵀMȧ + ω hᵀȧ + ½ω² T_θθ`.
    pub mass: [[f64; K]; K],
    /// `h(a)`.
    pub coupling: [f64; K],
    /// `T_θθ(a)`, the hub's inertia or the carriage's mass left out.
    pub inertia: f64,
    /// `∫(X, Y) dm`, payload included: gravity's potential is `g (x sinχ + y cosχ)`.
    pub moment: [f64; 2],
    /// The tip `(X, Y)`.
    pub tip: [f64; 2],
}

impl<const K: usize> Rod<K> {
    /// Largest tip angle relative to the hub to expect of a motion with accelerations up to that
    /// many rad/s² (a carriage's: m/s²), rad: twice the quasi-static one, and the sag under
    /// gravity; first mode.
    pub fn bend(&self, acceleration: f64) -> f64 {
        let rest = self.kinetics(&[0.0; K]);
        let compliance = self.tip_slope[0] / (self.frequency[0] * self.frequency[0]);
        let mut a = [0.0; K];
        a[0] = 1e-4 * self.scene.link.length;
        // A hub that turns meets gravity across the link somewhere; a carriage holds it one way.
        let across = if self.scene.mount.is_linear() {
            let mut hub = HubState::ZERO;
            self.scene.gravity_direction().aim(&mut hub);
            f64::abs(hub.cos)
        } else {
            1.0
        };
        let weight = self.scene.in_plane_gravity() * across * self.kinetics(&a).moment[1] / a[0];
        compliance * (2.0 * rest.coupling[0].abs() * acceleration + weight)
    }

    /// Modal coordinates to expect with tip angles up to `bend` rad: the first mode alone makes the
    /// bend, the others reach six times their quasi-static share.
    pub(crate) fn range(&self, bend: f64) -> [f64; K] {
        let coupling = self.kinetics(&[0.0; K]).coupling;
        let share: [f64; K] =
            array(|k| (coupling[k] / (self.frequency[k] * self.frequency[k])).abs());
        array(|k| {
            let of_first = if k == 0 { 1.0 } else { 6.0 * share[k] / share[0] };
            of_first * bend / self.tip_slope[0]
        })
    }

    /// Everything that depends on the shape alone.
    pub fn kinetics(&self, a: &[f64; K]) -> Kinetics<K> {
        let (scene, stations) = (&self.scene, &self.stations);
        let length = scene.link.length;
        let mut sin = [0.0; POINTS];
        let mut cos = [0.0; POINTS];
        for p in 0..POINTS {
            let phi: f64 = (0..K).map(|k| self.slope[k][p] * a[k]).sum();
            (sin[p], cos[p]) = (phi / core::f64::consts::TAU).sin_cos_turns();
        }
        // Each as its values at the stations, and last at the payload's centre.
        let integral = |f: &[f64; POINTS]| -> ([f64; LINK_STATIONS], f64) {
            let at_payload = length * dot(&stations.to_payload, f);
            (stations.running.each(|row| length * dot(&row, f)), at_payload)
        };
        let times =
            |f: &[f64; POINTS], g: &[f64; POINTS]| -> [f64; POINTS] { array(|p| f[p] * g[p]) };
        let (mut x, mut x_p) = integral(&cos);
        x = x.each(|x| x + scene.hub.radius);
        x_p += scene.hub.radius;
        let (y, y_p) = integral(&sin);
        let along: [_; K] = array(|k| {
            let (f, end) = integral(&times(&self.slope[k], &sin));
            (f.each(|f| -f), -end)
        });
        let across: [_; K] = array(|k| integral(&times(&self.slope[k], &cos)));
        let link = |f: [f64; LINK_STATIONS]| stations.mass * dot(&stations.weights, &f);
        let sum = |f: &dyn Fn(usize) -> f64| link(array(f));
        let (m_p, j_p) = (scene.payload.mass, scene.payload.inertia);
        let tip_slope = &self.tip_slope;
        let carried = scene.mount.is_linear();
        Kinetics {
            mass: array(|i| {
                array(|j| {
                    sum(&|s| along[i].0[s] * along[j].0[s] + across[i].0[s] * across[j].0[s])
                        + m_p * (along[i].1 * along[j].1 + across[i].1 * across[j].1)
                        + j_p * tip_slope[i] * tip_slope[j]
                })
            }),
            coupling: array(|i| {
                if carried {
                    return link(across[i].0) + m_p * across[i].1;
                }
                sum(&|s| x[s] * across[i].0[s] - y[s] * along[i].0[s])
                    + m_p * (x_p * across[i].1 - y_p * along[i].1)
                    + j_p * tip_slope[i]
            }),
            inertia: if carried {
                stations.mass + m_p
            } else {
                sum(&|s| x[s] * x[s] + y[s] * y[s]) + m_p * (x_p * x_p + y_p * y_p) + j_p
            },
            moment: [link(x) + m_p * x_p, link(y) + m_p * y_p],
            tip: [
                length * dot(&stations.to_tip, &cos) + scene.hub.radius,
                length * dot(&stations.to_tip, &sin),
            ],
        }
    }
}
