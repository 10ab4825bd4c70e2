//! The exact step of one damped oscillator: matrix exponential and φ-functions of a 2 × 2 matrix.

use super::{Each, array};

/// A 2 × 2 matrix, row-wise.
pub(crate) type Matrix2 = [[f64; 2]; 2];

/// Terms of the Taylor series at norm ½: the last is below 1e-20 of the sum.
const TERMS: u32 = 16;

const IDENTITY: Matrix2 = [[1.0, 0.0], [0.0, 1.0]];

/// `φ₀(Z) … φ₄(Z)` with `φ₀ = exp Z`, `φ_{k+1} = (φₖ − 1/k!) Z⁻¹`.
///
/// Taylor series of `Z/2ᵐ` with norm below ½, then `m` doublings,
/// `φₖ(2Z) = 2⁻ᵏ [φ₀φₖ + Σⱼ₌₁ᵏ φⱼ/(k−j)!]`: no cancellation for small `Z`, no inverse.
/// Error: relative 1e-14 up to a norm of 100. Source: Higham, Functions of Matrices, 10.7.4.
pub(crate) fn phi_functions(z: &Matrix2) -> [Matrix2; 5] {
    let mut norm = z.iter().map(|row| row[0].abs() + row[1].abs()).fold(0.0, f64::max);
    let (mut doublings, mut scale) = (0, 1.0);
    while norm > 0.5 {
        (norm, scale, doublings) = (0.5 * norm, 0.5 * scale, doublings + 1);
    }
    let z = scaled(scale, z);
    let mut phi = [0, 1, 2, 3, 4].each(|k| series(&z, k));
    for _ in 0..doublings {
        let [p0, p1, p2, p3, p4] = phi;
        phi = [
            product(&p0, &p0),
            scaled(0.5, &sum(&[product(&p0, &p1), p1])),
            scaled(0.25, &sum(&[product(&p0, &p2), p2, p1])),
            scaled(0.125, &sum(&[product(&p0, &p3), p3, p2, scaled(0.5, &p1)])),
            scaled(
                0.0625,
                &sum(&[product(&p0, &p4), p4, p3, scaled(0.5, &p2), scaled(1.0 / 6.0, &p1)]),
            ),
        ];
    }
    phi
}

/// `φₖ(Z) = Σₙ Zⁿ/(n+k)!` for a small `Z`.
fn series(z: &Matrix2, k: u32) -> Matrix2 {
    let mut factorial: f64 = (1..=k).map(f64::from).product();
    let mut power = IDENTITY;
    let mut phi = scaled(1.0 / factorial, &power);
    for n in 1..TERMS {
        factorial *= f64::from(n + k);
        power = product(&power, z);
        phi = sum(&[phi, scaled(1.0 / factorial, &power)]);
    }
    phi
}

/// `a b`.
pub(crate) fn product(a: &Matrix2, b: &Matrix2) -> Matrix2 {
    array(|i| array(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

fn sum<const N: usize>(terms: &[Matrix2; N]) -> Matrix2 {
    array(|i| array(|j| terms.iter().map(|term| term[i][j]).sum()))
}

fn scaled(s: f64, a: &Matrix2) -> Matrix2 {
    a.each(|row| row.each(|x| s * x))
}

#[cfg(test)]
mod tests {
    use super::{phi_functions, product};

    /// The matrix exponential of a rotation by `angle` is cosine and sine of it, small and large.
    #[test]
    fn the_exponential_of_a_rotation_is_its_cosine_and_sine() {
        for angle in [1e-6, 0.3, 2.0, 50.0] {
            let [exponential, ..] = phi_functions(&[[0.0, angle], [-angle, 0.0]]);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            for (found, expected) in exponential.iter().flatten().zip([cos, sin, -sin, cos]) {
                assert!((found - expected).abs() < 1e-13, "{angle}: {found} is not {expected}");
            }
        }
    }

    /// `Z φₖ₊₁ = φₖ − 1/k!`, the definition, for a damped oscillator.
    #[test]
    fn each_function_is_the_one_before_less_its_first_term() {
        let z = [[0.0, 1.0], [-4.0, -0.5]];
        let phi = phi_functions(&z);
        let mut factorial = 1.0;
        for k in 0..4 {
            factorial *= if k == 0 { 1.0 } else { k as f64 };
            let left = product(&z, &phi[k + 1]);
            for i in 0..2 {
                for j in 0..2 {
                    let identity = if i == j { 1.0 / factorial } else { 0.0 };
                    let right = phi[k][i][j] - identity;
                    assert!((left[i][j] - right).abs() < 1e-14, "φ{k} [{i}][{j}]");
                }
            }
        }
    }
}
