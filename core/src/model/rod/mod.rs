//! The inextensible rod in its own modes: exact kinematics at set-up, in f64.

mod basis;
mod expansion;
pub(crate) mod monomials;
mod points;
mod stations;
mod varied;

pub(crate) use expansion::Expansion;
pub(crate) use points::{Load, RodPoints};
pub(crate) use stations::{LINK_STATIONS, Stations};

use basis::Basis;

use crate::Error;
use crate::hub::HubState;
use crate::math::{Band, GAUSS_POINTS, Scalar, dot, gauss_points, generalized_eigen, sqrt};
use crate::scene::{LinkShape, Scene, Uniform};

/// Polynomials that [`Rod::new`] makes its modes of: slopes of degree 1 to 5.
const BASIS: usize = 5;

/// Gauss points over the link. A deflection has degree `N + 1`; products of two have at most
/// `2(N + 1)`, and the rule is exact to degree 15.
pub(crate) const POINTS: usize = GAUSS_POINTS;

/// An inextensible rod with payload, its angle relative to the hub expanded in the slopes of its
/// lowest `K` modes: `φ(x) = Σ aₖ ψₖ(x)`, `X = r + ∫cos φ`, `Y = ∫sin φ`.
///
/// The modes are the lowest `K` of `N` polynomials of the bending moment (Rayleigh–Ritz),
/// `ψₖ(0) = M(0)/k` with a joint of stiffness `k`, mass-normalised:
/// `a` are the modal coordinates of the small-deflection model. [`Rod::new`] takes `N = 5`; the
/// exact rod that `auto` judges its rungs by takes more.
#[derive(Clone, Debug)]
pub struct Rod<const K: usize> {
    scene: Scene<f64, Uniform>,
    /// `ωₖ`, rad/s.
    frequency: [f64; K],
    /// `ψₖ` at the points, at the root and at the tip.
    slope: [[f64; POINTS]; K],
    root: [f64; K],
    tip_slope: [f64; K],
    stations: Stations,
}

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
    /// Solves for the lowest `K` modes of five polynomials; `K` is 1 to 5.
    pub fn new<S: LinkShape>(scene: &Scene<f64, S>) -> Result<Self, Error> {
        Self::of_polynomials::<BASIS>(scene)
    }

    /// Solves for the lowest `K` modes of `N` polynomials. `N` is at most 6: then the rule
    /// integrates the products of two deflections exactly.
    pub(crate) fn of_polynomials<const N: usize>(
        scene: &Scene<f64, impl LinkShape>,
    ) -> Result<Self, Error> {
        const { assert!(1 <= K && K <= N, "as many modes as polynomials at most") }
        const { assert!(2 * (N + 1) < 2 * POINTS, "the mass is integrated exactly") }
        let scene = scene.validate()?;
        let Basis { at_points, root, tip, bending, stations } = Basis::<N>::new(&scene);
        let length = scene.link.length;
        let stiffness = bending.map(|share| scene.link.bending_stiffness / length * share);
        let angle = |basis: usize| -> [f64; POINTS] { at_points.map(|row| row[basis]) };
        let deflection = |basis: usize| -> [f64; LINK_STATIONS] {
            let f = angle(basis);
            stations.running.map(|row| length * dot(&row, &f))
        };
        let payload_deflection =
            |basis: usize| -> f64 { length * dot(&stations.to_payload, &angle(basis)) };
        let mut mass = Band::<f64, N, N>::ZERO;
        for i in 0..N {
            for j in 0..=i {
                let (wi, wj) = (deflection(i), deflection(j));
                let product: [f64; LINK_STATIONS] = core::array::from_fn(|s| wi[s] * wj[s]);
                let value = stations.mass * dot(&stations.weights, &product)
                    + scene.payload.mass * payload_deflection(i) * payload_deflection(j)
                    + scene.payload.inertia * tip[i] * tip[j];
                mass.add(i, j, value);
            }
        }
        let (values, vectors) = generalized_eigen(&stiffness, &mass);
        let frequency: [f64; K] = core::array::from_fn(|k| 1.0 / sqrt(values[k]));
        let shape = |k: usize| {
            let sign = if dot(&vectors[k], &tip) < 0.0 { -1.0 } else { 1.0 };
            vectors[k].map(|x| sign * frequency[k] * x)
        };
        Ok(Self {
            scene: scene.shaped(Uniform),
            frequency,
            slope: core::array::from_fn(|k| {
                let shape = shape(k);
                at_points.map(|basis| dot(&shape, &basis))
            }),
            root: core::array::from_fn(|k| dot(&shape(k), &root)),
            tip_slope: core::array::from_fn(|k| dot(&shape(k), &tip)),
            stations,
        })
    }

    /// `ωₖ`, rad/s.
    pub fn frequency(&self) -> &[f64; K] {
        &self.frequency
    }

    /// `ψₖ(L)`, the tip's angle per modal coordinate.
    pub fn tip_slope(&self) -> &[f64; K] {
        &self.tip_slope
    }

    /// `ψₖ(0)`, the root's angle per modal coordinate: 0 where the link is clamped without give.
    pub fn root_slope(&self) -> &[f64; K] {
        &self.root
    }

    /// `βₖ` of each mode, s: `β`, and the joint's own damping by the mode's share in its strain
    /// energy. What the joint's damping couples of two modes is left out.
    pub fn stiffness_damping(&self) -> [f64; K] {
        let (damping, hub) = (&self.scene.damping, &self.scene.hub);
        let loss = damping.joint * hub.stiffness.unwrap_or(0.0);
        core::array::from_fn(|k| {
            let share = self.root[k] / self.frequency[k];
            damping.beta + loss * share * share
        })
    }

    /// `½(α/ωₖ + βₖωₖ)`: damping ratios of the modes.
    pub fn damping_ratio(&self) -> [f64; K] {
        let (alpha, beta) = (self.scene.damping.alpha, self.stiffness_damping());
        core::array::from_fn(|k| 0.5 * (alpha / self.frequency[k] + beta[k] * self.frequency[k]))
    }

    /// `∂Y/∂aₖ` of the straight link's tip, m.
    pub(crate) fn tip_swing(&self) -> [f64; K] {
        core::array::from_fn(|k| {
            self.scene.link.length * dot(&self.stations.to_tip, &self.slope[k])
        })
    }

    /// The payload's centre in the hub frame, m, of an arm whose tip is at `tip` there.
    pub fn payload_centre(&self, coordinate: &[f64; K], tip: [f64; 2]) -> [f64; 2] {
        let angle = dot(&self.tip_slope, coordinate) / core::f64::consts::TAU;
        let (sin, cos) = angle.sin_cos_turns();
        let offset = self.scene.payload.offset;
        [tip[0] + offset * cos, tip[1] + offset * sin]
    }

    /// `ψₖ(ξ)`, the angle of the link at `ξ = x/L`, 0 to 1, per modal coordinate. The arm's shape
    /// is `φ(ξ) = Σ aₖψₖ(ξ)`. The polynomial through the points.
    pub fn slopes_at(&self, xi: f64) -> [f64; K] {
        let (points, weights) = rule();
        let there = legendre::<POINTS>(xi);
        let at = points.map(legendre::<POINTS>);
        core::array::from_fn(|k| {
            let mut sum = 0.0;
            for j in 0..POINTS {
                for p in 0..POINTS {
                    sum += (2 * j + 1) as f64 * there[j] * weights[p] * at[p][j] * self.slope[k][p];
                }
            }
            sum
        })
    }

    /// `ψₖ` at the points.
    pub(crate) fn slope(&self) -> &[[f64; POINTS]; K] {
        &self.slope
    }

    /// The places that carry the link's mass.
    pub(crate) fn stations(&self) -> &Stations {
        &self.stations
    }

    /// The scene this was built from, its link's shape left out.
    pub fn scene(&self) -> &Scene<f64, Uniform> {
        &self.scene
    }

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
            core::array::from_fn(|k| (coupling[k] / (self.frequency[k] * self.frequency[k])).abs());
        core::array::from_fn(|k| {
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
            (stations.running.map(|row| length * dot(&row, f)), at_payload)
        };
        let times = |f: &[f64; POINTS], g: &[f64; POINTS]| -> [f64; POINTS] {
            core::array::from_fn(|p| f[p] * g[p])
        };
        let (mut x, mut x_p) = integral(&cos);
        x = x.map(|x| x + scene.hub.radius);
        x_p += scene.hub.radius;
        let (y, y_p) = integral(&sin);
        let along: [_; K] = core::array::from_fn(|k| {
            let (f, end) = integral(&times(&self.slope[k], &sin));
            (f.map(|f| -f), -end)
        });
        let across: [_; K] = core::array::from_fn(|k| integral(&times(&self.slope[k], &cos)));
        let link = |f: [f64; LINK_STATIONS]| stations.mass * dot(&stations.weights, &f);
        let sum = |f: &dyn Fn(usize) -> f64| link(core::array::from_fn(f));
        let (m_p, j_p) = (scene.payload.mass, scene.payload.inertia);
        let tip_slope = &self.tip_slope;
        let carried = scene.mount.is_linear();
        Kinetics {
            mass: core::array::from_fn(|i| {
                core::array::from_fn(|j| {
                    sum(&|s| along[i].0[s] * along[j].0[s] + across[i].0[s] * across[j].0[s])
                        + m_p * (along[i].1 * along[j].1 + across[i].1 * across[j].1)
                        + j_p * tip_slope[i] * tip_slope[j]
                })
            }),
            coupling: core::array::from_fn(|i| {
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

/// The whole Gauss rule.
pub(super) fn rule() -> ([f64; POINTS], [f64; POINTS]) {
    (gauss_points().map(|(xi, _)| xi), gauss_points().map(|(_, weight)| weight))
}

/// Legendre polynomials `P₀ … P_{N−1}` of `2ξ − 1`.
pub(super) fn legendre<const N: usize>(xi: f64) -> [f64; N] {
    let u = 2.0 * xi - 1.0;
    let mut p = [1.0; N];
    for k in 1..N {
        let before = if k > 1 { p[k - 2] } else { 0.0 };
        p[k] = ((2 * k - 1) as f64 * u * p[k - 1] - (k - 1) as f64 * before) / k as f64;
    }
    p
}

/// `ψⱼ(ξ) = ∫₀^ξ P_{j}(2ξ' − 1) dξ'`, `j = 0..N`: degree 1 to `N`, zero at the clamp.
fn slopes<const N: usize>(xi: f64) -> [f64; N] {
    let p = legendre::<POINTS>(xi);
    core::array::from_fn(
        |j| {
            if j == 0 { xi } else { (p[j + 1] - p[j - 1]) / (2 * (2 * j + 1)) as f64 }
        },
    )
}

/// Integrates the interpolation through the points from the clamp to each point.
fn running_integrals(points: &[f64; POINTS], weights: &[f64; POINTS]) -> [[f64; POINTS]; POINTS] {
    let at = points.map(legendre::<{ POINTS + 1 }>);
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let mut sum = 0.0;
            for k in 0..POINTS {
                let integral = if k == 0 {
                    points[i]
                } else {
                    (at[i][k + 1] - at[i][k - 1]) / (2 * (2 * k + 1)) as f64
                };
                sum += (2 * k + 1) as f64 * weights[j] * at[j][k] * integral;
            }
            sum
        })
    })
}

