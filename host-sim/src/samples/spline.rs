//! Cubic splines with even knots, and their ends.

/// Cubic B-splines on `count` intervals of `width` s from t = 0: coefficients
/// `c₀ … c₍count+2₎`, of which four carry each interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knots {
    /// Interval between two knots, s.
    pub width: f64,
    /// Number of intervals.
    pub count: usize,
}

/// Condition at one end of a spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Any rate, any acceleration.
    Free,
    /// No rate. The acceleration may jump there.
    Rest,
    /// No rate and no acceleration.
    SmoothRest,
}

/// Coefficients and their factors, of which a linear form of the spline consists.
pub type Form = [(usize, f64); 4];

impl Knots {
    /// Number of coefficients of a spline with free ends.
    pub fn coefficients(self) -> usize {
        self.count + 3
    }

    /// Returns the form of the angle at `t` s.
    pub fn angle(self, t: f64) -> Form {
        let at = (t / self.width).clamp(0.0, self.count as f64);
        let k = (at as usize).min(self.count - 1);
        let u = at - k as f64;
        let v = 1.0 - u;
        let weights = [
            v * v * v / 6.0,
            (4.0 + u * u * (3.0 * u - 6.0)) / 6.0,
            (4.0 + v * v * (3.0 * v - 6.0)) / 6.0,
            u * u * u / 6.0,
        ];
        std::array::from_fn(|j| (k + j, weights[j]))
    }

    /// Returns the form of the rate at a knot, 1/s.
    pub fn rate(self, knot: usize) -> Form {
        let factor = 0.5 / self.width;
        [(knot, -factor), (knot + 1, 0.0), (knot + 2, factor), (knot + 2, 0.0)]
    }

    /// Returns the form of the acceleration at a knot, 1/s².
    pub fn acceleration(self, knot: usize) -> Form {
        let factor = 1.0 / (self.width * self.width);
        [(knot, factor), (knot + 1, -2.0 * factor), (knot + 2, factor), (knot + 2, 0.0)]
    }

    /// Returns the form of the jerk in an interval, times the interval's third power. The jerk of a
    /// cubic is constant there.
    pub fn jerk(self, interval: usize) -> Form {
        [(interval, -1.0), (interval + 1, 3.0), (interval + 2, -3.0), (interval + 3, 1.0)]
    }
}

impl End {
    /// Number of coefficients that the condition takes away.
    pub fn conditions(self) -> usize {
        match self {
            Self::Free => 0,
            Self::Rest => 1,
            Self::SmoothRest => 2,
        }
    }

    /// Returns the coefficient that equals the one at `distance` from the end, both counted from
    /// the end. No rate: the outermost equals the third. No acceleration either: all three are
    /// equal.
    fn fold(self, distance: usize) -> usize {
        match (self, distance) {
            (Self::Rest, 0) | (Self::SmoothRest, 0..=1) => 2,
            _ => distance,
        }
    }
}

/// Maps the coefficients of a spline with free ends to those that its end conditions leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Folding {
    /// Number of coefficients with free ends.
    pub all: usize,
    /// Conditions at the beginning and at the end.
    pub ends: [End; 2],
}

impl Folding {
    /// Number of coefficients that are left.
    pub fn left(self) -> usize {
        self.all - self.ends[0].conditions() - self.ends[1].conditions()
    }

    /// Returns the index among those left of a coefficient.
    pub fn index(self, k: usize) -> usize {
        let [begin, end] = self.ends;
        let k = begin.fold(k);
        let k = self.all - 1 - end.fold(self.all - 1 - k);
        k - begin.conditions()
    }

    /// Returns a form in the coefficients that are left.
    pub fn form(self, form: &Form) -> Form {
        form.map(|(k, factor)| (self.index(k), factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(form: &Form, c: &[f64]) -> f64 {
        form.iter().map(|&(k, factor)| factor * c[k]).sum()
    }

    /// A spline through a cubic's own coefficients is that cubic.
    #[test]
    fn a_cubic_is_reproduced() {
        let knots = Knots { width: 0.5, count: 6 };
        // Coefficients of t³: k (k² − 1) h³ about the knot k.
        let c: Vec<f64> = (0..knots.coefficients())
            .map(|j| {
                let k = j as f64 - 1.0;
                k * (k * k - 1.0) * 0.125
            })
            .collect();
        for t in [0.0, 0.3, 0.5, 1.7, 3.0] {
            assert!((value(&knots.angle(t), &c) - t * t * t).abs() < 1e-12, "{t}");
        }
        for knot in [0, 3, 6] {
            let t = 0.5 * knot as f64;
            assert!((value(&knots.rate(knot), &c) - 3.0 * t * t).abs() < 1e-12);
            assert!((value(&knots.acceleration(knot), &c) - 6.0 * t).abs() < 1e-12);
        }
        assert!((value(&knots.jerk(2), &c) / 0.125 - 6.0).abs() < 1e-12);
    }

    #[test]
    fn ends_are_at_rest() {
        let knots = Knots { width: 0.1, count: 4 };
        let all = knots.coefficients();
        for begin in [End::Free, End::Rest, End::SmoothRest] {
            let folding = Folding { all, ends: [begin, End::SmoothRest] };
            let left: Vec<f64> = (0..folding.left()).map(|k| (k * k) as f64 + 1.0).collect();
            let c: Vec<f64> = (0..all).map(|k| left[folding.index(k)]).collect();
            assert_eq!(value(&knots.rate(0), &c) == 0.0, begin != End::Free);
            assert_eq!(value(&knots.acceleration(0), &c) == 0.0, begin == End::SmoothRest);
            assert!(value(&knots.rate(4), &c) == 0.0 && value(&knots.acceleration(4), &c) == 0.0);
        }
    }
}
