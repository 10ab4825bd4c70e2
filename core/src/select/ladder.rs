//! The rungs, and the error to expect of one.

use core::fmt;

use crate::Error;
use crate::scene::Scene;
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
    /// Left out: a third mode of small deflections costs as much as one of the exact kinematics,
    /// and a finer step of that one as much as a second, and they are the better of the two next to
    /// never.
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

    /// Every rung, in the order of what its tick costs on the target for that arm. Damping and
    /// gravity cost small deflections more than the exact kinematics. A test compares both orders
    /// with `docs/instructions.csv`.
    pub fn ladder(scene: &Scene) -> [Self; 8] {
        let mut ladder = Self::LADDER;
        if scene.in_plane_gravity() > 0.0 || !scene.damping.is_zero() {
            ladder.swap(2, 3);
            ladder.swap(5, 6);
        }
        ladder
    }

    /// True if it is set up for a bend.
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
            Self::Elastica(n, quality) => write!(f, "elastica, {n} {}, {quality}", modes(n)),
        }
    }
}

/// Largest errors that a choice may make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest distance of the tip from the real one, fraction of L, 1e-6 to 1.
    pub tip: f64,
    /// Largest difference of the torque from the real one at the ticks, fraction of its peak, from
    /// 1e-6 to one. Ticks less than one and a half ticks from a jump of the commanded acceleration
    /// are left out: what the torque is there depends on how many modes are taken for all of them.
    pub torque: f64,
}

impl Default for Tolerance {
    /// 0.1 % of L and 1 % of the torque's peak.
    fn default() -> Self {
        Self { tip: 1e-3, torque: 1e-2 }
    }
}

impl Tolerance {
    /// The tolerances themselves if both are in range.
    pub fn validate(self) -> Result<Self, Error> {
        Error::check("solver.tolerance", self.tip, 1e-6, 1.0, "of the length")?;
        Error::check("solver.torque_tolerance", self.torque, 1e-6, 1.0, "of the torque's peak")?;
        Ok(self)
    }
}

/// The errors to expect of a stepper on a motion, and the loads that the motion takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// Largest distance of the tip from the real one, fraction of L: the distance seen in the
    /// trial, and a little for what the trial itself leaves out. Infinite where the stepper has no
    /// answer.
    pub tip: f64,
    /// Largest difference of the torque, fraction of its peak, as [`Tolerance::torque`] has it.
    pub torque: f64,
    /// Largest magnitude of the exact rod's hub torque, between the ticks too, N m.
    pub peak_torque: f64,
    /// Largest magnitude of the exact rod's bending moment at the clamp, between the ticks too, N
    /// m.
    pub peak_moment: f64,
    /// Steps of the exact rod that were taken to find it.
    pub steps: u32,
}

impl Assessment {
    /// The larger of the two errors, each over its tolerance: at most 1 where both are kept.
    pub fn excess(&self, tolerance: &Tolerance) -> f64 {
        (self.tip / tolerance.tip).max(self.torque / tolerance.torque)
    }

    /// The error for a tolerance that is not kept: the one that is exceeded by the larger factor.
    pub(super) fn fault(&self, tolerance: &Tolerance) -> Error {
        if self.tip / tolerance.tip >= self.torque / tolerance.torque {
            let (tolerance, best) = (tolerance.tip, self.tip);
            Error::Tolerance { parameter: "solver.tolerance", tolerance, best }
        } else {
            let (tolerance, best) = (tolerance.torque, self.torque);
            Error::Tolerance { parameter: "solver.torque_tolerance", tolerance, best }
        }
    }
}

/// Result of a choice.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Choice {
    /// The cheapest that is good enough.
    pub rung: Rung,
    /// The errors to expect of it; its steps are those of the whole choice, and what it cost.
    pub expected: Assessment,
    /// Tip angle relative to the hub that it is set up for, rad.
    pub bend: f64,
}

/// Differences of a stepper from the exact rod in a trial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome {
    /// Largest distance between the two tips, fraction of L; infinite where one of them has none.
    pub distance: f64,
    /// Largest deflection of the exact rod, fraction of L.
    pub deflection: f64,
    /// Largest difference of the torques away from jumps, N m; infinite likewise.
    pub torque: f64,
    /// Largest torque of the exact rod at the ticks, N m.
    pub peak: f64,
}

impl Outcome {
    /// Error of the tip to expect, fraction of L: the distance from the exact rod, and what that
    /// leaves out, more polynomials and the rounding of long moves. Fewer than one in 200 of the
    /// 3,966 errors that six polynomials or more have judged over 4,000 arms is above that.
    pub fn tip(&self) -> f64 {
        1.005 * self.distance + 2e-5 * self.deflection + 2e-6
    }

    /// Error of the torque to expect, fraction of its peak: the difference from the exact rod with
    /// the ringing that it has lost, and what that leaves out, more polynomials and rounding.
    /// With these margins 2 of 6,709 choices over the 10,000 arms of `docs/auto.md` are beyond a
    /// tolerance, and 0.6 % two rungs too dear. With 1.02 and 1e-4 it would be 1, and 0.8 %.
    pub fn torque(&self) -> f64 {
        if self.torque == 0.0 { 0.0 } else { 1.005 * self.torque / self.peak + 3e-5 }
    }
}
