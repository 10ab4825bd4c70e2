//! The shape functions of the relative angle, and the quadrature that goes with them.

use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;
use nalgebra::SMatrix;
use stillbeam::Scene;
use stillbeam::scene::Varied;

/// Gauss points over a uniform link: exact to degree 27. With 16 or 24 of them the runs of
/// `tests/truth` change by less than 2e-10 of L.
pub(super) const POINTS: usize = 14;
/// The points and the payload.
pub(super) const STATIONS: usize = POINTS + 1;

/// Gauss points over a link of several sections, shared among its smooth pieces: four or more each.
pub(super) const VARIED_POINTS: usize = 48;
/// The points, the masses that are mounted, and the payload.
pub(super) const VARIED_STATIONS: usize = VARIED_POINTS + stillbeam::scene::MAX_MASSES + 1;

/// Angles along the link and what follows from their values at `P` points, on ξ = x/L = 0..1.
///
/// `ψₖ(ξ) = ψₖ(0) + ∫₀^ξ P̃ₖ₋₁/e`, `P̃ₖ(ξ) = Pₖ(2ξ − 1)`, with `e` the link's `EI` relative to its
/// mean: the angles that a bending moment `P̃ₖ₋₁ EI/L` makes. On a uniform link they span the
/// polynomials; their derivatives are orthogonal, and only ψ₁ is not zero at the tip.
///
/// A joint without damping of its own turns by its moment over its stiffness, `ψₖ(0) = M(0)/k`. One
/// with it has an unknown of its own, `ψ₁ = 1`, in place of the highest polynomial.
pub(super) struct Basis<const N: usize, const P: usize, const S: usize> {
    /// `ψₖ` at the points.
    pub shapes: [[f64; N]; P],
    /// `ψₖ(0)` and `ψₖ(1)`.
    pub root: [f64; N],
    pub tip: [f64; N],
    /// `∫₀¹ e ψᵢ'ψⱼ' dξ`.
    pub bending: SMatrix<f64, N, N>,
    /// Row s integrates values at the points from 0 to station s.
    pub running: [[f64; P]; S],
    /// The same to the tip.
    pub to_tip: [f64; P],
    /// Masses at the stations, kg.
    pub masses: [f64; S],
}

/// A stretch of the link with one smooth law of stiffness and mass.
struct Piece {
    begin: f64,
    length: f64,
    rule: Rule,
}

/// Gauss's rule with its running integrals on 0..1.
pub(in crate::reference) struct Rule {
    pub points: Vec<f64>,
    pub weights: Vec<f64>,
}

impl Rule {
    pub fn new(points: usize) -> Self {
        let degree = NonZeroUsize::new(points).expect("a piece has points");
        let mut pairs: Vec<(f64, f64)> =
            GaussLegendre::new(degree).iter().map(|&(x, w)| (0.5 * (1.0 + x), 0.5 * w)).collect();
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (points, weights) = pairs.into_iter().unzip();
        Self { points, weights }
    }

    /// Returns the weights of the integral from 0 to `x` of the interpolant
    /// `Σ (2k+1) P̃ₖ(ξ) Σ_q w_q P̃ₖ(ξ_q) f_q`: discrete orthogonality.
    pub fn running(&self, x: f64) -> Vec<f64> {
        let integrals = integrals(x, self.points.len());
        self.interpolated(&integrals)
    }

    /// Returns the weights of the interpolant's value at `x`.
    fn at(&self, x: f64) -> Vec<f64> {
        self.interpolated(&legendre(x, self.points.len()))
    }

    fn interpolated(&self, of: &[f64]) -> Vec<f64> {
        let n = self.points.len();
        let weight = |q: usize| -> f64 {
            let values = legendre(self.points[q], n);
            let sum: f64 = (0..n).map(|k| (2 * k + 1) as f64 * values[k] * of[k]).sum();
            self.weights[q] * sum
        };
        (0..n).map(weight).collect()
    }
}

