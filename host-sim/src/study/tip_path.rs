//! Fig. 1: the path of a rigid link's tip, and of the flexible one's.

use super::Run;
use crate::error::Error;
use crate::solver::{Method, Scalar, SolverKeys};

/// Both paths of the same move.
#[derive(Clone, Debug)]
pub struct TipPath {
    /// Run of a link that does not bend.
    pub rigid: Run,
    /// Run with one consistent element.
    pub flexible: Run,
}

/// The paper's step for its section 3, s.
pub const TICK: f64 = 0.4e-3;

impl TipPath {
    /// Runs member D bare, π in 0.2 s and 0.2 s of rest.
    pub fn compute() -> Result<Self, Error> {
        let keys =
            SolverKeys { tick: Some(TICK), scalar: Some(Scalar::F64), ..SolverKeys::default() };
        Ok(Self {
            rigid: Run::embedded("d-fast", SolverKeys { method: Some(Method::Rigid), ..keys })?,
            flexible: Run::embedded("d-fast", keys)?,
        })
    }
}
