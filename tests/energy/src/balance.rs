//! The account of a motion: what the hub's torque puts in, what the arm gains, what damping takes.

use super::Energy;

/// Energy and powers at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// Energy, J.
    pub energy: f64,
    /// Power of the torque at the hub, W.
    pub work: f64,
    /// Power that damping takes, W.
    pub dissipation: f64,
}

impl Energy {
    /// Adds the power of a `torque`, N m, at a hub that turns at `rate`, rad/s.
    pub fn under(&self, torque: f64, rate: f64) -> Balance {
        Balance { energy: self.total(), work: torque * rate, dissipation: self.dissipation }
    }
}

/// Returns |work − energy gained − dissipation| over the integral of the absolute power.
///
/// A stretch holds an odd number of samples `tick` s apart, and the torque jumps between stretches
/// only.
///
/// # Panics
/// Panics if a stretch has another number of samples, or if there is none.
pub fn imbalance(stretches: &[Vec<Balance>], tick: f64) -> f64 {
    let sum = |of: fn(&Balance) -> f64| -> f64 {
        stretches.iter().map(|stretch| simpson(stretch, of)).sum::<f64>() * tick
    };
    let last = stretches.last().and_then(|stretch| stretch.last()).expect("samples");
    let gained = last.energy - stretches[0][0].energy;
    let balance = sum(|b| b.work) - gained - sum(|b| b.dissipation);
    balance.abs() / sum(|b| b.work.abs())
}

/// Integrates over samples a unit apart by Simpson's rule.
fn simpson(samples: &[Balance], of: fn(&Balance) -> f64) -> f64 {
    assert!(samples.len() % 2 == 1, "an even number of intervals");
    let last = samples.len() - 1;
    let weight = |i: usize| match i {
        0 => 1.0,
        i if i == last => 1.0,
        i if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    samples.iter().enumerate().map(|(i, s)| weight(i) * of(s)).sum::<f64>() / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy t³ of a power 3t² that nothing takes from; then a tenth of it is taken.
    #[test]
    fn an_account_that_does_not_close_is_told() {
        let samples = |loss: f64| -> Vec<Balance> {
            (0..=4)
                .map(|k| 0.5 * f64::from(k))
                .map(|t| Balance {
                    energy: t * t * t,
                    work: 3.0 * t * t,
                    dissipation: 3.0 * loss * t * t,
                })
                .collect()
        };
        assert!(imbalance(&[samples(0.0)], 0.5) < 1e-12);
        assert!((imbalance(&[samples(0.1)], 0.5) - 0.1).abs() < 1e-12);
    }
}
