//! Still moves as they are asked for.

use stillbeam::Limits;

use super::Options;
use crate::limits::Case;

/// A still move as it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The moves before it, the arm, the shaper and the tick.
    pub before: Case<'a>,
    /// Limits of the drive.
    pub limits: &'a Limits,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// Hub angle at the end, rad.
    pub to: f64,
    /// Duration, s. `None` asks for the shortest within the limits.
    pub duration: Option<f64>,
    /// Fraction to which the arm's frequencies are known, for a robust move.
    pub robust: Option<f64>,
    /// Residual that it may leave, and quantity that it keeps least.
    pub options: Options,
    /// Time after it, s.
    pub settle: f64,
    /// Number of moves in the scene.
    pub count: usize,
}
