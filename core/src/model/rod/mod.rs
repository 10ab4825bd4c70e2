//! The inextensible rod in its own modes: exact kinematics at set-up, in f64.

mod basis;
mod expansion;
mod kinetics;
pub(crate) mod monomials;
mod points;
mod polynomials;
mod stations;
mod varied;
mod weights;

pub(crate) use expansion::Expansion;
pub use kinetics::Kinetics;
pub(crate) use kinetics::Straight;
pub(crate) use points::{Load, RodPoints};
pub(crate) use stations::{LINK_STATIONS, Stations};

use basis::Basis;
use polynomials::{legendre, rule};

use crate::Error;
use crate::math::{Band, Each, GAUSS_POINTS, Scalar, array, dot, generalized_eigen, sqrt};
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
    straight: Straight<K>,
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
        // Deflections at the stations, and of the payload.
        let angle: [[f64; POINTS]; N] = array(|basis| at_points.each(|row| row[basis]));
        let link: [[f64; LINK_STATIONS]; N] =
            array(|basis| stations.running.each(|row| length * dot(&row, &angle[basis])));
        let payload: [f64; N] = array(|basis| length * dot(&stations.to_payload, &angle[basis]));
        let mut mass = Band::<f64, N, N>::ZERO;
        for i in 0..N {
            let weighed: [f64; LINK_STATIONS] =
                array(|s| stations.mass * stations.weights[s] * link[i][s]);
            let (carried, turned) =
                (scene.payload.mass * payload[i], scene.payload.inertia * tip[i]);
            for j in 0..=i {
                mass.add(i, j, dot(&weighed, &link[j]) + carried * payload[j] + turned * tip[j]);
            }
        }
        let (values, vectors) = generalized_eigen(&stiffness, &mass);
        let frequency: [f64; K] = array(|k| 1.0 / sqrt(values[k]));
        let shape = |k: usize| {
            let sign = if dot(&vectors[k], &tip) < 0.0 { -1.0 } else { 1.0 };
            vectors[k].each(|x| sign * frequency[k] * x)
        };
        let shapes: [[f64; N]; K] = array(shape);
        let slope = shapes.each(|shape| at_points.each(|basis| dot(&shape, &basis)));
        let tip_slope = shapes.each(|shape| dot(&shape, &tip));
        let scene = scene.shaped(Uniform);
        Ok(Self {
            scene,
            frequency,
            slope,
            root: shapes.each(|shape| dot(&shape, &root)),
            tip_slope,
            straight: Straight::new(&scene, &stations, &slope, &tip_slope),
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
    /// energy. What the joint's damping couples of two modes is left to `elastica`.
    pub fn stiffness_damping(&self) -> [f64; K] {
        let (damping, hub) = (&self.scene.damping, &self.scene.hub);
        let loss = damping.joint * hub.stiffness.unwrap_or(0.0);
        array(|k| {
            let share = self.root[k] / self.frequency[k];
            damping.beta + loss * share * share
        })
    }

    /// `c ψₖ(0)ψⱼ(0)`, 1/s: what a joint with the damping `c` (N m s/rad) couples of two modes; 0
    /// on the diagonal, which [`Self::stiffness_damping`] holds.
    pub(crate) fn joint_damping(&self) -> [[f64; K]; K] {
        let c = self.scene.damping.joint * self.scene.hub.stiffness.unwrap_or(0.0);
        array(|k| array(|j| if j == k { 0.0 } else { c * self.root[k] * self.root[j] }))
    }

    /// `½(α/ωₖ + βₖωₖ)`: damping ratios of the modes.
    pub fn damping_ratio(&self) -> [f64; K] {
        let (alpha, beta) = (self.scene.damping.alpha, self.stiffness_damping());
        array(|k| 0.5 * (alpha / self.frequency[k] + beta[k] * self.frequency[k]))
    }

    /// `∂Y/∂aₖ` of the straight link's tip, m.
    pub(crate) fn tip_swing(&self) -> [f64; K] {
        self.straight.tip_slope
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
        let at = points.each(legendre::<POINTS>);
        array(|k| {
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
