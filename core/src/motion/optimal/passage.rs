//! The furthest motions whose acceleration passes zero on its way down.

use super::leg::Leg;
use super::root::root;
use super::{Phases, Problem};

/// Motions by jerk + 0 − 0 − 0 +, counted by the rate r at which the acceleration is zero on its
/// way down: two [`Leg`]s, up to r and down from it.
///
/// Unlimited, the peaks A and b of the two legs are `A² = j(r − v₀) + a₀²/2` and `b² = A² − K`. The
/// unknown is the smaller of the two, `x`: `r` itself would lose half of its digits where `x` is
/// small. With `h = r + Ab/2j`, which increases with r, the angle changes as `dΔ = h dT` and
/// `dT = (1/A + 1/b) dr`. So it falls until h is zero, and rises from there.
struct Passage<'a> {
    problem: &'a Problem,
    /// Squares of A and b less x²: one of them is zero, none negative.
    excess: [f64; 2],
}

/// A motion of the family.
struct Candidate {
    legs: [Leg; 2],
    /// r, rad/s.
    rate: f64,
}

impl Problem {
    /// The furthest motion in the shortest time that turns by `distance`, rad, if its acceleration
    /// passes zero on its way down. `distance` is above what the first of these motions turns by.
    pub fn pass_zero(&self, distance: f64) -> Phases {
        if self.jerk.is_infinite() {
            return self.pass_at_once(distance);
        }
        let passage = Passage::new(self);
        let (least, most) = passage.range();
        let fastest = passage.at(most);
        let missing = distance - fastest.distance();
        if missing >= 0.0 {
            return fastest.phases(missing / self.rate);
        }
        // What a move from rest to rest would need.
        let guess = libm::cbrt(0.5 * libm::fabs(distance) * self.jerk * self.jerk);
        let x = root(least, most, guess, |x| {
            let candidate = passage.at(x);
            (candidate.distance() - distance, passage.slope(x, &candidate))
        });
        passage.at(x).phases(0.0)
    }

    /// The same where the acceleration jumps: `r²(1/A + 1/b) = 2Δ + v₀²/A + v₁²/b`.
    fn pass_at_once(&self, distance: f64) -> Phases {
        let ([v0, _], [v1, _]) = (self.from, self.to);
        let (up, down) = (1.0 / self.upper, 1.0 / self.lower);
        let square = (2.0 * distance + v0 * v0 * up + v1 * v1 * down) / (up + down);
        let peak = libm::sqrt(square.max(0.0)).max(v0).max(v1).min(self.rate.max(v0).max(v1));
        let turned = 0.5 * ((peak * peak - v0 * v0) * up + (peak * peak - v1 * v1) * down);
        let cruise = if square > peak * peak { (distance - turned) / peak } else { 0.0 };
        let durations = [0.0, (peak - v0) * up, 0.0, cruise, 0.0, (peak - v1) * down, 0.0];
        Phases { durations, peak: self.upper, trough: -self.lower, mirrored: false }
    }
}

impl<'a> Passage<'a> {
    fn new(problem: &'a Problem) -> Self {
        let ([_, a0], [_, a1]) = (problem.from, problem.to);
        let k = problem.jerk * problem.change() + 0.5 * (a0 * a0 - a1 * a1);
        Self { problem, excess: [k.max(0.0), (-k).max(0.0)] }
    }

    /// x of the first of these motions, where one leg has but one phase, and of the fastest.
    fn range(&self) -> (f64, f64) {
        let ([v0, a0], [_, a1]) = (self.problem.from, self.problem.to);
        let [up, down] = self.excess;
        let (first, last) = (a0.max(0.0), (-a1).max(0.0));
        let least = (first * first - up).max(last * last - down).max(0.0);
        let most = self.problem.jerk * (self.problem.rate - v0) + 0.5 * a0 * a0 - up;
        (libm::sqrt(least), libm::sqrt(most.max(least)))
    }

    fn at(&self, x: f64) -> Candidate {
        let Problem { from: [v0, a0], to: [v1, a1], upper, lower, jerk, .. } = *self.problem;
        let [up, down] = self.excess.map(|excess| excess + x * x);
        let legs = [Leg::new([v0, a0], up, upper, jerk), Leg::new([v1, -a1], down, lower, jerk)];
        Candidate { legs, rate: v0 + (up - 0.5 * a0 * a0) / jerk }
    }

    /// Angle by x.
    fn slope(&self, x: f64, candidate: &Candidate) -> f64 {
        let jerk = self.problem.jerk;
        let [up, down] = candidate.legs.map(|leg| leg.peak);
        let h = candidate.rate + 0.5 * up * down / jerk;
        let share = |peak: f64| if peak > 0.0 { x / peak } else { 1.0 };
        2.0 / jerk * h * (share(up) + share(down))
    }
}

impl Candidate {
    fn distance(&self) -> f64 {
        self.legs[0].distance + self.legs[1].distance
    }

    fn phases(&self, cruise: f64) -> Phases {
        let [[up, hold, down], [last, low, fall]] = self.legs.map(|leg| leg.durations);
        Phases {
            durations: [up, hold, down, cruise, fall, low, last],
            peak: self.legs[0].peak,
            trough: -self.legs[1].peak,
            mirrored: false,
        }
    }
}
