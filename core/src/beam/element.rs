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

/// `∫ P(ξ) N'N'ᵀ dx` over an element of length `l`, for an axial force `p₀ + p₁ξ + p₂ξ²` with
/// `ξ = x/ℓ ∈ 0..1`; unit axial force gives the foreshortening matrix.
///
/// Four Gauss points: exact to degree 7, and `N'N'ᵀ` has degree 4.
#[inline(never)]
pub(crate) fn axial(l: f64, p: [f64; 3]) -> Matrix {
    const POINTS: [(f64, f64); 4] = [
        (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
        (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
        (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
        (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
    ];
    let mut sum = [[0.0; 4]; 4];
    for (xi, weight) in POINTS {
        let bend = 6.0 * xi * (xi - 1.0) / l;
        let slope = [bend, 1.0 + xi * (3.0 * xi - 4.0), -bend, xi * (3.0 * xi - 2.0)];
        let c = weight * l * (p[0] + xi * (p[1] + xi * p[2]));
        for i in 0..4 {
            for j in 0..4 {
                sum[i][j] += c * slope[i] * slope[j];
            }
        }
    }
    sum
}
