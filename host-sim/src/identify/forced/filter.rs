//! Linear filters driven by samples at uneven times, exactly between them.
//!
//! A transfer function with a pole pair for each factor of its denominator is a sum of first-order
//! ones, `D + 2 Re Σ rᵢ/(s − pᵢ)`. Each is stepped in closed form with an input that is linear
//! between the samples (first-order hold).

use nalgebra::Complex;

/// `s² + 2ζωs + ω²`, a factor of a denominator, ζ below 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// ω, rad/s.
    pub omega: f64,
    /// ζ.
    pub ratio: f64,
}

/// A known second-order low-pass of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lowpass {
    /// Corner frequency, Hz.
    pub frequency: f64,
    /// Damping ratio.
    pub ratio: f64,
}

impl Lowpass {
    /// Returns its denominator. A ratio of 1 or more has real poles, which lie as close to a pair
    /// as the arithmetic needs.
    pub fn pair(&self) -> Pair {
        Pair { omega: std::f64::consts::TAU * self.frequency, ratio: self.ratio.min(0.9999) }
    }
}

impl Pair {
    /// Returns the pole in the upper half plane.
    pub fn pole(&self) -> Complex<f64> {
        let Self { omega, ratio } = *self;
        Complex::new(-ratio * omega, omega * (1.0 - ratio * ratio).sqrt())
    }
}

/// Returns `z` at every time, with `ż = pz + u` from rest.
pub fn states(pole: Complex<f64>, time: &[f64], input: &[f64]) -> Vec<Complex<f64>> {
    let mut z = Complex::new(0.0, 0.0);
    let mut all = Vec::with_capacity(time.len());
    let mut step = Step::of(pole, 0.0);
    all.push(z);
    for k in 1..time.len() {
        let h = time[k] - time[k - 1];
        if (h - step.h).abs() > 1e-12 * h {
            step = Step::of(pole, h);
        }
        z = step.decay * z + step.first * input[k - 1] + step.second * (input[k] - input[k - 1]);
        all.push(z);
    }
    all
}

/// A step of length h: `φ₀`, `hφ₁` and `hφ₂` of `ph`.
struct Step {
    h: f64,
    decay: Complex<f64>,
    first: Complex<f64>,
    second: Complex<f64>,
}

impl Step {
    fn of(pole: Complex<f64>, h: f64) -> Self {
        let x = pole * h;
        let decay = x.exp();
        // The closed forms cancel for small x.
        let (one, two) = if x.norm() < 1e-3 {
            (1.0 + x * (0.5 + x / 6.0), 0.5 + x * (1.0 / 6.0 + x / 24.0))
        } else {
            ((decay - 1.0) / x, (decay - 1.0 - x) / (x * x))
        };
        Self { h, decay, first: one * h, second: two * h }
    }
}

/// Responses to one input of transfer functions that share their poles.
pub struct Bank {
    poles: Vec<Complex<f64>>,
    states: Vec<Vec<Complex<f64>>>,
    input: Vec<f64>,
}

impl Bank {
    /// Drives all pole pairs with the input.
    pub fn new(pairs: &[Pair], time: &[f64], input: Vec<f64>) -> Self {
        let poles: Vec<Complex<f64>> = pairs.iter().map(Pair::pole).collect();
        let states = poles.iter().map(|&pole| states(pole, time, &input)).collect();
        Self { poles, states, input }
    }

    /// Returns the response of `N(s)/Π(s² + 2ζωs + ω²)` over the pairs at those indices.
    /// `numerator` are N's coefficients, of s⁰ first. Its degree is at most twice the number of
    /// pairs.
    pub fn response(&self, numerator: &[f64], pairs: &[usize]) -> Vec<f64> {
        let direct =
            if numerator.len() == 2 * pairs.len() + 1 { numerator[2 * pairs.len()] } else { 0.0 };
        let residues: Vec<Complex<f64>> =
            pairs.iter().map(|&k| self.residue(numerator, pairs, k)).collect();
        (0..self.input.len())
            .map(|n| {
                let parts = pairs.iter().zip(&residues).map(|(&k, r)| (r * self.states[k][n]).re);
                direct * self.input[n] + 2.0 * parts.sum::<f64>()
            })
            .collect()
    }

    fn residue(&self, numerator: &[f64], pairs: &[usize], k: usize) -> Complex<f64> {
        let pole = self.poles[k];
        let zero = Complex::new(0.0, 0.0);
        let top = numerator.iter().rev().fold(zero, |sum, &n| sum * pole + n);
        let others = pairs.iter().filter(|&&other| other != k).map(|&other| self.poles[other]);
        let bottom = others.fold(pole - pole.conj(), |product, other| {
            product * (pole - other) * (pole - other.conj())
        });
        top / bottom
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mode driven by a ramp: `x = t − 2ζ/ω + e^{−ζωt}(…)` tends to the ramp less `2ζ/ω`, and the
    /// deflection `x − θ` of a mode without damping is `−sin(ωt)/ω`.
    #[test]
    fn a_ramp_is_followed_exactly_at_uneven_times() {
        let time: Vec<f64> =
            (0..400).map(|k| 0.01 * f64::from(k) + 2e-3 * f64::from(k % 3)).collect();
        let omega = 9.0;
        let bank = Bank::new(&[Pair { omega, ratio: 1e-9 }], &time, time.clone());
        let deflection = bank.response(&[0.0, 0.0, -1.0], &[0]);
        for (t, y) in time.iter().zip(deflection) {
            assert!((y + (omega * t).sin() / omega).abs() < 1e-6, "{t}: {y}");
        }
    }

    /// Two filters in series by partial fractions against one after the other on a fine grid.
    #[test]
    fn a_chain_is_its_parts_in_series() {
        let time: Vec<f64> = (0..20_000).map(|k| 2e-4 * f64::from(k)).collect();
        let input: Vec<f64> = time.iter().map(|t| (3.0 * t).sin() * t).collect();
        let pairs = [Pair { omega: 11.0, ratio: 0.1 }, Pair { omega: 12.6, ratio: 0.9 }];
        let square = |k: usize| pairs[k].omega * pairs[k].omega;
        let bank = Bank::new(&pairs, &time, input.clone());
        let both = bank.response(&[square(0) * square(1)], &[0, 1]);
        let first = Bank::new(&pairs[..1], &time, input).response(&[square(0)], &[0]);
        let second = Bank::new(&pairs[1..], &time, first).response(&[square(1)], &[0]);
        for (one, other) in both.iter().zip(second) {
            assert!((one - other).abs() < 1e-5, "{one} {other}");
        }
    }
}
