//! Response of a mode to a kink of the motion inside a tick.

use super::oscillator::pulled_back;
use crate::math::{Each, Matrix2, Scalar, Words, array, phi_functions, product};
use crate::motion::{Kink, ORDERS};

/// Changes of a mode's state before a tick, one for each moment of a [`Kink`].
///
/// With `J` the part of θ̈ that jumps and its moments `mₖ`, a mode ends the tick as if it had been
/// driven by `J` itself, but for moments beyond the eighth. Nothing for modes that turn by more
/// than [`LARGEST_NORM`] in a tick or that the tick damps out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kicks<T>([[T; 2]; ORDERS]);

/// Largest norm of `hA` for which a jump's answer is told. A mode beyond turns ten times in a tick,
/// and answers to a jump by less than a sixtieth of what a mode at rest does.
const LARGEST_NORM: f64 = 60.0;

impl<T: Scalar> Kicks<T> {
    /// Computes the changes of the mode `ẏ = A y − (0, b θ̈)`, `A = [0, ω; −ω, −c]`, `c = α + βω²`,
    /// over steps of `h` s. The state is `(ωa, ȧ)`.
    pub(super) fn new(omega: f64, alpha: f64, beta: f64, b: f64, h: f64) -> Self {
        let z = [[0.0, omega * h], [-omega * h, -(alpha + beta * omega * omega) * h]];
        let [whole, ..] = phi_functions(&z);
        let answers = answers(&z);
        Self(array(|k| {
            let [a, p] = answers[k].each(|row| -b * h * (2 * k + 3) as f64 * row[1]);
            pulled_back(&whole, [a, p]).each(T::from_f64)
        }))
    }

    /// The same for a state that holds the rate times `scale`.
    pub(super) fn rates_by(self, scale: f64) -> Self {
        let scale = T::from_f64(scale);
        Self(self.0.each(|[a, p]| [a, scale * p]))
    }

    /// Returns the change to add to the state before the tick.
    pub(super) fn of(&self, kink: &Kink<T>) -> [T; 2] {
        let mut sum = [T::ZERO; 2];
        for (kick, moment) in self.0.iter().zip(kink.excess()) {
            for r in 0..2 {
                sum[r] += kick[r] * moment;
            }
        }
        sum
    }
}

/// `Gₖ = ∫₀¹ Pₖ(2s − 1) exp((1 − s)Z) ds` for `k = 1..8`.
///
/// Integrating by parts, `Z(Gₖ₊₁ − Gₖ₋₁) = 2(2k + 1)Gₖ`: a continued fraction for `Gₖ = RₖGₖ₋₁`,
/// `Rₖ = −(2(2k + 1) − Z Rₖ₊₁)⁻¹Z`, from where `Rₖ` is nothing down to `k = 1` (Miller's algorithm;
/// for a rotation these are spherical Bessel functions). Error: 1e-14.
fn answers(z: &Matrix2) -> [Matrix2; ORDERS] {
    let mut answers = [[[0.0; 2]; 2]; ORDERS];
    let norm = z[1][0].abs() + z[1][1].abs();
    if norm > LARGEST_NORM {
        return answers;
    }
    let mut ratio = [[0.0; 2]; 2];
    for k in (1..=ORDERS + 24 + norm as usize).rev() {
        let next = product(z, &ratio);
        let whole = (2 * (2 * k + 1)) as f64;
        let [[a, b], [c, d]] =
            [[whole - next[0][0], -next[0][1]], [-next[1][0], whole - next[1][1]]];
        let determinant = a * d - b * c;
        let inverse = [[d, -b], [-c, a]].each(|row| row.each(|x| -x / determinant));
        ratio = product(&inverse, z);
        if k <= ORDERS {
            answers[k - 1] = ratio;
        }
    }
    let [_, mut before, ..] = phi_functions(z);
    for answer in &mut answers {
        before = product(answer, &before);
        *answer = before;
    }
    answers
}

impl<T: Scalar> Words for Kicks<T> {
    const LAYOUT: u32 = <[[T; 2]; ORDERS]>::LAYOUT;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        self.0.put(sink);
    }

    fn get(source: &mut dyn FnMut() -> u32) -> Self {
        Self(Words::get(source))
    }
}

// Not under Miri, which takes many minutes for the sums and finds nothing here: no code is unsafe.
#[cfg(all(test, not(miri)))]
mod tests {
    use super::*;

    /// Against Simpson's rule.
    #[test]
    fn answers_are_integrals() {
        for (turn, decay) in [(0.01, 0.0), (2.0, 0.0), (12.6, 0.3), (35.0, 1.0), (0.5, 20.0)] {
            let z = [[0.0, turn], [-turn, -decay]];
            let steps = 4000;
            for (k, answer) in answers(&z).iter().enumerate() {
                let mut sum = [[0.0; 2]; 2];
                for i in 0..=steps {
                    let s = f64::from(i) / f64::from(steps);
                    let weight = match i {
                        0 => 1.0,
                        i if i == steps => 1.0,
                        i if i % 2 == 1 => 4.0,
                        _ => 2.0,
                    } / f64::from(3 * steps);
                    let [exp, ..] = phi_functions(&z.map(|row| row.map(|x| (1.0 - s) * x)));
                    let legendre = polynomial(k + 1, 2.0 * s - 1.0);
                    for r in 0..2 {
                        for c in 0..2 {
                            sum[r][c] += weight * legendre * exp[r][c];
                        }
                    }
                }
                for r in 0..2 {
                    for c in 0..2 {
                        let error = (sum[r][c] - answer[r][c]).abs();
                        assert!(error < 1e-8, "{turn} {decay} {k} {r} {c}: {error}");
                    }
                }
            }
        }
    }

    fn polynomial(k: usize, x: f64) -> f64 {
        let (mut before, mut p) = (1.0, x);
        for n in 1..k {
            let n = n as f64;
            (before, p) = (p, ((2.0 * n + 1.0) * x * p - n * before) / (n + 1.0));
        }
        p
    }
}
