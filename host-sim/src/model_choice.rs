//! From numbers that a user types to the model types of the core: the one place that lists them.

use stillbeam::Scene;
use stillbeam::beam::{Model, Modes};

use crate::error::Error;
use crate::solver::Mass;

/// What to do with a model whose type is only known here.
pub trait Visitor {
    /// What comes out.
    type Output;

    /// Receives the model.
    fn visit<const N: usize, const W: usize>(
        self,
        model: Model<N, W>,
    ) -> Result<Self::Output, Error>;
}

/// Builds the model of `elements` (1, 2, 4 or 8) and hands it to the visitor.
pub fn with_model<V: Visitor>(
    scene: &Scene,
    elements: usize,
    mass: Mass,
    visitor: V,
) -> Result<V::Output, Error> {
    // Lumped rotations are condensed, but for the tip's if the payload gives it an inertia.
    let tip_turns = scene.payload.inertia > 0.0;
    match (mass, elements) {
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
        (_, n) => Err(Error::new(format_args!("solver.elements = {n}: accepted is 1, 2, 4 or 8"))),
    }
}

/// First natural period of the clamped arm, hub at rest, no gravity, s.
pub fn first_period(scene: &Scene, elements: usize, mass: Mass) -> Result<f64, Error> {
    struct FirstPeriod;
    impl Visitor for FirstPeriod {
        type Output = f64;
        fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Result<f64, Error> {
            Ok(Modes::of(&model).first_period())
        }
    }
    with_model(scene, elements, mass, FirstPeriod)
}
