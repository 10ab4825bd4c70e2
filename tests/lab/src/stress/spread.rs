//! Spread of a positive quantity, as counts a quarter of a decade. Counts add up in any order.

use serde::{Deserialize, Serialize};

/// Bins from 10⁻¹² to 10⁴. A smaller value counts in the first, a larger one in the last.
const BINS: usize = 64;
const LEAST: f64 = -12.0;
const A_DECADE: f64 = 4.0;

/// Counts a quarter of a decade, and the largest value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    counts: Vec<u64>,
    /// Largest value.
    pub most: f64,
}

impl Default for Spread {
    fn default() -> Self {
        Self { counts: vec![0; BINS], most: 0.0 }
    }
}

impl Spread {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        let bin = ((value.log10() - LEAST) * A_DECADE).floor();
        // Not a number counts as large as can be.
        let bin = if value.is_nan() { BINS - 1 } else { (bin.max(0.0) as usize).min(BINS - 1) };
        self.counts[bin] += 1;
        self.most = if value.is_nan() { f64::INFINITY } else { self.most.max(value) };
    }

    /// Returns the number of values.
    pub fn count(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// Returns the upper edge of the bin in which that share of the values ends, at most the
    /// largest.
    pub fn quantile(&self, share: f64) -> f64 {
        let wanted = (share * self.count() as f64).ceil().max(1.0) as u64;
        let mut sum = 0;
        for (bin, count) in self.counts.iter().enumerate() {
            sum += count;
            if sum >= wanted {
                let edge = 10f64.powf(LEAST + (bin + 1) as f64 / A_DECADE);
                return edge.min(self.most);
            }
        }
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn quantiles_are_bin_edges() {
        let mut spread = Spread::default();
        for value in [1e-6, 1.1e-6, 1e-3, 0.0] {
            spread.add(value);
        }
        assert_eq!(spread.count(), 4);
        assert!((1.1e-6..2e-6).contains(&spread.quantile(0.75)), "{}", spread.quantile(0.75));
        assert_eq!(spread.quantile(1.0), 1e-3);
        spread.add(f64::NAN);
        assert_eq!(spread.most, f64::INFINITY);
    }
}
