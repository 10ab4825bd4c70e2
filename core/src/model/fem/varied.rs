//! One element of a link whose stiffness and mass vary along it.
//!
//! Its shape functions are the exact static ones: between its ends the bending moment is a straight
//! line, `EI w'' = a + b y`. An element of any sections is then exact under loads at its ends, and
//! borders of sections may lie anywhere in it. For a uniform link they are the cubic ones.

use super::element::Matrix;
use crate::math::{Scalar, array, dot};
use crate::scene::{LinkShape, Point, Scene, Varied};

/// Matrices of an element, degrees of freedom `w₁ φ₁ w₂ φ₂`.
#[derive(Clone, Copy)]
pub(super) struct VariedElement {
    pub stiffness: Matrix<f64>,
    pub mass: Matrix<f64>,
    /// `∫ P N'N'ᵀ dx` of the axial force per θ̇², per g along the link, and of a unit force.
    pub centrifugal: Matrix<f64>,
    pub hanging: Matrix<f64>,
    pub shortening: Matrix<f64>,
}

/// The link in SI units, and what sits beyond its tip.
pub(super) struct Beam<'a> {
    shape: &'a Varied,
    /// L (m), m (kg), EI (N m²) of the link, and r (m).
    length: f64,
    mass: f64,
    stiffness: f64,
    radius: f64,
    /// m_p (kg), and its first moment about the axis, kg m.
    payload: [f64; 2],
}

/// `∫ yᵏ/EI dy` from the element's beginning, k = 0, 1, 2.
type Compliance = [f64; 3];

/// Where an element begins, m from the clamp, its length, m, and `a` and `b` of its moment by the
/// degrees of freedom.
struct Span {
    begin: f64,
    length: f64,
    a: [f64; 4],
    b: [f64; 4],
}

impl<'a> Beam<'a> {
    /// The link of a scene, if it is not a uniform one.
    pub(super) fn of<T: Scalar, S: LinkShape>(scene: &'a Scene<T, S>) -> Option<Self> {
        let (link, mass) = (scene.link, scene.payload.mass.to_f64());
        Some(Self {
            shape: scene.shape.varied()?,
            length: link.length.to_f64(),
            mass: link.mass.to_f64(),
            stiffness: link.bending_stiffness.to_f64(),
            radius: scene.hub.radius.to_f64(),
            payload: [mass, mass * scene.payload_reach().to_f64()],
        })
    }

    /// Element number `e` of `count` equal ones. With `lumped`, its mass is shared between its ends
    /// by the lever rule and rotations are massless.
    pub(super) fn element(&self, e: usize, count: usize, lumped: bool) -> VariedElement {
        let length = self.length / count as f64;
        let begin = e as f64 * length;
        let [a0, a1, a2] = self.compliance(begin, begin + length);
        // φ₂ − φ₁ = a A₀ + b A₁ and w₂ − w₁ − ℓφ₁ = a (ℓA₀ − A₁) + b (ℓA₁ − A₂).
        let determinant = a1 * a1 - a0 * a2;
        let (turn, lift) = ([0.0, -1.0, 0.0, 1.0], [-1.0, -length, 1.0, 0.0]);
        let (along, across) = (length * a0 - a1, length * a1 - a2);
        let pair = |i: usize| (across * turn[i] - a1 * lift[i], a0 * lift[i] - along * turn[i]);
        let span = Span {
            begin,
            length,
            a: array(|i| pair(i).0 / determinant),
            b: array(|i| pair(i).1 / determinant),
        };
        let (a, b) = (&span.a, &span.b);
        let zero = [[0.0; 4]; 4];
        let mut element = VariedElement {
            stiffness: array(|i| {
                // ∫ (a + b y)²/EI dy.
                let moment = [a0 * a[i] + a1 * b[i], a1 * a[i] + a2 * b[i]];
                array(|j| moment[0] * a[j] + moment[1] * b[j])
            }),
            mass: zero,
            centrifugal: zero,
            hanging: zero,
            shortening: zero,
        };
        self.shape.each_piece(begin / self.length, (begin + length) / self.length, |piece| {
            for point in piece.points() {
                self.gather(&mut element, &span, &point, lumped);
            }
        });
        for mounted in self.shape.masses() {
            // Counted from 1 at the clamp, so that a mass on a border is the inner element's.
            let owner = libm::ceil(mounted.position * count as f64 - 1e-9).max(1.0) as usize;
            if owner == e + 1 {
                let at = mounted.position * self.length - begin;
                add_mass(&mut element.mass, &self.carried(&span, at, lumped), mounted.mass);
            }
        }
        element
    }

    /// Adds one point of the quadrature.
    fn gather(&self, element: &mut VariedElement, span: &Span, point: &Point, lumped: bool) {
        let at = point.xi * self.length - span.begin;
        let weight = point.weight * self.length;
        let mass = point.weight * self.mass * point.density;
        add_mass(&mut element.mass, &self.carried(span, at, lumped), mass);
        let [beyond, moment, _] = self.shape.mass_beyond(point.xi, self.mass, self.length);
        let hanging = beyond + self.payload[0];
        let centrifugal = beyond * self.radius + moment + self.payload[1];
        let (_, slope) = self.shapes(span, at);
        for i in 0..4 {
            for j in 0..4 {
                let product = weight * slope[i] * slope[j];
                element.centrifugal[i][j] += centrifugal * product;
                element.hanging[i][j] += hanging * product;
                element.shortening[i][j] += product;
            }
        }
    }

    /// `w` at `y` by the degrees of freedom, for the mass matrix: of lumped masses, the lever rule.
    fn carried(&self, span: &Span, y: f64, lumped: bool) -> Carried {
        if lumped {
            let far = y / span.length;
            Carried::Lever([1.0 - far, far])
        } else {
            Carried::Shape(self.shapes(span, y).0)
        }
    }

    /// `w` and `w'` at `y` from the element's beginning, by the degrees of freedom.
    fn shapes(&self, span: &Span, y: f64) -> ([f64; 4], [f64; 4]) {
        let [a0, a1, a2] = self.compliance(span.begin, span.begin + y);
        let (first, turned) = ([1.0, y, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]);
        (
            array(|i| first[i] + dot(&[y * a0 - a1, y * a1 - a2], &[span.a[i], span.b[i]])),
            array(|i| turned[i] + dot(&[a0, a1], &[span.a[i], span.b[i]])),
        )
    }

    /// `∫ yᵏ/EI dy` between two places, m from the clamp; `y` from the first.
    fn compliance(&self, from: f64, to: f64) -> Compliance {
        let mut sum = [0.0; 3];
        self.shape.each_piece(from / self.length, to / self.length, |piece| {
            for point in piece.points() {
                let y = point.xi * self.length - from;
                let soft = point.weight * self.length / (self.stiffness * point.stiffness);
                for (sum, power) in sum.iter_mut().zip([1.0, y, y * y]) {
                    *sum += soft * power;
                }
            }
        });
        sum
    }
}

/// How a mass inside the element hangs on its ends.
enum Carried {
    Shape([f64; 4]),
    Lever([f64; 2]),
}

fn add_mass(matrix: &mut Matrix<f64>, carried: &Carried, mass: f64) {
    match carried {
        Carried::Shape(n) => {
            for i in 0..4 {
                for j in 0..4 {
                    matrix[i][j] += mass * n[i] * n[j];
                }
            }
        }
        Carried::Lever([near, far]) => {
            matrix[0][0] += mass * near;
            matrix[2][2] += mass * far;
        }
    }
}
