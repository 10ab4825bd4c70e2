//! The envelope of a vibration whose damping grows with its amplitude.
//!
//! The amplitude obeys `ȧ = −σa − κa²`: viscous damping, and the friction of a clamp or the drag of
//! air. With `s = a/a₀` and `K = κa₀/σ` its closed form is `s = E/q`, `E = exp(−σt)`, `q = 1 + K(1
//! − E)`. The frequency falls in proportion to the amplitude, by δ at a₀, so that the phase is
//! `ωt + δ ∫s dt` with `∫s dt = ln(q)/(σK)`.

/// Envelope at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// `s = a/a₀`.
    pub amplitude: f64,
    /// `∫₀ᵗ s dt`, s.
    pub integral: f64,
}

/// Returns the envelope at `t` s, with σ in 1/s.
pub fn envelope(t: f64, sigma: f64, growth: f64) -> Envelope {
    let decay = (-sigma * t).exp();
    let lost = -(-sigma * t).exp_m1();
    let amplitude = decay / (1.0 + growth * lost);
    // The limit of ln(1 + Kx)/K for small K.
    let integral =
        if growth > 1e-6 { (growth * lost).ln_1p() / (sigma * growth) } else { lost / sigma };
    Envelope { amplitude, integral }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed form against steps of a thousandth of a second by the midpoint rule.
    #[test]
    fn the_closed_form_solves_its_equation() {
        let (sigma, growth) = (0.2, 3.0);
        let rate = |s: f64| -sigma * s - sigma * growth * s * s;
        let (mut s, mut integral, h) = (1.0_f64, 0.0, 1e-3);
        for k in 0..5000 {
            let middle = s + 0.5 * h * rate(s);
            s += h * rate(middle);
            integral += h * middle;
            let exact = envelope(h * f64::from(k + 1), sigma, growth);
            assert!((exact.amplitude - s).abs() < 1e-6, "{k}");
            assert!((exact.integral - integral).abs() < 1e-6, "{k}");
        }
        let viscous = envelope(2.0, sigma, 0.0);
        assert!((viscous.amplitude - (-0.4_f64).exp()).abs() < 1e-15);
    }
}
