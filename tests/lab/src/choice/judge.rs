//! Judges one choice by the true error of every rung.

use stillbeam::model::Rod;
use stillbeam::motion::Limits;
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::Elastica;
use stillbeam::{Error as CoreError, Generator, Move};

use super::random::Case;
use super::verdict::{Doubt, Judged, Verdict};
use stillbeam_sim::compare;
use stillbeam_sim::error::Error;
use stillbeam_sim::reference::{Sample, rod};
use stillbeam_sim::trajectory::Trajectory;

/// Polynomials of the judge, coarsest first. An arm is judged with one more each time, until no
/// verdict depends on it.
pub(super) const ORDERS: [usize; 4] = [5, 6, 7, 8];

/// Least and largest tolerance of a step, rad. The highest polynomial's vibration binds most steps;
/// this is for the others.
pub(super) const TOLERANCE: (f64, f64) = (1e-11, 1e-7);

/// Tolerance of a step, fraction of the angle by which the arm bends. A stiff arm bends by 1e-4,
/// and its torque must be right to a part in a thousand of that.
pub(super) const PART: f64 = 1e-5;

/// Factor between a rung's error and the tolerance from which on the coarsest judge is enough.
/// Where the torque rings most, that judge errs by two fifths of the error.
pub(super) const FAR: f64 = 2.5;

/// Largest change of a rung's error from one judge to the next, fraction of its distance from the
/// tolerance. Each polynomial more takes half of the remaining error or less, so that the remainder
/// is no larger than the change.
pub(super) const CHANGE: f64 = 0.25;

/// Largest change if the error is below twice the tolerance, fraction of the tolerance.
pub(super) const NEAR: f64 = 0.03;

/// Options of the stricter judge that judges the judge.
pub(super) const STRICT: rod::Options =
    rod::Options { order: 8, tolerance: 1e-11, integrator: None };

/// Interval of arms at which the judge itself is judged.
pub(super) const STRICT_EACH: u64 = 50;

/// Segments in a generator's queue. It holds all moves of a case at once.
const QUEUE: usize = 64;

impl Case {
    /// Lets `auto` choose, and judges every rung over the moves and one first period after them.
    pub fn judge(&self, index: u64) -> Result<Verdict, Error> {
        let chosen =
            Auto::<f32>::choose(&self.arm, self.tick, self.from, &self.moves, &self.tolerance);
        let choice = chosen.map(|(_, choice)| choice);
        let mut run = self.moves.clone();
        run.push(Move::Dwell { duration: self.period });
        let trajectory = Trajectory::plan(self.from, &run, &Limits::default(), self.tick)?;
        let expected = self.bend(&trajectory)?;
        let bend = Elastica::<f32, 1>::nearest_bend(expected);
        let away = away(&trajectory, self.tick);
        let ladder = Rung::ladder(&self.arm);
        let errors = |truth: &[Sample]| {
            let of = |rung| self.errors(&run, rung, bend, truth, &away);
            ladder.map(|rung| of(rung).unwrap_or([f64::INFINITY; 2]))
        };
        let chosen = choice.as_ref().ok().map(|choice| choice.rung);
        let chosen = ladder.iter().position(|&rung| Some(rung) == chosen);
        let tolerance = (PART * expected).clamp(TOLERANCE.0, TOLERANCE.1);
        let judge = |order| -> Result<_, Error> {
            let options = rod::Options { order, tolerance, integrator: None };
            Ok(errors(&self.truth(&trajectory, &options)?))
        };
        let mut order = ORDERS[0];
        let mut found = judge(order)?;
        let alone = pairs(&found, &found, chosen);
        let mut settled = alone.iter().all(|(error, _)| !(1.0 / FAR..FAR).contains(error));
        for finer in &ORDERS[1..] {
            if settled {
                break;
            }
            let before = std::mem::replace(&mut found, judge(*finer)?);
            order = *finer;
            let both = pairs(&before, &found, chosen);
            settled = both.iter().all(|&(a, b)| is_settled(a, b));
        }
        let doubt = if index.is_multiple_of(STRICT_EACH) {
            let strict = errors(&self.truth(&trajectory, &STRICT)?);
            Some(Doubt::of(&pairs(&found, &strict, chosen)))
        } else {
            None
        };
        let judged = Judged { order, settled, doubt };
        let ticks = trajectory.ticks();
        let errors = found.map(larger);
        let parts = chosen.map(|rung| found[rung]);
        Ok(Verdict { tolerance: self.tolerance, ticks, ladder, choice, errors, parts, judged })
    }

