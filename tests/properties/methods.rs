//! Every stepper, in either precision, behind one trait.

use proptest::test_runner::TestCaseResult;
use stillbeam::model::{EightElements, FourElements, Model, OneElement, Rod, TwoElements};
use stillbeam::stepper::{Elastica, Modal, Newmark, Pointwise, Quality, Rigid};
use stillbeam::{Error, Scalar, Scene, Stepper};

use crate::arms::BEND;

/// One stepper.
pub trait Method {
    /// In messages.
    const NAME: &'static str;
    /// Linear in the hub's motion, in the horizontal plane.
    const LINEAR: bool;
    /// In the precision of the tick.
    type Stepper<T: Scalar>: Stepper<Scalar = T> + Copy;

    /// Sets it up in f64.
    fn stepper<T: Scalar>(scene: &Scene, tick: f64) -> Result<Self::Stepper<T>, Error>;
}

/// A property of a method.
pub trait Property {
    /// Fails where it does not.
    fn holds<M: Method>(&self) -> TestCaseResult;
}

macro_rules! methods {
    ($($type:ident: $name:literal, $linear:literal, $stepper:ty, $build:expr;)*) => {
        $(
            enum $type {}

            impl Method for $type {
                const NAME: &'static str = $name;
                const LINEAR: bool = $linear;
                type Stepper<T: Scalar> = $stepper;

                fn stepper<T: Scalar>(scene: &Scene, tick: f64) -> Result<$stepper, Error> {
                    let build: fn(&Scene, f64) -> Result<$stepper, Error> = $build;
                    build(scene, tick)
                }
            }
        )*

        /// Checks every method.
        pub fn all(property: &impl Property) -> TestCaseResult {
            $(property.holds::<$type>()?;)*
            Ok(())
        }
    };
}

/// Fitted for more than the moves bend.
const FITTED: f64 = 1.5 * BEND;

methods! {
    RigidArm: "rigid", true, Rigid<T>, |s, h| Rigid::new(s, h);
    Newmark1: "newmark, 1 element", false, Newmark<T, 2, 2>,
        |s, h| Newmark::new(&OneElement::consistent(s)?, h);
    Newmark1Slow: "newmark, 1 element, no spin", true, Newmark<T, 2, 2>,
        |s, h| Ok(Newmark::new(&OneElement::consistent(s)?, h)?.without_spin());
    Newmark2: "newmark, 2 elements", false, Newmark<T, 4, 4>,
        |s, h| Newmark::new(&TwoElements::consistent(s)?, h);
    Newmark4Slow: "newmark, 4 elements, no spin", true, Newmark<T, 8, 4>,
        |s, h| Ok(Newmark::new(&FourElements::consistent(s)?, h)?.without_spin());
    Newmark8: "newmark, 8 elements", false, Newmark<T, 16, 4>,
        |s, h| Newmark::new(&EightElements::consistent(s)?, h);
    Modal1: "modal, 1 mode", false, Modal<T, 1>,
        |s, h| Modal::new(&FourElements::consistent(s)?, h);
    Modal2Slow: "modal, 2 modes, no spin", true, Modal<T, 2>,
        |s, h| Ok(Modal::new(&FourElements::consistent(s)?, h)?.without_spin());
    Modal3: "modal, 3 modes", false, Modal<T, 3>,
        |s, h| Modal::new(&EightElements::consistent(s)?, h);
    Modal2Lumped: "modal, 2 modes, lumped", false, Modal<T, 2>, |s, h| {
        // The payload's rotary inertia keeps one more degree of freedom.
        if s.payload.inertia > 0.0 {
            Modal::new(&Model::<5, 5>::lumped::<8>(s)?, h)
        } else {
            Modal::new(&Model::<4, 4>::lumped::<8>(s)?, h)
        }
    };
    Elastica1: "elastica, 1 mode, fast", false, Elastica<T, 1>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fast, FITTED);
    Elastica2: "elastica, 2 modes, fast", false, Elastica<T, 2>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fast, FITTED);
    Elastica2Fine: "elastica, 2 modes, fine", false, Elastica<T, 2>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fine, FITTED);
    Elastica3: "elastica, 3 modes, fine", false, Elastica<T, 3>,
        |s, h| Elastica::new(&Rod::new(s)?, h, Quality::Fine, FITTED);
    Pointwise2: "pointwise, 2 modes", false, Pointwise<T, 2>, |s, h| Pointwise::new(s, h);
    Pointwise3: "pointwise, 3 modes", false, Pointwise<T, 3>, |s, h| Pointwise::new(s, h);
}
