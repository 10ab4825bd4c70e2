//! The rungs, and the error to expect of one.

use core::fmt;

use super::trial::Outcome;
use crate::scene::{Damping, Scene};
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
    /// Every rung, in the order of what its tick costs on the target for an arm without damping and
    /// gravity.
    ///
    /// Left out: a third mode of small deflections costs as much as one of the exact kinematics, and
    /// a finer step of that one as much as a second, and they are the better of the two next to never.
    pub const LADDER: [Self; 8] = [
        Self::Rigid,
        Self::Modal(1),
        Self::Modal(2),
        Self::Elastica(1, Quality::Fast),
        Self::Elastica(2, Quality::Fast),
        Self::Elastica(2, Quality::Fine),
        Self::Elastica(3, Quality::Fast),
        Self::FINEST,
    ];

    /// The last.
    pub const FINEST: Self = Self::Elastica(3, Quality::Fine);

    /// Every rung, in the order of what its tick costs on the target for that arm. Damping and gravity
    /// cost small deflections more than the exact kinematics. A test compares both orders with
    /// `docs/instructions.csv`.
    pub fn ladder(scene: &Scene) -> [Self; 8] {
        let mut ladder = Self::LADDER;
        let Damping { alpha, beta } = scene.damping;
        if scene.gravity > 0.0 || alpha > 0.0 || beta > 0.0 {
            ladder.swap(2, 3);
            ladder.swap(5, 6);
        }
        ladder
    }

    /// Whether it is set up for a bend.
    pub(super) fn is_elastica(self) -> bool {
        matches!(self, Self::Elastica(..))
    }
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
    /// Largest distance of its tip from the real one to expect, fraction of L: the distance seen in
    /// the trial, and a little for what the trial itself leaves out.
    pub error: f64,
    /// Tip angle relative to the hub that it is set up for, rad.
    pub bend: f64,
    /// Steps of the exact rod that were taken to find it: the cost of the choice.
    pub steps: u32,
}

/// Error to expect of a rung, fraction of L: the distance from the exact rod, and what that leaves
/// out, more polynomials and the rounding of long moves.
pub(super) fn expected(outcome: &Outcome) -> f64 {
    1.02 * outcome.distance + 2e-5 * outcome.deflection + 2e-6
}
