//! Fig. 5: the length of the step.

use super::Run;
use crate::compare::compare;
use crate::error::Error;
use crate::solver::{Scalar, SolverKeys};

/// Runs of member A with 30 g over the step.
#[derive(Clone, Debug)]
pub struct Steps {
    /// Run at [`FINEST`], by which the others are judged. Every tenth of its rows is kept.
    pub finest: Run,
    /// Residual vibration of the finest run, fraction of L.
    pub finest_residual: f64,
    /// Runs at longer steps, ascending.
    pub steps: Vec<Step>,
}

/// One step.
#[derive(Clone, Debug)]
pub struct Step {
    /// The run.
    pub run: Run,
    /// Largest distance of the tip from the finest run's, fraction of L.
    pub tip_max: f64,
    /// Root mean square distance of the tip from the finest run's, fraction of L.
    pub tip_rms: f64,
    /// Residual vibration, fraction of L.
    pub residual: f64,
}

/// Step of the finest run, s.
pub const FINEST: f64 = 0.1e-3;

/// Steps of the study, s. The paper settles on 10 ms.
const STEPS: [f64; 7] = [1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 50e-3, 100e-3];

impl Steps {
    /// Runs π in 2 s and 2 s of rest, undamped, one consistent element.
    pub fn compute() -> Result<Self, Error> {
        let run = |tick| {
            let keys =
                SolverKeys { tick: Some(tick), scalar: Some(Scalar::F64), ..SolverKeys::default() };
            Run::embedded("a-tip30", keys)
        };
        let mut finest = run(FINEST)?;
        let step = |tick| -> Result<Step, Error> {
            let run = run(tick)?;
            let apart = compare(&run.rows, &finest.rows, &run.scene)?;
            let residual = run.residual()?;
            Ok(Step { run, tip_max: apart.tip_max, tip_rms: apart.tip_rms, residual })
        };
        let steps = STEPS.into_iter().map(step).collect::<Result<_, _>>()?;
        let finest_residual = finest.residual()?;
        finest.rows = finest.rows.into_iter().step_by(10).collect();
        Ok(Self { finest, finest_residual, steps })
    }
}
