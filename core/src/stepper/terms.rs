//! Terms of a tick that a scene needs.

use crate::math::{Scalar, words};
use crate::scene::{LinkShape, Scene};

/// Terms that the scene needs; the others cost nothing but a branch that never changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms {
    pub spin: bool,
    pub gravity: bool,
    pub damping: bool,
}

impl Terms {
    pub fn of<P: Scalar, S: LinkShape>(scene: &Scene<P, S>) -> Self {
        Self {
            // A carriage does not turn.
            spin: !scene.mount.is_linear(),
            gravity: scene.in_plane_gravity() != P::ZERO,
            damping: !scene.damping.is_zero(),
        }
    }
}

words! {
    [] Terms: spin, gravity, damping;
}
