//! The choice: the ladder tried, cheapest rung first.

use heapless::Vec;

use super::Auto;
use super::candidate::Candidate;
use super::ladder::{Assessment, Choice, Rung, Tolerance};
use super::trial::Trial;
use crate::model::Rod;
use crate::motion::{Commanded, Move, Moves};
use crate::stepper::{Elastica, OnCarrier, Stepper, check_tick};
use crate::{Error, Scene};

/// Rungs that are tried at once: half of the ladder, so that the exact rod flies twice at most.
const AT_ONCE: usize = 4;

/// Reason why there is no choice, and the nearest rung.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoChoice {
    /// [`Error::Tolerance`] with the error of the finest rung, or why the finest cannot be set up
    /// for this motion.
    pub error: Error,
    /// The rung that comes nearest to the tolerances, if one can follow at all.
    pub nearest: Option<Choice>,
}

impl From<NoChoice> for Error {
    fn from(none: NoChoice) -> Self {
        none.error
    }
}

/// Chooses the cheapest rung whose tip and torque stay within `tolerance` of the real ones, over
/// the motion and one first period after it.
///
/// Four rungs at a time, cheapest first, are flown along the motion beside the exact rod in six
/// modes and small steps. What that costs at set-up stands in `docs/auto.md`: the exact rod flies
/// once or twice, each time in at most 60,000 steps or 32 a tick, whichever is more. `progress` is
/// given the part that is done, 0 to 1.
// Inlined, as generics are: a crate that chooses nothing compiles none of the candidates.
#[inline]
#[allow(clippy::result_large_err)] // Once a set-up, and there is no heap to put it on.
pub fn choose(
    scene: &Scene,
    tick: f64,
    motion: &dyn Commanded,
    tolerance: &Tolerance,
    progress: &mut dyn FnMut(f64),
) -> Result<Choice, NoChoice> {
    let mut search = Search { nearest: None, steps: 0 };
    let found = if scene.mount.carrier == 0.0 {
        let set_up = |rung, bend| Auto::<f32>::new(scene, tick, rung, bend);
        search.run(scene, tick, motion, tolerance, progress, &set_up)
    } else {
        let set_up = |rung, bend| OnCarrier::<Auto<f32>>::of_rung(scene, tick, rung, bend);
        search.run(scene, tick, motion, tolerance, progress, &set_up)
    };
    found.map_err(|error| {
        let nearest = search.nearest.map(|choice| choice.costing(search.steps));
        NoChoice { error, nearest }
    })
}

/// [`choose`] for moves from rest at `from` rad, with the error alone if there is no choice.
#[inline]
pub(super) fn choose_for_moves(
    scene: &Scene,
    tick: f64,
    from: f64,
    moves: &[Move],
    tolerance: &Tolerance,
) -> Result<Choice, Error> {
    let motion = Moves::new(from, moves, check_tick(tick)?)?;
    Ok(choose(scene, tick, &motion, tolerance, &mut |_| ())?)
}

/// The errors to expect of a stepper along a motion and one first period after it. Runs the exact
/// rod beside it, once.
pub fn assess<S: Stepper>(
    scene: &Scene,
    stepper: S,
    motion: &dyn Commanded,
    progress: &mut dyn FnMut(f64),
) -> Result<Assessment, Error> {
    let trial = Trial::new(scene, stepper.tick(), motion)?;
    let mut candidates = [trial.candidate(stepper)?];
    let assessment = trial.fly(&mut candidates, f64::INFINITY, progress)?;
    let [candidate] = candidates;
    match candidate.error {
        Some(error) => Err(error),
        None => Ok(assessment(&candidate)),
    }
}

/// Sets up a rung, for a tip angle of so many rad.
type SetUp<'a, S> = &'a dyn Fn(Rung, f64) -> Result<S, Error>;

/// Rungs that are tried at once.
struct Part<S: Stepper> {
    names: Vec<Rung, AT_ONCE>,
    candidates: Vec<Candidate<S>, AT_ONCE>,
    /// Error of the last rung that cannot be set up.
    refused: Option<Error>,
}