#[cfg(test)]
mod tests {
    use super::Rod;
    use crate::math::sqrt;
    use crate::{Link, Scene};

    /// Roots of `cos λ cosh λ = −1`: `ω = λ² √(EI/ρA)/L²`.
    #[test]
    fn frequencies_are_those_of_the_cantilever() {
        let link = Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 };
        let rod = Rod::<2>::new(&Scene::new(link)).expect("a rod");
        let scale = sqrt(0.46 / (0.0224 / 0.4)) / (0.4 * 0.4);
        for (i, (root, error)) in
            [(1.875_104_069, 1e-5), (4.694_091_133, 1e-3)].into_iter().enumerate()
        {
            let ratio = rod.frequency()[i] / (root * root * scale);
            assert!((ratio - 1.0).abs() < error, "mode {i}: {ratio} of the closed form");
        }
    }

    /// A heavy payload on a light link: a massless cantilever, `ω² = 3EI/(m_p L³)`.
    #[test]
    fn a_heavy_payload_swings_on_a_spring() {
        let mut scene = Scene::new(Link { length: 0.5, mass: 1e-4, bending_stiffness: 2.0 });
        scene.payload.mass = 1.0;
        let rod = Rod::<1>::new(&scene).expect("a rod");
        let ratio = rod.frequency()[0] / sqrt(3.0 * 2.0 / 0.125);
        assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    }
}
