//! The exact step of one damped oscillator: matrix exponential and φ-functions of a 2 × 2 matrix.

use super::{Each, array};

/// A 2 × 2 matrix, row-wise.
pub(crate) type Matrix2 = [[f64; 2]; 2];

/// Terms of the Taylor series of `φ₄` at norm ½: what is left out is below 1e-18 of the sum.
const TERMS: usize = 14;

/// `1/n!`.
const INVERSE_FACTORIALS: [f64; TERMS + 4] = {
    let mut inverse = [1.0; TERMS + 4];
    let (mut n, mut factorial) = (1, 1.0);
    while n < TERMS + 4 {
        factorial *= n as f64;
        inverse[n] = 1.0 / factorial;
        n += 1;
    }
    inverse
};

/// A function of a matrix `Z`, `[a, b, d]` for `[[a, b z₀₁], [b z₁₀, d]]`: polynomials in `Z` and
/// their quotients all have this form.
pub(crate) type Function = [f64; 3];

/// The algebra of the functions of one matrix. They commute; a product takes six multiplications
/// in place of eight, and every sum three terms in place of four.
pub(crate) struct Functions {
    z: [f64; 2],
    off: [f64; 2],
    /// `z₀₁z₁₀`.
    cross: f64,
}

impl Functions {
    /// The functions of `z`.
    pub(crate) fn of(z: &Matrix2) -> Self {
        let [[a, b], [c, d]] = *z;
        Self { z: [a, d], off: [b, c], cross: b * c }
    }

    /// `f g`.
    pub(crate) fn product(&self, f: &Function, g: &Function) -> Function {
        let across = self.cross * (f[1] * g[1]);
        [f[0] * g[0] + across, f[0] * g[1] + f[1] * g[2], f[2] * g[2] + across]
    }

    /// `Z f`.
    pub(crate) fn by_z(&self, f: &Function) -> Function {
        let across = self.cross * f[1];
        [self.z[0] * f[0] + across, self.z[0] * f[1] + f[2], self.z[1] * f[2] + across]
    }

    /// `f⁻¹`.
    pub(crate) fn inverse(&self, f: &Function) -> Function {
        let [a, b, d] = *f;
        let scale = 1.0 / (a * d - self.cross * (b * b));
        [scale * d, -(scale * b), scale * a]
    }

    /// The matrix itself.
    pub(crate) fn matrix(&self, f: &Function) -> Matrix2 {
        [[f[0], f[1] * self.off[0]], [f[1] * self.off[1], f[2]]]
    }
}

/// `φ₀(Z) … φ₄(Z)` with `φ₀ = exp Z`, `φ_{k+1} = (φₖ − 1/k!) Z⁻¹`.
///
/// Taylor series of `φ₄` of `Z/2ᵐ` with norm below ½, from it the others, then `m` doublings,
/// `φₖ(2Z) = 2⁻ᵏ [φ₀φₖ + Σⱼ₌₁ᵏ φⱼ/(k−j)!]`: no cancellation for small `Z`, no inverse.
/// Error: relative 1e-14 up to a norm of 100. Source: Higham, Functions of Matrices, 10.7.4.
#[inline(never)]
pub(crate) fn phi_functions(z: &Matrix2) -> [Matrix2; 5] {
    let mut norm = z.iter().map(|row| row[0].abs() + row[1].abs()).fold(0.0, f64::max);
    let (mut doublings, mut scale) = (0, 1.0);
    while norm > 0.5 {
        (norm, scale, doublings) = (0.5 * norm, 0.5 * scale, doublings + 1);
    }
    let functions = Functions::of(&z.each(|row| row.each(|x| scale * x)));
    // Horner's rule: `(Z f + 1/n!)` again and again, at last for φ₃ to φ₀.
    let after = |f: &Function, n: usize| {
        let [a, b, d] = functions.by_z(f);
        [a + INVERSE_FACTORIALS[n], b, d + INVERSE_FACTORIALS[n]]
    };
    let mut phi = [[0.0; 3]; 5];
    let mut last = [0.0; 3];
    for n in (0..TERMS + 4).rev() {
        last = after(&last, n);
        if n < 5 {
            phi[n] = last;
        }
    }
    for _ in 0..doublings {
        phi = doubled(&functions, &phi);
    }
    phi.each(|f| functions.matrix(&f))
}

/// `φₖ(2Z)` from `φₖ(Z)`.
#[inline(never)]
fn doubled(functions: &Functions, phi: &[Function; 5]) -> [Function; 5] {
    let [[a, b, d], p1, p2, p3, _] = *phi;
    let more = [a + 1.0, b, d + 1.0];
    let half = p1.each(|x| 0.5 * x);
    let (third, fourth): (Function, Function) =
        (array(|i| p2[i] + half[i]), array(|i| p3[i] + (0.5 * p2[i] + 1.0 / 6.0 * p1[i])));
    let add = |k: usize, scale: f64, rest: &Function| -> Function {
        let product = functions.product(&more, &phi[k]);
        array(|i| scale * (product[i] + rest[i]))
    };
    [
        functions.product(&phi[0], &phi[0]),
        functions.product(&more, &half),
        add(2, 0.25, &p1),
        add(3, 0.125, &third),
        add(4, 0.0625, &fourth),
    ]
}

#[cfg(test)]
mod tests {
    use super::{Functions, Matrix2, array, phi_functions};

    /// `a b`.
    fn product(a: &Matrix2, b: &Matrix2) -> Matrix2 {
        array(|i| array(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
    }

    /// A damped mode's matrix squared and inverted by its algebra is itself.
    #[test]
    fn functions_of_a_matrix_are_matrices() {
        let z = [[0.25, 2.0], [-4.0, -0.5]];
        let functions = Functions::of(&z);
        let own = [z[0][0], 1.0, z[1][1]];
        let square = functions.matrix(&functions.product(&own, &own));
        assert_eq!(square, product(&z, &z));
        assert_eq!(functions.matrix(&functions.by_z(&own)), square);
        let one = product(&z, &functions.matrix(&functions.inverse(&own)));
        for (i, row) in one.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                let identity = if i == j { 1.0 } else { 0.0 };
                assert!((entry - identity).abs() < 1e-15, "[{i}][{j}]: {entry}");
            }
        }
    }

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