    fn truth(&self, trajectory: &Trajectory, options: &rod::Options) -> Result<Vec<Sample>, Error> {
        let times: Vec<f64> = (0..=trajectory.ticks()).map(|k| k as f64 * self.tick).collect();
        Ok(rod::solve(&self.arm, trajectory, &times, options)?)
    }

    /// Returns the expected tip angle, rad.
    fn bend(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let peaks = trajectory.plans().iter().map(|plan| plan.summary.peaks.acceleration);
        Ok(Rod::<1>::new(&self.arm)?.bend(peaks.fold(0.0, f64::max)))
    }

    /// Returns the largest distance of the tip from the truth and the largest difference of the
    /// torque at the ticks that are `away` from jumps, each over its tolerance.
    fn errors(
        &self,
        run: &[Move],
        rung: Rung,
        bend: f64,
        truth: &[Sample],
        away: &[bool],
    ) -> Result<[f64; 2], CoreError> {
        let stepper = Auto::<f32>::new(&self.arm, self.tick, rung, bend)?;
        let mut generator = Generator::<_, QUEUE>::new(stepper, self.from)?;
        for motion in run {
            generator.push(motion)?;
        }
        let far = |x: f64, y: f64| if y <= x { x } else { y };
        let (mut tip, mut torque, mut peak) = (0.0, 0.0, 0.0f64);
        for (sample, &away) in truth.iter().zip(away) {
            let setpoint = generator.tick();
            tip = far(tip, distance(setpoint.global_tip().map(f64::from), sample.tip));
            peak = peak.max(sample.torque.abs());
            if away {
                torque = far(torque, (f64::from(setpoint.torque) - sample.torque).abs());
            }
        }
        let torque = if torque == 0.0 { 0.0 } else { torque / peak };
        Ok([tip / self.arm.link.length / self.tolerance.tip, torque / self.tolerance.torque])
    }
}

/// Returns, for each tick, true if it is more than one and a half ticks from every jump of the
/// commanded acceleration, as `compare` has it.
fn away(trajectory: &Trajectory, tick: f64) -> Vec<bool> {
    let jumps = compare::jumps(trajectory);
    let near = |t: f64| jumps.iter().any(|jump| (t - jump).abs() <= 1.5 * tick);
    (0..=trajectory.ticks()).map(|k| !near(k as f64 * tick)).collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn larger([a, b]: [f64; 2]) -> f64 {
    a.max(b)
}

/// Returns the errors by two judges of the rungs on which a verdict depends. These are the rungs up
/// to the chosen one, or all if none is chosen or the chosen one exceeds its tolerances.
fn pairs(a: &[[f64; 2]], b: &[[f64; 2]], chosen: Option<usize>) -> Vec<(f64, f64)> {
    let kept = |rung: &usize| larger(a[*rung]).max(larger(b[*rung])) <= 1.0;
    let count = chosen.filter(kept).map_or(a.len(), |rung| rung + 1);
    a.iter().zip(b).take(count).map(|(&a, &b)| (larger(a), larger(b))).collect()
}

/// True if an error over its tolerance, `before` and now, is known well enough to decide whether
/// the tolerance is kept.
fn is_settled(before: f64, now: f64) -> bool {
    // Both may be infinite.
    let change = if now == before { 0.0 } else { (now - before).abs() };
    change <= CHANGE * (now - 1.0).abs() && (now > 2.0 || change <= NEAR)
}
