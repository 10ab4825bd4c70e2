//! Feed-forward setpoints of one move, as a controller would receive them.

use super::Run;
use crate::error::Error;
use crate::solver::{Method, SolverKeys};

/// Setpoints of member B with 30 g.
#[derive(Clone, Debug)]
pub struct Setpoints {
    /// Run of the default solver: f32, one consistent element, every 10 ms.
    pub flexible: Run,
    /// The same move of a link that does not bend.
    pub rigid: Run,
}

impl Setpoints {
    /// Runs π in 2 s and 2 s of rest, undamped.
    pub fn compute() -> Result<Self, Error> {
        let rigid = SolverKeys { method: Some(Method::Rigid), ..SolverKeys::default() };
        Ok(Self {
            flexible: Run::embedded("b-tip30", SolverKeys::default())?,
            rigid: Run::embedded("b-tip30", rigid)?,
        })
    }

    /// Returns the largest |torque| of a run, N m.
    pub fn peak_torque(run: &Run) -> f64 {
        run.rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max)
    }
}
