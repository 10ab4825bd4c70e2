//! Newmark's rule with any parameters, on one oscillator.
//!
//! `q⁺ = q + hq̇ + h²[(½ − β)q̈ + βq̈⁺]`, `q̇⁺ = q̇ + h[(1 − δ)q̈ + δq̈⁺]`, `q̈ = −ω²q`.
//! Source: Bathe, Finite Element Procedures, section 9.4.

/// A rule of the family.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rule {
    /// Name of the rule.
    pub name: &'static str,
    /// δ. The value ½ neither feeds nor damps, a greater one damps.
    pub delta: f64,
    /// β.
    pub beta: f64,
}

/// Rules: the core's first, then others of the literature.
pub const RULES: [Rule; 5] = [
    Rule { name: "constant average acceleration", delta: 0.5, beta: 0.25 },
    Rule { name: "linear acceleration", delta: 0.5, beta: 1.0 / 6.0 },
    Rule { name: "Fox and Goodwin", delta: 0.5, beta: 1.0 / 12.0 },
    Rule { name: "central differences", delta: 0.5, beta: 0.0 },
    Rule { name: "damped", delta: 0.6, beta: 0.3025 },
];

impl Rule {
    /// Returns the matrix by which a step multiplies `(ωq, q̇)`, for a given `ωh`.
    pub fn step(&self, turn: f64) -> [[f64; 2]; 2] {
        let Self { delta, beta, .. } = *self;
        let square = turn * turn;
        let weight = 1.0 / (1.0 + beta * square);
        // q̈⁺h² of q and of hq̇.
        let of_q = -square * (1.0 - square * (0.5 - beta)) * weight;
        let of_v = -square * weight;
        [
            [1.0 - square * (0.5 - beta) + beta * of_q, turn * (1.0 + beta * of_v)],
            [(-square * (1.0 - delta) + delta * of_q) / turn, 1.0 + delta * of_v],
        ]
    }

    /// Returns the largest magnitude of an eigenvalue of [`Self::step`]. The rule is stable up to
    /// 1.
    pub fn radius(&self, turn: f64) -> f64 {
        let [[a, b], [c, d]] = self.step(turn);
        let (half, determinant) = (0.5 * (a + d), a * d - b * c);
        let root = half * half - determinant;
        if root < 0.0 { determinant.sqrt() } else { half.abs() + root.sqrt() }
    }

    /// Returns the relative error of the period, positive if it is too long. Infinite if nothing
    /// swings.
    pub fn period_error(&self, turn: f64) -> f64 {
        let [[a, b], [c, d]] = self.step(turn);
        let (half, determinant) = (0.5 * (a + d), a * d - b * c);
        let root = determinant - half * half;
        if root <= 0.0 { f64::INFINITY } else { turn / root.sqrt().atan2(half) - 1.0 }
    }

    /// Returns the greatest `ωh` up to which the rule is stable; infinite for `2β ≥ δ ≥ ½`.
    pub fn stable_up_to(&self) -> f64 {
        self.up_to(|turn| self.radius(turn) <= 1.0 + 1e-9)
    }

    /// Returns the greatest `ωh` up to which period and decay a period are true to 1 %.
    pub fn accurate_up_to(&self) -> f64 {
        self.up_to(|turn| {
            let decay = self.radius(turn).powf(std::f64::consts::TAU / turn) - 1.0;
            self.period_error(turn).abs() <= 0.01 && decay.abs() <= 0.01
        })
    }

    fn up_to(&self, holds: impl Fn(f64) -> bool) -> f64 {
        let turns = (0..=6000).map(|k| 10f64.powf(-3.0 + f64::from(k) / 1000.0));
        let mut last = 0.0;
        for turn in turns {
            if !holds(turn) {
                return last;
            }
            last = turn;
        }
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Textbook limits: √12, √6 and 2.
    #[test]
    fn limits_are_those_of_the_literature() {
        let limits = RULES.map(|rule| rule.stable_up_to());
        assert_eq!([limits[0], limits[4]], [f64::INFINITY; 2]);
        for (limit, exact) in [(1, 12f64.sqrt()), (2, 6f64.sqrt()), (3, 2.0)] {
            assert!((limits[limit] / exact - 1.0).abs() < 3e-3, "{:?}", RULES[limit]);
        }
        // Period error (ωh)²/12 of the core's, −(ωh)²/24 of central differences.
        assert!((RULES[0].period_error(0.1) * 1200.0 - 1.0).abs() < 0.01);
        assert!((RULES[3].period_error(0.1) * 2400.0 + 1.0).abs() < 0.01);
    }
}
