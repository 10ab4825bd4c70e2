//! Names for common steppers, so that matrix sizes need not be counted.
//!
//! A number is that of elements for Newmark's rule, of modes for the others. The scalar is told:
//! `Newmark4::<f32>` on the target.

use super::{Elastica, Modal, Newmark};

/// One consistent element, for [`OneElement`](crate::model::OneElement): the cheapest stepper that
/// bends.
pub type Newmark1<T> = Newmark<T, 2, 2>;

/// Two consistent elements, for [`TwoElements`](crate::model::TwoElements).
pub type Newmark2<T> = Newmark<T, 4, 4>;

/// Four consistent elements, for [`FourElements`](crate::model::FourElements).
pub type Newmark4<T> = Newmark<T, 8, 4>;

/// Eight consistent elements, for [`EightElements`](crate::model::EightElements).
pub type Newmark8<T> = Newmark<T, 16, 4>;

/// Small deflections in one mode.
pub type Modal1<T> = Modal<T, 1>;

/// Small deflections in two modes.
pub type Modal2<T> = Modal<T, 2>;

/// Small deflections in three modes.
pub type Modal3<T> = Modal<T, 3>;

/// Exact kinematics in one mode.
pub type Elastica1<T> = Elastica<T, 1>;

/// Exact kinematics in two modes: the first choice for an arm that bends.
pub type Elastica2<T> = Elastica<T, 2>;

/// Exact kinematics in three modes, for slow loads and quick moves.
pub type Elastica3<T> = Elastica<T, 3>;