impl<const N: usize, const P: usize, const S: usize> Basis<N, P, S> {
    /// Returns the basis of the scene's link with as many points as it has.
    pub fn new(scene: &Scene) -> Self {
        let shape = (!scene.shape.is_uniform()).then_some(&scene.shape);
        let pieces = pieces(shape, P);
        let soft = |xi: f64| shape.map_or(1.0, |shape| 1.0 / shape.stiffness(xi));
        let density = |xi: f64| shape.map_or(1.0, |shape| shape.density(xi));
        let link = &scene.link;
        let mut basis = Self {
            shapes: [[0.0; N]; P],
            root: [0.0; N],
            tip: [0.0; N],
            bending: SMatrix::zeros(),
            running: [[0.0; P]; S],
            to_tip: [0.0; P],
            masses: [0.0; S],
        };
        let own_unknown = scene.hub.stiffness.is_some() && scene.damping.joint > 0.0;
        let first = usize::from(own_unknown);
        // Values of P̃ₖ/e at the points.
        let mut curvature = [[0.0; N]; P];
        let mut row = [0.0; P];
        let mut p = 0;
        for piece in &pieces {
            let n = piece.rule.points.len();
            for q in 0..n {
                let xi = piece.begin + piece.rule.points[q] * piece.length;
                let values = legendre(xi, N);
                for k in first..N {
                    curvature[p + q][k] = values[k - first] * soft(xi);
                }
                let weight = piece.rule.weights[q] * piece.length;
                basis.masses[p + q] = link.mass * weight * density(xi);
                basis.running[p + q] = row;
                for (own, part) in basis.running[p + q][p..]
                    .iter_mut()
                    .zip(piece.rule.running(piece.rule.points[q]))
                {
                    *own = piece.length * part;
                }
                for i in first..N {
                    for j in first..N {
                        basis.bending[(i, j)] +=
                            weight * values[i - first] * values[j - first] * soft(xi);
                    }
                }
            }
            for q in 0..n {
                row[p + q] = piece.length * piece.rule.weights[q];
            }
            p += n;
            basis.mount(shape, piece.begin + piece.length, &row);
        }
        basis.to_tip = row;
        basis.add_payload(scene, pieces.last().expect("a link has pieces"));
        basis.integrate(&curvature);
        basis.hinge(scene, own_unknown);
        basis
    }

    /// Puts the masses that are mounted at `xi` on stations behind the points'.
    fn mount(&mut self, shape: Option<&Varied>, xi: f64, row: &[f64; P]) {
        let masses = shape.into_iter().flat_map(Varied::masses).enumerate();
        for (i, own) in masses.filter(|(_, own)| (own.position - xi).abs() < CLOSE) {
            self.running[P + i] = *row;
            self.masses[P + i] = own.mass;
        }
    }

    /// Puts the payload's centre, `d` beyond the tip, on the last station.
    fn add_payload(&mut self, scene: &Scene, last: &Piece) {
        let offset = scene.payload.offset / scene.link.length;
        let end = last.rule.at(1.0);
        let mut row = self.to_tip;
        for (own, end) in row[P - end.len()..].iter_mut().zip(&end) {
            *own += offset * end;
        }
        self.running[S - 1] = row;
        self.masses[S - 1] = scene.payload.mass;
    }

    /// Integrates the curvatures to angles.
    fn integrate(&mut self, curvature: &[[f64; N]; P]) {
        let sum = |row: &[f64; P]| -> [f64; N] {
            std::array::from_fn(|k| (0..P).map(|q| row[q] * curvature[q][k]).sum())
        };
        for p in 0..P {
            self.shapes[p] = sum(&self.running[p]);
        }
        self.tip = sum(&self.to_tip);
    }

    /// Lets the root turn.
    fn hinge(&mut self, scene: &Scene, own_unknown: bool) {
        let Some(stiffness) = scene.hub.stiffness else { return };
        let give = scene.link.bending_stiffness / scene.link.length / stiffness;
        self.root = std::array::from_fn(|k| match (own_unknown, k) {
            (true, 0) => 1.0,
            (true, _) => 0.0,
            // P̃ₖ(0) = ±1.
            (false, k) => give * if k % 2 == 0 { 1.0 } else { -1.0 },
        });
        for row in self.shapes.iter_mut().chain([&mut self.tip]) {
            for (own, root) in row.iter_mut().zip(&self.root) {
                *own += root;
            }
        }
    }
}

/// Distance below which two places on the link are one, fraction of L.
const CLOSE: f64 = 1e-12;

/// Cuts the link at the borders of its sections and at its masses, and shares the points among the
/// pieces: evenly, what is left to the longest.
fn pieces(shape: Option<&Varied>, points: usize) -> Vec<Piece> {
    let mut borders = vec![0.0, 1.0];
    if let Some(shape) = shape {
        borders.extend(shape.borders());
        borders.extend(shape.masses().map(|own| own.position));
    }
    borders.sort_by(f64::total_cmp);
    borders.dedup_by(|b, a| *b - *a < CLOSE);
    let stretches: Vec<(f64, f64)> = borders.windows(2).map(|w| (w[0], w[1] - w[0])).collect();
    let each = points / stretches.len();
    let mut counts = vec![each; stretches.len()];
    for _ in 0..points - each * stretches.len() {
        let share = |i: usize| stretches[i].1 / counts[i] as f64;
        let most = (0..counts.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)));
        counts[most.expect("a piece")] += 1;
    }
    let piece = |(&(begin, length), &count): (&(f64, f64), &usize)| Piece {
        begin,
        length,
        rule: Rule::new(count),
    };
    stretches.iter().zip(&counts).map(piece).collect()
}

