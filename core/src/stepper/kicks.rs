//! Response of a mode to a kink of the motion inside a tick.

use super::oscillator::pulled_back;
use crate::math::{Each, Functions, Matrix2, Scalar, Words, array, dot, phi_functions};
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
        let [whole, mean, ..] = phi_functions(&z);
        let answers = answers(&z, mean.each(|row| row[1]));
        Self(array(|k| {
            let scale = -b * h * (2 * k + 3) as f64;
            let [a, p] = answers[k].each(|x| scale * x);
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

/// The second column of `Gₖ = ∫₀¹ Pₖ(2s − 1) exp((1 − s)Z) ds` for `k = 1..8`.
///
/// `mean` is that of `G₀ = φ₁(Z)`. Integrating by parts, `Z(Gₖ₊₁ − Gₖ₋₁) = 2(2k + 1)Gₖ`: a
/// continued fraction for `Gₖ = RₖGₖ₋₁`, `Rₖ = −(2(2k + 1) − Z Rₖ₊₁)⁻¹Z`, from where `Rₖ` is
/// nothing down to `k = 1` (Miller's algorithm; for a rotation these are spherical Bessel
/// functions). Error: 1e-14.
#[inline(never)]
fn answers(z: &Matrix2, mean: [f64; 2]) -> [[f64; 2]; ORDERS] {
    let mut answers = [[0.0; 2]; ORDERS];
    let norm = z[1][0].abs() + z[1][1].abs();
    if norm > LARGEST_NORM {
        return answers;
    }
    let functions = Functions::of(z);
    let mut ratios = [[[0.0; 2]; 2]; ORDERS];
    let mut ratio = [0.0; 3];
    // Each step takes all but `(|Z|/(4k + 2))²` off the error of the ratio before.
    for k in (1..=ORDERS + 6 + norm as usize).rev() {
        let [a, b, d] = functions.by_z(&ratio);
        let whole = (2 * (2 * k + 1)) as f64;
        // `−(whole − Z R)⁻¹` is `(Z R − whole)⁻¹`.
        ratio = functions.by_z(&functions.inverse(&[a - whole, b, d - whole]));
        if k <= ORDERS {
            ratios[k - 1] = functions.matrix(&ratio);
        }
    }
    let mut before = mean;
    for (answer, ratio) in answers.iter_mut().zip(&ratios) {
        before = ratio.each(|row| dot(&row, &before));
        *answer = before;
    }
    answers
}

impl<T: Scalar> Words for Kicks<T> {
    const LAYOUT: u32 = <[[T; 2]; ORDERS]>::LAYOUT;
    const BLANK: Self = Self(Words::BLANK);

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        self.0.put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        self.0.fill(source);
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
            let [_, mean, ..] = phi_functions(&z);
            for (k, answer) in answers(&z, mean.map(|row| row[1])).iter().enumerate() {
                let mut sum = [0.0; 2];
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
                        sum[r] += weight * legendre * exp[r][1];
                    }
                }
                for r in 0..2 {
                    let error = (sum[r] - answer[r]).abs();
                    assert!(error < 1e-8, "{turn} {decay} {k} {r}: {error}");
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
