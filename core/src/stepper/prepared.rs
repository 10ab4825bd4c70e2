//! The steppers as prepared words.

use super::{Elastica, Modal, Newmark, OnCarrier, Pointwise, Rigid, Stepper};
use crate::math::{Scalar, Words, mix, named};
use crate::prepared::{Prepare, Prepared, sizes};

/// Implements both traits for a stepper: its family in four letters, and its sizes.
macro_rules! prepared {
    ($([$($generics:tt)*] $type:ty: $family:literal, $n:expr, $w:expr, $variant:expr;)*) => {
        $(
            impl<$($generics)*> Prepare for $type {
                fn kind(&self) -> [u32; 3] {
                    Self::KIND
                }

                fn period(&self) -> f64 {
                    Stepper::tick(self)
                }

                fn put_own(&self, sink: &mut dyn FnMut(u32)) {
                    self.put(sink);
                }
            }

            impl<$($generics)*> Prepared for $type {
                const KIND: [u32; 3] =
                    [u32::from_le_bytes(*$family), sizes::<T>($n, $w, $variant), Self::LAYOUT];
            }
        )*
    };
}

prepared! {
    [T: Scalar] Rigid<T>: b"rigi", 0, 0, false;
    [T: Scalar, const N: usize, const W: usize, const AXES: bool] Newmark<T, N, W, AXES>:
        b"newm", N, W, AXES;
    [T: Scalar, const K: usize] Modal<T, K>: b"moda", K, 0, false;
    [T: Scalar, const K: usize] Elastica<T, K>: b"elas", K, 0, false;
    [T: Scalar, const K: usize] Pointwise<T, K>: b"poin", K, 0, false;
}

/// The arm's own kind, the family in capitals.
const fn carried([family, sizes, layout]: [u32; 3]) -> [u32; 3] {
    [family & !u32::from_le_bytes([0x20; 4]), sizes, mix(layout, named("carrier"))]
}

impl<S: Stepper + Prepare> Prepare for OnCarrier<S> {
    fn kind(&self) -> [u32; 3] {
        carried(self.arm().kind())
    }

    fn period(&self) -> f64 {
        self.arm().period()
    }

    fn put_own(&self, sink: &mut dyn FnMut(u32)) {
        self.arm().put_own(sink);
        self.carrier().put(sink);
    }
}

impl<S: Stepper + Prepared> Prepared for OnCarrier<S> {
    const KIND: [u32; 3] = carried(S::KIND);
}
