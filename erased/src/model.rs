//! Element models by their number of elements. No other place lists them.

use stillbeam::model::{Model, Modes};
use stillbeam::stepper::Newmark;
use stillbeam::{Error, Scene};

use crate::{Erasable, Refused, Scalar};

/// How the elements' mass is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mass {
    /// By the element's shape functions.
    Consistent,
    /// Half at each node.
    Lumped,
}

/// Action on a model whose type is known only here.
pub trait ModelVisitor {
    /// Result of the action.
    type Output;

    /// Receives the model.
    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Self::Output
    where
        Model<N, W>: Marched;
}

/// A model whose time marching is one of the steppers that are compiled here.
pub trait Marched {
    /// Newmark of it.
    type Newmark<T: Scalar>: Erasable;

    /// Sets Newmark up for ticks of `tick` s, without the spin's terms if `spin` is false.
    ///
    /// # Errors
    /// Those of [`Newmark::new`].
    fn newmark<T: Scalar>(&self, tick: f64, spin: bool) -> Result<Self::Newmark<T>, Error>;
}

/// Implements it for models by their unknowns and bandwidth.
macro_rules! marched {
    ($($n:literal, $w:literal;)*) => {
        $(
            impl Marched for Model<$n, $w> {
                type Newmark<T: Scalar> = Newmark<T, $n, $w>;

                fn newmark<T: Scalar>(
                    &self,
                    tick: f64,
                    spin: bool,
                ) -> Result<Self::Newmark<T>, Error> {
                    let stepper = Newmark::new(self, tick)?;
                    Ok(if spin { stepper } else { stepper.without_spin() })
                }
            }
        )*
    };
}

marched! {
    1, 1;
    2, 2;
    3, 3;
    4, 4;
    5, 5;
    8, 4;
    8, 8;
    9, 9;
    16, 4;
}

/// Builds the model of `elements` (1, 2, 4 or 8) and hands it to the visitor.
///
/// # Errors
/// Another number of elements, and what the model refuses.
pub fn with_model<V: ModelVisitor>(
    scene: &Scene,
    elements: usize,
    mass: Mass,
    visitor: V,
) -> Result<V::Output, Refused> {
    // Lumped rotations are condensed, but for the tip's if the payload gives it an inertia.
    let tip_turns = scene.payload.inertia > 0.0;
    Ok(match (mass, elements) {
        (Mass::Consistent, 1) => visitor.visit(Model::<2, 2>::consistent(scene)?),
        (Mass::Consistent, 2) => visitor.visit(Model::<4, 4>::consistent(scene)?),
        (Mass::Consistent, 4) => visitor.visit(Model::<8, 4>::consistent(scene)?),
        (Mass::Consistent, 8) => visitor.visit(Model::<16, 4>::consistent(scene)?),
        (Mass::Lumped, 1) if tip_turns => visitor.visit(Model::<2, 2>::lumped::<2>(scene)?),
        (Mass::Lumped, 1) => visitor.visit(Model::<1, 1>::lumped::<2>(scene)?),
        (Mass::Lumped, 2) if tip_turns => visitor.visit(Model::<3, 3>::lumped::<4>(scene)?),
        (Mass::Lumped, 2) => visitor.visit(Model::<2, 2>::lumped::<4>(scene)?),
        (Mass::Lumped, 4) if tip_turns => visitor.visit(Model::<5, 5>::lumped::<8>(scene)?),
        (Mass::Lumped, 4) => visitor.visit(Model::<4, 4>::lumped::<8>(scene)?),
        (Mass::Lumped, 8) if tip_turns => visitor.visit(Model::<9, 9>::lumped::<16>(scene)?),
        (Mass::Lumped, 8) => visitor.visit(Model::<8, 8>::lumped::<16>(scene)?),
        (_, elements) => return Err(Refused::Elements(elements)),
    })
}

/// Returns the first natural period of the clamped arm, hub at rest, no gravity, s.
///
/// # Errors
/// Those of [`with_model`].
pub fn first_period(scene: &Scene, elements: usize, mass: Mass) -> Result<f64, Refused> {
    struct FirstPeriod;
    impl ModelVisitor for FirstPeriod {
        type Output = f64;
        fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> f64
        where
            Model<N, W>: Marched,
        {
            Modes::of(&model).first_period()
        }
    }
    with_model(scene, elements, mass, FirstPeriod)
}
