//! Runs a stepper beside the exact rod over the moves that it is meant for.

use super::exact::{Exact, Shape};
use crate::Error;
use crate::beam::Rod;
use crate::generator::Generator;
use crate::math::{Scalar, sqrt};
use crate::motion::{Limits, MAX_SEGMENTS, Move, Plan, Start};
use crate::scene::Scene;
use crate::stepper::Stepper;

/// Segments that wait in the candidate's generator: two of the longest moves.
const QUEUE: usize = 2 * MAX_SEGMENTS;

/// Longest rest after the moves, ticks.
const MAX_SETTLE: f64 = 2000.0;

/// Modes of the exact rod, of as many polynomials. Where the motion jumps, what five leave out is a
/// tenth of a tolerance of 1e-3; six leave a tenth of that.
const MODES: usize = 6;

/// What a stepper is tried on.
pub(super) struct Trial<'a> {
    exact: Exact<f32, MODES>,
    /// h, s.
    tick: f64,
    /// First hub angle, rad.
    from: f64,
    moves: &'a [Move],
    /// Rest after the moves, s.
    settle: f64,
    /// L, m.
    length: f64,
}

/// What was seen, fractions of L.
pub(super) struct Outcome {
    /// Largest distance between the two tips; infinite where one of them has none.
    pub distance: f64,
    /// Largest deflection of the exact rod.
    pub deflection: f64,
    /// Steps that the exact rod took.
    pub steps: u32,
}

impl<'a> Trial<'a> {
    /// With a rest of one first period after the moves.
    pub fn new(scene: &Scene, tick: f64, from: f64, moves: &'a [Move]) -> Result<Self, Error> {
        let rod = Rod::<MODES>::of_polynomials::<MODES>(scene)?;
        let settle = core::f64::consts::TAU / rod.frequency()[0];
        let exact = Exact::new(&rod, tick);
        Ok(Self { exact, tick, from, moves, settle, length: scene.link.length })
    }

    /// Tries a candidate, up to the end or until it is further than `most` away.
    pub fn run<S: Stepper<Scalar = f32>>(&self, candidate: S, most: f64) -> Result<Outcome, Error> {
        let mut generator = Generator::<S, QUEUE>::new(candidate, self.from)?;
        let mut outcome = Outcome { distance: 0.0, deflection: 0.0, steps: 0 };
        let mut start = Start::at_rest(self.from)?;
        let mut shape: Option<Shape<f32, MODES>> = None;
        let settle = (self.settle / self.tick).clamp(1.0, MAX_SETTLE) * self.tick;
        let settle = Move::Dwell { duration: settle };
        let moves = || self.moves.iter().chain([&settle]);
        let mut waiting = moves();
        if let Some(motion) = waiting.next() {
            generator.push(motion)?;
        }
        generator.tick();
        for motion in moves() {
            // While one move runs the next one waits: none begins late.
            if let Some(next) = waiting.next() {
                generator.push(next)?;
            }
            let plan = Plan::new(motion, start, &Limits::default(), self.tick)?;
            start = plan.outline.end;
            for (i, segment) in plan.segments.iter().enumerate() {
                let (count, segment_f32) = (segment.count(), segment.cast::<f32>());
                let after = plan.segments.get(i + 1).map_or(0.0, |next| next.ticks_before());
                let mut at = -segment.ticks_before();
                let shape =
                    shape.get_or_insert_with(|| self.exact.equilibrium(&segment_f32.hub_at(0.0)));
                for k in 0..count {
                    outcome.steps += self.exact.advance(shape, &segment_f32, at, f64::from(k));
                    at = f64::from(k);
                    outcome.watch(self.exact.tip(shape), generator.setpoint().tip, self.length);
                    if outcome.distance > most {
                        return Ok(outcome);
                    }
                    generator.tick();
                }
                let end = f64::from(count) - after;
                outcome.steps += self.exact.advance(shape, &segment_f32, at, end);
            }
        }
        if let Some(shape) = &shape {
            outcome.watch(self.exact.tip(shape), generator.setpoint().tip, self.length);
        }
        Ok(outcome)
    }
}

impl Outcome {
    fn watch(&mut self, exact: [f32; 2], candidate: [f32; 2], length: f64) {
        let [x, y] = [0, 1].map(|i| (exact[i] - candidate[i]).to_f64());
        let distance = sqrt(x * x + y * y) / length;
        // Not a number is no distance.
        self.distance =
            if distance.is_finite() { self.distance.max(distance) } else { f64::INFINITY };
        self.deflection = self.deflection.max(exact[1].to_f64().abs() / length);
    }
}
