//! Random numbers of campaigns.

use rand::Rng;
use rand::rngs::StdRng;

/// Draws from `from` to `to`, both above 0, uniformly in the logarithm.
pub fn log(rng: &mut StdRng, from: f64, to: f64) -> f64 {
    from * (to / from).powf(rng.random_range(0.0..1.0))
}

/// Draws from 10 to the power `from` to 10 to the power `to`, uniformly in the logarithm.
pub fn decades(rng: &mut StdRng, from: f64, to: f64) -> f64 {
    10f64.powf(rng.random_range(from..to))
}

/// Draws 1 or -1.
pub fn sign(rng: &mut StdRng) -> f64 {
    if rng.random_bool(0.5) { 1.0 } else { -1.0 }
}
