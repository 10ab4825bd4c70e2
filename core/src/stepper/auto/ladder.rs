//! The rungs, and the error to expect of one.

use core::fmt;

use super::trial::Outcome;
use crate::stepper::Quality;

/// A stepper without its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rung {
    /// The arm does not bend.
    Rigid,
    /// Small deflections in that many modes, 1 to 3.
    Modal(usize),
    /// Exact kinematics in that many modes, 1 to 3.
    Elastica(usize, Quality),
}

impl Rung {
    /// Every rung, in the order of what its tick costs on the target.
    /// A third mode of small deflections costs as much as one of the exact kinematics, and is the
    /// better of the two next to never: it is not tried.
    pub const LADDER: [Self; 8] = [
        Self::Rigid,
        Self::Modal(1),
        Self::Modal(2),
        Self::Elastica(1, Quality::Fast),
        Self::Elastica(2, Quality::Fast),
        Self::Elastica(3, Quality::Fast),
        Self::Elastica(2, Quality::Fine),
        Self::FINEST,
    ];

    /// The last.
    pub const FINEST: Self = Self::Elastica(3, Quality::Fine);
}

impl fmt::Display for Rung {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let modes = |n: usize| if n == 1 { "mode" } else { "modes" };
        match *self {
            Self::Rigid => write!(f, "rigid"),
            Self::Modal(n) => write!(f, "modal, {n} {}", modes(n)),
            Self::Elastica(n, Quality::Fast) => write!(f, "elastica, {n} {}, fast", modes(n)),
            Self::Elastica(n, Quality::Fine) => write!(f, "elastica, {n} {}, fine", modes(n)),
        }
    }
}

/// What [`Auto::choose`](super::Auto::choose) decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The cheapest that is good enough.
    pub rung: Rung,
    /// Largest distance of its tip from the real one to expect, fraction of L: the distance seen
    /// in the trial, and what the trial's own reference leaves out.
    pub error: f64,
    /// Tip angle relative to the hub that it is set up for, rad.
    pub bend: f64,
}

/// Error to expect of a rung whose tip was `distance` away, both fractions of L.
pub(super) fn expected(distance: f64, floor: f64) -> f64 {
    1.02 * distance + floor
}

/// What the trial's reference itself leaves out. `finest` is the finest rung's outcome, `twin` that
/// of the reference's twin, fitted for [`TWIN_RANGE`] times the bend; `w` the largest deflection
/// over L.
///
/// The expansion's error shows as the distance of the twins; the modes beyond the third make
/// `1e-4 w`; the steps, of second order, a third of what quartering the finest rung's made. Twice
/// the first two held for all but 2 of 145 random arms with `w` of 0.4 to 1.
pub(super) fn floor(finest: &Outcome, twin: &Outcome) -> f64 {
    let w = finest.deflection;
    2.0 * (twin.distance + 1e-4 * w + 2e-6) + finest.distance / 3.0
}

/// See [`floor`].
pub(super) const TWIN_RANGE: f64 = 1.45;
