//! What one choice is worth: the true error of every rung.

use stillbeam::model::Rod;
use stillbeam::motion::Limits;
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::Elastica;
use stillbeam::{Error as CoreError, Generator, Move};

use super::random::Case;
use super::verdict::Verdict;
use stillbeam_sim::compare;
use stillbeam_sim::error::Error;
use stillbeam_sim::reference::{Sample, rod};
use stillbeam_sim::trajectory::Trajectory;

/// The judge. Its steps are bound by the highest polynomial's vibration; where damping has it take the
/// implicit method, by the tolerance, an angle in rad: a stiff arm bends by 1e-4, and its torque is to be
/// right to a part in a thousand of that.
pub(super) const JUDGE: rod::Options = rod::Options { order: 6, tolerance: 1e-9, integrator: None };

/// The judge where it is close.
pub(super) const CLOSE: rod::Options = rod::Options { order: 7, ..JUDGE };

/// Where it is close: a rung that errs by the tolerance, give or take this part of it.
pub(super) const MARGIN: f64 = 0.1;

/// The judge's judge.
pub(super) const STRICT: rod::Options = rod::Options { order: 8, tolerance: 1e-11, ..JUDGE };

/// Every so many arms the judge itself is judged.
pub(super) const STRICT_EACH: u64 = 50;

/// Segments in a generator: all moves of a case at once.
const QUEUE: usize = 64;

impl Case {
    /// Chooses, and judges every rung over the moves and one first period after them.
    pub fn judge(&self, index: u64) -> Result<Verdict, Error> {
        let chosen =
            Auto::<f32>::choose(&self.arm, self.tick, self.from, &self.moves, &self.tolerance);
        let choice = chosen.map(|(_, choice)| choice);
        let mut run = self.moves.clone();
        run.push(Move::Dwell { duration: self.period });
        let trajectory = Trajectory::plan(self.from, &run, &Limits::default(), self.tick)?;
        let bend = self.bend(&trajectory)?;
        let away = away(&trajectory, self.tick);
        let ladder = Rung::ladder(&self.arm);
        let errors = |truth: &[Sample]| {
            let of = |rung| self.errors(&run, rung, bend, truth, &away);
            ladder.map(|rung| of(rung).unwrap_or([f64::INFINITY; 2]))
        };
        let mut truth = self.truth(&trajectory, &JUDGE)?;
        let mut found = errors(&truth);
        let close = |ratio: &f64| (ratio - 1.0).abs() < MARGIN;
        let closely = found.as_flattened().iter().any(close);
        if closely {
            truth = self.truth(&trajectory, &CLOSE)?;
            found = errors(&truth);
        }
        let doubt = if index.is_multiple_of(STRICT_EACH) {
            let strict = errors(&self.truth(&trajectory, &STRICT)?);
            Some(doubt(&found, &strict))
        } else {
            None
        };
        let ticks = trajectory.ticks();
        let errors = found.map(larger);
        let tolerance = self.tolerance;
        let mut verdict =
            Verdict { tolerance, ticks, ladder, choice, errors, parts: None, closely, doubt };
        verdict.parts = verdict.chosen().map(|rung| found[rung]);
        Ok(verdict)
    }

    fn truth(&self, trajectory: &Trajectory, options: &rod::Options) -> Result<Vec<Sample>, Error> {
        let times: Vec<f64> = (0..=trajectory.ticks()).map(|k| k as f64 * self.tick).collect();
        Ok(rod::solve(&self.arm, trajectory, &times, options)?)
    }

    /// Tip angle that the rungs are set up for, as `auto` does.
    fn bend(&self, trajectory: &Trajectory) -> Result<f64, Error> {
        let peaks = trajectory.plans().iter().map(|plan| plan.outline.peaks.acceleration);
        let bend = Rod::<1>::new(&self.arm)?.bend(peaks.fold(0.0, f64::max));
        let (least, most) = Elastica::<f32, 1>::BEND;
        Ok(bend.clamp(least, most))
    }

    /// Largest distance of the tip from the truth and largest difference of the torque at the ticks
    /// that are `away` from jumps, each over its tolerance.
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

/// By tick, true if it is one and a half ticks or more from every jump of the commanded acceleration,
/// as `compare` has it.
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

/// Largest change of a rung's error over its tolerance by a stricter judge, of the rungs that either
/// finds within twice the tolerance.
fn doubt(errors: &[[f64; 2]], strict: &[[f64; 2]]) -> f64 {
    let pairs = errors.as_flattened().iter().zip(strict.as_flattened());
    let pairs = pairs.filter(|(a, b)| a.min(**b) <= 2.0);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
