//! Matrices of one cubic Bernoulli-Euler element, degrees of freedom `w₁ φ₁ w₂ φ₂`.

/// A 4 × 4 element matrix.
pub(crate) type Matrix = [[f64; 4]; 4];

/// Bending stiffness, `EI/ℓ³ [12 6ℓ −12 6ℓ; …]`. `ei` in N m², `l` in m.
pub(crate) fn stiffness(ei: f64, l: f64) -> Matrix {
    let c = ei / (l * l * l);
    let (a, b, d, e) = (12.0 * c, 6.0 * l * c, 4.0 * l * l * c, 2.0 * l * l * c);
    [[a, b, -a, b], [b, d, -b, e], [-a, -b, a, -b], [b, e, -b, d]]
}

/// Consistent mass, `ρAℓ/420 [156 22ℓ 54 −13ℓ; …]`. `rho_a` in kg/m, `l` in m.
pub(crate) fn consistent_mass(rho_a: f64, l: f64) -> Matrix {
    let c = rho_a * l / 420.0;
    let (a, b, d, e) = (156.0 * c, 22.0 * l * c, 54.0 * c, 13.0 * l * c);
    let (f, g) = (4.0 * l * l * c, 3.0 * l * l * c);
    [[a, b, d, -e], [b, f, e, -g], [d, e, a, -b], [-e, -g, -b, f]]
}

/// Lumped mass, `ρAℓ/2 diag(1, 0, 1, 0)`: half the element at each end, rotations massless.
pub(crate) fn lumped_mass(rho_a: f64, l: f64) -> Matrix {
    let half = 0.5 * rho_a * l;
    [[half, 0.0, 0.0, 0.0], [0.0; 4], [0.0, 0.0, half, 0.0], [0.0; 4]]
}

/// `∫ P(ξ) N'N'ᵀ dx` over an element of length `l`, for an axial force `P = p₀ + p₁ξ + p₂ξ²` with
/// `ξ = x/ℓ ∈ 0..1`; unit axial force gives the foreshortening matrix. Exact, in closed form.
#[inline(never)]
pub(crate) fn axial(l: f64, [p0, p1, p2]: [f64; 3]) -> Matrix {
    let a = (1.2 * p0 + 0.6 * p1 + 12.0 / 35.0 * p2) / l;
    let b = 0.1 * (p0 + p1) + p2 / 14.0;
    let c = 0.1 * p0 - p2 / 35.0;
    let d = l * (2.0 / 15.0 * p0 + p1 / 30.0 + 2.0 / 105.0 * p2);
    let e = -l * (p0 / 30.0 + p1 / 60.0 + p2 / 70.0);
    let f = l * (2.0 / 15.0 * p0 + 0.1 * p1 + 3.0 / 35.0 * p2);
    [[a, b, -a, c], [b, d, -b, e], [-a, -b, a, -c], [c, e, -c, f]]
}
