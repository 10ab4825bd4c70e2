//! A still move as it is asked for, and all that is found out about it.

use rayon::prelude::*;
use stillbeam::motion::{Angle, Origin, Still, StillMove, Survey};
use stillbeam::{Limits, Scene};

use super::judge::{Judgement, Motion};
use crate::error::Error;

/// Frequency errors of a sensitivity curve.
pub const ERRORS: [f64; 17] = [
    -0.2, -0.175, -0.15, -0.125, -0.1, -0.075, -0.05, -0.025, 0.0, 0.025, 0.05, 0.075, 0.1, 0.125,
    0.15, 0.175, 0.2,
];

/// What to plan.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// The arm.
    pub arm: Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// Hub angle at the end, rad.
    pub to: f64,
    /// s; the shortest within the limits where there is none.
    pub duration: Option<f64>,
    /// What the drive can do.
    pub limits: Limits,
    /// The fraction to which the arm's frequencies are known, for a robust move.
    pub robust: Option<f64>,
    /// h, s.
    pub tick: f64,
}

/// A plan and its judgement.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The plan.
    pub plan: StillMove,
    /// What its planner expects.
    pub survey: Survey,
    /// `2π/ω₁`, s.
    pub first_period: f64,
    /// What the reference rod does.
    pub judgement: Judgement,
    /// `(frequency error, residual)`, fractions.
    pub sensitivity: Vec<(f64, f64)>,
}

impl Request {
    /// Plans, in f32 as the target does.
    pub fn plan(&self) -> Result<(StillMove, Survey, f64), Error> {
        let planner = match self.robust {
            Some(spread) => Still::<f32, 2>::robust(&self.arm, self.tick, spread)?,
            None => Still::<f32, 2>::new(&self.arm, self.tick)?,
        };
        let (plan, survey) = match self.duration {
            None => planner.shortest(self.from, self.to, &self.limits)?,
            Some(duration) => {
                let from = Origin::at_rest(Angle::from_radians(self.from));
                planner.within(&from, None, self.to, duration, &self.limits)?
            }
        };
        Ok((plan, survey, planner.first_period()))
    }

    /// Plans and judges; `tick` is called once for each of [`ERRORS`].
    pub fn carry_out(&self, tick: &(dyn Fn() + Sync)) -> Result<Planned, Error> {
        let (plan, survey, first_period) = self.plan()?;
        let motion = Motion::of(self.from, plan.motion(), self.tick);
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
        Ok(Planned { plan, survey, first_period, judgement, sensitivity })
    }
}

impl Planned {
    /// Residual at a frequency error of [`ERRORS`], fraction of L.
    pub fn residual_at(&self, error: f64) -> f64 {
        let off = |entry: &&(f64, f64)| (entry.0 - error).abs() < 1e-9;
        self.sensitivity.iter().find(off).map_or(f64::NAN, |entry| entry.1)
    }
}
