//! The furthest motions whose acceleration stays positive on its way down.

use super::root::root;
use super::{Phases, Problem};

/// Motions by jerk + 0 − +, counted by the trough B ≥ 0 of the acceleration between its peak A and
/// its end a₁ > 0. Unlimited, `A² = K + B²`.
///
/// The time grows as B falls: `dT = −(2/j)(1 − B/A) dB`, and the angle changes as `dΔ = h dT` with
/// `h = v₁ − a₁²/2j + B²/j − AB/2j`. As B falls, h falls to a single lowest value and rises from
/// there, so the angle may rise, fall and rise.
struct Strict<'a> {
    problem: &'a Problem,
    k: f64,
}

/// A motion of the family.
struct Candidate {
    phases: Phases,
    distance: f64,
    /// h, rad/s.
    slope: f64,
}

/// `(B/A)²` of the lowest h, over `1 − (B/A)²`: `B/A = 2 − √3`.
const LOWEST: f64 = 0.077_350_269_189_625_76;

impl Problem {
    /// The furthest motion in the shortest time that turns by `distance`, rad, if there is one
    /// whose acceleration does not pass zero on its way down. `distance` is above what the fastest
    /// change of the rate turns by.
    pub fn stay_strict(&self, distance: f64) -> Option<Phases> {
        let rises = self.rises();
        if self.jerk.is_infinite() {
            None
        } else if rises && self.to[1] > 0.0 {
            Strict::new(self).reach(distance)
        } else if !rises && self.from[1] < 0.0 {
            let backwards = self.reverse();
            Strict::new(&backwards).reach(distance).map(Phases::reverse)
        } else {
            None
        }
    }

    /// True if between the fastest change of the rate and the next slower one that passes zero lie
    /// times that no change of the rate takes. It has accelerations of one sign at both ends.
    pub fn has_gap(&self) -> bool {
        let [from, to] = [self.from[1], self.to[1]];
        let forward = if from > 0.0 { *self } else { self.mirror() };
        from * to > 0.0 && forward.rises() && forward.closing() >= 0.0
    }

    /// Square of the trough at which the peak is where the acceleration begins; negative if there
    /// is none.
    fn closing(&self) -> f64 {
        let [from, to] = [self.from[1], self.to[1]];
        0.5 * (from * from + to * to) - self.jerk * self.change()
    }
}

impl<'a> Strict<'a> {
    fn new(problem: &'a Problem) -> Self {
        let [from, to] = [problem.from[1], problem.to[1]];
        let k = problem.jerk * problem.change() + 0.5 * (from * from - to * to);
        Self { problem, k: k.max(0.0) }
    }

    fn reach(&self, distance: f64) -> Option<Phases> {
        let (from, to) = (self.problem.from[1], self.problem.to[1]);
        let closing = if from > 0.0 { self.problem.closing().max(0.0) } else { 0.0 };
        let last = libm::sqrt(closing).min(to);
        let lowest = self.lowest().max(last).min(to);
        // The unknown grows with the time.
        let at = |fallen: f64| self.at(to - fallen);
        let reaches = |fallen: f64| at(fallen).distance >= distance;
        let between = |low: f64, high: f64| {
            let fallen = root(low, high, high, |fallen| {
                let Candidate { phases, distance: turned, slope } = at(fallen);
                let steepness = 1.0 - phases.trough / phases.peak;
                (turned - distance, 2.0 / self.problem.jerk * steepness * slope)
            });
            at(fallen).phases
        };
        let (turn, end) = (to - lowest, to - last);
        if at(turn).slope >= 0.0 {
            return reaches(end).then(|| between(0.0, end));
        }
        if at(0.0).slope > 0.0 {
            let summit = root(0.0, turn, turn, |fallen| (-at(fallen).slope, 0.0));
            if reaches(summit) {
                return Some(between(0.0, summit));
            }
        }
        reaches(end).then(|| between(turn, end))
    }

    /// B of the lowest h, where nothing ends the family before.
    fn lowest(&self) -> f64 {
        let upper = self.problem.upper;
        let free = libm::sqrt(LOWEST * self.k);
        if self.k + free * free <= upper * upper {
            return free;
        }
        // With the peak at its limit, or where it begins to be.
        let border = libm::sqrt((upper * upper - self.k).max(0.0));
        border.max(0.25 * upper)
    }

    fn at(&self, trough: f64) -> Candidate {
        let Problem { from: [v, from], to: [v1, to], upper, jerk, .. } = *self.problem;
        let square = self.k + trough * trough;
        let (peak, hold, fall) = if square > upper * upper {
            (upper, (square - upper * upper) / (jerk * upper), upper - trough)
        } else {
            let peak = libm::sqrt(square);
            // The difference of two that may be equal.
            let fall = if peak > 0.0 { self.k / (peak + trough) } else { 0.0 };
            (peak, 0.0, fall)
        };
        let up = ((peak - from) / jerk).max(0.0);
        let (down, last) = (fall / jerk, (to - trough) / jerk);
        let after_up = v + 0.5 * up * (from + peak);
        let after_hold = after_up + hold * peak;
        let after_down = after_hold + 0.5 * down * (peak + trough);
        let distance = up * (v + up * (2.0 * from + peak) / 6.0)
            + hold * (after_up + 0.5 * hold * peak)
            + down * (after_hold + down * (2.0 * peak + trough) / 6.0)
            + last * (after_down + last * (2.0 * trough + to) / 6.0);
        let durations = [up, hold, down, 0.0, 0.0, 0.0, last];
        let phases = Phases { durations, peak, trough, mirrored: false };
        let slope = v1 + (trough * trough - 0.5 * to * to - 0.5 * peak * trough) / jerk;
        Candidate { phases, distance, slope }
    }
}
