//! Knowledge of the hub's motion within a tick, as types: a step is written once, and what its
//! motion does not need folds away when it is compiled.

use crate::math::Scalar;
use crate::motion::Kink;

/// Kind of the hub's motion within a tick. The constants are those of the type, so that a branch on
/// them costs nothing.
pub trait HubMotion: sealed::Sealed {
    /// θ̈ is a straight line from the beginning of the tick to its end.
    const LINEAR: bool;
    /// The hub rests at the beginning of the tick, at its end and in between.
    const AT_REST: bool;
}

/// Any motion.
#[derive(Clone, Copy, Debug)]
pub struct AnyMotion;

/// A linear acceleration, in a segment for which
/// [`Stepper::is_linear_fast`](super::Stepper::is_linear_fast) holds.
#[derive(Clone, Copy, Debug)]
pub struct Linear;

/// A hub at rest.
#[derive(Clone, Copy, Debug)]
pub struct AtRest;

impl HubMotion for AnyMotion {
    const LINEAR: bool = false;
    const AT_REST: bool = false;
}

impl HubMotion for Linear {
    const LINEAR: bool = true;
    const AT_REST: bool = false;
}

impl HubMotion for AtRest {
    const LINEAR: bool = false;
    const AT_REST: bool = true;
}

mod sealed {
    pub trait Sealed {}

    impl Sealed for super::AnyMotion {}
    impl Sealed for super::Linear {}
    impl Sealed for super::AtRest {}
}

/// The motions for which a stepper has code of its own. The generator links none for the others and
/// advances them as any motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FastPaths {
    /// [`Linear`].
    pub linear: bool,
    /// [`AtRest`].
    pub at_rest: bool,
    /// True if the code for [`AtRest`] is so large that every tick at rest is to share it, where
    /// the last of a rest would else have a copy of its own.
    pub large: bool,
}

impl FastPaths {
    /// Both motions.
    pub const BOTH: Self = Self { linear: true, at_rest: true, large: false };
}

/// By how much the commanded acceleration departs, within a tick, from the parabola with the mean
/// and the ends that a step is given: its moments, rad/s².
#[derive(Clone, Copy, Debug)]
pub enum KinkMoments<'a, T: Scalar> {
    /// By how much `∫₀¹(1 − s)θ̈ ds` exceeds that of the parabola, `s` the fraction of the tick:
    /// what two segments of a move have that meet inside a tick.
    First(T),
    /// All that matter, of the jumps that a shaper's delays put inside a tick.
    All(&'a Kink<T>),
}
