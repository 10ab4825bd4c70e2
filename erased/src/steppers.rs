//! All steppers of a precision as three types: those with the same fast paths are one, so that each
//! ticks on the paths that it takes when a firmware links it by itself. What is generic over a
//! stepper, its generator above all, is thereby compiled three times and not once for each.

use std::any::type_name;

use stillbeam::hub::{GravityDirection, HubState};
use stillbeam::motion::Peaks;
use stillbeam::prepared::Prepare;
use stillbeam::select::Auto;
use stillbeam::stepper::{
    Elastica, FastPaths, HubMotion, KinkMoments, Modal, Newmark, OnCarrier, Pointwise, Response,
    Rigid,
};
use stillbeam::{Error, Stepper};

use crate::Scalar;

/// What a stepper needs to have for a generator of it to be handed from thread to thread.
pub trait Held:
    Stepper<Scalar: Scalar, State: Send + Sync> + Prepare + Clone + Send + Sync + 'static
{
}

impl<S> Held for S where
    S: Stepper<Scalar: Scalar, State: Send + Sync> + Prepare + Clone + Send + Sync + 'static
{
}

/// A stepper whose type can be left open.
pub trait Erasable: Held {
    /// The type that it shares with others.
    type Any: Held + Stepper<Scalar = Self::Scalar>;

    /// Returns it as the shared type. It gives the same bits.
    fn into_any(self) -> Self::Any;
}

impl<S: Erasable> Erasable for OnCarrier<S> {
    type Any = OnCarrier<S::Any>;

    fn into_any(self) -> Self::Any {
        self.map(S::into_any)
    }
}

/// The rung itself: `Auto` only says that it was chosen.
impl<T: Scalar> Erasable for Auto<T> {
    type Any = Fast<T>;

    fn into_any(self) -> Fast<T> {
        match self {
            Self::Rigid(stepper) => Fast::Rigid(stepper),
            Self::Modal1(stepper) => Fast::Modal1(stepper),
            Self::Modal2(stepper) => Fast::Modal2(stepper),
            Self::Modal3(stepper) => Fast::Modal3(stepper),
            Self::Elastica1(stepper) => Fast::Elastica1(stepper),
            Self::Elastica2(stepper) => Fast::Elastica2(stepper),
            Self::Elastica3(stepper) => Fast::Elastica3(stepper),
        }
    }
}

