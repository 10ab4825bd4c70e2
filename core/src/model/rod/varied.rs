//! A link whose stiffness and mass vary along it, for the rod.
//!
//! Unknowns are the coefficients of the bending moment, polynomials in `x`: the angles
//! `φⱼ = ∫P_j/e dξ`, `e` being `EI` over the link's, have the kinks that the sections give them.
//! Integrals over the link go by values at eight points, as on a uniform one. They
//! lie at Gauss's places in `s = ∫dξ/e`, in which the angle changes evenly. Between them values are
//! interpolated in the space of a constant, the angles, and higher polynomials in `s`: in it the
//! linear arm is exact.

use super::POINTS;
use super::basis::Basis;
use super::polynomials::{RUNNING, legendre, rule};
use super::stations::{LINK_STATIONS, Stations};
use crate::math::{Band, Each, array, dot, sqrt};
use crate::scene::{Piece, Varied};

/// Parts that the link is cut into at least, so that Gauss's rule is exact for steep tapers.
const PARTS: u32 = 8;

/// Halvings in search of a point: to a rounding.
const HALVINGS: u32 = 60;

/// Integrals from the clamp to one place.
#[derive(Clone, Copy)]
struct Progress<const N: usize> {
    /// `∫dξ/e`.
    soft: f64,
    /// `φⱼ`.
    angle: [f64; N],
}

impl<const N: usize> Progress<N> {
    const CLAMP: Self = Self { soft: 0.0, angle: [0.0; N] };

    /// The integrals at the end of a piece that begins here.
    fn after(&self, piece: &Piece) -> Self {
        let mut sum = *self;
        for point in piece.points() {
            let soft = point.weight / point.stiffness;
            let p = legendre::<N>(point.xi);
            sum.soft += soft;
            for j in 0..N {
                sum.angle[j] += soft * p[j];
            }
        }
        sum
    }

    /// The functions of the space, `soft` being that of the whole link.
    fn space(&self, soft: f64) -> [f64; POINTS] {
        let p = legendre::<POINTS>(self.soft / soft);
        array(|m| match m {
            0 => 1.0,
            m if m <= N => self.angle[m - 1],
            m => p[m],
        })
    }
}

/// A link, its angle in `N` unknowns.
pub(super) struct VariedLink<'a, const N: usize> {
    shape: &'a Varied,
    /// Mass of the sections, and of the mounted masses too, kg.
    mass: [f64; 2],
    /// At the tip.
    whole: Progress<N>,
    /// The angles at the points.
    at_points: [[f64; N]; POINTS],
    /// Coefficients in the space by values at the points: rows are functions.
    inverse: [[f64; POINTS]; POINTS],
}

impl<'a, const N: usize> VariedLink<'a, N> {
    /// `mass` of the sections in kg.
    pub fn new(shape: &'a Varied, mass: f64) -> Self {
        const { assert!(N < POINTS, "the angles and a constant are of the space") }
        let mut whole = Progress::CLAMP;
        each_piece(shape, |piece| whole = whole.after(piece));
        let at = rule().0.map(|s| place(shape, s * whole.soft));
        let mounted: f64 = shape.masses().map(|own| own.mass).sum();
        Self {
            shape,
            mass: [mass, mass + mounted],
            at_points: at.map(|at: Progress<N>| at.angle),
            inverse: inverse(at.map(|at| at.space(whole.soft))),
            whole,
        }
    }

    pub fn basis(&self, offset: f64) -> Basis<N> {
        let mut bending = Band::ZERO;
        each_piece(self.shape, |piece| {
            for point in piece.points() {
                let p = legendre::<N>(point.xi);
                for i in 0..N {
                    for j in 0..=i {
                        bending.add(i, j, point.weight / point.stiffness * p[i] * p[j]);
                    }
                }
            }
        });
        Basis {
            at_points: self.at_points,
            root: [0.0; N],
            tip: self.whole.angle,
            bending,
            stations: self.stations().with_payload(offset, &self.end()),
        }
    }

    /// Takes the values at the points to the tip.
    fn end(&self) -> [f64; POINTS] {
        self.by_points(&self.whole.space(self.whole.soft))
    }

    /// Fewer points, at those shares of `s`, that interpolate in the space of a constant and the
    /// first `M − 1` angles: takes the values at the eight points to them, and back.
    pub fn coarse<const M: usize>(
        &self,
        shares: &[f64; M],
    ) -> ([[f64; POINTS]; M], [[f64; M]; POINTS]) {
        const { assert!(M <= N + 1, "a constant and the angles") }
        let at = shares.map(|share| place::<N>(self.shape, share * self.whole.soft));
        let space =
            |angle: &[f64; N]| -> [f64; M] { array(|m| if m == 0 { 1.0 } else { angle[m - 1] }) };
        let inverse = inverse(at.map(|at| space(&at.angle)));
        let back = self.at_points.map(|angle| {
            let functions = space(&angle);
            array(|p| (0..M).map(|m| functions[m] * inverse[m][p]).sum())
        });
        (at.map(|at| self.by_points(&at.space(self.whole.soft))), back)
    }

    /// Weights of the values at the points, from those of the functions of the space.
    fn by_points(&self, functions: &[f64; POINTS]) -> [f64; POINTS] {
        array(|p| (0..POINTS).map(|m| functions[m] * self.inverse[m][p]).sum())
    }