impl<S: Stepper> Part<S> {
    /// Sets the rungs up, for a motion that bends the arm by `expected` rad.
    ///
    /// # Errors
    /// An arm that cannot stand upright, which no rung changes, nor one that seems stiff.
    fn new(
        trial: &Trial<'_>,
        rungs: &[Rung],
        expected: f64,
        set_up: SetUp<'_, S>,
    ) -> Result<Self, Error> {
        let (_, most) = Elastica::<f32, 3>::BEND;
        let bend = Elastica::<f32, 3>::nearest_bend(expected);
        let mut part = Self { names: Vec::new(), candidates: Vec::new(), refused: None };
        for &rung in rungs {
            let candidate = if rung.is_elastica() && expected > most {
                Err(Error::BendsTooFar { bend: expected, max: most })
            } else {
                set_up(rung, bend).and_then(|stepper| trial.candidate(stepper))
            };
            match candidate {
                // There is room for as many as are tried at once.
                Ok(candidate) => {
                    let _ = (part.names.push(rung), part.candidates.push(candidate));
                }
                Err(error @ Error::Buckles { .. }) => return Err(error),
                // Else the scene and the motion are valid: it is the rung that cannot do it.
                Err(error) => part.refused = Some(error),
            }
        }
        Ok(part)
    }
}

/// A choice under way.
struct Search {
    nearest: Option<Choice>,
    steps: u32,
}

impl Search {
    fn run<S: Stepper>(
        &mut self,
        scene: &Scene,
        tick: f64,
        motion: &dyn Commanded,
        tolerance: &Tolerance,
        progress: &mut dyn FnMut(f64),
        set_up: SetUp<'_, S>,
    ) -> Result<Choice, Error> {
        let (tick, tolerance) = (check_tick(tick)?, tolerance.validate()?);
        let expected_bend = Rod::<1>::new(scene)?.bend(motion.peaks().acceleration);
        let bend = Elastica::<f32, 3>::nearest_bend(expected_bend);
        let trial = Trial::new(scene, tick, motion)?;
        let ladder = Rung::ladder(scene);
        let parts = ladder.len().div_ceil(AT_ONCE) as f64;
        let mut reason = Error::Tolerance {
            parameter: "solver.tolerance",
            tolerance: tolerance.tip,
            best: f64::INFINITY,
        };
        for (part, rungs) in ladder.chunks(AT_ONCE).enumerate() {
            let Part { names, mut candidates, refused } =
                Part::new(&trial, rungs, expected_bend, set_up)?;
            reason = refused.unwrap_or(reason);
            if candidates.is_empty() {
                continue;
            }
            // The finest is tried to the end, to tell its error.
            let stop = if names.contains(&Rung::FINEST) { f64::INFINITY } else { tolerance.tip };
            let mut part_of = |done: f64| progress((part as f64 + done) / parts);
            let assess = trial.fly(&mut candidates, stop, &mut part_of)?;
            for (&rung, candidate) in names.iter().zip(&candidates) {
                if let Some(error) = candidate.error {
                    reason = error;
                    continue;
                }
                let expected = assess(candidate);
                let choice = Choice { rung, expected, bend };
                reason = expected.fault(&tolerance);
                // What was given up on the way may be further off than was seen: it is no nearest.
                if !candidate.follows(stop) {
                    continue;
                }
                if self.take(choice, &tolerance) {
                    return Ok(choice.costing(self.steps + expected.steps));
                }
            }
            self.steps += candidates.first().map_or(0, |first| assess(first).steps);
        }
        Err(reason)
    }

    /// Returns true if the rung is good enough, and keeps it if it is the nearest so far.
    fn take(&mut self, choice: Choice, tolerance: &Tolerance) -> bool {
        let excess = choice.expected.excess(tolerance);
        let nearer = |other: Choice| excess < other.expected.excess(tolerance);
        if excess.is_finite() && self.nearest.is_none_or(nearer) {
            self.nearest = Some(choice);
        }
        excess <= 1.0
    }
}

impl Choice {
    fn costing(mut self, steps: u32) -> Self {
        self.expected.steps = steps;
        self
    }
}
