//! A request for a still move, and the results for it.

use rayon::prelude::*;
use stillbeam::planner::{Prediction, ShortestMove};
use stillbeam::{Limits, Scene};

use super::Options;
use super::asked::Asked;
use super::judge::{Judgement, Motion};
use super::kept::Kept;
use super::shortest::{self, INTERVALS};
use crate::error::Error;
use crate::limits::{Case, Window, load};
use crate::step::Step;

/// Frequency errors of a sensitivity curve.
pub const ERRORS: [f64; 17] = [
    -0.2, -0.175, -0.15, -0.125, -0.1, -0.075, -0.05, -0.025, 0.0, 0.025, 0.05, 0.075, 0.1, 0.125,
    0.15, 0.175, 0.2,
];

/// Request for a still move.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// The arm.
    pub arm: Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// Hub angle at the end, rad.
    pub to: f64,
    /// Duration, s. `None` asks for the shortest within the limits.
    pub duration: Option<f64>,
    /// Limits of the drive.
    pub limits: Limits,
    /// Fraction to which the arm's frequencies are known, for a robust move.
    pub robust: Option<f64>,
    /// Residual that the move may leave, and quantity that it keeps least.
    pub options: Options,
    /// h, s.
    pub tick: f64,
}

/// A plan and its judgement.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The plan.
    pub plan: ShortestMove<INTERVALS>,
    /// Prediction of the planner.
    pub prediction: Prediction,
    /// `2π/ω₁`, s.
    pub first_period: f64,
    /// Judgement by the reference rod.
    pub judgement: Judgement,
    /// Peak loads of the reference rod, over the move and a first period after it.
    pub loads: load::Peaks,
    /// `(frequency error, residual)`, fractions.
    pub sensitivity: Vec<(f64, f64)>,
}

impl Request {
    /// Plans in f32, as the target does, within the limits on the reference rod.
    pub fn plan(&self) -> Result<Kept, Error> {
        self.asked().plan()
    }

    fn asked(&self) -> Asked<'_> {
        let Self { arm, from, to, duration, limits, robust, options, tick } = self;
        let before = Case { arm, from: *from, steps: &[], shaper: None, tick: *tick };
        let (from, to, duration, robust) = (*from, *to, *duration, *robust);
        let (options, settle, count) = (*options, 0.0, 1);
        Asked { before, limits, from, to, duration, robust, options, settle, count }
    }

    /// Returns the rod's peak loads along a motion.
    fn loads(&self, motion: Step) -> Result<load::Peaks, Error> {
        let steps = [motion];
        let case = self.asked().before.with(&steps);
        let trajectory = case.trajectory()?;
        let window = Window { index: 0, begin: 0.0, end: trajectory.duration() };
        Ok(load::fly(&case, &trajectory, &window, &load::FINE, None, &|_| ())?.0)
    }

    /// Plans and judges. `tick` is called once for each of [`ERRORS`].
    pub fn carry_out(&self, tick: &(dyn Fn() + Sync)) -> Result<Planned, Error> {
        let (plan, prediction, first_period) = match self.asked().plan_fastest()? {
            Some((fastest, period)) => (ShortestMove::Fastest(fastest), fastest.prediction, period),
            None => {
                let Kept { plan, prediction, first_period } = self.plan()?;
                (ShortestMove::Still(plan), prediction, first_period)
            }
        };
        let along = shortest::motion(&plan);
        let motion = Motion::of(self.from, along.clone(), self.tick);
        let judgements = ERRORS
            .par_iter()
            .map(|&error| {
                let judgement = motion.judge(&self.arm, error);
                tick();
                judgement
            })
            .collect::<Result<Vec<_>, _>>()?;
        let residuals = judgements.iter().map(|judgement| judgement.residual);
        let sensitivity = ERRORS.into_iter().zip(residuals).collect();
        let judgement = judgements[ERRORS.len() / 2].clone();
        let loads = self.loads(Step { motion: along, settle: 0.0 })?;
        Ok(Planned { plan, prediction, first_period, judgement, loads, sensitivity })
    }
}

impl Planned {
    /// Returns the residual at a frequency error of [`ERRORS`], fraction of L.
    pub fn residual_at(&self, error: f64) -> f64 {
        let off = |entry: &&(f64, f64)| (entry.0 - error).abs() < 1e-9;
        self.sensitivity.iter().find(off).map_or(f64::NAN, |entry| entry.1)
    }
}