    /// Stations with the same integrals of two of `1, ∫v₁, …` over the mass as the link itself.
    ///
    /// With `G = BBᵀ` those integrals, `B` a triangle, and `H` the reflection that takes the first
    /// axis to `(⅓, …, ⅓)`, the columns of `3BH` begin with 1 and are the stations, each with a
    /// ninth of the mass.
    fn stations(&self) -> Stations {
        let (gram, to_tip) = self.gram();
        let b = triangle(&gram);
        let third = 1.0 / sqrt(LINK_STATIONS as f64);
        // v = e₀ − u, and 2/vᵀv = 1/(1 − u₀).
        let v: [f64; LINK_STATIONS] = array(|s| if s == 0 { 1.0 - third } else { -third });
        let reflected = b.map(|row| {
            let along = dot(&row, &v) / (1.0 - third);
            array::<f64, LINK_STATIONS, _>(|s| row[s] - along * v[s])
        });
        Stations {
            mass: self.mass[1],
            weights: [third * third; LINK_STATIONS],
            running: array(|s| self.by_points(&array(|m| reflected[m + 1][s] / third))),
            to_tip: self.by_points(&to_tip),
            to_payload: [0.0; POINTS],
        }
    }

    /// Integrals over the mass of two of `1, ∫v₁, …`, the whole mass being 1; and `∫v` to the tip.
    fn gram(&self) -> ([[f64; LINK_STATIONS]; LINK_STATIONS], [f64; POINTS]) {
        let (points, weights) = rule();
        let mut gram = [[0.0; LINK_STATIONS]; LINK_STATIONS];
        let mut add = |integral: &[f64; POINTS], mass: f64| {
            let f = |i: usize| if i == 0 { 1.0 } else { integral[i - 1] };
            for (i, row) in gram.iter_mut().enumerate() {
                for (j, sum) in row.iter_mut().enumerate() {
                    *sum += mass * f(i) * f(j);
                }
            }
        };
        let [sections, all] = self.mass;
        let mut begin = [0.0; POINTS];
        let mut at = Progress::<N>::CLAMP;
        // Masses beyond one place up to another.
        let mounted = |from: f64, to: f64| -> f64 {
            let inside =
                self.shape.masses().filter(|own| from < own.position && own.position <= to);
            inside.map(|own| own.mass / all).sum()
        };
        add(&begin, mounted(-1.0, 0.0));
        let mut done = 0.0;
        each_piece(self.shape, |piece| {
            let values: [[f64; POINTS]; POINTS] =
                array(|p| at.after(&piece.first(points[p])).space(self.whole.soft));
            let length = piece.length();
            let integral = |row: &[f64; POINTS]| -> [f64; POINTS] {
                array(|m| {
                    begin[m] + length * (0..POINTS).map(|p| row[p] * values[p][m]).sum::<f64>()
                })
            };
            for (row, point) in RUNNING.iter().zip(piece.points()) {
                add(&integral(row), point.weight * point.density * sections / all);
            }
            begin = integral(&weights);
            add(&begin, mounted(done, piece.end()));
            done = piece.end();
            at = at.after(piece);
        });
        // At the tip itself, which the sections' lengths meet to a rounding.
        add(&begin, mounted(done, 2.0));
        (gram, begin)
    }
}

/// Calls `f` with the pieces of the whole link.
fn each_piece(shape: &Varied, mut f: impl FnMut(&Piece)) {
    for part in 0..PARTS {
        let border = |part: u32| f64::from(part) / f64::from(PARTS);
        shape.each_piece(border(part), border(part + 1), &mut f);
    }
}

/// Finds the place where `∫dξ/e` is `soft`.
fn place<const N: usize>(shape: &Varied, soft: f64) -> Progress<N> {
    let mut found = None;
    let mut at = Progress::<N>::CLAMP;
    each_piece(shape, |piece| {
        let end = at.after(piece);
        if found.is_none() && end.soft >= soft {
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if at.after(&piece.first(middle)).soft < soft {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            found = Some(at.after(&piece.first(high)));
        }
        at = end;
    });
    found.unwrap_or(at)
}

/// The inverse of a matrix of full rank, by elimination with the largest pivot of each column.
fn inverse<const N: usize>(mut a: [[f64; N]; N]) -> [[f64; N]; N] {
    let mut inverse: [[f64; N]; N] = array(|i| array(|j| if i == j { 1.0 } else { 0.0 }));
    for column in 0..N {
        let mut pivot = column;
        for row in column..N {
            if a[row][column].abs() > a[pivot][column].abs() {
                pivot = row;
            }
        }
        a.swap(column, pivot);
        inverse.swap(column, pivot);
        let scale = 1.0 / a[column][column];
        (a[column], inverse[column]) =
            (a[column].each(|x| scale * x), inverse[column].each(|x| scale * x));
        let (own, own_inverse) = (a[column], inverse[column]);
        for row in (0..N).filter(|&row| row != column) {
            let factor = a[row][column];
            for j in 0..N {
                a[row][j] -= factor * own[j];
                inverse[row][j] -= factor * own_inverse[j];
            }
        }
    }
    inverse
}

/// `B` of `BBᵀ = A`, a lower triangle. What rounding has left of a positive pivot is none.
pub(super) fn triangle<const N: usize>(a: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut b = [[0.0; N]; N];
    for j in 0..N {
        let left = a[j][j] - dot(&b[j], &b[j]);
        if left <= 1e-15 * a[j][j] {
            continue;
        }
        b[j][j] = sqrt(left);
        for i in j + 1..N {
            b[i][j] = (a[i][j] - dot(&b[i], &b[j])) / b[j][j];
        }
    }
    b
}
