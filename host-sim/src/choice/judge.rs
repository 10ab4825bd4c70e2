//! What one choice is worth: the true error of every rung.

use stillbeam::beam::Rod;
use stillbeam::motion::Limits;
use stillbeam::stepper::{Auto, Elastica, Rung};
use stillbeam::{Error as CoreError, Generator, Move};

use super::random::Case;
use super::verdict::Verdict;
use crate::error::Error;
use crate::reference::{Sample, rod};
use crate::trajectory::Trajectory;

/// The judge. Its steps are bound by the highest polynomial's vibration, the tolerance hardly counts.
pub(super) const JUDGE: rod::Options = rod::Options { order: 6, tolerance: 1e-6, integrator: None };

/// The judge where it is close.
pub(super) const CLOSE: rod::Options = rod::Options { order: 7, ..JUDGE };

/// Where it is close: a rung that errs by the tolerance, give or take this part of it.
pub(super) const MARGIN: f64 = 0.1;

/// The judge's judge.
pub(super) const STRICT: rod::Options = rod::Options { order: 8, tolerance: 1e-8, ..JUDGE };

/// Every so many arms the judge itself is judged.
pub(super) const STRICT_EACH: u64 = 50;

/// Segments in a generator: all moves of a case at once.
const QUEUE: usize = 64;

impl Case {
    /// Chooses, and judges every rung over the moves and one first period after them.
    pub fn judge(&self, index: u64) -> Result<Verdict, Error> {
        let chosen =
            Auto::<f32>::choose(&self.arm, self.tick, self.from, &self.moves, self.tolerance);
        let choice = chosen.map(|(_, choice)| choice);
        let mut run = self.moves.clone();
        run.push(Move::Dwell { duration: self.period });
        let trajectory = Trajectory::plan(self.from, &run, &Limits::default(), self.tick)?;
        let bend = self.bend(&trajectory)?;
        let errors = |truth: &[Sample]| {
            Rung::ladder(&self.arm)
                .map(|rung| self.tip_error(&run, rung, bend, truth).unwrap_or(f64::INFINITY))
        };
        let mut truth = self.truth(&trajectory, &JUDGE)?;
        let mut found = errors(&truth);
        let close = |error: &f64| (error / self.tolerance - 1.0).abs() < MARGIN;
        let closely = found.iter().any(close);
        if closely {
            truth = self.truth(&trajectory, &CLOSE)?;
            found = errors(&truth);
        }
        let doubt = if index.is_multiple_of(STRICT_EACH) {
            let strict = errors(&self.truth(&trajectory, &STRICT)?);
            Some(doubt(&found, &strict, self.tolerance))
        } else {
            None
        };
        let ticks = trajectory.ticks();
        let (tolerance, ladder) = (self.tolerance, Rung::ladder(&self.arm));
        Ok(Verdict { tolerance, ticks, ladder, choice, errors: found, closely, doubt })
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

    /// Largest distance of the tip from the truth, fraction of L.
    fn tip_error(
        &self,
        run: &[Move],
        rung: Rung,
        bend: f64,
        truth: &[Sample],
    ) -> Result<f64, CoreError> {
        let stepper = Auto::<f32>::new(&self.arm, self.tick, rung, bend)?;
        let mut generator = Generator::<_, QUEUE>::new(stepper, self.from)?;
        for motion in run {
            generator.push(motion)?;
        }
        let apart =
            |sample: &Sample| distance(generator.tick().global_tip().map(f64::from), sample.tip);
        let far = |x: f64, y: f64| if y <= x { x } else { y };
        Ok(truth.iter().map(apart).fold(0.0, far) / self.arm.link.length)
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Largest change of a rung's error by a stricter judge, of the rungs that either finds within twice
/// the tolerance, over the tolerance.
fn doubt(errors: &[f64], strict: &[f64], tolerance: f64) -> f64 {
    let pairs = errors.iter().zip(strict).filter(|(a, b)| a.min(**b) <= 2.0 * tolerance);
    pairs.map(|(a, b)| (a - b).abs() / tolerance).fold(0.0, f64::max)
}
