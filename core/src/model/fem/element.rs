//! Matrices of one cubic Bernoulli-Euler element, degrees of freedom `w₁ φ₁ w₂ φ₂`.

use crate::math::Scalar;

/// A 4 × 4 element matrix.
pub(crate) type Matrix<T> = [[T; 4]; 4];

/// Bending stiffness, `EI/ℓ³ [12 6ℓ −12 6ℓ; …]`. `ei` in N m², `l` in m.
pub(crate) fn stiffness<T: Scalar>(ei: T, l: T) -> Matrix<T> {
    let f = T::from_f64;
    let c = f(2.0) * ei / (l * l * l);
    let e = c * l * l;
    let (a, b, d) = (f(6.0) * c, f(3.0) * l * c, f(2.0) * e);
    [[a, b, -a, b], [b, d, -b, e], [-a, -b, a, -b], [b, e, -b, d]]
}

/// Consistent mass, `ρAℓ/420 [156 22ℓ 54 −13ℓ; …]`. `rho_a` in kg/m, `l` in m.
pub(crate) fn consistent_mass<T: Scalar>(rho_a: T, l: T) -> Matrix<T> {
    let n = T::from_f64;
    let c = rho_a * l / n(420.0);
    let (cl, cll) = (c * l, c * l * l);
    let (a, b, d, e) = (n(156.0) * c, n(22.0) * cl, n(54.0) * c, n(13.0) * cl);
    let (f, g) = (n(4.0) * cll, n(3.0) * cll);
    [[a, b, d, -e], [b, f, e, -g], [d, e, a, -b], [-e, -g, -b, f]]
}

/// Lumped mass, `ρAℓ/2 diag(1, 0, 1, 0)`: half the element at each end, rotations massless.
pub(crate) fn lumped_mass<T: Scalar>(rho_a: T, l: T) -> Matrix<T> {
    let (half, o) = (T::HALF * rho_a * l, T::ZERO);
    [[half, o, o, o], [o; 4], [o, o, half, o], [o; 4]]
}

/// `∫ P(ξ) N'N'ᵀ dx` over an element of length `l`, for an axial force `P = p₀ + p₁ξ + p₂ξ²` with
/// `ξ = x/ℓ ∈ 0..1`; unit axial force gives the foreshortening matrix. Exact, in closed form.
pub(crate) fn axial<T: Scalar>(l: T, [p0, p1, p2]: [T; 3]) -> Matrix<T> {
    let n = T::from_f64;
    let a = (n(1.2) * p0 + n(0.6) * p1 + n(12.0 / 35.0) * p2) / l;
    let b = n(0.1) * (p0 + p1) + n(1.0 / 14.0) * p2;
    let c = n(0.1) * p0 - n(1.0 / 35.0) * p2;
    let d = l * (n(2.0 / 15.0) * p0 + n(1.0 / 30.0) * p1 + n(2.0 / 105.0) * p2);
    let e = -l * (n(1.0 / 30.0) * p0 + n(1.0 / 60.0) * p1 + n(1.0 / 70.0) * p2);
    let f = l * (n(2.0 / 15.0) * p0 + n(0.1) * p1 + n(3.0 / 35.0) * p2);
    [[a, b, -a, c], [b, d, -b, e], [-a, -b, a, -c], [c, e, -c, f]]
}