/// Declares a type for steppers with the same fast paths, and one for their states.
macro_rules! shared {
    ($(#[$about:meta])* $any:ident, $state:ident, $fast:expr;
     $($variant:ident: $stepper:ty;)*) => {
        $(#[$about])*
        #[derive(Clone)]
        #[allow(clippy::large_enum_variant)] // A generator holds its stepper without a box, too.
        pub enum $any<T: Scalar> {
            $($variant($stepper),)*
        }

        /// The state of such a stepper: of the same variant.
        #[derive(Clone, Copy)]
        #[allow(clippy::large_enum_variant)]
        pub enum $state<T: Scalar> {
            $($variant(<$stepper as Stepper>::State),)*
        }

        $(
            impl<T: Scalar> Erasable for $stepper {
                type Any = $any<T>;

                fn into_any(self) -> $any<T> {
                    $any::$variant(self)
                }
            }
        )*

        impl<T: Scalar> $any<T> {
            /// Evaluated at compile time: the paths are those of every stepper.
            const PATHS: FastPaths = {
                let all: FastPaths = $fast;
                $(
                    let own = <$stepper as Stepper>::FAST;
                    assert!(own.linear == all.linear && own.at_rest == all.at_rest);
                )*
                all
            };

            /// A state is made by the stepper that it is given to.
            fn mismatch() -> ! {
                unreachable!("the state of another stepper than {}", type_name::<Self>())
            }
        }

        impl<T: Scalar> Stepper for $any<T> {
            type Scalar = T;
            type State = $state<T>;

            const FAST: FastPaths = Self::PATHS;

            fn tick(&self) -> f64 {
                match self {
                    $(Self::$variant(stepper) => stepper.tick(),)*
                }
            }

            fn gravity(&self) -> &GravityDirection<T> {
                match self {
                    $(Self::$variant(stepper) => stepper.gravity(),)*
                }
            }

            fn is_linear_fast(&self, rate: T) -> bool {
                match self {
                    $(Self::$variant(stepper) => stepper.is_linear_fast(rate),)*
                }
            }

            fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
                match self {
                    $(Self::$variant(stepper) => stepper.admit(peaks, held),)*
                }
            }

            fn equilibrium(&self, hub: &HubState<T>) -> $state<T> {
                match self {
                    $(Self::$variant(stepper) => $state::$variant(stepper.equilibrium(hub)),)*
                }
            }

            // The steps of all steppers are inlined here, once.
            #[inline(never)]
            fn step<M: HubMotion>(
                &self,
                state: &mut $state<T>,
                before: &HubState<T>,
                after: &HubState<T>,
            ) {
                match (self, state) {
                    $((Self::$variant(stepper), $state::$variant(own)) => {
                        stepper.step::<M>(own, before, after)
                    })*
                    _ => Self::mismatch(),
                }
            }

            #[inline(never)]
            fn response<M: HubMotion>(
                &self,
                state: &$state<T>,
                hub: &HubState<T>,
            ) -> Response<T> {
                match (self, state) {
                    $((Self::$variant(stepper), $state::$variant(own)) => {
                        stepper.response::<M>(own, hub)
                    })*
                    _ => Self::mismatch(),
                }
            }

            #[inline(never)]
            fn tip_angle(&self, state: &$state<T>) -> T {
                match (self, state) {
                    $((Self::$variant(stepper), $state::$variant(own)) => stepper.tip_angle(own),)*
                    _ => Self::mismatch(),
                }
            }

            #[inline(never)]
            fn kink(&self, state: &mut $state<T>, moments: KinkMoments<'_, T>) {
                match (self, state) {
                    $((Self::$variant(stepper), $state::$variant(own)) => {
                        stepper.kink(own, moments)
                    })*
                    _ => Self::mismatch(),
                }
            }

            #[inline(never)]
            fn is_settled(&self, state: &$state<T>) -> bool {
                match (self, state) {
                    $((Self::$variant(stepper), $state::$variant(own)) => stepper.is_settled(own),)*
                    _ => Self::mismatch(),
                }
            }
        }

        /// The words of the stepper itself, which a program loads by its own type.
        impl<T: Scalar> Prepare for $any<T> {
            fn kind(&self) -> [u32; 3] {
                match self {
                    $(Self::$variant(stepper) => stepper.kind(),)*
                }
            }

            fn period(&self) -> f64 {
                self.tick()
            }

            fn put_own(&self, sink: &mut dyn FnMut(u32)) {
                match self {
                    $(Self::$variant(stepper) => stepper.put_own(sink),)*
                }
            }
        }
    };
}

shared! {
    /// Steppers with paths of their own for linear accelerations and for a hub at rest.
    Fast, FastState, FastPaths::BOTH;
    Rigid: Rigid<T>;
    Newmark1: Newmark<T, 1, 1>;
    Newmark2: Newmark<T, 2, 2>;
    Modal1: Modal<T, 1>;
    Modal2: Modal<T, 2>;
    Modal3: Modal<T, 3>;
    Elastica1: Elastica<T, 1>;
    Elastica2: Elastica<T, 2>;
    Elastica3: Elastica<T, 3>;
}

shared! {
    /// Steppers with a path of their own for a hub at rest, by their unknowns and bandwidth.
    FastAtRest, FastAtRestState, FastPaths { linear: false, at_rest: true, large: false };
    Newmark3: Newmark<T, 3, 3>;
    Newmark4: Newmark<T, 4, 4>;
    Newmark5: Newmark<T, 5, 5>;
    Newmark8: Newmark<T, 8, 8>;
    Newmark8Banded: Newmark<T, 8, 4>;
    Newmark9: Newmark<T, 9, 9>;
    Newmark16Banded: Newmark<T, 16, 4>;
}

shared! {
    /// Steppers that step alike, whatever the motion.
    Plain, PlainState, FastPaths { linear: false, at_rest: false, large: false };
    Pointwise1: Pointwise<T, 1>;
    Pointwise2: Pointwise<T, 2>;
    Pointwise3: Pointwise<T, 3>;
}
