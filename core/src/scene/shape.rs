//! Distribution of stiffness and mass along the link.

use core::fmt::Debug;

use super::Varied;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Uniform {}
    impl Sealed for super::Varied {}
}

/// The way in which stiffness and mass are distributed along a link: [`Uniform`] or [`Varied`].
///
/// A type rather than a value, so that a program for uniform links holds no code for others.
pub trait LinkShape: sealed::Sealed + Copy + Debug + PartialEq {
    /// The sections and masses, if the link is not a uniform one.
    fn varied(&self) -> Option<&Varied>;
}

/// A link with the same stiffness and mass per length everywhere, and nothing mounted on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Uniform;

impl LinkShape for Uniform {
    #[inline(always)]
    fn varied(&self) -> Option<&Varied> {
        None
    }
}

impl LinkShape for Varied {
    fn varied(&self) -> Option<&Varied> {
        (!self.is_uniform()).then_some(self)
    }
}