/// Returns `P̃₀..P̃ₙ` at ξ, by the three-term recurrence.
fn legendre(x: f64, n: usize) -> Vec<f64> {
    let u = 2.0 * x - 1.0;
    let mut p = vec![1.0; n + 1];
    for k in 0..n {
        let m = k as f64;
        let before = if k > 0 { p[k - 1] } else { 0.0 };
        p[k + 1] = ((2.0 * m + 1.0) * u * p[k] - m * before) / (m + 1.0);
    }
    p
}

/// Returns `∫₀^ξ P̃ₖ = (P̃ₖ₊₁ − P̃ₖ₋₁) / (2(2k + 1))`, k below n, and ξ for k = 0.
pub(in crate::reference) fn integrals(x: f64, n: usize) -> Vec<f64> {
    let p = legendre(x, n);
    let of = |k: usize| match k {
        0 => x,
        _ => (p[k + 1] - p[k - 1]) / (2 * (2 * k + 1)) as f64,
    };
    (0..n).map(of).collect()
}

#[cfg(test)]
mod tests {
    use stillbeam::scene::{PointMass, Section};
    use stillbeam::{Link, Scene};

    use super::*;

    #[test]
    fn running_integrals_are_exact() {
        let rule = Rule::new(POINTS);
        for &x in rule.points.iter().chain([&1.0]) {
            let sum: f64 =
                rule.running(x).iter().zip(&rule.points).map(|(w, x)| w * x.powi(3).exp()).sum();
            // ∫ exp(x³) by its series.
            let mut exact = 0.0;
            let mut factorial = 1.0;
            for n in 0..20 {
                exact += x.powi(3 * n + 1) / (factorial * f64::from(3 * n + 1));
                factorial *= f64::from(n + 1);
            }
            assert!((sum - exact).abs() < 1e-9, "{x}: {sum} against {exact}");
        }
    }

    #[test]
    fn shapes_vanish_at_the_clamp_and_at_the_tip_but_for_the_first() {
        assert_eq!(integrals(0.0, 7)[0], 0.0);
        assert!(integrals(0.0, 7)[1..].iter().all(|psi| psi.abs() < 1e-15));
        assert!(integrals(1.0, 7)[1..].iter().all(|psi| psi.abs() < 1e-15));
        let scene = Scene::new(Link { length: 1.0, mass: 1.0, bending_stiffness: 1.0 });
        let tip = Basis::<7, POINTS, STATIONS>::new(&scene).tip;
        assert!((tip[0] - 1.0).abs() < 1e-14);
        assert!(tip[1..].iter().all(|psi| psi.abs() < 1e-14), "{tip:?}");
    }

    /// Every mass of a link with sections and mounted masses is on a station, at its place.
    #[test]
    fn stations_carry_the_link() {
        let section = |l, ei, rho| Section::linear(l, ei, rho).expect("a section");
        let mut scene = Scene::of_sections(&[
            section(0.1, [5.0, 5.0], [0.4, 0.4]),
            section(0.25, [1.0, 0.4], [0.2, 0.1]),
        ])
        .expect("an arm");
        scene.payload.mass = 0.02;
        for (position, mass) in [(0.1, 0.03), (0.2, 0.01), (0.35, 0.002)] {
            scene = scene.with_mass(PointMass { position, mass }).expect("room");
        }
        let basis = Basis::<7, VARIED_POINTS, VARIED_STATIONS>::new(&scene);
        let (mut mass, mut second) = (0.0, 0.0);
        for (row, m) in basis.running.iter().zip(&basis.masses) {
            let x: f64 = row.iter().sum::<f64>() * scene.link.length;
            mass += m;
            second += m * x * x;
        }
        let [all, _, moment] = scene.link_moments();
        assert!((mass / (all + 0.02) - 1.0).abs() < 1e-12, "{mass}");
        assert!((second / (moment + 0.02 * 0.35 * 0.35) - 1.0).abs() < 1e-12, "{second}");
    }
}
