//! Runs a stepper beside a finer one over the moves that it is meant for.

use crate::Error;
use crate::generator::Generator;
use crate::math::{Scalar, sqrt};
use crate::motion::{MAX_SEGMENTS, Move};
use crate::stepper::{Elastica, Stepper};

/// Segments that wait in its generators: two of the longest moves.
const QUEUE: usize = 2 * MAX_SEGMENTS;

/// Longest rest after the moves, ticks.
const MAX_SETTLE: f64 = 1000.0;

/// What a stepper is tried on.
pub(super) struct Trial<'a> {
    /// The finer one, at the tick or half of it.
    pub reference: Elastica<f32, 3>,
    /// First hub angle, rad.
    pub from: f64,
    pub moves: &'a [Move],
    /// Rest after the moves, s.
    pub settle: f64,
    /// L, m.
    pub length: f64,
}

/// What was seen, fractions of L.
pub(super) struct Outcome {
    /// Largest distance between the two tips.
    pub distance: f64,
    /// Largest deflection of the reference.
    pub deflection: f64,
}

impl Trial<'_> {
    pub(super) fn run<S: Stepper<Scalar = f32>>(&self, candidate: S) -> Result<Outcome, Error> {
        let tick = candidate.tick();
        // One or two of the reference's.
        let finer = if candidate.tick() > 1.5 * self.reference.tick() { 2 } else { 1 };
        let mut fine = Generator::<_, QUEUE>::new(self.reference, self.from)?;
        let mut coarse = Generator::<S, QUEUE>::new(candidate, self.from)?;
        let mut outcome = Outcome { distance: 0.0, deflection: 0.0 };
        let mut watch = |fine: &Generator<_, QUEUE>, coarse: &Generator<S, QUEUE>| {
            let (a, b): ([f32; 2], [f32; 2]) = (fine.setpoint().tip, coarse.setpoint().tip);
            let [x, y] = [0, 1].map(|i| (a[i] - b[i]).to_f64());
            outcome.distance = outcome.distance.max(sqrt(x * x + y * y) / self.length);
            outcome.deflection = outcome.deflection.max(a[1].to_f64().abs() / self.length);
        };
        let settle = Move::Dwell { duration: (self.settle / tick).clamp(1.0, MAX_SETTLE) * tick };
        let mut waiting = self.moves.iter().chain([&settle]);
        let mut push = |fine: &mut Generator<_, QUEUE>, coarse: &mut Generator<S, QUEUE>| {
            let Some(motion) = waiting.next() else { return Ok(0) };
            let ticks = coarse.push(motion)?.ticks;
            // The same whole number of the candidate's ticks.
            fine.push(&motion.lasting(f64::from(ticks) * tick))?;
            Ok(ticks)
        };
        let mut ticks = push(&mut fine, &mut coarse)?;
        fine.tick();
        coarse.tick();
        while ticks > 0 {
            // While one move runs the next one waits: none begins late.
            let next = push(&mut fine, &mut coarse)?;
            for _ in 0..ticks {
                watch(&fine, &coarse);
                for _ in 0..finer {
                    fine.tick();
                }
                coarse.tick();
            }
            ticks = next;
        }
        watch(&fine, &coarse);
        Ok(outcome)
    }
}
